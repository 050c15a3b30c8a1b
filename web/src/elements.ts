// Elements of sections, byte by byte (docs/notes/format.md). Each is refused where a byte is not as it must be.
import { halfToFloat } from './bytes';
import type { ByteReader } from './bytes';
import type {
  Mesh, Material, Texture, Page, Reflector, Emitter, Slice, Kernel, Fresnel, Camera, Path, WalkGrid, LightGroup, PageGroups, Day, CurvedReflector, Surround, EmissionTexture, Metalness, SkyMap, Mover, Pose } from './types';
import type { Vec3 } from './vec';

export const mostGroups = 64;
const kMaxSide = 32768, kLargestCode = 0x7bff >> 4;

export function vec3(r: ByteReader): Vec3 { return r.floats(3) as Vec3; }

function unpackOctahedral(codes: Uint32Array, of: number): Float32Array {
  const out = new Float32Array(codes.length * of);
  for (let i = 0; i < codes.length; ++i) {
    const code = codes[i]!;
    let x = Math.max((code << 16) >> 16, -32767) / 32767, y = Math.max(code >> 16, -32767) / 32767;
    const z = 1 - Math.abs(x) - Math.abs(y);
    if (z < 0) [x, y] = [(1 - Math.abs(y)) * (x < 0 ? -1 : 1), (1 - Math.abs(x)) * (y < 0 ? -1 : 1)];
    const length = Math.hypot(x, y, z);
    out[of * i] = x / length, out[of * i + 1] = y / length, out[of * i + 2] = z / length;
  }
  return out;
}

export function readMesh(r: ByteReader): Mesh {
  const origin: Vec3 = [r.f64(), r.f64(), r.f64()];
  const vertices = r.u32(), count = r.u32(), parts = r.u32(), flags = r.size(3, 'mesh flags');
  if (count % 3 !== 0) r.fail(`found ${count} indices, expected triangles`);
  const mesh: Mesh = {
    origin, positions: r.planesF32(vertices, 3), normals: unpackOctahedral(r.planesU32(vertices), 3),
    uvs: r.planesF32(vertices, 2), lightmapUvs: r.planesF32(vertices, 2), indices: new Uint32Array(), parts: [],
  };
  if (flags & 1) mesh.colors = r.planes(vertices, 4);
  if (flags & 2) {
    mesh.normalUvs = r.planesF32(vertices, 2);
    mesh.tangents = unpackOctahedral(r.planesU32(vertices), 4);
    const sides = new Int8Array(r.planes(vertices, 1).buffer);
    for (let i = 0; i < vertices; ++i) mesh.tangents[4 * i + 3] = sides[i]!;
  }
  mesh.indices = r.planesU32(count);
  for (let i = 0, index = 0; i < count; ++i) {
    index = (index + mesh.indices[i]!) >>> 0;
    if (index >= vertices) r.fail(`found index ${index} of ${vertices} vertices`);
    mesh.indices[i] = index;
  }
  for (let i = 0; i < parts; ++i) {
    const part = { name: r.text(), first: r.u32(), count: r.u32(), material: r.u32(), page: r.i32() };
    if (part.first % 3 || part.count % 3 || part.first + part.count > count) r.fail(`found part '${part.name}' outside the indices`);
    mesh.parts.push(part);
  }
  return mesh;
}

export const readMetalness = (r: ByteReader): Metalness => ({ material: r.u32(), texture: r.i32(), dielectric: r.floats(3) });
export const readEmissionTexture = (r: ByteReader): EmissionTexture => ({ material: r.u32(), texture: r.u32(), mean: r.floats(3) });
export function readMaterial(r: ByteReader): Material {
  const name = r.text(), baseColor = r.floats(3), alpha = r.f32(), texture = r.i32();
  const alphaMode = r.choice(2, 'alpha mode'), doubleSided = r.choice(1, 'flag') > 0, unlit = r.choice(1, 'flag') > 0;
  r.choice(0, 'reserved byte');
  const cutoff = r.f32(), metallic = r.f32();
  r.floats(2);
  const f0 = r.floats(3);
  return {
    name, baseColor, alpha, texture, alphaMode, doubleSided, unlit, cutoff, metallic, f0, transmission: r.f32(), emission: r.floats(3),
    kernel: r.i32(), fresnel: r.i32(), normalTexture: r.i32(), normalScale: r.f32(),
  };
}

