// Coarser levels of textures whose alpha cuts out: those keep the share that is cut, and their colours are of what is left.
// The twin of player/images/cutout_mips.h.
import type { Texture } from './sections';

/** By texel: red, green, blue times weight; weight; alpha. */
interface Level { width: number; height: number; texels: Float32Array; }

const linear = Float32Array.from({ length: 256 }, (_, code) => (code / 255 <= 0.04045 ? code / 255 / 12.92 : ((code / 255 + 0.055) / 1.055) ** 2.4));
const srgb = (v: number): number => (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
const code = (v: number): number => Math.round(255 * Math.min(Math.max(v, 0), 1));

function firstLevel(texture: Texture, cutoff: number): Level {
  const n = texture.width * texture.height, texels = new Float32Array(5 * n), t = texture.texels;
  for (let i = 0; i < n; ++i) {
    const alpha = t[4 * i + 3]! / 255, weight = cutoff > 0 ? Number(alpha >= Math.fround(cutoff)) : alpha;
    for (let c = 0; c < 3; ++c) texels[5 * i + c] = linear[t[4 * i + c]!]! * weight;
    texels[5 * i + 3] = weight, texels[5 * i + 4] = alpha;
  }
  return { width: texture.width, height: texture.height, texels };
}

// What of a line of `from` texels texel i of `to` covers, and how much.
function covered(from: number, to: number): [number, number][][] {
  const scale = from / to;
  return Array.from({ length: to }, (_, i) => {
    const out: [number, number][] = [];
    for (let x = Math.floor(i * scale); x < from && x < (i + 1) * scale; ++x)
      out.push([x, (Math.min((i + 1) * scale, x + 1) - Math.max(i * scale, x)) / scale]);
    return out;
  });
}

function halved(fine: Level): Level {
  const width = Math.max(1, fine.width >> 1), height = Math.max(1, fine.height >> 1), texels = new Float32Array(5 * width * height);
  const columns = covered(fine.width, width), rows = covered(fine.height, height);
  rows.forEach((row, y) => columns.forEach((column, x) => {
    for (const [v, partV] of row)
      for (const [u, partU] of column)
        for (let c = 0; c < 5; ++c) texels[5 * (y * width + x) + c]! += partU * partV * fine.texels[5 * (v * fine.width + u) + c]!;
  }));
  return { width, height, texels };
}

// What alpha is multiplied by, so that the share of the level's texels that reach the cutoff is `coverage`.
function alphaScale(level: Level, coverage: number, cutoff: number): number {
  const size = level.texels.length / 5, wanted = Math.min(Math.round(coverage * size), size);
  const alphas = new Float32Array(size);
  for (let i = 0; i < size; ++i) alphas[i] = level.texels[5 * i + 4]!;
  alphas.sort().reverse();
  const passing = alphas.filter((a) => a >= Math.fround(cutoff)).length;
  if (wanted === 0 || wanted === passing) return 1;
  // Texels of one alpha pass together or not at all: where that is nearer to what is wanted, not.
  const last = alphas[wanted - 1]!, without = alphas.indexOf(last), withAll = alphas.lastIndexOf(last) + 1;
  const least = without === 0 || withAll - wanted <= wanted - without ? last : alphas[without - 1]!;
  return least > 0 ? (cutoff + 1 / 255) / least : 1;
}

function encoded(level: Level, scale: number): Uint8Array {
  const out = new Uint8Array((level.texels.length / 5) * 4), t = level.texels;
  for (let i = 0; i < out.length / 4; ++i) {
    const weight = t[5 * i + 3]!;
    for (let c = 0; c < 3; ++c) out[4 * i + c] = code(weight > 0 ? srgb(t[5 * i + c]! / weight) : 0);
    out[4 * i + 3] = code(scale * t[5 * i + 4]!);
  }
  return out;
}

/** Levels 1 and up. cutoff 0: alpha blends, and nothing is cut. */
export function cutoutMips(texture: Texture, cutoff: number): { width: number; height: number; texels: Uint8Array }[] {
  const levels: Level[] = [];
  for (let fine = firstLevel(texture, cutoff); fine.width > 1 || fine.height > 1;) levels.push((fine = halved(fine)));
  if (levels.length === 0) return [];
  const coverage = levels[levels.length - 1]!.texels[3]!;
  for (let l = levels.length - 2; l >= 0; --l) {  // coarse to fine: who has no colour takes that of the texel above
    const coarse = levels[l + 1]!, fine = levels[l]!;
    for (let y = 0, i = 0; y < fine.height; ++y)
      for (let x = 0; x < fine.width; ++x, ++i) {
        if (fine.texels[5 * i + 3]! > 0) continue;
        const above = 5 * (Math.min(y >> 1, coarse.height - 1) * coarse.width + Math.min(x >> 1, coarse.width - 1));
        fine.texels.set(coarse.texels.subarray(above, above + 4), 5 * i);
      }
  }
  return levels.map((l) => ({ width: l.width, height: l.height, texels: encoded(l, cutoff > 0 ? alphaScale(l, coverage, cutoff) : 1) }));
}
