import { expect, test } from 'vitest';
import { csv, usable } from '../src/curves/data';
import type { ChartData } from '../src/curves/data';

const chart: ChartData = {
  title: 't', x: { title: 'strain', unit: '‰', log: false, low: 0, high: 1 }, y: { title: 'a, "b"', unit: '', log: true, low: 1, high: 10 },
  series: [
    { name: 'range', kind: 'band', colour: 0, x: [0, 1], y: [1, 2], upper: [3, null] },
    { name: 'run 1, mean', kind: 'line', colour: 1, x: [0.5], y: [null] },
  ],
};

test('the CSV has every point, quotes what needs it, and leaves gaps empty', () => {
  expect(csv(chart)).toBe('series,strain[‰],"a, ""b""[-]",upper\nrange,0,1,3\nrange,1,2,\n"run 1, mean",0.5,,\n');
});

test('a logarithmic axis cannot show what is not above zero', () => {
  expect(usable(0, chart.y)).toBe(false);
  expect(usable(0, chart.x)).toBe(true);
  expect(usable(null, chart.x)).toBe(false);
});
