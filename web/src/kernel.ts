// K as taps of equal energy by incidence, and lobes as transformed cosines: the twin of player/scene/kernel_taps.h and
// player/scene/textures.cpp, which tell what the numbers mean.
import type { Fresnel, Kernel, Slice } from './sections';

export interface Taps { count: number; rows: number; median: number; texels: Float32Array; means: number[]; }
interface Tap { x: number; y: number; width: number; weight: number; }

function invert(weights: ArrayLike<number>, u: number): number {
  let total = 0;
  for (let i = 0; i < weights.length; ++i) total += weights[i]!;
  let left = u * total;
  for (let i = 0; i < weights.length; ++i) {
    if (left < weights[i]!) return i + left / weights[i]!;
    left -= weights[i]!;
  }
  return weights.length;
}

function radicalInverse(i: number): number {
  let value = 0;
  for (let digit = 0.5; i !== 0; i >>>= 1, digit *= 0.5) value += (i & 1) * digit;
  return value;
}

function tapsOf(weights: Float32Array, n: number, count: number, place: (x: number, y: number) => [number, number]): Tap[] {
  const rows = new Float64Array(n);
  for (let y = 0; y < n; ++y) for (let x = 0; x < n; ++x) rows[y]! += weights[y * n + x]!;
  const taps: Tap[] = [], one = place(1, 1), zero = place(0, 0), all = (one[0] - zero[0]) * (one[1] - zero[1]);
  for (let i = 0; i < count; ++i) {
    const v = invert(rows, (i + 0.5) / count), y = Math.min(Math.floor(v), n - 1);
    const u = invert(weights.subarray(y * n, y * n + n), radicalInverse(i) + 0.5 / count), x = Math.min(Math.floor(u), n - 1);
    const a = place(x / n, y / n), b = place((x + 1) / n, (y + 1) / n), at = place(u / n, v / n);
    const sharing = Math.max(weights[y * n + x]!, 1e-12) * count;
    taps.push({ x: at[0], y: at[1], width: Math.sqrt(Math.min(((b[0] - a[0]) * (b[1] - a[1])) / sharing, all)), weight: 1 });
  }
  return taps;
}

const slicePoint = (s: Slice) => (x: number, y: number): [number, number] => [
  s.width[0]! * Math.sinh(s.lower[0]! + x * (s.upper[0]! - s.lower[0]!)),
  s.shift + s.width[1]! * Math.sinh(s.lower[1]! + y * (s.upper[1]! - s.lower[1]!))];

function centredPoint(kernel: Kernel, cosine: number) {
  return (x: number, y: number): [number, number] => {
    const tx = (2 * x - 1) * kernel.halfExtent * cosine, ty = (2 * y - 1) * kernel.halfExtent;
    const f = 2 / (1 + Math.sqrt(1 + tx * tx + ty * ty));
    return [tx * f, ty * f];
  };
}

function findSlice(slices: Slice[], cosine: number): [number, number, number] {
  if (slices.length === 1) return [0, 0, 0];
  const root = (i: number): number => Math.sqrt(slices[i]!.cosTheta), at = Math.sqrt(cosine);
  let above = 1;
  while (above + 1 < slices.length && root(above) < at) ++above;
  const low = root(above - 1);
  return [above - 1, above, Math.min(Math.max((at - low) / (root(above) - low), 0), 1)];
}

function factorAt(fresnel: Fresnel | undefined, cosine: number): number {
  const table = fresnel?.factor;
  if (!table || table.length === 0) return 1;
  const last = table.length / 3 - 1, at = Math.sqrt(Math.min(Math.max(cosine, 0), 1)) * last, i = Math.min(Math.floor(at), last);
  const light = (k: number): number => 0.2126 * table[3 * k]! + 0.7152 * table[3 * k + 1]! + 0.0722 * table[3 * k + 2]!;
  return light(i) + (light(Math.min(i + 1, last)) - light(i)) * (at - i);
}

