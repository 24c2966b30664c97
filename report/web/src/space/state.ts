/** What the reader has chosen to see, and what follows from it for one element. Drawing, pointing and counting ask here,
 *  so that they agree. */
import type { MapName } from './colours';
import { NO_VALUE } from './unpack';
import type { SceneData } from './unpack';

export interface State {
  frame: number;
  field: number;
  map: MapName;
  /** Ends of the colour scale, in the field's unit. */
  from: number;
  to: number;
  /** Elements whose code in the field is lower are hidden; 0 hides none. */
  threshold: number;
  magnification: number;
  /** 0 to 2, or -1 for none. */
  cutAxis: number;
  /** Along the axis [m]; kept is what lies below it, or above if flipped. */
  cutAt: number;
  cutFlipped: boolean;
  brokenOnly: boolean;
  mesh: boolean;
  body: boolean;
}

export const isCut = (state: State, along: number): boolean =>
  state.cutFlipped ? along < state.cutAt : along > state.cutAt;

/** Whether element k is drawn. A cut takes elements by where they were at the start, so it takes the same ones in every frame. */
export function isShown(scene: SceneData, state: State, k: number): boolean {
  if (state.brokenOnly) return false;
  if (state.cutAxis >= 0) {
    const { low, quantum } = scene.header.centres;
    if (isCut(state, low[state.cutAxis]! + quantum[state.cutAxis]! * scene.centres[3 * k + state.cutAxis]!)) return false;
  }
  if (state.threshold > 0) {
    const code = scene.frames[state.frame]!.values[state.field]![k]!;
    if (code === NO_VALUE || code < state.threshold) return false;
  }
  return true;
}

/** Where element k is shown [m]. */
export function placeOf(scene: SceneData, state: State, k: number): [number, number, number] {
  const { low, quantum } = scene.header.centres;
  const moved = state.magnification * scene.header.displacement_quantum;
  const displacements = scene.frames[state.frame]!.displacements;
  const along = (axis: number): number => low[axis]! + quantum[axis]! * scene.centres[3 * k + axis]! + moved * displacements[3 * k + axis]!;
  return [along(0), along(1), along(2)];
}

/** The field's value at element k; NaN where it has none. */
export function valueOf(scene: SceneData, state: State, k: number): number {
  const field = scene.header.fields[state.field];
  const code = scene.frames[state.frame]?.values[state.field]?.[k];
  return !field || code === undefined || code === NO_VALUE ? NaN : field.low + field.quantum * code;
}

/** Links broken by the shown frame; they are sorted by frame. */
export function brokenLinks(scene: SceneData, state: State): number {
  const { frame } = scene.links;
  let [low, high] = [0, frame.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (frame[middle]! <= state.frame) low = middle + 1;
    else high = middle;
  }
  return low;
}
