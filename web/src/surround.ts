// Maps of what curved reflectors see, with their coarser levels in one image: the twin of player/images/surround_pyramid.h.
import { makeTexture } from './gl';
import type { Surround } from './sections';
import type { Vec3 } from './vec';

export interface GpuSurround {
  centre: Vec3; size: number; scale: number; range: [number, number]; tint: Vec3; light: WebGLTexture; inverseDistance: WebGLTexture;
}
/** Light, and in the fourth the usable part of the texel's solid angle. */
interface Level { size: number; texels: Float32Array; }

function firstLevel(map: Surround): Level {
  const texels = new Float32Array(4 * map.light.length);
  map.light.forEach((code, i) => {
    if (map.valid[i] === 0) return;
    const scale = map.scale * 2 ** ((code >>> 27) - 24);
    const x = (2 * (i % map.size) + 1) / map.size - 1, y = (2 * Math.floor(i / map.size) + 1) / map.size - 1;
    const z = 1 - Math.abs(x) - Math.abs(y), u = z < 0 ? 1 - Math.abs(y) : x, v = z < 0 ? 1 - Math.abs(x) : y;
    texels.set([(code & 511) * scale, ((code >>> 9) & 511) * scale, ((code >>> 18) & 511) * scale, Math.hypot(u, v, z) ** -3], 4 * i);
  });
  return { size: map.size, texels };
}

function halved(fine: Level): Level {
  const size = fine.size / 2, out: Level = { size, texels: new Float32Array(4 * size * size) };
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      const sum = [0, 0, 0, 0];
      for (let k = 0; k < 4; ++k) {
        const at = 4 * ((2 * y + (k >> 1)) * fine.size + 2 * x + (k & 1)), w = fine.texels[at + 3]!;
        for (let c = 0; c < 3; ++c) sum[c]! += w * fine.texels[at + c]!;
        sum[3]! += w;
      }
      if (sum[3]! > 0) out.texels.set([sum[0]! / sum[3]!, sum[1]! / sum[3]!, sum[2]! / sum[3]!, 0.25 * sum[3]!], 4 * (y * size + x));
    }
  return out;
}

// From coarse to fine: what has no light of its own takes that of the level above.
function fillGaps(levels: Level[]): void {
  for (let l = levels.length - 2; l >= 0; --l) {
    const fine = levels[l]!, coarse = levels[l + 1]!;
    for (let i = 0; i < fine.size * fine.size; ++i) {
      if (fine.texels[4 * i + 3]! > 0) continue;
      const above = 4 * (((i / fine.size) >> 1) * coarse.size + ((i % fine.size) >> 1));
      fine.texels.set(coarse.texels.subarray(above, above + 4), 4 * i);
    }
  }
}

/** put(x, y, from): each texel of a level with its border of one, in which the octahedral map goes on over its edges. */
function eachWithBorder(size: number, put: (x: number, y: number, from: number) => void): void {
  for (let y = -1; y <= size; ++y)
    for (let x = -1; x <= size; ++x) {
      const at: [number, number] = [x, y];
      for (const axis of [0, 1] as const)
        if (at[axis] < 0 || at[axis] >= size) {
          at[axis] = at[axis] < 0 ? -1 - at[axis] : 2 * size - 1 - at[axis];
          at[1 - axis] = size - 1 - at[1 - axis]!;
        }
      put(x + 1, y + 1, at[1] * size + at[0]);
    }
}

function rgb9e5(r: number, g: number, b: number): number {
  const clamp = (c: number): number => (c > 0 ? Math.min(c, 65408) : 0), c = [clamp(r), clamp(g), clamp(b)], largest = Math.max(...c);
  if (largest <= 0) return 0;
  let exponent = Math.max(-16, Math.floor(Math.log2(largest))) + 16;
  if (Math.floor(largest * 2 ** (24 - exponent) + 0.5) >= 512) ++exponent;
  const [x, y, z] = c.map((v) => Math.floor(v * 2 ** (24 - exponent) + 0.5)) as [number, number, number];
  return (x | (y << 9) | (z << 18) | (exponent << 27)) >>> 0;
}

const corner = (size: number, level: number): [number, number] =>
  level === 0 ? [0, 0] : [size + 2, size - (size >> (level - 1)) + 2 * (level - 1)];

export function uploadSurround(gl: WebGL2RenderingContext, map: Surround): GpuSurround {
  const levels = [firstLevel(map)], size = map.size;
  while (levels[levels.length - 1]!.size > 1) levels.push(halved(levels[levels.length - 1]!));
  fillGaps(levels);
  let brightest = 0, near = 0, far = Infinity;
  for (let i = 0; i < size * size; ++i) {
    for (let c = 0; c < 3; ++c) brightest = Math.max(brightest, levels[0]!.texels[4 * i + c]!);
    near = Math.max(near, map.inverseDistance[i]!), far = Math.min(far, map.inverseDistance[i]!);
  }
  const scale = brightest > 0 ? 2 ** Math.min(Math.max(Math.floor(Math.log2(brightest)) - 14, -120), 120) : 1, last = levels.length - 1;
  const width = Math.max(size + 2, last > 0 ? size + size / 2 + 4 : 0), height = Math.max(size + 2, last > 0 ? corner(size, last)[1] + 3 : 3);
  const light = new Uint32Array(width * height), distance = new Float32Array((size + 2) ** 2);
  levels.forEach((level, l) => {
    const [x0, y0] = corner(size, l), t = level.texels;
    eachWithBorder(level.size, (x, y, from) => {
      light[(y0 + y) * width + x0 + x] = rgb9e5(t[4 * from]! / scale, t[4 * from + 1]! / scale, t[4 * from + 2]! / scale);
    });
  });
  eachWithBorder(size, (x, y, from) => { distance[y * (size + 2) + x] = map.inverseDistance[from]!; });
  const filter = gl.getExtension('OES_texture_float_linear') ? gl.LINEAR : gl.NEAREST;
  return {
    centre: map.centre, size, scale, range: [near, far], tint: [1, 1, 1],
    light: makeTexture(gl, { width, height, format: gl.RGB9_E5, min: gl.LINEAR, mag: gl.LINEAR }, light),
    inverseDistance: makeTexture(gl, { width: size + 2, height: size + 2, format: gl.R32F, min: filter, mag: filter }, distance),
  };
}
