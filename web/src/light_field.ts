// Light where a mover stands, as harmonics: the twin of formats/query/light_at.h, player/movers/light_samples.h and
// formats/core/sh.h. Bright lights are added as harmonics, unshadowed, as oriel-play --mover-lights harmonics does.
import * as v from './vec';
import { meanFactor } from './lights';
import type { BrightLight, LightField, LightGroup } from './types';
import type { Vec3 } from './vec';

const kLeastTrust = 1e-3, kFaint = 0.2, kPoints = 16;

/** All real harmonics of a unit direction up to a band, orthonormal, without Condon-Shortley phase. */
export function harmonics(d: Vec3, bands: number): Float64Array {
  const out = new Float64Array(bands * bands);
  let diagonal = Math.sqrt(0.25 / Math.PI), cosine = 1, sine = 0;
  for (let m = 0; m < bands; ++m) {
    if (m > 0) {
      diagonal *= Math.sqrt((2 * m + 1) / (2 * m));
      [cosine, sine] = [d[0] * cosine - d[1] * sine, d[0] * sine + d[1] * cosine];
    }
    let before = 0, n = diagonal * (m > 0 ? Math.SQRT2 : 1);
    for (let l = m; l < bands; ++l) {
      if (l > m) {
        const a = Math.sqrt((4 * l * l - 1) / (l * l - m * m));
        const b = l === m + 1 ? 0 : -a * Math.sqrt(((l - 1) ** 2 - m * m) / (4 * (l - 1) ** 2 - 1));
        [before, n] = [n, a * d[2] * n + b * before];
      }
      out[l * (l + 1) + m] = n * cosine;
      if (m > 0) out[l * (l + 1) - m] = n * sine;
    }
  }
  return out;
}

/** Light and its factors where lamps shine otherwise than they were baked. */
export interface FieldLight { field: LightField; bright: Vec3[]; probes: Vec3[]; }

export function fieldLight(field: LightField, groups: LightGroup[], factors: Vec3[]): FieldLight {
  const bright = field.lights.map((l) => l.intensity);
  groups.forEach((g, i) => {
    for (const b of g.brightLights) bright[b] = field.lights[b]!.intensity.map((x, c) => x * factors[i]![c]!) as Vec3;
  });
  return { field, bright, probes: field.valid.length === 0 ? [] : Array.from(field.valid, (_, p) => meanFactor(groups, factors, 'probes', p)) };
}

function towards(field: LightField, probe: number, d: Vec3): [number, number] {
  const r = Math.sqrt(Math.max(0, 1 - Math.abs(d[2]))), b = r * Math.atan2(Math.abs(d[1]), Math.abs(d[0])) * (2 / Math.PI), a = r - b;
  const [px, py] = d[2] < 0 ? [1 - b, 1 - a] : [a, b], side = field.depthSide, sign = (x: number): number => (x < 0 || Object.is(x, -0) ? -1 : 1);
  const x = (0.5 * px * sign(d[0]) + 0.5) * side - 0.5, y = (0.5 * py * sign(d[1]) + 0.5) * side - 0.5;
  const x0 = Math.floor(x), y0 = Math.floor(y), fx = x - x0, fy = y - y0, n = side * side, out: [number, number] = [0, 0];
  for (let k = 0; k < 4; ++k) {
    const at: [number, number] = [x0 + (k & 1), y0 + (k >> 1)];
    for (const axis of [0, 1] as const)
      if (at[axis] < 0 || at[axis] >= side) {
        at[axis] = at[axis] < 0 ? -1 - at[axis] : 2 * side - 1 - at[axis];
        at[1 - axis] = side - 1 - at[1 - axis]!;
      }
    const w = (k & 1 ? fx : 1 - fx) * (k >> 1 ? fy : 1 - fy), texel = probe * n + at[1] * side + at[0];
    out[0] += (w * field.depth[texel]!) / 65535, out[1] += (w * field.depthSquared[texel]!) / 65535;
  }
  return out;
}

/** How likely a probe sees p. */
function sight(field: LightField, probe: number, p: Vec3): number {
  const to = v.sub(p, v.at(field.positions, probe)), distance = v.length(to);
  if (!(distance > 0)) return 1;
  const [mean, square] = towards(field, probe, v.scale(to, 1 / distance)), behind = distance / field.depthCap - mean;
  if (behind <= 0) return 1;
  const variance = Math.max(square - mean * mean, 1e-6);
  return (variance / (variance + behind * behind)) ** 3;
}

function cellAt(field: LightField, p: Vec3): { cell: number; inCell: number[] } {
  const inCell = [0, 0, 0];
  let cell = 0, stride = 1;
  for (let axis = 0; axis < 3; ++axis) {
    const cells = field.size[axis]!, at = Math.min(Math.max((p[axis]! - field.lower[axis]!) / field.cell[axis]!, 0), cells), index = Math.min(Math.floor(at), cells - 1);
    inCell[axis] = at - index;
    cell += index * stride;
    stride *= cells;
  }
  while (field.cells[9 * cell]! !== 0) {
    cell = field.cells[9 * cell]!;
    for (let axis = 0; axis < 3; ++axis) {
      const upper = inCell[axis]! >= 0.5;
      inCell[axis] = 2 * inCell[axis]! - Number(upper);
      if (upper) cell += 1 << axis;
    }
  }
  return { cell, inCell };
}

const hasBit = (bits: Uint32Array, probe: number, light: number): boolean => ((bits[2 * probe + (light >> 5)]! >>> (light & 31)) & 1) > 0;

