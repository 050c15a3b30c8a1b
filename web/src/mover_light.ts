// Where movers stand, and the table of light that their vertices are shaded from: the twin of formats/query/mover_pose.h and
// player/movers/mover_light.h.
import * as v from './vec';
import { harmonics, lightAt } from './light_field';
import type { FieldLight } from './light_field';
import type { Mover, Pose, Transfer } from './types';
import type { Bounds, Mat4, Vec3 } from './vec';

const kInside = 0.7, kLeastWeight = 0.02, kFlatness = 0.05;

function slerp(a: number[], b: number[], share: number): number[] {
  let cosine = a.reduce((sum, x, i) => sum + x * b[i]!, 0), to = b;
  if (cosine < 0) cosine = -cosine, to = b.map((x) => -x);
  if (cosine > 1 - 1e-7) return a.map((x, i) => x + (to[i]! - x) * share);
  const angle = Math.acos(cosine);
  return a.map((x, i) => (Math.sin((1 - share) * angle) * x + Math.sin(share * angle) * to[i]!) / Math.sin(angle));
}

/** Its animation repeats. */
export function poseAt(mover: Mover, seconds: number): Pose {
  const keys = mover.keys, end = keys[keys.length - 1];
  if (!end) return mover.rest;
  const time = seconds > end.time ? (end.time > 0 ? seconds % end.time : end.time) : seconds, above = keys.findIndex((k) => k.time > time);
  if (above <= 0) return (above === 0 ? keys[0]! : end).pose;
  const a = keys[above - 1]!, b = keys[above]!, share = (time - a.time) / (b.time - a.time);
  return {
    position: v.add(a.pose.position, v.scale(v.sub(b.pose.position, a.pose.position), share)), rotation: slerp(a.pose.rotation, b.pose.rotation, share),
  };
}

export function packFromObject(pose: Pose): Mat4 {
  const length = Math.hypot(...pose.rotation) || 1, [x, y, z, w] = pose.rotation.map((q) => q / length) as [number, number, number, number];
  return new Float64Array([
    1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0,
    2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0,
    2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0,
    ...pose.position, 1]);
}

const corner = (i: number): [number, number, number, number] => [1, i & 1 ? kInside : -kInside, i & 2 ? kInside : -kInside, i & 4 ? kInside : -kInside];

// By corner, what its value counts in each of the four linear parts: weighted least squares by (1, q).
function fitColumns(weights: number[]): number[][] {
  const normal = Array.from({ length: 4 }, (_, r) => Array.from({ length: 4 }, (_, c) => weights.reduce((sum, w, i) => sum + w * corner(i)[r]! * corner(i)[c]!, 0)));
  for (let axis = 1; axis < 4; ++axis) normal[axis]![axis]! += kFlatness * normal[0]![0]!;
  const m = new Float64Array(normal.flat());  // symmetric, so that planeInClip(), which solves by the transpose, solves by it
  return weights.map((w, i) => v.planeInClip(m, corner(i)).map((x) => w * x));
}

// Gauss-Legendre by a uniform azimuth: exact for products of two harmonics of up to six bands.
const gauss = [[0.1252334085114689, 0.2491470458134028], [0.3678314989981802, 0.2334925365383548], [0.5873179542866175, 0.2031674267230659],
  [0.7699026741943047, 0.1600783285433462], [0.9041172563704749, 0.1069393259953184], [0.9815606342467192, 0.0471753363865118]] as const;
let directions: { way: Vec3; weight: number }[] | undefined;
function quadrature(): { way: Vec3; weight: number }[] {
  if (directions) return directions;
  const made: { way: Vec3; weight: number }[] = [], around = 12;
  for (const [cosine, weight] of gauss)
    for (const z of [cosine, -cosine])
      for (let k = 0; k < around; ++k) {
        const angle = (2 * Math.PI * k) / around, sine = Math.sqrt(1 - z * z);
        made.push({ way: [sine * Math.cos(angle), sine * Math.sin(angle), z], weight: (weight * 2 * Math.PI) / around });
      }
  return (directions = made);
}

/** Fitted coefficients, `parts` of each, turned into the object's axes. */
function turned(world: Float64Array, parts: number, bands: number, m: Mat4): Float64Array {
  const n = bands * bands, out = new Float64Array(world.length);
  for (const { way, weight } of quadrature()) {
    const own = harmonics(way, bands), there: Vec3 = [0, 1, 2].map((r) => m[r]! * way[0] + m[4 + r]! * way[1] + m[8 + r]! * way[2]) as Vec3, theirs = harmonics(there, bands);
    for (let p = 0; p < parts; ++p) {
      let value = 0;
      for (let k = 0; k < n; ++k) value += world[p * n + k]! * theirs[k]!;
      for (let k = 0; k < n; ++k) out[p * n + k]! += weight * value * own[k]!;
    }
  }
  return out;
}

/** Rows by cluster of 3 (components + 1) texels: irradiance over pi of a vertex, linear over the mover's box. */
export function moverTable(light: FieldLight, transfer: Transfer, box: Bounds, m: Mat4): Float32Array {
  const entries = transfer.components + 1, table = new Float32Array(transfer.clusters * entries * 3 * 4), { bands } = light.field, n = bands * bands;
  const corners = Array.from({ length: 8 }, (_, i) => {
    const q = corner(i), p = [0, 1, 2].map((a) => 0.5 * (box.lower[a]! + box.upper[a]!) + 0.5 * q[a + 1]! * (box.upper[a]! - box.lower[a]!)) as Vec3;
    return lightAt(light, v.point(m, p));
  });
  const columns = fitColumns(corners.map((c) => Math.max(c.trust, kLeastWeight)));
  const world = new Float64Array(12 * n);  // by colour and part
  for (let c = 0; c < 3; ++c)
    for (let part = 0; part < 4; ++part)
      for (let k = 0; k < n; ++k) world[(4 * c + part) * n + k] = corners.reduce((sum, one, i) => sum + columns[i]![part]! * one.sh[c * n + k]!, 0);
  const object = turned(world, 12, bands, m), known = Math.min(transfer.bands * transfer.bands, n);
  const stride = transfer.channels * transfer.bands * transfer.bands;
  for (let row = 0; row < transfer.clusters * entries; ++row) {
    const cluster = Math.floor(row / entries), k = row % entries, scale = k === 0 ? 1 : transfer.weightScale[cluster * (entries - 1) + k - 1]!;
    for (let c = 0; c < 3; ++c) {
      const from = row * stride + (transfer.channels === 3 ? c * transfer.bands * transfer.bands : 0);
      for (let part = 0; part < 4; ++part) {
        let sum = 0;
        for (let i = 0; i < known; ++i) sum += transfer.basis[from + i]! * object[(4 * c + part) * n + i]!;
        table[4 * (3 * row + c) + part] = scale * sum;
      }
    }
  }
  return table;
}
