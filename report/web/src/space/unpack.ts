/** A scene's data as the page carries them, taken apart again: the other side of report/scene_pack.h, which describes
 *  the layout. Integers stay integers; what they mean is low + code * quantum. */

interface Box {
  low: [number, number, number];
  quantum: [number, number, number];
}

export interface FieldHeader {
  name: string;
  unit: string;
  from: number;
  to: number;
  low: number;
  quantum: number;
}

export interface Header {
  title: string;
  elements: number;
  centres: Box;
  radii: { low: number; quantum: number };
  displacement_quantum: number;
  mesh: { nodes: number; indices: number; box: Box; displacement_quantum: number };
  body: { points: number; indices: number; box: Box };
  links: number;
  fields: FieldHeader[];
  frames: { time: number; label: string }[];
  raw_bytes: number;
}

export interface Frame {
  /** x y z of every element, in displacement_quantum. */
  displacements: Int16Array;
  /** By field: 0 to 254, or NO_VALUE. */
  values: Uint8Array[];
  meshDisplacements: Int16Array;
  bodyPoints: Uint16Array;
}

export interface SceneData {
  header: Header;
  centres: Uint16Array;
  radii: Uint8Array;
  meshNodes: Uint16Array;
  meshFaces: Uint32Array;
  bodyTriangles: Uint32Array;
  links: { first: Uint32Array; second: Uint32Array; frame: Uint32Array };
  frames: Frame[];
}

export const NO_VALUE = 255;

/** Reads one part after another. */
class Reader {
  private at = 0;
  constructor(private readonly bytes: Uint8Array) {}

  plain(count: number): Uint8Array {
    return this.bytes.subarray(this.at, (this.at += count));
  }

  /** Differences of `width` bytes each, by ranks: calls back with each one, unfolded. */
  differences(count: number, width: 1 | 2 | 4, take: (k: number, difference: number) => void): void {
    const { bytes, at } = this;
    for (let k = 0; k < count; ++k) {
      let folded = bytes[at + k]!;
      if (width > 1) folded |= bytes[at + count + k]! << 8;
      if (width > 2) folded |= (bytes[at + 2 * count + k]! << 16) | (bytes[at + 3 * count + k]! << 24);
      take(k, (folded >>> 1) ^ -(folded & 1));
    }
    this.at += count * width;
  }

  /** Three columns of differences along their entries, as x y z x y z. */
  vectors(count: number): Uint16Array {
    const out = new Uint16Array(3 * count);
    for (let axis = 0; axis < 3; ++axis) {
      let last = 0;
      this.differences(count, 2, (k, difference) => (out[3 * k + axis] = last += difference));
    }
    return out;
  }

  indices(count: number): Uint32Array {
    const out = new Uint32Array(count);
    let last = 0;
    this.differences(count, 4, (k, difference) => (out[k] = last = (last + difference) | 0));
    return out;
  }

  /** Three columns of differences from the frame before. */
  next<Codes extends Int16Array | Uint16Array>(before: Codes): Codes {
    const out = before.slice() as Codes;
    for (let axis = 0; axis < 3; ++axis)
      this.differences(before.length / 3, 2, (k, difference) => (out[3 * k + axis] = out[3 * k + axis]! + difference));
    return out;
  }

  nextValues(before: Uint8Array): Uint8Array {
    const out = before.slice();
    this.differences(before.length, 1, (k, difference) => (out[k] = out[k]! + difference));
    return out;
  }

  get done(): boolean {
    return this.at === this.bytes.length;
  }
}

export function unpack(header: Header, bytes: Uint8Array): SceneData {
  if (bytes.length !== header.raw_bytes) throw new Error(`${bytes.length} bytes where the page promises ${header.raw_bytes}`);
  const reader = new Reader(bytes);
  const centres = reader.vectors(header.elements);
  const radii = reader.plain(header.elements);
  const meshNodes = reader.vectors(header.mesh.nodes);
  const meshFaces = reader.indices(header.mesh.indices);
  const bodyTriangles = reader.indices(header.body.indices);
  const links = { first: reader.indices(header.links), second: reader.indices(header.links), frame: reader.indices(header.links) };
  let last: Frame = {
    displacements: new Int16Array(3 * header.elements), values: header.fields.map(() => new Uint8Array(header.elements)),
    meshDisplacements: new Int16Array(3 * header.mesh.nodes), bodyPoints: new Uint16Array(3 * header.body.points),
  };
  const frames = header.frames.map(() => {
    const before = last;
    return (last = {
      displacements: reader.next(before.displacements), values: before.values.map((codes) => reader.nextValues(codes)),
      meshDisplacements: reader.next(before.meshDisplacements), bodyPoints: reader.next(before.bodyPoints),
    });
  });
  if (!reader.done) throw new Error('more data than the header names');
  return { header, centres, radii, meshNodes, meshFaces, bodyTriangles, links, frames };
}

/** From the text in the page to bytes: base64, then zlib's format. */
export async function inflate(text: string): Promise<Uint8Array> {
  const packed = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
