// Movers and the light field that they move through, byte by byte (docs/notes/format.md).
import { halfToFloat } from './bytes';
import { exponent, list, readMesh, readMotion, vec3 } from './elements';
import type { ByteReader } from './bytes';
import type { BrightLight, LightField, Mover, Transfer } from './types';

const kMostLights = 64;

function readTransfer(r: ByteReader, vertices: number): Transfer {
  const bands = r.u16(), channels = r.u16(), clusters = r.u16(), components = r.u16();
  if (bands < 2 || bands > 6 || (channels !== 1 && channels !== 3) || clusters < 1 || clusters > 256 || components < 1 || components > 64)
    r.fail(`found a transfer of ${bands} bands, ${channels} channels, ${clusters} clusters and ${components} components`);
  r.f32();
  const basis = r.f32s(clusters * (components + 1) * channels * bands * bands), weightScale = r.f32s(clusters * components);
  const cluster = r.planes(vertices, 1), weight = new Int16Array(r.planes(vertices * components, 2).buffer);
  for (const c of cluster) if (c >= clusters) r.fail(`found cluster ${c} of ${clusters}`);
  return { bands, channels, clusters, components, basis, weightScale, cluster, weight };
}

export function readMover(r: ByteReader): Mover {
  const name = r.text(), motion = readMotion(r, name), mesh = readMesh(r);
  return { name, ...motion, mesh, transfer: readTransfer(r, mesh.positions.length / 3) };
}

function readBright(r: ByteReader): BrightLight {
  r.text();
  return {
    kind: r.choice(3, 'kind of light'), twoSided: r.choice(1, 'flag') > 0, intensity: vec3(r), position: vec3(r), direction: vec3(r),
    innerCone: r.f32(), outerCone: r.f32(), angularRadius: r.f32(), corners: list(r, r.count(12), vec3),
  };
}

export function readField(r: ByteReader): LightField {
  const bands = r.u32(), depthSide = r.u32();
  if (bands < 2 || bands > 6 || depthSide < 2 || depthSide > 64) r.fail(`found ${bands} bands and depth maps of ${depthSide} texels a side`);
  const depthCap = r.f32();
  r.f32();
  const lower = vec3(r), cell = vec3(r), size = [r.u32(), r.u32(), r.u32()], cells = r.count(36), probes = r.count(12), lights = r.size(kMostLights, 'lights');
  if (!(depthCap > 0) || cell.some((c) => !(c > 0)) || size.some((n) => n < 1) || size[0]! * size[1]! * size[2]! > cells) r.fail(`found a grid of ${size.join(' x ')} cells of ${cells}`);
  const codes = new Uint32Array(r.planes(cells, 36).buffer);
  for (let i = 0; i < cells; ++i) {
    const children = codes[9 * i]!;
    if (children !== 0 && (children <= i || children + 8 > cells)) r.fail(`found parts ${children} of cell ${i} of ${cells}`);
    for (let k = 1; k < 9; ++k) if (codes[9 * i + k]! >= probes) r.fail(`found probe ${codes[9 * i + k]} of ${probes}`);
  }
  const positions = r.planesF32(probes, 3), valid = r.planes(probes, 1), bits = (): Uint32Array => new Uint32Array(r.planes(probes, 8).buffer);
  const bright = bits(), kept = bits(), up = 2 ** exponent(r), halves = r.planesU16(3 * bands * bands * probes), texels = depthSide * depthSide * probes;
  const harmonics = Float32Array.from(halves, (h) => halfToFloat(h) * up);
  if (harmonics.some((h) => !Number.isFinite(h))) r.fail('found a coefficient that is not finite');
  return {
    bands, depthSide, depthCap, lower, cell, size, cells: codes, positions, valid, bright, kept, harmonics, depth: r.planesU16(texels),
    depthSquared: r.planesU16(texels), lights: list(r, lights, readBright),
  };
}
