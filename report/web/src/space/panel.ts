/** The controls below the picture. Each one changes the state and says so; none draws. */
import { button, make, shortNumber, withUnit } from '../dom';
import { MAPS } from './colours';
import type { MapName } from './colours';
import type { State } from './state';
import type { SceneData } from './unpack';

const MAGNIFICATIONS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

export interface Panel {
  element: HTMLElement;
  /** Shows what the state says, e.g. after a frame was played. */
  refresh: () => void;
  stop: () => void;
}

type Labelled = [label: string, control: HTMLElement, ...after: HTMLElement[]];

function group(title: string, ...rows: Labelled[]): HTMLFieldSetElement {
  const set = make('fieldset', {}, make('legend', {}, title));
  for (const [label, control, ...after] of rows) set.append(make('div', { className: 'row' }, make('label', {}, make('span', {}, label), control), ...after));
  return set;
}

function select(options: readonly string[], chosen: number, act: (k: number) => void): HTMLSelectElement {
  const element = make('select');
  options.forEach((text, k) => element.append(make('option', { value: String(k), selected: k === chosen }, text)));
  element.addEventListener('change', () => act(element.selectedIndex));
  return element;
}

function slider(min: number, max: number, step: number, value: number, act: (value: number) => void): HTMLInputElement {
  const element = make('input', { type: 'range', min: String(min), max: String(max), step: String(step) });
  element.value = String(value);
  element.addEventListener('input', () => act(element.valueAsNumber));
  return element;
}

function check(checked: boolean, act: (on: boolean) => void): HTMLInputElement {
  const element = make('input', { type: 'checkbox', checked });
  element.addEventListener('change', () => act(element.checked));
  return element;
}

function numberInput(value: number, act: (value: number) => void): HTMLInputElement {
  const element = make('input', { type: 'number', step: 'any' });
  element.value = String(Number(value.toPrecision(6)));
  element.addEventListener('change', () => {
    if (Number.isFinite(element.valueAsNumber)) act(element.valueAsNumber);
  });
  return element;
}

