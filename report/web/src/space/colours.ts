/** Colour maps whose steps look alike everywhere and whose lightness goes one way, so that they read in grey too.
 *  Magma and cividis as matplotlib has them (public domain), every eighth colour; between those, linear. */
const MAGMA =
  '0000040303120a0822130d341d114729115a36106b440f7651127c5d177f6a1c81762181832681902a819c2e7faa337db73779c23b75cf4070db476ae55064ee5b5ef4695cf9785dfb8761fd9668fea571feb47bfec287fed194fde0a1fceeb0fcfdbf';
const CIVIDIS =
  '00224e00285b002e6a0533711a386f273e6e32436d3b496c434e6c4b546c535a6d5a5f6e61656f686a716f70737676767d7c788381798b8778928d789a9376a29975aaa073b3a670bbad6dc3b369ccba64d4c15fddc858e6d051efd748f8df3cfee838';

function stops(table: string): number[][] {
  return Array.from({ length: table.length / 6 }, (_, k) => [0, 2, 4].map((at) => parseInt(table.slice(6 * k + at, 6 * k + at + 2), 16)));
}

/** Light is low where the reader looks for what is high: whole concrete stays pale. */
export const MAPS = {
  magma: { name: 'pale to dark (magma)', stops: stops(MAGMA).reverse().slice(1, -3) },
  cividis: { name: 'blue to yellow (cividis)', stops: stops(CIVIDIS) },
  grey: { name: 'grey', stops: [[236, 236, 236], [24, 24, 24]] },
} as const;
export type MapName = keyof typeof MAPS;

/** The colour at a place from 0 to 1. */
export function colourAt(map: MapName, place: number): [number, number, number] {
  const table: readonly (readonly number[])[] = MAPS[map].stops;
  const at = Math.min(1, Math.max(0, place)) * (table.length - 1);
  const k = Math.min(table.length - 2, Math.floor(at));
  const mix = (channel: number): number =>
    Math.round(table[k]![channel]! + (at - k) * (table[k + 1]![channel]! - table[k]![channel]!));
  return [mix(0), mix(1), mix(2)];
}

/** 256 colours, four bytes each. */
export function lookup(map: MapName): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array(4 * 256);
  for (let k = 0; k < 256; ++k) out.set([...colourAt(map, k / 255), 255], 4 * k);
  return out;
}

export function gradient(map: MapName, direction: string): string {
  const colours = Array.from({ length: 17 }, (_, k) => `rgb(${colourAt(map, k / 16).join(' ')})`);
  return `linear-gradient(${direction}, ${colours.join(', ')})`;
}