export function readTexture(r: ByteReader): Texture {
  r.text();
  const width = r.size(kMaxSide, 'width'), height = r.size(kMaxSide, 'height');
  const wrapS = r.choice(2, 'wrap'), wrapT = r.choice(2, 'wrap'), nearest = r.choice(1, 'filter') > 0;
  r.choice(0, 'reserved byte');
  if (!width || !height) r.fail('found a texture without texels');
  return { width, height, wrapS, wrapT, nearest, texels: r.planes(width * height, 4) };
}

// Halves that are numbers, and of light not negative.
function halves(r: ByteReader, n: number, signed: boolean): Uint16Array {
  const out = r.planesU16(n, 3);
  for (const h of out) if ((h & 0x7c00) === 0x7c00 || (!signed && h > 0x8000)) r.fail('found light that is negative or no number');
  return out;
}

export function exponent(r: ByteReader): number {
  const value = r.i32();
  if (value < -94 || value > 112) r.fail(`found exponent ${value}, expected -94 to 112`);
  return value;
}

export function readPage(r: ByteReader): Page {
  const width = r.size(kMaxSide, 'width'), height = r.size(kMaxSide, 'height'), flags = r.size(3, 'lightmap flags');
  const detailWidth = r.size(16384, 'details'), detailHeight = r.size(16384, 'details');
  const page: Page = { width, height, detailWidth, detailHeight, scale: 2 ** exponent(r), light: halves(r, width * height, false) };
  if (!width || !height) r.fail('found a page without texels');
  if (flags & 1) page.direction = halves(r, width * height, true);
  if (detailWidth > 0) {
    page.cells = r.planesU32(width * height);
    for (const code of page.cells) {
      const side = code >>> 28;
      if (code === 0) continue;
      if (side < 1 || side > 5 || (code & 0x3fff) + (1 << side) >= detailWidth || ((code >>> 14) & 0x3fff) + (1 << side) >= detailHeight)
        r.fail('found a cell outside of the image of details');
    }
    page.detail = halves(r, detailWidth * detailHeight, false);
  }
  if (flags & 2) {
    page.sharpAt = r.planesU32(width * height);
    exponent(r);
    halves(r, width * height, false);
  }
  exponent(r);
  halves(r, width * height, false);
  r.planes(width * height, 1);
  return page;
}

export function readReflector(r: ByteReader): Reflector {
  const name = r.text(), material = r.u32(), matrix = new Float64Array(r.floats(16));
  const lower = r.floats(2), upper = r.floats(2);
  r.f32();
  const flatness = r.f32();
  r.u32s(4);
  const indices = r.u32s(r.count(4)), emitters = r.size(64, 'emitters');
  const nodesX = r.size(kMaxSide, 'nodes'), nodesY = r.size(kMaxSide, 'nodes');
  if (emitters > 0 && (nodesX < 2 || nodesY < 2)) r.fail('found emitters without nodes');
  return {
    name, material, packFromReflector: matrix, lower, upper, flatness, indices, nodesX, nodesY,
    emitters: r.u32s(emitters), visibility: r.planes(nodesX * nodesY * emitters, 1),
  };
}

export function readEmitter(r: ByteReader): Emitter {
  const corners = r.choice(4, 'corners'), twoSided = r.choice(1, 'flag') > 0;
  if (corners < 3) r.fail(`found ${corners} corners, expected 3 or 4`);
  return { twoSided, radiance: r.floats(3), corners: Array.from({ length: corners }, () => vec3(r)) };
}

