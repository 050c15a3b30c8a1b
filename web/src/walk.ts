// Where the eye is, and how it moves.
import * as v from './vec';
import { Floors } from './walker';
import type { Camera, Path, Sections } from './sections';
import type { Vec3 } from './vec';
import type { Wish } from './input';

const kSpeed = 2, kFast = 3, kMostPitch = 1.55;

export const yawOf = (forward: Vec3): number => Math.atan2(-forward[0], -forward[2]);
export const pitchOf = (forward: Vec3): number => Math.asin(Math.min(Math.max(forward[1] / Math.max(v.length(forward), 1e-12), -1), 1));
const forwardFrom = (yaw: number, pitch: number): Vec3 => [-Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), -Math.cos(yaw) * Math.cos(pitch)];

export class Walk {
  camera: Camera;
  readonly cameras: Camera[];
  readonly path?: Path;
  readonly floors: Floors;
  private readonly origin: Vec3;
  private readonly state = { fall: 0 };
  private way: Vec3[] = [];
  private tour?: number;  // seconds into the path
  place = 0;
  readonly clock: { seconds: number; runs: boolean };  // of movers' animations

  constructor(scene: Sections) {
    this.floors = new Floors(scene.grids);
    this.origin = scene.mesh!.origin;
    this.path = scene.paths.find((p) => p.keys.length > 1);
    this.cameras = scene.cameras.length > 0 ? scene.cameras : [this.somewhere(scene)];
    this.camera = { ...(this.fromHash() ?? this.cameras[0]!) };
    const time = Number(new URLSearchParams(location.hash.slice(1)).get('time') ?? NaN), fixed = Number.isFinite(time);
    this.clock = { seconds: fixed ? Math.max(time, 0) : 0, runs: !fixed && !matchMedia('(prefers-reduced-motion: reduce)').matches };
  }

  private somewhere(scene: Sections): Camera {
    const grid = scene.grids.findIndex((g) => g.walkable.some((w) => w > 0));
    const eye: Vec3 = grid < 0 ? [0, 1.6, 0] : this.floors.eyeOf(grid, scene.grids[grid]!.walkable.indexOf(1));
    return { name: 'start', eye, forward: [0, 0, -1], up: [0, 1, 0], fov: 1.05, halfHeight: 0 };
  }

  /** #camera=NAME, or x,y,z,yaw,pitch in world metres and degrees. */
  fromHash(): Camera | undefined {
    const text = new URLSearchParams(location.hash.slice(1)).get('camera');
    if (!text) return undefined;
    const named = this.cameras.find((c) => c.name === text);
    if (named) return named;
    const n = text.split(',').map(Number);
    if (n.length < 5 || n.length > 6 || !n.every(Number.isFinite)) return undefined;
    const fov = n[5] === undefined ? 60 : Math.min(Math.max(n[5], 10), 120), rad = Math.PI / 180;
    return { name: '', eye: v.sub(n.slice(0, 3) as Vec3, this.origin), forward: forwardFrom(n[3]! * rad, n[4]! * rad), up: [0, 1, 0], fov: fov * rad, halfHeight: 0 };
  }

  /** The same of where it is. */
  toHash(): string {
    const c = this.camera, eye = v.add(c.eye, this.origin), deg = 180 / Math.PI;
    const numbers = [...eye.map((x) => x.toFixed(3)), ...[yawOf(c.forward), pitchOf(c.forward), c.fov].map((a) => (a * deg).toFixed(2))];
    return `#camera=${numbers.join(',')}`;
  }

  jump(camera: Camera): void {
    this.camera = { ...camera };
    this.way = [];
    this.tour = undefined;
    this.state.fall = 0;
  }

  goTo(floor: Vec3, still: boolean): boolean {
    this.tour = undefined;
    this.way = this.floors.way(this.camera.eye, floor);
    if (still && this.way[0]) this.jump({ ...this.camera, eye: this.way[0] });
    return this.way.length > 0 || still;
  }

  get touring(): boolean { return this.tour !== undefined; }
  toggleTour(): void {
    this.tour = this.touring || !this.path ? undefined : this.path.keys[0]!.time;
    this.way = [];
  }

  /** Whether anything moved. */
  step(wish: Wish, dt: number): boolean {
    const before = { ...this.camera };
    const moved = wish.right !== 0 || wish.ahead !== 0, turned = wish.yaw !== 0 || wish.pitch !== 0;
    if (moved) this.way = [];
    if (moved || turned) this.tour = undefined;
    if (this.touring) this.alongPath(dt);
    if (turned) {
      const pitch = Math.min(Math.max(pitchOf(this.camera.forward) - wish.pitch, -kMostPitch), kMostPitch);
      this.camera.forward = forwardFrom(yawOf(this.camera.forward) - wish.yaw, pitch);
      this.camera.up = [0, 1, 0];
    }
    if (!this.touring && (moved || this.way.length > 0 || this.state.fall > 0 || this.settling)) this.walk(wish, dt);
    const changed = (a: Vec3, b: Vec3): boolean => a.some((x, i) => x !== b[i]);
    return changed(before.eye, this.camera.eye) || changed(before.forward, this.camera.forward);
  }

  private settling = false;

  private walk(wish: Wish, dt: number): void {
    const speed = (kSpeed * this.floors.eyeHeight * (wish.fast ? kFast : 1)) / 1.6, from = this.camera.eye;
    let to: Vec3 = [...from];
    if (this.way.length > 0) {
      let left = speed * 1.5 * dt;
      while (this.way.length > 0 && left > 0) {
        const next = this.way[this.way.length - 1]!, d = [next[0] - to[0], next[2] - to[2]] as const, length = Math.hypot(...d);
        const share = length > left ? left / length : 1;
        to = [to[0] + d[0] * share, to[1], to[2] + d[1] * share];
        left -= length;
        if (share === 1) this.way.pop();
      }
    } else {
      const yaw = yawOf(this.camera.forward), length = Math.max(Math.hypot(wish.right, wish.ahead), 1), by = (speed * dt) / length;
      to[0] += (Math.cos(yaw) * wish.right - Math.sin(yaw) * wish.ahead) * by;
      to[2] += (-Math.sin(yaw) * wish.right - Math.cos(yaw) * wish.ahead) * by;
    }
    this.camera.eye = this.floors.grids.length > 0 ? this.floors.walk(from, to, dt, this.state) : to;
    this.settling = this.camera.eye[1] !== from[1];
  }

  private alongPath(dt: number): void {
    const keys = this.path!.keys, last = keys[keys.length - 1]!;
    this.tour! += dt;
    if (this.tour! >= last.time) this.tour = undefined;
    const at = this.tour ?? last.time, i = Math.max(1, keys.findIndex((k) => k.time >= at)), a = keys[i - 1]!, b = keys[i]!;
    const share = Math.min(Math.max((at - a.time) / Math.max(b.time - a.time, 1e-9), 0), 1);
    const mix = (x: Vec3, y: Vec3): Vec3 => x.map((n, k) => n + (y[k]! - n) * share) as Vec3;
    this.camera = { name: '', eye: mix(a.eye, b.eye), forward: v.normalize(mix(a.forward, b.forward), a.forward), up: [0, 1, 0], fov: this.path!.fov, halfHeight: 0 };
  }
}
