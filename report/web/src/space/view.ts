/** The picture itself: camera, drawing when something has changed, less detail while it moves, pointing. */
import * as three from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Body, BrokenLinks, FiniteElements, outline } from './lines';
import type { Colours } from './lines';
import { Spheres } from './spheres';
import { isShown, placeOf } from './state';
import type { State } from './state';
import type { SceneData } from './unpack';

/** What a picture may take while it moves [ms]; with more, there is less detail. */
const BUDGET = 33;
/** Fewer elements are always drawn whole. */
const FEWEST = 3000;
/** After this long without a change everything is drawn again [ms]. */
const REST = 160;

export const VIEWS = {
  x: [1, 0, 0], y: [0, -1, 0], z: [0, 0, 1], iso: [0.62, -0.95, 0.62],
} as const;

export class View {
  readonly canvas: HTMLCanvasElement;
  /** Called after each picture; the camera may have moved. */
  onDrawn: () => void = () => undefined;
  /** How long the last picture with every element took, until its pixels were there [ms]. */
  wholeTime = NaN;
  /** The share of elements that the last picture had. */
  detail = 1;

  private readonly renderer: three.WebGLRenderer;
  private readonly camera = new three.OrthographicCamera();
  private readonly controls: OrbitControls;
  private readonly stage = new three.Scene();
  private readonly spheres: Spheres;
  private readonly links: BrokenLinks;
  private readonly mesh: FiniteElements;
  private readonly body: Body;
  private readonly outline: three.LineSegments<three.BufferGeometry, three.LineBasicMaterial>;
  private readonly box: three.Box3;
  private readonly pixel = new Uint8Array(4);
  private loaded: { frame: number; field: number } | null = null;
  private wanted = 0;
  private restTimer = 0;
  private movingDetail = 1;
  /** The smallest share that is drawn while it moves. */
  private readonly least: number;
  private lastMoving = 0;

  constructor(private readonly scene: SceneData, readonly state: State, private readonly colours: () => Colours) {
    this.renderer = new three.WebGLRenderer({ antialias: true, alpha: true, powerPreference: 'high-performance' });
    this.canvas = this.renderer.domElement;
    this.renderer.localClippingEnabled = true;
    this.renderer.outputColorSpace = three.LinearSRGBColorSpace;
    three.ColorManagement.enabled = false;
    this.least = Math.min(1, Math.max(0.03, FEWEST / scene.header.elements));
    this.box = extent(scene);
    this.spheres = new Spheres(scene);
    this.links = new BrokenLinks(scene);
    this.mesh = new FiniteElements(scene);
    this.body = new Body(scene);
    this.outline = outline(this.box);
    const sun = new three.DirectionalLight(0xffffff, 2.0);
    sun.position.set(-0.37, 0.46, 0.81);
    this.camera.add(sun);
    this.stage.add(this.camera, new three.AmbientLight(0xffffff, 1.6), this.spheres.points, this.links.object, this.body.object, this.outline, this.mesh.object);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.zoomToCursor = true;
    this.controls.minZoom = 0.3;
    this.controls.maxZoom = 60;
    this.controls.addEventListener('change', () => this.moving());
    this.look('iso');
  }

  resize(width: number, height: number): void {
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(width, height);
    this.fit();
  }

  /** The reader has chosen something else: loads what is new, draws. */
  update(): void {
    if (this.loaded?.frame !== this.state.frame || this.loaded.field !== this.state.field) {
      this.spheres.load(this.state);
      this.loaded = { frame: this.state.frame, field: this.state.field };
    }
    const colours = this.colours();
    const clip: three.Plane[] = [];
    if (this.state.cutAxis >= 0) {
      const sign = this.state.cutFlipped ? 1 : -1;
      clip.push(new three.Plane(new three.Vector3().setComponent(this.state.cutAxis, sign), -sign * this.state.cutAt));
    }
    this.spheres.apply(this.state);
    this.links.apply(this.state, colours, clip);
    this.mesh.apply(this.state, colours, clip);
    this.body.apply(this.state);
    this.outline.material.color.set(colours.soft);
    this.moving();
  }