export function panel(scene: SceneData, state: State, look: (view: 'x' | 'y' | 'z' | 'iso') => void, changed: () => void): Panel {
  const { header } = scene;
  const frames = header.frames.length;
  const change = (by: Partial<State>): void => {
    Object.assign(state, by);
    refresh();
    changed();
  };

  // Time.
  let timer = 0;
  const stop = (): void => {
    clearInterval(timer);
    timer = 0;
    play.textContent = '▶ Play';
    play.setAttribute('aria-pressed', 'false');
  };
  const play = button('▶ Play', 'Play the frames one after another', () => {
    if (timer) { stop(); return; }
    if (state.frame === frames - 1) change({ frame: 0 });
    play.textContent = '❚❚ Pause';
    play.setAttribute('aria-pressed', 'true');
    timer = window.setInterval(() => {
      if (state.frame === frames - 1) { stop(); return; }
      change({ frame: state.frame + 1 });
    }, 140);
  });
  play.className = 'play';
  const time = slider(0, frames - 1, 1, state.frame, (frame) => {
    stop();
    change({ frame });
  });
  time.className = 'time';
  time.setAttribute('aria-label', 'Frame');
  const moment = make('output', { className: 'moment' });
  const timeline = make('div', { className: 'timeline', hidden: frames < 2 }, play, time, moment);

  // Colour.
  const field = (): SceneData['header']['fields'][number] | undefined => header.fields[state.field];
  const from = numberInput(state.from, (value) => change({ from: value }));
  const to = numberInput(state.to, (value) => change({ to: value }));
  from.setAttribute('aria-label', 'Colour scale from');
  to.setAttribute('aria-label', 'Colour scale to');
  const pickField = select(header.fields.map(({ name }) => name), state.field, (k) => {
    const { from: low, to: high } = header.fields[k]!;
    change({ field: k, from: low, to: high, threshold: 0 });
  });
  const maps = Object.keys(MAPS) as MapName[];
  const pickMap = select(maps.map((map) => MAPS[map].name), maps.indexOf(state.map), (k) => change({ map: maps[k]! }));
  const threshold = slider(0, 254, 1, 0, (value) => change({ threshold: value }));
  const thresholdWords = make('output');

  // Shape.
  const magnification = slider(0, MAGNIFICATIONS.length - 1, 1, 0, (k) => change({ magnification: MAGNIFICATIONS[k]! }));
  const magnificationWords = make('output');
  const cutWhere = slider(0, 1, 0.002, 0.5, (place) => change({ cutAt: cutPlace(place) }));
  const cutWords = make('output');
  const cutPlace = (place: number): number => {
    const axis = Math.max(0, state.cutAxis);
    const { low, quantum } = header.centres;
    return low[axis]! + place * 65535 * quantum[axis]!;
  };
  const cut = select(['none', 'across x', 'across y', 'across z'], 0, (k) => {
    state.cutAxis = k - 1;
    change({ cutAt: cutPlace(cutWhere.valueAsNumber) });
  });
  const flip = button('Flip', 'Keep the other side of the cut', () => change({ cutFlipped: !state.cutFlipped }));

  const broken = check(state.brokenOnly, (on) => change({ brokenOnly: on }));
  const shown: Labelled[] = [['Broken links only', broken]];
  if (header.mesh.nodes > 0) shown.push(['Finite element mesh', check(state.mesh, (on) => change({ mesh: on }))]);
  if (header.body.indices > 0) shown.push(['Impactor', check(state.body, (on) => change({ body: on }))]);
  const still = scene.frames.every((frame) => frame.displacements.every((code) => code === 0));

  const views = make('div', { className: 'views' }, ...(['x', 'y', 'z', 'iso'] as const).map((name) =>
    button(name === 'iso' ? 'Iso' : name, name === 'iso' ? 'Look from a corner (0)' : `Look along ${name} (${name})`, () => look(name))));
  const viewSet = make('fieldset', {}, make('legend', {}, 'View along'), views);

  const sets = [
    ...(header.fields.length ? [group('Colour', ['By', pickField], ['Map', pickMap], ['Scale', from, make('span', {}, 'to'), to])] : []),
    group('Cut', ['Plane', cut, flip], ['At', cutWhere, cutWords]),
    group('Shape',
      ...(still ? [] : [['Displacements ×', magnification, magnificationWords] as Labelled]),
      ...(header.fields.length ? [['Hide below', threshold, thresholdWords] as Labelled] : [])),
    group('Show', ...shown),
    viewSet,
  ];

  function refresh(): void {
    const frame = header.frames[state.frame]!;
    time.value = String(state.frame);
    time.setAttribute('aria-valuetext', frame.label);
    moment.textContent = `${frame.label}  (${state.frame + 1} of ${frames})`;
    from.value = String(Number(state.from.toPrecision(6)));
    to.value = String(Number(state.to.toPrecision(6)));
    threshold.value = String(state.threshold);
    const shownField = field();
    thresholdWords.textContent = state.threshold && shownField ? withUnit(shownField.low + shownField.quantum * state.threshold, shownField.unit, 3) : 'off';
    threshold.setAttribute('aria-valuetext', thresholdWords.textContent);
    magnificationWords.textContent = `${state.magnification}`;
    magnification.setAttribute('aria-valuetext', `${state.magnification} times`);
    const off = state.cutAxis < 0;
    cutWhere.disabled = flip.disabled = off;
    cutWords.textContent = off ? '' : `${'xyz'[state.cutAxis]!} = ${shortNumber(1e3 * state.cutAt, 3)} mm`;
    cutWhere.setAttribute('aria-valuetext', cutWords.textContent);
    flip.setAttribute('aria-pressed', String(state.cutFlipped));
  }
  refresh();
  return { element: make('div', { className: 'panel' }, timeline, make('div', { className: 'sets' }, ...sets)), refresh, stop };
}