function lightSamples(light: BrightLight): { at: Vec3; w: number }[] {
  if (light.kind === 1 || light.kind === 2) return [{ at: light.position, w: 1 }];
  const out: { at: Vec3; w: number }[] = [];
  if (light.kind === 3) {
    const tangent = Math.tan(Math.min(light.angularRadius, 1.5)), n = v.scale(light.direction, -1), count = tangent > 0 ? kPoints : 1;
    const side = v.normalize(v.cross(Math.abs(n[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0], n), [1, 0, 0]), up = v.cross(n, side);
    for (let i = 0; i < count; ++i) {
      const r = count > 1 ? tangent * Math.sqrt((i + 0.5) / count) : 0, angle = 2.3999632 * i;
      out.push({ at: v.normalize(v.add(n, v.add(v.scale(side, r * Math.cos(angle)), v.scale(up, r * Math.sin(angle)))), n), w: 0 });
    }
    return out;
  }
  const areas: number[] = [], c = light.corners;
  let area = 0;
  for (let t = 0; t + 2 < c.length; t += 3) areas.push((area += 0.5 * v.length(v.cross(v.sub(c[t + 1]!, c[t]!), v.sub(c[t + 2]!, c[t]!)))));
  for (let i = 0; i < kPoints && area > 0; ++i) {
    let y = 0.5 / kPoints, t = 0;
    for (let bits = i, half = 0.5; bits > 0; bits >>= 1, half *= 0.5) y += (bits & 1) * half;
    const at = ((i + 0.5) / kPoints) * area;
    while (t + 1 < areas.length && areas[t]! <= at) ++t;
    const below = t > 0 ? areas[t - 1]! : 0, u = Math.sqrt(Math.min(Math.max((at - below) / Math.max(areas[t]! - below, 1e-30), 0), 1)), [a, b, d] = [c[3 * t]!, c[3 * t + 1]!, c[3 * t + 2]!];
    out.push({ at: v.add(v.scale(a, 1 - u), v.add(v.scale(b, u * (1 - y)), v.scale(d, u * y))), w: 1 });
  }
  return out;
}

/** Adds a light, unshadowed and times `share`, as harmonics about p. */
function addBright(light: BrightLight, intensity: Vec3, share: number, p: Vec3, bands: number, sh: Float64Array): void {
  const samples = lightSamples(light), n = bands * bands;
  let area = 1;
  if (light.kind === 0) {
    area = 0;
    for (let t = 0, c = light.corners; t + 2 < c.length; t += 3) area += 0.5 * v.length(v.cross(v.sub(c[t + 1]!, c[t]!), v.sub(c[t + 2]!, c[t]!)));
  }
  const outer = Math.cos(light.outerCone), inner = outer + Math.max(1e-3, Math.cos(light.innerCone) - outer);
  for (const { at, w } of samples) {
    const to = v.sub(at, v.scale(p, w)), distance2 = Math.max(v.dot(to, to), 1e-12), way = v.scale(to, 1 / Math.sqrt(distance2));
    const forward = -v.dot(way, light.direction);
    let shape = 1;
    if (light.kind === 0) shape = light.twoSided ? Math.abs(forward) : Math.max(forward, 0);
    if (light.kind === 2) shape = Math.min(Math.max((forward - outer) / (inner - outer), 0), 1) ** 2;
    const lux = w === 0 ? 1 : (area * shape) / distance2, y = harmonics(way, bands), times = (lux * share) / samples.length;
    for (let c = 0; c < 3; ++c) for (let k = 0; k < n; ++k) sh[c * n + k]! += times * intensity[c]! * y[k]!;
  }
}

/** Harmonics of the light at p, R, G, B; trust: how surely probes see it. */
export function lightAt(light: FieldLight, p: Vec3): { sh: Float64Array; trust: number } {
  const { field } = light, n = field.bands * field.bands, sh = new Float64Array(3 * n), { cell, inCell } = cellAt(field, p);
  const probes = [...field.cells.subarray(9 * cell + 1, 9 * cell + 9)], seen: number[] = [], valid: number[] = [], trilinear: number[] = [];
  probes.forEach((probe, i) => {
    const share = inCell.reduce((product, at, axis) => product * ((i >> axis) & 1 ? at : 1 - at), 1), ok = field.valid[probe]! > 0;
    let w = ok ? sight(field, probe, p) : 0;
    if (w < kFaint) w *= (w * w) / (kFaint * kFaint);
    trilinear.push(share), valid.push(ok ? share : 0), seen.push(w * share);
  });
  const sum = (w: number[]): number => w.reduce((a, b) => a + b, 0), trust = Math.min(1, sum(seen));
  const weights = trust > kLeastTrust ? seen : sum(valid) > 0 ? valid : trilinear, total = sum(weights), kept = field.lights.map(() => 0);
  const bright = field.lights.map(() => false);
  probes.forEach((probe, i) => {
    const w = weights[i]! / total;
    if (!(w > 0)) return;
    for (let c = 0; c < 3; ++c) {
      const factor = w * (light.probes[probe]?.[c] ?? 1);
      for (let k = 0; k < n; ++k) sh[c * n + k]! += factor * field.harmonics[(c * n + k) * field.valid.length + probe]!;
    }
    field.lights.forEach((_, l) => {
      bright[l] ||= hasBit(field.bright, probe, l);
      if (hasBit(field.kept, probe, l)) kept[l]! += w;
    });
  });
  field.lights.forEach((one, l) => {
    if (bright[l]) addBright(one, light.bright[l]!, Math.max(0, 1 - kept[l]!), p, field.bands, sh);
  });
  return { sh, trust };
}
