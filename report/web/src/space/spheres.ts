/** Elements as spheres, all in one call: each is a square of pixels in which a shader finds the sphere's surface and
 *  depth. The camera looks in parallel, so a sphere's outline is a circle and its depth is exact. */
import * as three from 'three';
import { lookup } from './colours';
import type { State } from './state';
import { NO_VALUE } from './unpack';
import type { SceneData } from './unpack';

const VERTEX = /* glsl */ `
  precision highp float;
  uniform mat4 viewMatrix, projectionMatrix;
  uniform vec3 low, quantum, cut;
  uniform float cutAt, movedBy, radiusLow, radiusQuantum, pixels, inflation, threshold, valueLow, valueQuantum, from, to;
  in vec3 position;  // the centre's codes
  in vec3 displacement;
  in float radius, value;
  out float place, depthReach;
  void main() {
    vec3 centre = low + quantum * position;
    bool none = value > ${NO_VALUE - 0.5};
    if (dot(cut, centre) > cutAt || (threshold > 0.0 && (none || value < threshold - 0.5))) {
      gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
      gl_PointSize = 0.0;
      return;
    }
    float size = (radiusLow + radiusQuantum * radius) * inflation;
    gl_Position = projectionMatrix * viewMatrix * vec4(centre + movedBy * displacement, 1.0);
    depthReach = -0.5 * projectionMatrix[2][2] * size;
    gl_PointSize = max(1.0, 2.0 * size * pixels);
    place = none ? -1.0 : clamp((valueLow + valueQuantum * value - from) / (to - from), 0.0, 1.0);
  }`;

const FRAGMENT = /* glsl */ `
  precision highp float;
  uniform sampler2D map;
  in float place, depthReach;
  out vec4 colour;
  const vec3 light = vec3(-0.37, 0.46, 0.81);
  void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    float out2 = dot(at, at);
    if (out2 > 1.0) discard;
    float up = sqrt(1.0 - out2);
    vec3 own = place < 0.0 ? vec3(0.55) : texture(map, vec2((place * 255.0 + 0.5) / 256.0, 0.5)).rgb;
    float shade = 0.58 + 0.42 * max(0.0, dot(vec3(at.x, -at.y, up), light));
    colour = vec4(own * shade, 1.0);
    #ifndef FLAT
      gl_FragDepth = gl_FragCoord.z - depthReach * up;
    #endif
  }`;

export class Spheres {
  readonly points: three.Points;
  private readonly geometry = new three.BufferGeometry();
  private readonly whole: three.RawShaderMaterial;
  private readonly flat: three.RawShaderMaterial;
  private readonly uniforms: Record<string, three.IUniform>;
  private readonly displacement: three.BufferAttribute;
  private readonly value: three.BufferAttribute;
  /** Elements in an order without order: its beginning is a fair sample of them all. */
  private readonly order: Uint32Array;

  constructor(private readonly scene: SceneData) {
    const { header } = scene;
    this.order = shuffled(header.elements);
    const centres = new Uint16Array(3 * header.elements);
    const radii = new Uint8Array(header.elements);
    this.order.forEach((k, at) => {
      for (let axis = 0; axis < 3; ++axis) centres[3 * at + axis] = scene.centres[3 * k + axis]!;
      radii[at] = scene.radii[k]!;
    });
    this.displacement = new three.BufferAttribute(new Int16Array(3 * header.elements), 3);
    this.value = new three.BufferAttribute(new Uint8Array(header.elements), 1);
    this.displacement.setUsage(three.DynamicDrawUsage);
    this.value.setUsage(three.DynamicDrawUsage);
    this.geometry.setAttribute('position', new three.BufferAttribute(centres, 3));
    this.geometry.setAttribute('radius', new three.BufferAttribute(radii, 1));
    this.geometry.setAttribute('displacement', this.displacement);
    this.geometry.setAttribute('value', this.value);
    const map = new three.DataTexture(lookup('magma'), 256, 1);
    map.needsUpdate = true;
    this.uniforms = Object.fromEntries(Object.entries({
      low: new three.Vector3(...header.centres.low), quantum: new three.Vector3(...header.centres.quantum), cut: new three.Vector3(),
      cutAt: 0, movedBy: 0, radiusLow: header.radii.low, radiusQuantum: header.radii.quantum, pixels: 1, inflation: 1, threshold: 0,
      valueLow: 0, valueQuantum: 0, from: 0, to: 1, map,
    }).map(([name, value]) => [name, { value }]));
    const material = (defines: Record<string, string>): three.RawShaderMaterial =>
      new three.RawShaderMaterial({ glslVersion: three.GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: this.uniforms, defines });
    this.whole = material({});
    this.flat = material({ FLAT: '' });
    this.points = new three.Points(this.geometry, this.whole);
    this.points.frustumCulled = false;
  }

  /** Puts the shown frame's numbers where the card reads them. */
  load(state: State): void {
    const frame = this.scene.frames[state.frame]!;
    const [moves, values] = [this.displacement.array, this.value.array];
    const codes = frame.values[state.field];
    for (let at = 0; at < this.order.length; ++at) {
      const k = this.order[at]!;
      moves[3 * at] = frame.displacements[3 * k]!;
      moves[3 * at + 1] = frame.displacements[3 * k + 1]!;
      moves[3 * at + 2] = frame.displacements[3 * k + 2]!;
      values[at] = codes ? codes[k]! : NO_VALUE;
    }
    this.displacement.needsUpdate = this.value.needsUpdate = true;
  }

  apply(state: State): void {
    const u = this.uniforms;
    const field = this.scene.header.fields[state.field];
    const sign = state.cutFlipped ? -1 : 1;
    (u.cut!.value as three.Vector3).set(0, 0, 0);
    if (state.cutAxis >= 0) (u.cut!.value as three.Vector3).setComponent(state.cutAxis, sign);
    u.cutAt!.value = state.cutAxis >= 0 ? sign * state.cutAt : 1;
    u.movedBy!.value = state.magnification * this.scene.header.displacement_quantum;
    u.threshold!.value = state.threshold;
    u.valueLow!.value = field?.low ?? 0;
    u.valueQuantum!.value = field?.quantum ?? 0;
    u.from!.value = state.from;
    u.to!.value = state.to === state.from ? state.from + 1 : state.to;
    const map = u.map!.value as three.DataTexture;
    map.image.data = lookup(state.map);
    map.needsUpdate = true;
    this.points.visible = !state.brokenOnly;
  }

  /** What a fraction of all elements looks like: larger ones in their stead, as discs. 1 draws every sphere. */
  detail(fraction: number, pixelsPerMetre: number): void {
    this.points.material = fraction < 1 ? this.flat : this.whole;
    this.geometry.setDrawRange(0, Math.ceil(fraction * this.order.length));
    this.uniforms.inflation!.value = Math.min(2.5, fraction ** (-1 / 3));
    this.uniforms.pixels!.value = pixelsPerMetre;
  }
}

/** 0 to count - 1, shuffled, the same every time. */
function shuffled(count: number): Uint32Array {
  const order = Uint32Array.from({ length: count }, (_, k) => k);
  let seed = 12345;
  for (let k = count - 1; k > 0; --k) {
    seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
    const other = Math.floor((seed / 2 ** 32) * (k + 1));
    [order[k], order[other]] = [order[other]!, order[k]!];
  }
  return order;
}
