import { deflateSync } from 'node:zlib';
import { describe, expect, test } from 'vitest';
import { inflate, unpack } from '../src/space/unpack';
import type { Header } from '../src/space/unpack';

/** Writes what report/scene_pack.h describes, as far as these tests need it. */
function fold(difference: number, width: number): number {
  const bits = 32 - 8 * width;
  difference = (difference << bits) >> bits;
  return difference < 0 ? -2 * difference - 1 : 2 * difference;
}
function ranks(differences: number[], width: number): number[] {
  const folded = differences.map((difference) => fold(difference, width));
  return Array.from({ length: width }, (_, rank) => folded.map((code) => Math.floor(code / 256 ** rank) % 256)).flat();
}
const along = (codes: number[], width: number): number[] => ranks(codes.map((code, k) => code - (codes[k - 1] ?? 0)), width);

const box = { low: [0, 0, 0], quantum: [1, 1, 1] } as Header['centres'];
const header: Header = {
  title: 'two elements', elements: 2, centres: box, radii: { low: 1, quantum: 0.5 }, displacement_quantum: 0.1,
  mesh: { nodes: 0, indices: 0, box, displacement_quantum: 0 }, body: { points: 1, indices: 3, box }, links: 1,
  fields: [{ name: 'damage', unit: '', from: 0, to: 1, low: 0, quantum: 1 / 254 }],
  frames: [{ time: 0, label: 'a' }, { time: 1, label: 'b' }], raw_bytes: 0,
};
const bytes = Uint8Array.from([
  ...along([0, 65535], 2), ...along([300, 2], 2), ...along([7, 7], 2), 0, 255,
  ...along([0, 0, 0], 4), ...along([1], 4), ...along([70000], 4), ...along([1], 4),
  ...ranks([-1, 500], 2), ...ranks([0, 0], 2), ...ranks([32767, -32767], 2), ...ranks([0, 127], 1), ...ranks([9], 2), ...ranks([8], 2), ...ranks([7], 2),
  ...ranks([1, -1], 2), ...ranks([0, 3], 2), ...ranks([-1, 1], 2), ...ranks([-1, 127], 1), ...ranks([-9], 2), ...ranks([0], 2), ...ranks([1], 2),
]);

describe('unpack', () => {
  const scene = unpack({ ...header, raw_bytes: bytes.length }, bytes);
  test('gives centres, radii and indices back', () => {
    expect([...scene.centres]).toEqual([0, 300, 7, 65535, 2, 7]);
    expect([...scene.radii]).toEqual([0, 255]);
    expect([...scene.bodyTriangles]).toEqual([0, 0, 0]);
    expect([scene.links.first[0], scene.links.second[0], scene.links.frame[0]]).toEqual([1, 70000, 1]);
  });
  test('adds each frame to the one before', () => {
    expect([...scene.frames[0]!.displacements]).toEqual([-1, 0, 32767, 500, 0, -32767]);
    expect([...scene.frames[1]!.displacements]).toEqual([0, 0, 32766, 499, 3, -32766]);
    expect([...scene.frames[0]!.values[0]!]).toEqual([0, 127]);
    expect([...scene.frames[1]!.values[0]!]).toEqual([255, 254]);
    expect([...scene.frames[1]!.bodyPoints]).toEqual([0, 8, 8]);
  });
  test('refuses data of another length than promised', () => {
    expect(() => unpack({ ...header, raw_bytes: bytes.length - 1 }, bytes)).toThrow('promises');
    expect(() => unpack({ ...header, frames: header.frames.slice(1), raw_bytes: bytes.length }, bytes)).toThrow('more data');
  });
});

test('inflate reads base64 of what zlib deflated', async () => {
  const text = deflateSync(bytes).toString('base64');
  expect([...(await inflate(text + '\n'))]).toEqual([...bytes]);
});
