/** What stands beside the elements: the box around them, broken links, the finite element mesh, the body. */
import * as three from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { brokenLinks, placeOf } from './state';
import type { State } from './state';
import type { SceneData } from './unpack';

export interface Colours {
  ink: string;
  soft: string;
  broken: string;
}

type Position = three.InterleavedBufferAttribute;

/** One line from element to element for every link that is broken by now. */
export class BrokenLinks {
  readonly object: LineSegments2;
  private readonly geometry = new LineSegmentsGeometry();
  private readonly material = new LineMaterial({ linewidth: 2 });

  constructor(private readonly scene: SceneData) {
    this.geometry.setPositions(new Float32Array(6 * Math.max(1, scene.links.first.length)));
    this.object = new LineSegments2(this.geometry, this.material);
    this.object.frustumCulled = false;
  }

  apply(state: State, colours: Colours, clip: three.Plane[]): void {
    const count = brokenLinks(this.scene, state);
    const data = (this.geometry.attributes.instanceStart as Position).data;
    const { first, second } = this.scene.links;
    for (let k = 0; k < count; ++k) {
      data.array.set(placeOf(this.scene, state, first[k]!), 6 * k);
      data.array.set(placeOf(this.scene, state, second[k]!), 6 * k + 3);
    }
    data.needsUpdate = true;
    this.geometry.instanceCount = count;
    // Among the spheres they could not be seen.
    this.object.visible = state.brokenOnly && count > 0;
    this.material.color.set(colours.broken);
    this.material.clippingPlanes = clip;
  }
}

/** Its outer faces, faint, and their edges. */
export class FiniteElements {
  readonly object = new three.Group();
  private readonly position: three.BufferAttribute;
  private readonly edges: three.LineSegments<three.BufferGeometry, three.LineBasicMaterial>;
  private readonly faces: three.Mesh<three.BufferGeometry, three.MeshBasicMaterial>;

  constructor(private readonly scene: SceneData) {
    this.position = new three.BufferAttribute(new Float32Array(3 * scene.header.mesh.nodes), 3);
    const corners = scene.meshFaces;
    const triangles: number[] = [], lines: number[] = [];
    const seen = new Set<number>();
    for (let k = 0; k < corners.length; k += 4) {
      const face = [corners[k]!, corners[k + 1]!, corners[k + 2]!, corners[k + 3]!] as const;
      triangles.push(face[0], face[1], face[2], face[0], face[2], face[3]);
      face.forEach((a, side) => {
        const b = face[(side + 1) % 4]!;
        const key = Math.min(a, b) * scene.header.mesh.nodes + Math.max(a, b);
        if (a === b || seen.has(key)) return;
        seen.add(key);
        lines.push(a, b);
      });
    }
    const geometry = (index: number[]): three.BufferGeometry => {
      const out = new three.BufferGeometry();
      out.setAttribute('position', this.position);
      out.setIndex(index);
      return out;
    };
    this.edges = new three.LineSegments(geometry(lines), new three.LineBasicMaterial({ transparent: true, opacity: 0.55 }));
    this.faces = new three.Mesh(geometry(triangles),
      new three.MeshBasicMaterial({ transparent: true, opacity: 0.1, depthWrite: false, side: three.DoubleSide }));
    for (const part of [this.faces, this.edges]) part.frustumCulled = false;
    this.object.add(this.faces, this.edges);
  }

  apply(state: State, colours: Colours, clip: three.Plane[]): void {
    this.object.visible = state.mesh && this.scene.header.mesh.nodes > 0;
    if (!this.object.visible) return;
    const { box, displacement_quantum, nodes } = this.scene.header.mesh;
    const moves = this.scene.frames[state.frame]!.meshDisplacements;
    for (let k = 0; k < 3 * nodes; ++k)
      this.position.array[k] = box.low[k % 3]! + box.quantum[k % 3]! * this.scene.meshNodes[k]! + state.magnification * displacement_quantum * moves[k]!;
    this.position.needsUpdate = true;
    for (const part of [this.edges, this.faces]) {
      part.material.color.set(colours.soft);
      part.material.clippingPlanes = clip;
    }
  }
}

/** The body as it is, its way not magnified. */
export class Body {
  readonly object: three.Mesh<three.BufferGeometry, three.MeshLambertMaterial>;
  private readonly position: three.BufferAttribute;

  constructor(private readonly scene: SceneData) {
    this.position = new three.BufferAttribute(new Float32Array(3 * scene.header.body.points), 3);
    const geometry = new three.BufferGeometry();
    geometry.setAttribute('position', this.position);
    geometry.setIndex(new three.BufferAttribute(scene.bodyTriangles, 1));
    this.object = new three.Mesh(geometry, new three.MeshLambertMaterial({ color: 0x7d8894, flatShading: true, side: three.DoubleSide }));
    this.object.frustumCulled = false;
  }

  apply(state: State): void {
    this.object.visible = state.body && this.scene.bodyTriangles.length > 0;
    if (!this.object.visible) return;
    const { box } = this.scene.header.body;
    const points = this.scene.frames[state.frame]!.bodyPoints;
    for (let k = 0; k < points.length; ++k) this.position.array[k] = box.low[k % 3]! + box.quantum[k % 3]! * points[k]!;
    this.position.needsUpdate = true;
  }
}

export function outline(box: three.Box3): three.LineSegments<three.BufferGeometry, three.LineBasicMaterial> {
  const size = box.getSize(new three.Vector3());
  const edges = new three.EdgesGeometry(new three.BoxGeometry(size.x, size.y, size.z));
  const lines = new three.LineSegments(edges, new three.LineBasicMaterial({ transparent: true, opacity: 0.5 }));
  lines.position.copy(box.getCenter(new three.Vector3()));
  return lines;
}
