// Vectors and matrices as arrays of numbers; matrices column by column, in double precision.

export type Vec3 = [number, number, number];
export type Vec4 = [number, number, number, number];
export type Mat4 = Float64Array;

export const at = (values: Float32Array, i: number): Vec3 => [values[3 * i]!, values[3 * i + 1]!, values[3 * i + 2]!];
export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vec3, s: number): Vec3 => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec3, b: Vec3): Vec3 =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);
export const normalize = (a: Vec3, otherwise: Vec3): Vec3 => {
  const l = length(a);
  return l > 0 && Number.isFinite(l) ? scale(a, 1 / l) : otherwise;
};

export function identity(): Mat4 {
  const m = new Float64Array(16);
  m[0] = m[5] = m[10] = m[15] = 1;
  return m;
}
export function multiply(a: Mat4, b: Mat4): Mat4 {
  const out = new Float64Array(16);
  for (let c = 0; c < 4; ++c)
    for (let r = 0; r < 4; ++r) {
      let sum = 0;
      for (let k = 0; k < 4; ++k) sum += a[4 * k + r]! * b[4 * c + k]!;
      out[4 * c + r] = sum;
    }
  return out;
}
export function transform(m: Mat4, v: Vec4): Vec4 {
  const out: Vec4 = [0, 0, 0, 0];
  for (let r = 0; r < 4; ++r) out[r] = m[r]! * v[0] + m[4 + r]! * v[1] + m[8 + r]! * v[2] + m[12 + r]! * v[3];
  return out;
}
export const point = (m: Mat4, v: Vec3): Vec3 => transform(m, [v[0], v[1], v[2], 1]).slice(0, 3) as Vec3;

/** Of a rotation and a translation. */
export function inverseRigid(m: Mat4): Mat4 {
  const out = new Float64Array(16);
  for (let r = 0; r < 3; ++r)
    for (let c = 0; c < 3; ++c) out[4 * c + r] = m[4 * r + c]!;
  for (let r = 0; r < 3; ++r) out[12 + r] = -(m[4 * r]! * m[12]! + m[4 * r + 1]! * m[13]! + m[4 * r + 2]! * m[14]!);
  out[15] = 1;
  return out;
}

/** The coefficients in clip space of a plane of the space that `m` takes to it: transpose(inverse(m)) * plane. */
export function planeInClip(m: Mat4, plane: Vec4): Vec4 {
  // Solves transpose(m) x = plane by elimination with pivots.
  const a = Array.from({ length: 4 }, (_, r) => [...Array.from({ length: 4 }, (_, c) => m[4 * r + c]!), plane[r]!]);
  for (let c = 0; c < 4; ++c) {
    let pivot = c;
    for (let r = c + 1; r < 4; ++r) if (Math.abs(a[r]![c]!) > Math.abs(a[pivot]![c]!)) pivot = r;
    [a[c], a[pivot]] = [a[pivot]!, a[c]!];
    for (let r = 0; r < 4; ++r) {
      if (r === c) continue;
      const f = a[r]![c]! / a[c]![c]!;
      for (let k = c; k < 5; ++k) a[r]![k]! -= f * a[c]![k]!;
    }
  }
  return a.map((row, i) => row[4]! / row[i]!) as Vec4;
}

export interface Bounds { lower: Vec3; upper: Vec3; }
export const emptyBounds = (): Bounds => ({ lower: [Infinity, Infinity, Infinity], upper: [-Infinity, -Infinity, -Infinity] });
export function extend(b: Bounds, x: number, y: number, z: number): void {
  b.lower[0] = Math.min(b.lower[0], x), b.lower[1] = Math.min(b.lower[1], y), b.lower[2] = Math.min(b.lower[2], z);
  b.upper[0] = Math.max(b.upper[0], x), b.upper[1] = Math.max(b.upper[1], y), b.upper[2] = Math.max(b.upper[2], z);
}
export const centre = (b: Bounds): Vec3 => scale(add(b.lower, b.upper), 0.5);
export const radius = (b: Bounds): number => 0.5 * length(sub(b.upper, b.lower));

/** Whether a box may be in what a clip matrix shows. */
export function mayBeVisible(clip: Mat4, b: Bounds): boolean {
  for (let plane = 0; plane < 6; ++plane) {
    const row = plane >> 1, sign = plane & 1 ? -1 : 1;
    let sum = clip[15]! + sign * clip[12 + row]!;
    for (let axis = 0; axis < 3; ++axis) {
      const n = clip[4 * axis + 3]! + sign * clip[4 * axis + row]!;
      sum += n * (n > 0 ? b.upper[axis]! : b.lower[axis]!);
    }
    if (sum < 0) return false;
  }
  return true;
}
