// A camera and a picture size as matrices: the twin of player/navigation/view.h, which tells what they mean.
import * as v from './vec';
import type { Bounds, Mat4, Vec3, Vec4 } from './vec';
import type { Camera } from './sections';

export interface View {
  viewFromPack: Mat4; clipFromView: Mat4; clipFromPack: Mat4;
  eye: Vec4; tangents: [number, number]; centre: [number, number];
  ortho: boolean; mirrored: boolean; near: number; far: number; width: number; height: number;
}

function depthRange(bounds: Bounds, eye: Vec3, forward: Vec3, ortho: boolean): [number, number] {
  const radius = Math.max(v.radius(bounds), 1e-12);
  const middle = v.dot(v.sub(v.centre(bounds), eye), forward);
  let far = middle + radius * 1.01, near = middle - radius * 1.01;
  if (ortho) return [near, Math.max(far, near + radius * 1e-3)];
  far = Math.max(far, radius * 1e-2);
  near = Math.max(near, Math.min(0.1, radius / 64), far * 1e-5);
  return [near, Math.max(far, near * 1.001)];
}

export function clipFromViewTo(view: View, wanted: number): Mat4 {
  const far = Math.max(wanted, view.near + 1e-3 * Math.max(Math.abs(view.near), 1e-20)), depth = far - view.near;
  const [tx, ty] = view.tangents, clip = new Float64Array(16), aside = [view.centre[0] / tx, view.centre[1] / ty] as const;
  clip[0] = 1 / tx, clip[5] = 1 / ty;
  if (view.ortho) {
    clip[12] = -aside[0], clip[13] = -aside[1], clip[10] = -2 / depth, clip[14] = -(far + view.near) / depth, clip[15] = 1;
  } else {
    clip[10] = -(far + view.near) / depth, clip[14] = (-2 * far * view.near) / depth, clip[11] = -1;
    clip[8] = aside[0], clip[9] = aside[1];
  }
  return clip;
}

export function axesOf(camera: Camera): { right: Vec3; up: Vec3; forward: Vec3 } {
  const forward = v.normalize(camera.forward, [0, 0, -1]);
  let up = v.normalize(camera.up, [0, 1, 0]);
  if (v.length(v.cross(forward, up)) < 1e-5) up = Math.abs(forward[1]) < 0.9 ? [0, 1, 0] : [0, 0, -1];
  const right = v.normalize(v.cross(forward, up), [1, 0, 0]);
  return { right, up: v.cross(right, forward), forward };
}

/** jitter: what the picture is moved by, pixels. */
export function makeView(camera: Camera, width: number, height: number, bounds: Bounds, jitter: [number, number] = [0, 0]): View {
  const { right, up, forward } = axesOf(camera), ortho = camera.fov === 0, e = camera.eye;
  const m = new Float64Array([
    right[0], up[0], -forward[0], 0, right[1], up[1], -forward[1], 0, right[2], up[2], -forward[2], 0,
    -v.dot(right, e), -v.dot(up, e), v.dot(forward, e), 1]);
  const [near, far] = depthRange(bounds, e, forward, ortho);
  const half = ortho ? (camera.halfHeight > 0 ? camera.halfHeight : v.radius(bounds)) : Math.tan(0.5 * Math.min(Math.max(camera.fov, 1e-3), 3.1));
  const tangents: [number, number] = [(half * width) / height, half];
  const view: View = {
    viewFromPack: m, clipFromView: m, clipFromPack: m, eye: ortho ? [-forward[0], -forward[1], -forward[2], 0] : [...e, 1],
    tangents, centre: [(tangents[0] * 2 * jitter[0]) / width, (tangents[1] * 2 * jitter[1]) / height],
    ortho, mirrored: false, near, far, width, height,
  };
  view.clipFromView = clipFromViewTo(view, far);
  view.clipFromPack = v.multiply(view.clipFromView, m);
  return view;
}

export function partOf(view: View, origin: [number, number], width: number, height: number): View {
  const part: View = { ...view, width, height };
  part.tangents = [(view.tangents[0] * width) / view.width, (view.tangents[1] * height) / view.height];
  part.centre = [
    view.centre[0] + view.tangents[0] * ((2 * origin[0] + width) / view.width - 1),
    view.centre[1] + view.tangents[1] * ((2 * origin[1] + height) / view.height - 1)];
  part.clipFromView = clipFromViewTo(part, part.far);
  part.clipFromPack = v.multiply(part.clipFromView, part.viewFromPack);
  return part;
}

/** The clip space whose near plane is a plane of the space it comes from (Lengyel 2005). */
export function withNearPlane(clip: Mat4, plane: Vec4): Mat4 {
  const inClip = v.planeInClip(clip, plane);
  const reach = inClip[0] * (inClip[0] < 0 ? -1 : 1) + inClip[1] * (inClip[1] < 0 ? -1 : 1) + inClip[2] + inClip[3];
  if (!(reach > 0)) return clip;
  const out = clip.slice();
  for (let c = 0; c < 4; ++c) out[4 * c + 2] = (plane[c]! * 2) / reach - clip[4 * c + 3]!;
  return out;
}

export interface Rect { lower: [number, number]; upper: [number, number]; }

/** Around a polygon in a picture, clip space -1 to 1; nothing where it is outside. */
export function projectPolygon(clip: Mat4, corners: Vec3[]): Rect | undefined {
  let polygon = corners.map((c) => v.transform(clip, [c[0], c[1], c[2], 1]));
  const planes: Vec4[] = [[0, 0, 1, 1], [1, 0, 0, 1], [-1, 0, 0, 1], [0, 1, 0, 1], [0, -1, 0, 1]];
  for (const plane of planes) {
    const height = (p: Vec4): number => plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3] * p[3];
    polygon = polygon.flatMap((a, i) => {
      const b = polygon[(i + 1) % polygon.length]!, da = height(a), db = height(b);
      const kept: Vec4[] = da >= 0 ? [a] : [];
      if (da >= 0 !== db >= 0) kept.push(a.map((x, k) => x + ((b[k]! - x) * da) / (da - db)) as Vec4);
      return kept;
    });
  }
  const inside = polygon.filter((p) => p[3] > 0).map((p) => [p[0] / p[3], p[1] / p[3]].map((x) => Math.min(Math.max(x, -1), 1)));
  if (inside.length === 0) return undefined;
  const xs = inside.map((p) => p[0]!), ys = inside.map((p) => p[1]!);
  return { lower: [Math.min(...xs), Math.min(...ys)], upper: [Math.max(...xs), Math.max(...ys)] };
}
