/** Views in space: each figure.space of the page becomes one. */
import { button, embedded, fileName, make, save, shortNumber, withUnit } from '../dom';
import { colour, onThemeChange } from '../theme';
import { Overlay } from './overlay';
import { panel } from './panel';
import type { Panel } from './panel';
import { picture } from './picture';
import { brokenLinks, isShown, placeOf, valueOf } from './state';
import type { State } from './state';
import { inflate, unpack } from './unpack';
import type { Header, SceneData } from './unpack';
import { View } from './view';

const HINT =
  'Drag turns, right drag or two fingers move, wheel after a click zooms. Keys: arrows turn, Shift with arrows moves, + and − zoom, ' +
  'x y z 0 look along axes and from a corner, space plays, , and . step, Enter reads the element in the middle.';

class Space {
  private readonly stage = make('div', { className: 'stage', tabIndex: 0 });
  private readonly status = make('p', { className: 'status' });
  private readonly reading = make('p', { className: 'reading' });
  private readonly overlay: Overlay;
  private readonly view: View;
  private readonly panel: Panel;
  private readonly state: State;
  private statusTimer = 0;

  constructor(private readonly figure: HTMLElement, private readonly scene: SceneData) {
    const field = scene.header.fields[0];
    this.state = {
      frame: scene.frames.length - 1, field: 0, map: 'magma', from: field?.from ?? 0, to: field?.to ?? 1, threshold: 0, magnification: 1,
      cutAxis: -1, cutAt: 0, cutFlipped: false, brokenOnly: false, mesh: true, body: true,
    };
    this.view = new View(scene, this.state, () => ({ ink: colour('ink'), soft: colour('soft'), broken: colour('missed') }));
    this.overlay = new Overlay(scene, this.state);
    this.panel = panel(scene, this.state, (name) => this.view.look(name), () => this.changed());
    this.reading.setAttribute('role', 'status');
    this.stage.setAttribute('role', 'application');
    this.stage.append(this.view.canvas, this.overlay.element);
    this.view.canvas.setAttribute('aria-hidden', 'true');
    this.view.onDrawn = () => {
      this.overlay.follow(this.view);
      figure.dataset.wholeTime = this.view.wholeTime.toFixed(1);
      figure.dataset.detail = this.view.detail.toFixed(3);
    };
    figure.querySelector('.head')!.append(make('div', { className: 'tools' },
      button('PNG', 'Save the picture as it is shown', () => void this.save())));
    figure.querySelector('.summary')!.after(this.stage, this.reading, this.panel.element, this.status);
    figure.append(make('p', { className: 'hint' }, HINT));
    this.listen();
    const fit = (): void => {
      const width = this.stage.clientWidth;
      this.view.resize(width, Math.round(Math.min(560, Math.max(300, 0.6 * width))));
    };
    fit();
    new ResizeObserver(() => {
      if (Math.abs(this.stage.clientWidth - this.view.canvas.clientWidth) > 1) fit();
    }).observe(this.stage);
    onThemeChange(() => this.changed());
    this.changed();
    this.view.whole();
    // For whoever wants to know how fast this machine draws it.
    Object.assign(figure, { measure: (turns: number, fraction: number) => this.view.measure(turns, fraction) });
    figure.dataset.ready = 'yes';
  }

  private changed(): void {
    this.view.update();
    this.overlay.refresh();
    this.figure.dataset.frame = String(this.state.frame);
    clearTimeout(this.statusTimer);
    this.statusTimer = window.setTimeout(() => this.say(), 120);
  }

  /** What is shown, in words. */
  private say(): void {
    const { header } = this.scene;
    let shown = 0, largest = -Infinity;
    for (let k = 0; k < header.elements; ++k) {
      if (!isShown(this.scene, this.state, k)) continue;
      ++shown;
      const value = valueOf(this.scene, this.state, k);
      if (value > largest) largest = value;
    }
    const field = header.fields[this.state.field];
    const count = (n: number): string => n.toLocaleString('en');
    const links = brokenLinks(this.scene, this.state);
    const words = [
      `${header.frames[this.state.frame]!.label}: ${count(shown)} of ${count(header.elements)} elements shown`,
      ...(field && Number.isFinite(largest) ? [`${field.name} up to ${withUnit(largest, field.unit, 3)}`] : []),
      `${count(links)} ${links === 1 ? 'link' : 'links'} broken`,
    ].join(', ');
    this.status.textContent = `${words}.`;
    this.stage.setAttribute('aria-label', `${header.title}, ${words}. ${HINT}`);
    this.figure.dataset.shown = String(shown);
  }

