/** Brings the page's charts to life: zoom, values under the pointer, keys, saving. Without it the page shows the same
 *  curves as still drawings (report/chart_svg.cpp), and so it does in print. */
import * as Plotly from 'plotly.js-basic-dist-min';
import type { PlotlyHTMLElement } from 'plotly.js-basic-dist-min';
import { button, embedded, fileName, make, save, withUnit } from '../dom';
import { onThemeChange } from '../theme';
import { csv, usable } from './data';
import type { ChartData } from './data';
import { home, layout, picture, traces } from './figure';
import type { Trace } from './figure';

const HINT =
  'Drag to zoom, double click to reset; wheel after a click. Keys: arrows move, + and − zoom, 0 resets, Shift with arrows reads values.';

class Chart {
  private readonly data: ChartData;
  private readonly canvas: HTMLElement;
  private readonly plot = make('div', { className: 'plotly-chart' });
  private readonly spoken = make('p', { className: 'unseen' });
  private readonly hidden = new Set<number>();
  private traces: Trace[] = [];
  private reading: { trace: number; point: number } | null = null;

  constructor(private readonly figure: HTMLElement) {
    this.data = JSON.parse(embedded(figure, 'application/json')) as ChartData;
    this.canvas = figure.querySelector<HTMLElement>('.canvas')!;
    this.spoken.setAttribute('role', 'status');
    this.canvas.append(this.plot, this.spoken);
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'application');
    this.canvas.setAttribute('aria-label', `${this.data.title}. ${HINT}`);
    this.addTools();
    this.legend();
    this.canvas.addEventListener('keydown', (event) => this.key(event));
    // The wheel belongs to the page until the reader has chosen the chart.
    this.canvas.addEventListener('wheel', (event) => {
      if (document.activeElement !== this.canvas && !event.ctrlKey) event.stopPropagation();
    }, { capture: true });
    this.canvas.addEventListener('pointerdown', () => this.canvas.focus({ preventScroll: true }), { capture: true });
    figure.append(make('p', { className: 'hint' }, HINT));
  }

  async start(): Promise<void> {
    this.figure.classList.add('live');
    await this.draw();
    onThemeChange(() => void this.draw(true));
    new ResizeObserver(() => {
      const { width, height } = this.size();
      if (Math.abs(width - this.live._fullLayout.width) > 1) void Plotly.relayout(this.live, { width, height });
    }).observe(this.canvas);
    this.figure.dataset.ready = 'yes';
  }

  private get live(): PlotlyHTMLElement & { _fullLayout: { width: number } } {
    return this.plot as unknown as PlotlyHTMLElement & { _fullLayout: { width: number } };
  }

  private size(): { width: number; height: number } {
    const width = Math.max(280, this.canvas.clientWidth);
    return { width, height: Math.round(Math.min(430, Math.max(280, width * 0.5))) };
  }

  private async draw(keepView = false): Promise<void> {
    this.traces = traces(this.data, this.hidden);
    const wanted = layout(this.data, this.size());
    if (keepView) {
      wanted.xaxis!.range = this.range('xaxis');
      wanted.yaxis!.range = this.range('yaxis');
    }
    await Plotly.react(this.plot, this.traces.map((trace) => trace.plot), wanted, {
      displayModeBar: false, scrollZoom: true, doubleClick: false, showTips: false, showAxisDragHandles: true, responsive: false,
    });
    if (!keepView) this.live.on('plotly_doubleclick', () => void this.reset());
    if (!keepView) this.live.on('plotly_unhover', () => (this.reading = null));
  }

  private range(axis: 'xaxis' | 'yaxis'): [number, number] {
    const [low, high] = this.live.layout[axis].range as [number, number];
    return [low, high];
  }

  private async reset(): Promise<void> {
    await Plotly.relayout(this.plot, { 'xaxis.range': home(this.data.x), 'yaxis.range': home(this.data.y) });
  }

  /** Moves by shares of what is shown, then scales about the middle. */
  private async view(right: number, up: number, scale: number): Promise<void> {
    const moved = ([low, high]: [number, number], by: number): [number, number] => {
      const middle = (low + high) / 2 + by * (high - low);
      return [middle - ((high - low) / 2) * scale, middle + ((high - low) / 2) * scale];
    };
    await Plotly.relayout(this.plot, { 'xaxis.range': moved(this.range('xaxis'), right), 'yaxis.range': moved(this.range('yaxis'), up) });
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const acts: Record<string, () => void> = event.shiftKey
      ? {
          ArrowRight: () => this.read(1, 0), ArrowLeft: () => this.read(-1, 0),
          ArrowDown: () => this.read(0, 1), ArrowUp: () => this.read(0, -1),
        }
      : {
          ArrowRight: () => void this.view(0.1, 0, 1), ArrowLeft: () => void this.view(-0.1, 0, 1),
          ArrowUp: () => void this.view(0, 0.1, 1), ArrowDown: () => void this.view(0, -0.1, 1),
        };
    Object.assign(acts, {
      '+': () => void this.view(0, 0, 0.8), '=': () => void this.view(0, 0, 0.8), '-': () => void this.view(0, 0, 1.25),
      '0': () => void this.reset(), Escape: () => void this.reset(),
    });
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  /** Goes along a curve, or on to the next one, and says the values there. */
  private read(along: number, across: number): void {
    const readable = this.traces.map((trace, k) => ({ trace, k }))
      .filter(({ trace }) => trace.plot.visible && trace.plot.hoverinfo !== 'skip')
      .map(({ trace, k }) => ({ trace, k, points: this.pointsOf(trace) })).filter(({ points }) => points.length > 0);
    if (!readable.length) return;
    const found = readable.findIndex(({ k }) => k === this.reading?.trace);
    const current = readable[(Math.max(0, found) + across + readable.length) % readable.length]!;
    const last = current.points.findIndex((point) => point >= (this.reading?.point ?? 0));
    const at = found < 0 ? 0 : Math.min(current.points.length - 1, Math.max(0, (last < 0 ? current.points.length - 1 : last) + along));
    const point = current.points[at]!;
    this.reading = { trace: current.k, point };
    (Plotly as unknown as { Fx: { hover: (plot: HTMLElement, points: object[]) => void } })
      .Fx.hover(this.plot, [{ curveNumber: current.k, pointNumber: point }]);
    const series = this.data.series[current.trace.series]!;
    const [x, y] = [(current.trace.plot.x as number[])[point]!, (current.trace.plot.y as number[])[point]!];
    this.spoken.textContent = `${series.name}: ${this.data.x.title} ${withUnit(x, this.data.x.unit)}, ${this.data.y.title} ${withUnit(y, this.data.y.unit)}`;
  }

  private pointsOf(trace: Trace): number[] {
    const [x, y] = [trace.plot.x as (number | null)[], trace.plot.y as (number | null)[]];
    return x.map((_, k) => k).filter((k) => usable(x[k], this.data.x) && usable(y[k], this.data.y));
  }

  private legend(): void {
    this.figure.querySelectorAll<HTMLElement>('.legend li').forEach((item, k) => {
      const entry = make('button', { type: 'button', title: 'Show or hide' }, ...item.childNodes);
      entry.setAttribute('aria-pressed', 'true');
      entry.addEventListener('click', () => {
        if (!this.hidden.delete(k)) this.hidden.add(k);
        entry.setAttribute('aria-pressed', String(!this.hidden.has(k)));
        void this.draw(true);
      });
      item.append(entry);
    });
  }

  private addTools(): void {
    const name = fileName(this.data.title, 'chart');
    this.figure.querySelector('.head')!.append(make('div', { className: 'tools' },
      button('Reset', 'Show everything again', () => void this.reset()),
      button('SVG', 'Save the drawing as it is shown, as vectors', () => void this.save(`${name}.svg`, 'svg')),
      button('PNG', 'Save the drawing as it is shown, as pixels', () => void this.save(`${name}.png`, 'png')),
      button('CSV', 'Save the data of every curve', () => save(`${name}.csv`, new Blob([csv(this.data)], { type: 'text/csv' }))),
    ));
  }

  private async save(name: string, format: 'svg' | 'png'): Promise<void> {
    const drawn = picture(this.data, this.traces, this.live.layout);
    const options = { format, width: drawn.layout.width!, height: drawn.layout.height!, scale: format === 'png' ? 2 : 1 };
    const url = await Plotly.toImage(drawn as unknown as Plotly.Root, options);
    const body = url.slice(url.indexOf(',') + 1);
    if (format === 'svg') { save(name, new Blob([decodeURIComponent(body)], { type: 'image/svg+xml' })); return; }
    const bytes = Uint8Array.from(atob(body), (c) => c.charCodeAt(0));
    save(name, new Blob([bytes], { type: 'image/png' }));
  }
}

// One after another, the first ones first: a page may hold many.
void (async () => {
  for (const figure of document.querySelectorAll<HTMLElement>('figure.chart')) await new Chart(figure).start();
})();