export function readSlice(r: ByteReader, size: number): Slice {
  const cosTheta = r.f32();
  r.floats(3);
  const shift = r.f32(), width = r.floats(2), lower = r.floats(2), upper = r.floats(2);
  r.f32();
  r.planesU16(r.count(2));
  const half = r.planesU16((size * (size + 1)) / 2), weights = new Float32Array(size * size);
  let i = 0;
  for (let y = 0; y < size; ++y)
    for (let x = (size - 1) / 2; x < size; ++x) {
      const weight = halfToFloat(half[i++]!);
      if (!(weight >= 0 && weight <= 1)) r.fail('found a weight outside 0 to 1');
      weights[y * size + x] = weights[y * size + size - 1 - x] = weight;
    }
  return { cosTheta, shift, width, lower, upper, weights };
}

export function readKernel(r: ByteReader): Kernel {
  r.choice(2, 'kernel model');
  r.u8(), r.u8(), r.u8();
  r.floats(2);
  const halfExtent = r.f32();
  r.f32();
  const size = r.size(kMaxSide, 'kernel size'), weights = r.planesF32(size * size), sliceSize = r.size(kMaxSide, 'slice size');
  const count = r.count(4);
  if (count > 256 || (count > 0 && sliceSize % 2 === 0)) r.fail(`found ${count} slices of ${sliceSize}`);
  const slices = Array.from({ length: count }, () => readSlice(r, sliceSize));
  const fits = r.count(20);
  if (fits !== 0 && fits !== count) r.fail(`found ${fits} cosine lobes of ${count} slices`);
  return { size, halfExtent, weights, sliceSize, slices, fits: Array.from({ length: fits }, () => r.floats(5)) };
}

export function readFresnel(r: ByteReader): Fresnel {
  r.f32();
  const n = r.u32(), m = r.u32(), sphere = r.size(kMaxSide, 'sphere');
  if (n < 2) r.fail('found a reflectance of fewer than two angles');
  const map = { table: r.planesF32(n, 3), factor: r.planesF32(m, 3) };
  r.planesF32(sphere * sphere, 3);
  return map;
}

export function readCamera(r: ByteReader): Camera {
  return { name: r.text(), eye: vec3(r), forward: vec3(r), up: vec3(r), fov: r.f32(), halfHeight: r.f32() };
}

export function readPath(r: ByteReader): Path {
  const name = r.text(), fov = r.f32(), count = r.count(28);
  return { name, fov, keys: Array.from({ length: count }, () => ({ time: r.f32(), eye: vec3(r), forward: vec3(r) })) };
}

export function readGrid(r: ByteReader): WalkGrid {
  const lower = r.floats(2), cell = r.f32(), eyeHeight = r.f32();
  const width = r.size(kMaxSide, 'width'), height = r.size(kMaxSide, 'height');
  if (!(cell > 0)) r.fail('found a walk grid without cells');
  return { lower, cell, eyeHeight, width, height, walkable: r.planes(width * height, 1), floor: r.planesF32(width * height) };
}

/** Of movers and of lamps. */
export function readMotion(r: ByteReader, name: string): Pick<Mover, 'rest' | 'keys'> {
  const pose = (): Pose => ({ position: vec3(r), rotation: r.floats(4) });
  const rest = pose(), keys = list(r, r.count(32), () => ({ time: r.f32(), pose: pose() }));
  keys.forEach((k, i) => { if (i > 0 && k.time < keys[i - 1]!.time) r.fail(`found keys of '${name}' whose times fall`); });
  return { rest, keys };
}

export function readGroup(r: ByteReader): LightGroup {
  const shares = (): Float32Array => Float32Array.from(r.floats(3 * r.count(12))), indices = (): Uint32Array => r.u32s(r.count(4));
  const group = {
    name: r.text(), lamps: list(r, r.count(4), () => r.text()), value: r.f32(), color: vec3(r), ownColor: vec3(r),
    materials: indices(), emitters: indices(), brightLights: indices(), sky: r.choice(1, 'sky flag') > 0,
  };
  const moves = r.choice(1, 'motion flag') > 0;
  for (let i = 0; i < 2; ++i) r.choice(0, 'reserved byte');
  if (!(group.value >= 0) || [...group.color, ...group.ownColor].some((c) => c < 0)) r.fail(`found negative light in group '${group.name}'`);
  const whole = { ...group, reflectors: shares(), surrounds: shares(), probes: shares() };
  if (moves) readMotion(r, group.name);  // lamps stand still here
  return whole;
}