  look(name: keyof typeof VIEWS): void {
    const [x, y, z] = VIEWS[name];
    this.controls.target.copy(this.box.getCenter(new three.Vector3()));
    this.camera.position.set(x, y, z).normalize().multiplyScalar(4 * this.reach()).add(this.controls.target);
    // Seen straight along the axis that is up, "up" needs help.
    if (name === 'z') this.camera.position.y -= 1e-4 * this.reach();
    this.camera.zoom = 1;
    this.fit();
  }

  turn(right: number, up: number): void {
    const away = this.camera.position.clone().sub(this.controls.target);
    const at = new three.Spherical().setFromVector3(new three.Vector3(away.x, away.z, -away.y));
    at.theta += right;
    at.phi = Math.min(Math.PI - 1e-4, Math.max(1e-4, at.phi - up));
    const back = new three.Vector3().setFromSpherical(at);
    this.camera.position.set(back.x, -back.z, back.y).add(this.controls.target);
    this.controls.update();
    this.moving();
  }

  /** By shares of what is shown. */
  pan(right: number, up: number): void {
    const width = (this.camera.right - this.camera.left) / this.camera.zoom;
    const shift = new three.Vector3(right * width, up * width, 0).applyQuaternion(this.camera.quaternion);
    this.camera.position.add(shift);
    this.controls.target.add(shift);
    this.controls.update();
    this.moving();
  }

  zoom(by: number): void {
    this.camera.zoom = Math.min(60, Math.max(0.3, this.camera.zoom * by));
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.moving();
  }