  private read(x: number, y: number): void {
    const k = this.view.pick(x, y);
    if (k < 0) {
      this.reading.textContent = '';
      return;
    }
    const [px, py, pz] = placeOf(this.scene, { ...this.state, magnification: 1 }, k).map((metres) => shortNumber(1e3 * metres, 4));
    const values = this.scene.header.fields.map((field, f) => `${field.name} ${withUnit(valueOf(this.scene, { ...this.state, field: f }, k), field.unit, 3)}`);
    this.reading.textContent = [`element ${k}`, `at (${px!}, ${py!}, ${pz!}) mm`, ...values].join('  ·  ');
  }

  private listen(): void {
    const { stage } = this;
    let pointer: { x: number; y: number } | null = null;
    stage.addEventListener('pointermove', (event) => {
      if (event.buttons) return;
      const frame = this.view.canvas.getBoundingClientRect();
      const waiting = pointer !== null;
      pointer = { x: event.clientX - frame.left, y: event.clientY - frame.top };
      if (!waiting)
        requestAnimationFrame(() => {
          if (pointer) this.read(pointer.x, pointer.y);
          pointer = null;
        });
    });
    stage.addEventListener('pointerdown', () => stage.focus({ preventScroll: true }));
    // The wheel belongs to the page until the reader has chosen the view.
    stage.addEventListener('wheel', (event) => {
      if (document.activeElement !== stage && !event.ctrlKey) event.stopPropagation();
    }, { capture: true });
    stage.addEventListener('keydown', (event) => this.key(event));
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const [view, shift] = [this.view, event.shiftKey];
    const arrow = (right: number, up: number) => (): void => (shift ? view.pan(-0.05 * right, -0.05 * up) : view.turn(-0.1 * right, 0.1 * up));
    const step = (by: number) => (): void => {
      this.panel.stop();
      this.state.frame = Math.min(this.scene.frames.length - 1, Math.max(0, this.state.frame + by));
      this.panel.refresh();
      this.changed();
    };
    const acts: Record<string, () => void> = {
      ArrowRight: arrow(1, 0), ArrowLeft: arrow(-1, 0), ArrowUp: arrow(0, 1), ArrowDown: arrow(0, -1),
      '+': () => view.zoom(1.2), '=': () => view.zoom(1.2), '-': () => view.zoom(1 / 1.2),
      x: () => view.look('x'), y: () => view.look('y'), z: () => view.look('z'), '0': () => view.look('iso'), Escape: () => view.look('iso'),
      ',': step(-1), '.': step(1), ' ': () => this.figure.querySelector<HTMLButtonElement>('.play')?.click(),
      Enter: () => this.read(view.canvas.clientWidth / 2, view.canvas.clientHeight / 2),
    };
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  private async save(): Promise<void> {
    this.view.whole();
    const { header } = this.scene;
    save(`${fileName(header.title, 'view')}-${this.state.frame + 1}.png`, await picture(this.view, this.scene, this.state, this.overlay));
  }
}

function instead(figure: HTMLElement, words: string): void {
  figure.querySelector('.summary')!.after(make('p', { className: 'absent' }, words));
  figure.dataset.ready = 'absent';
}

async function start(figure: HTMLElement): Promise<void> {
  if (!document.createElement('canvas').getContext('webgl2')) {
    instead(figure, 'The view in space needs WebGL 2, which this browser does not offer here. The text above says what it would show.');
    return;
  }
  const header = JSON.parse(embedded(figure, 'application/json')) as Header;
  new Space(figure, unpack(header, await inflate(embedded(figure, 'application/octet-stream'))));
}

for (const figure of document.querySelectorAll<HTMLElement>('figure.space'))
  start(figure).catch((error: unknown) => instead(figure, `The view in space could not be made: ${error instanceof Error ? error.message : String(error)}.`));
