/** What lies over the picture: axes, a scale, the colour bar, the moment. Text of the page, so it follows its theme. */
import { make, shortNumber } from '../dom';
import { gradient } from './colours';
import type { State } from './state';
import type { SceneData } from './unpack';
import type { View } from './view';

const SVG = 'http://www.w3.org/2000/svg';

function svg(name: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  return element;
}

/** The longest round length that is not longer than `metres`, in words of mm or m. */
export function roundLength(metres: number): { metres: number; words: string } {
  const power = 10 ** Math.floor(Math.log10(metres));
  const digit = [5, 2, 1].find((n) => n * power <= metres * (1 + 1e-9)) ?? 1;
  const length = digit * power;
  return { metres: length, words: length >= 0.9999 ? `${shortNumber(length)} m` : `${shortNumber(1e3 * length)} mm` };
}

export class Overlay {
  readonly element = make('div', { className: 'overlay' });
  private readonly moment = make('div', { className: 'moment' });
  private readonly bar = make('div', { className: 'bar' });
  private readonly strip = make('div', { className: 'strip' });
  private readonly ticks = make('div', { className: 'ticks' });
  private readonly title = make('div', { className: 'title' });
  private readonly scale = make('div', { className: 'scale' });
  private readonly triad = svg('svg', { viewBox: '-36 -36 72 72', class: 'triad' });

  constructor(private readonly scene: SceneData, private readonly state: State) {
    this.element.setAttribute('aria-hidden', 'true');
    this.bar.append(this.title, make('div', { className: 'scale-body' }, this.strip, this.ticks));
    this.element.append(this.moment, this.bar, this.scale, this.triad);
  }

  /** After the reader has chosen something. */
  refresh(): void {
    const field = this.scene.header.fields[this.state.field];
    this.moment.textContent = this.scene.header.frames[this.state.frame]!.label;
    this.bar.hidden = !field || this.state.brokenOnly;
    if (!field) return;
    this.title.textContent = field.unit ? `${field.name} [${field.unit}]` : field.name;
    this.strip.style.background = gradient(this.state.map, 'to top');
    this.ticks.replaceChildren(...this.tickValues().map((value) => make('span', {}, shortNumber(value, 3))));
  }

  tickValues(): number[] {
    return [1, 0.75, 0.5, 0.25, 0].map((place) => this.state.from + place * (this.state.to - this.state.from));
  }

  /** After the camera has moved. */
  follow(view: View): void {
    const length = roundLength(130 * view.metresPerPixel());
    this.scale.textContent = length.words;
    this.scale.style.width = `${length.metres / view.metresPerPixel()}px`;
    const axes = view.axes().map((axis, k) => ({ axis, name: 'xyz'[k]! })).sort((a, b) => a.axis[2] - b.axis[2]);
    this.triad.replaceChildren(...axes.flatMap(({ axis: [right, up, near], name }) => {
      const label = svg('text', { x: 30 * right, y: -30 * up + 4, 'text-anchor': 'middle', opacity: near < -0.95 ? 0 : 1 });
      label.textContent = name;
      return [svg('path', { d: `M0 0L${(22 * right).toFixed(1)} ${(-22 * up).toFixed(1)}` }), label];
    }));
  }
}