  /** The element under a place of the canvas [CSS pixels], or -1. */
  pick(x: number, y: number): number {
    const size = this.renderer.getSize(new three.Vector2());
    const metres = this.metresPerPixel();
    const right = new three.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    const up = new three.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
    const near = new three.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 2);
    const eye = this.camera.position;
    const [wantedX, wantedY] = [(x - size.x / 2) * metres, (size.y / 2 - y) * metres];
    const { low: radiusLow, quantum: radiusQuantum } = this.scene.header.radii;
    let best = -1, bestDepth = -Infinity;
    for (let k = 0; k < this.scene.header.elements; ++k) {
      if (!isShown(this.scene, this.state, k)) continue;
      const [px, py, pz] = placeOf(this.scene, this.state, k);
      const [dx, dy, dz] = [px - eye.x, py - eye.y, pz - eye.z];
      const aside = dx * right.x + dy * right.y + dz * right.z - wantedX;
      const over = dx * up.x + dy * up.y + dz * up.z - wantedY;
      const radius = radiusLow + radiusQuantum * this.scene.radii[k]!;
      const inside = radius * radius - aside * aside - over * over;
      if (inside < 0) continue;
      const depth = dx * near.x + dy * near.y + dz * near.z + Math.sqrt(inside);
      if (depth > bestDepth) [best, bestDepth] = [k, depth];
    }
    return best;
  }

  metresPerPixel(): number {
    return (this.camera.right - this.camera.left) / this.camera.zoom / this.renderer.getSize(new three.Vector2()).x;
  }

  /** Where the axes point on the screen: right and up, and towards the reader. */
  axes(): [number, number, number][] {
    const back = this.camera.quaternion.clone().invert();
    return [0, 1, 2].map((axis) => {
      const v = new three.Vector3().setComponent(axis, 1).applyQuaternion(back);
      return [v.x, v.y, v.z];
    });
  }

  /** Draws every element now; the canvas holds the picture until the next task. */
  whole(): void {
    clearTimeout(this.restTimer);
    cancelAnimationFrame(this.wanted);
    this.wanted = 0;
    const begin = performance.now();
    this.draw(1);
    // Waits for the pixels: only then is the picture there.
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, this.pixel);
    this.wholeTime = performance.now() - begin;
    this.onDrawn();
  }

  /** Draws `turns` pictures while turning, as fast as they come; their mean time [ms]. */
  measure(turns: number, fraction: number): number {
    const gl = this.renderer.getContext();
    const begin = performance.now();
    for (let k = 0; k < turns; ++k) {
      this.turn(0.02, 0);
      this.draw(fraction);
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, this.pixel);
    }
    return (performance.now() - begin) / turns;
  }

  private moving(): void {
    clearTimeout(this.restTimer);
    if (this.wanted) return;
    this.wanted = requestAnimationFrame((now) => {
      this.wanted = 0;
      // Time from picture to picture, while they follow each other, says what the machine can do.
      const since = now - this.lastMoving;
      if (since < 1000) {
        if (since > 1.3 * BUDGET) this.movingDetail = Math.max(this.least, this.movingDetail * Math.max(0.5, BUDGET / since));
        else if (since < 0.7 * BUDGET) this.movingDetail = Math.min(1, this.movingDetail * 1.15);
      } else if (Number.isFinite(this.wholeTime)) {
        this.movingDetail = this.wholeTime < BUDGET ? 1 : Math.min(this.movingDetail, Math.max(this.least, BUDGET / this.wholeTime));
      }
      this.lastMoving = now;
      this.draw(this.movingDetail);
      this.onDrawn();
      // Only now: on a slow machine a picture can come later than the rest after it.
      this.restTimer = window.setTimeout(() => this.whole(), REST);
    });
  }

  private draw(fraction: number): void {
    this.detail = fraction;
    const reach = 8 * this.reach();
    this.camera.near = -reach;
    this.camera.far = reach + 8 * this.reach();
    this.camera.updateProjectionMatrix();
    this.spheres.detail(fraction, this.renderer.getPixelRatio() / this.metresPerPixel());
    this.renderer.render(this.stage, this.camera);
  }

  private reach(): number {
    return this.box.getSize(new three.Vector3()).length() / 2;
  }

  /** At zoom 1 the box fills most of the view. */
  private fit(): void {
    const size = this.renderer.getSize(new three.Vector2());
    if (!(size.x > 0 && size.y > 0)) return;
    this.camera.lookAt(this.controls.target);
    this.camera.updateMatrixWorld();
    const into = this.camera.matrixWorldInverse;
    let [wide, high] = [0, 0];
    for (let corner = 0; corner < 8; ++corner) {
      const at = new three.Vector3(
        corner & 1 ? this.box.max.x : this.box.min.x, corner & 2 ? this.box.max.y : this.box.min.y, corner & 4 ? this.box.max.z : this.box.min.z,
      ).applyMatrix4(into);
      wide = Math.max(wide, Math.abs(at.x));
      high = Math.max(high, Math.abs(at.y));
    }
    const half = 1.14 * Math.max(wide, (high * size.x) / size.y);
    Object.assign(this.camera, { left: -half, right: half, top: (half * size.y) / size.x, bottom: (-half * size.y) / size.x });
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.moving();
  }
}

/** Around elements and mesh at the start. */
function extent(scene: SceneData): three.Box3 {
  const box = new three.Box3();
  const { centres, radii, mesh } = scene.header;
  const most = radii.low + 255 * radii.quantum;
  const corner = (of: typeof centres, code: number): three.Vector3 => new three.Vector3(...of.low).addScaledVector(new three.Vector3(...of.quantum), code);
  if (scene.header.elements > 0) {
    box.expandByPoint(corner(centres, 0).subScalar(most));
    box.expandByPoint(corner(centres, 65535).addScalar(most));
  }
  if (mesh.nodes > 0) {
    box.expandByPoint(corner(mesh.box, 0));
    box.expandByPoint(corner(mesh.box, 65535));
  }
  return box;
}
