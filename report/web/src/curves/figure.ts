/** A chart's data as Plotly's traces and layout, in the page's colours. */
import type { Layout, LayoutAxis, PlotData } from 'plotly.js-basic-dist-min';
import { withUnit } from '../dom';
import { colour } from '../theme';
import { axisWords, usable } from './data';
import type { AxisData, ChartData, SeriesData } from './data';

/** A trace, and the series that it is a part of. */
export interface Trace {
  series: number;
  plot: Partial<PlotData>;
}

/** The shape goes with the colour, so that series can be told apart without it; as in report/chart_svg.cpp. */
const SHAPES = ['circle', 'square', 'triangle-up', 'diamond', 'triangle-down', 'x', 'pentagon', 'cross'] as const;
const shapeOf = (series: SeriesData): string => SHAPES[series.colour % SHAPES.length]!;

export const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", sans-serif';

/** Plotly reads a little HTML in texts; names in a page are plain. */
const plain = (text: string): string => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;').replace(/%\{/g, '%\u200b{');

export function translucent(colour: string, opacity: number): string {
  const channel = (at: number): number => parseInt(colour.slice(at, at + 2), 16);
  return `rgba(${channel(1)},${channel(3)},${channel(5)},${opacity})`;
}

function band(chart: ChartData, series: SeriesData, own: string): Partial<PlotData>[] {
  const keep = series.x.map((_, k) => k).filter(
    (k) => usable(series.x[k], chart.x) && usable(series.y[k], chart.y) && usable(series.upper?.[k], chart.y));
  const x = keep.map((k) => series.x[k]!);
  const lower = keep.map((k) => series.y[k]!);
  const upper = keep.map((k) => series.upper![k]!);
  const words = keep.map((k) => `${withUnit(series.y[k]!, '')} to ${withUnit(series.upper![k]!, chart.y.unit)}`);
  const edges = { mode: 'lines', line: { color: translucent(own, 0.45), width: 0.75, shape: 'linear' } } as const;
  return [
    {
      ...edges, name: plain(series.name), x: [...x, ...[...x].reverse()], y: [...lower, ...[...upper].reverse()], fill: 'toself',
      fillcolor: translucent(own, 0.16), hoverinfo: 'skip', showlegend: true,
    },
    {
      ...edges, name: plain(series.name), x: [...x, null, ...x] as number[], y: [...lower, null, ...upper] as number[],
      customdata: [...words, '', ...words], showlegend: false, hovertemplate: hover(chart, '%{customdata}'),
    },
  ];
}

function hover(chart: ChartData, second: string): string {
  const unit = (axis: AxisData): string => (axis.unit && axis.unit !== '-' ? ` ${plain(axis.unit)}` : '');
  return `<b>%{fullData.name}</b><br>${plain(chart.x.title)}  %{x:.5~g}${unit(chart.x)}<br>${plain(chart.y.title)}  ${second}<extra></extra>`;
}

function curve(chart: ChartData, series: SeriesData, own: string): Partial<PlotData> {
  const unit = chart.y.unit && chart.y.unit !== '-' ? ` ${plain(chart.y.unit)}` : '';
  const both = {
    name: plain(series.name), x: series.x as number[],
    // What a logarithmic axis cannot show breaks the line, as what is not there does.
    y: series.y.map((y, k) => (usable(y, chart.y) && usable(series.x[k], chart.x) ? y : null)) as number[],
    hovertemplate: hover(chart, `%{y:.5~g}${unit}`),
  };
  if (series.kind === 'points')
    return {
      ...both, mode: 'markers',
      marker: { symbol: shapeOf(series), size: 8, color: colour('card'), line: { color: own, width: 1.6 } },
    };
  return {
    ...both, mode: series.marked ? 'lines+markers' : 'lines', connectgaps: false,
    line: { color: own, width: series.thin ? 1.1 : 2, dash: series.kind === 'dashed' ? 'dash' : 'solid', simplify: true },
    marker: { symbol: shapeOf(series), size: 7, color: own, maxdisplayed: 9, line: { width: 0 } } as PlotData['marker'],
  };
}

export function traces(chart: ChartData, hidden: ReadonlySet<number>): Trace[] {
  return chart.series.flatMap((series, k) => {
    const own = colour(`c${series.colour}`);
    const plots = series.kind === 'band' ? band(chart, series, own) : [curve(chart, series, own)];
    return plots.map((plot) => ({ series: k, plot: { type: 'scatter', ...plot, visible: !hidden.has(k) } as Partial<PlotData> }));
  });
}

/** What an axis shows at first, in Plotly's terms (powers of ten on a logarithmic one). */
export function home(axis: AxisData): [number, number] {
  return axis.log ? [Math.log10(axis.low), Math.log10(axis.high)] : [axis.low, axis.high];
}

function axis(data: AxisData): Partial<LayoutAxis> {
  const fewDecades = data.log && Math.log10(data.high / data.low) < 1.2;
  return {
    type: data.log ? 'log' : 'linear', range: home(data), title: { text: plain(axisWords(data)), standoff: 10, font: { size: 13, color: colour('ink') } },
    // Between few decades the digits 2 and 5 say more than powers of ten.
    ...(data.log && !fewDecades ? { dtick: 1 } : {}),
    exponentformat: 'power', showexponent: 'last', tickfont: { size: 12.5, color: colour('soft') },
    gridcolor: colour('faint'), zeroline: !data.log, zerolinecolor: colour('rule'), zerolinewidth: 1.5,
    showline: true, linecolor: colour('soft'), linewidth: 1, ticks: 'outside', ticklen: 4, tickcolor: colour('soft'), automargin: true,
    showspikes: true, spikemode: 'across', spikesnap: 'data', spikethickness: 1, spikedash: '2px,3px', spikecolor: colour('soft'),
  };
}

export function layout(chart: ChartData, size: { width: number; height: number }): Partial<Layout> {
  return {
    ...size, autosize: false, margin: { l: 64, r: 16, t: 14, b: 50 }, paper_bgcolor: 'rgba(0,0,0,0)', plot_bgcolor: 'rgba(0,0,0,0)',
    font: { family: FONT, size: 12.5, color: colour('soft') }, showlegend: false, hovermode: 'closest', hoverdistance: 40, dragmode: 'zoom',
    xaxis: axis(chart.x), yaxis: axis(chart.y),
    hoverlabel: { bgcolor: colour('card'), bordercolor: colour('soft'), align: 'left', font: { family: FONT, size: 13, color: colour('ink') } },
  };
}

/** The same chart as a picture that stands alone: title and legend inside, on paper. */
export function picture(chart: ChartData, shown: Trace[], live: Partial<Layout>): { data: Partial<PlotData>[]; layout: Partial<Layout> } {
  const entries = shown.filter((trace) => trace.plot.visible && trace.plot.showlegend !== false).length;
  return {
    data: shown.map((trace) => ({ ...trace.plot, hovertemplate: '' })),
    layout: {
      ...live, width: 860, height: 480 + 20 * entries, paper_bgcolor: colour('card'), showlegend: true,
      title: { text: plain(chart.title), x: 0, xref: 'paper', xanchor: 'left', y: 0.98, yanchor: 'top', font: { size: 16, color: colour('ink') } },
      legend: { orientation: 'v', x: 0, y: 1.02, xanchor: 'left', yanchor: 'bottom', font: { color: colour('ink') }, itemwidth: 40 },
      margin: { l: 64, r: 24, t: 46 + 20 * entries, b: 50 },
    },
  };
}