export function readDay(r: ByteReader): Day {
  r.text(), r.floats(3);
  const solar = r.choice(1, 'clock') > 0;
  r.choice(16, 'sky type');
  for (let i = 0; i < 2; ++i) r.choice(0, 'reserved byte');
  const offset = r.f32(), shown = r.f32(), minutes = Math.round(Math.abs(offset) * 60);
  const clock = solar ? 'solar time' : `UTC${offset < 0 ? '-' : '+'}${clockText(minutes / 60)}`;
  const hours = list(r, r.count(40), () => {
    const hour = r.f32(), group = r.u32();
    r.floats(5);
    return { hour, group, sky: r.floats(3) };
  });
  if (hours.some((h, i) => i > 0 && !(h.hour > hours[i - 1]!.hour))) r.fail('found hours that do not rise');
  return { clock, shown, hours };
}

/** "14:30". */
export function clockText(hour: number): string {
  const minutes = Math.round(hour * 60), two = (n: number): string => String(n).padStart(2, '0');
  return `${two(Math.floor(minutes / 60))}:${two(minutes % 60)}`;
}

export function readCodes(r: ByteReader, n: number): Uint16Array {
  const codes = r.planesU16(n, 3);  // red and blue as their difference from green
  for (let i = 0; i < codes.length; i += 3) {
    codes[i]! += codes[i + 1]!, codes[i + 2]! += codes[i + 1]!;
    for (let c = 0; c < 3; ++c) if (codes[i + c]! > kLargestCode) r.fail(`found code ${codes[i + c]} of light, expected at most ${kLargestCode}`);
  }
  return codes;
}

export function readPageGroups(r: ByteReader): PageGroups {
  const page = r.u32(), width = r.size(kMaxSide, 'width'), height = r.size(kMaxSide, 'height');
  const detailWidth = r.size(16384, 'details'), detailHeight = r.size(16384, 'details'), scale = 2 ** exponent(r);
  const others = r.size(mostGroups, 'groups'), texels = width * height, points = detailWidth * detailHeight;
  return {
    page, width, height, detailWidth, detailHeight, scale, rest: r.planes(texels, 1), restOfDetail: r.planes(points, 1),
    others: list(r, others, () => ({ group: r.u32(), light: readCodes(r, texels), detail: readCodes(r, points) })),
  };
}

export function readCurved(r: ByteReader): CurvedReflector {
  const curved = { name: r.text(), material: r.u32(), map: r.u32(), indices: r.u32s(r.count(4)) };
  if (curved.indices.length % 3) r.fail(`found ${curved.indices.length} indices, expected triangles`);
  return curved;
}

export function readSurround(r: ByteReader): Surround {
  const centre = vec3(r), size = r.size(kMaxSide, 'texels'), scale = 2 ** exponent(r), nearest = r.f32(), n = size * size;
  if (size === 0 || (size & (size - 1)) > 0) r.fail(`found ${size} texels a side, expected a power of two`);
  if (!(nearest >= 0 && nearest <= 1e18)) r.fail(`found inverse distance ${nearest}`);
  const light = r.planesU32(n), codes = r.planesU16(n);
  return { centre, size, scale, light, inverseDistance: Float32Array.from(codes, (c) => (c / 65535) * nearest), valid: r.planes(n, 1) };
}

export function readSky(r: ByteReader): SkyMap {
  const width = r.size(kMaxSide, 'width'), height = r.size(kMaxSide, 'height'), scale = 2 ** exponent(r);
  return { width, height, scale, light: r.planesU32(width * height) };
}

export function list<T>(r: ByteReader, count: number, one: (r: ByteReader) => T): T[] {
  const out: T[] = [];
  for (let i = 0; i < count; ++i) out.push(one(r));
  return out;
}