// Weighs each tap by F of its half vector; gives the mean of those above the surface.
function weigh(taps: Tap[], root: number, fresnel: Fresnel | undefined): number {
  const cosine = root * root, sine = Math.sqrt(Math.max(0, 1 - cosine * cosine));
  let sum = 0, above = 0;
  for (const tap of taps) {
    const q = 0.25 * (tap.x * tap.x + tap.y * tap.y), w = [tap.x / (1 + q), tap.y / (1 + q), (1 - q) / (1 + q)] as const;
    const eye = [0, 2 * cosine * sine, 2 * cosine * cosine - 1] as const;
    tap.weight = factorAt(fresnel, Math.sqrt(Math.max(0, 0.5 * (1 + eye[1] * w[1] + eye[2] * w[2]))));
    if (sine * w[1] + cosine * w[2] > 0) sum += tap.weight, ++above;
  }
  const mean = above > 0 ? sum / above : 1;
  for (const tap of taps) tap.weight = mean > 0 ? tap.weight / mean : 1;
  return mean;
}

export function makeTaps(kernel: Kernel | undefined, count: number, fresnel: Fresnel | undefined): Taps {
  if (!kernel || kernel.size <= 1 || !(kernel.halfExtent > 0))
    return { count: 1, rows: 1, median: 0, texels: new Float32Array([0, 0, 0, 1]), means: [1] };
  const slices = kernel.slices.map((s) => tapsOf(s.weights, kernel.sliceSize, count, slicePoint(s)));
  const rows = slices.length === 0 ? 9 : Math.max(slices.length, 2), texels = new Float32Array(4 * count * rows), means: number[] = [];
  let median = 0;
  for (let i = 0; i < rows; ++i) {
    const root = i / (rows - 1);
    let row: Tap[];
    if (slices.length === 0) {
      row = tapsOf(kernel.weights, kernel.size, count, centredPoint(kernel, Math.max(root * root, 1e-3)));
    } else {
      const [below, above, share] = findSlice(kernel.slices, root * root);
      row = slices[below]!.map((a, k) => {
        const b = slices[above]![k]!, mix = (x: number, y: number): number => x + (y - x) * share;
        return { x: mix(a.x, b.x), y: mix(a.y, b.y), width: mix(a.width, b.width), weight: 1 };
      });
    }
    means.push(weigh(row, root, fresnel));
    row.forEach((t, k) => texels.set([t.x, t.y, t.width, t.weight], 4 * (i * count + k)));
    if (i === rows - 1) median = row.map((t) => Math.hypot(t.x, t.y)).sort((a, b) => a - b)[count >> 1]!;
  }
  return { count, rows, median, texels, means };
}

export const lobeRows = 33;

/** Two rows of texels by incidence: inverse matrices in the frame of the mirror direction, and Fresnel's factors. */
export function lobeTexels(kernel: Kernel, fresnel: Fresnel | undefined, means: number[]): Float32Array {
  const out = new Float32Array(8 * lobeRows);
  const inMirrorFrame = (i: number): number[] => {
    const [x, y, z, w] = kernel.fits[i]! as [number, number, number, number], c = kernel.slices[i]!.cosTheta;
    const s = Math.sqrt(Math.max(0, 1 - c * c));
    return [x * c + y * s, y * c - x * s, z, w * c + s].map((m) => m / (c - w * s));
  };
  for (let i = 0; i < lobeRows; ++i) {
    const root = i / (lobeRows - 1), [below, above, share] = findSlice(kernel.slices, root * root);
    const a = inMirrorFrame(below), b = inMirrorFrame(above), m = a.map((x, k) => x + (b[k]! - x) * share);
    m[2] = (a[2]! * b[2]!) / (b[2]! + (a[2]! - b[2]!) * share);
    out.set(m, 4 * i);
    const at = root * (means.length - 1), low = Math.min(Math.floor(at), Math.max(means.length - 2, 0));
    const high = Math.min(low + 1, means.length - 1);
    out.set([factorAt(fresnel, root * root), means[low]! + (means[high]! - means[low]!) * (at - low)], 4 * (lobeRows + i));
  }
  return out;
}
