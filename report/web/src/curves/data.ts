/** What a chart's JSON in the page holds (report/chart_svg.cpp writes it) and its table for the CSV. */

export interface AxisData {
  title: string;
  unit: string;
  log: boolean;
  low: number;
  high: number;
}

export interface SeriesData {
  name: string;
  kind: 'line' | 'dashed' | 'band' | 'points';
  colour: number;
  x: (number | null)[];
  y: (number | null)[];
  upper?: (number | null)[];
  thin?: boolean;
  marked?: boolean;
}

export interface ChartData {
  title: string;
  x: AxisData;
  y: AxisData;
  series: SeriesData[];
}

export const axisWords = (axis: AxisData): string => (axis.unit ? `${axis.title} [${axis.unit}]` : axis.title);

export const usable = (value: number | null | undefined, axis: AxisData): value is number =>
  typeof value === 'number' && Number.isFinite(value) && (!axis.log || value > 0);

/** Every series, point by point: series, x, y, and a column for the upper edge where a band has one. */
export function csv(chart: ChartData): string {
  const quote = (text: string): string => (/[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
  const column = (axis: AxisData): string => quote(`${axis.title}[${axis.unit || '-'}]`);
  const cell = (value: number | null | undefined): string => (value ?? '').toString();
  const banded = chart.series.some((series) => series.upper);
  const rows = [`series,${column(chart.x)},${column(chart.y)}${banded ? ',upper' : ''}`];
  for (const series of chart.series)
    series.x.forEach((x, k) => {
      const cells = [quote(series.name), cell(x), cell(series.y[k])];
      if (banded) cells.push(cell(series.upper?.[k]));
      rows.push(cells.join(','));
    });
  return rows.join('\n') + '\n';
}
