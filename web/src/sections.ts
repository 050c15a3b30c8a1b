// The sections of a piece, which has the format of a pack (docs/format.md), as the viewer uses them.
import { decompress } from 'fzstd';
import { ByteReader, PieceError, halfToFloat } from './bytes';
import type { Vec3 } from './vec';

export interface Part { name: string; first: number; count: number; material: number; page: number; }
export interface Mesh {
  origin: Vec3;
  positions: Float32Array; normals: Float32Array; uvs: Float32Array; lightmapUvs: Float32Array;
  colors?: Uint8Array; normalUvs?: Float32Array; tangents?: Float32Array;
  indices: Uint32Array; parts: Part[];
}
export interface Material {
  name: string; baseColor: number[]; alpha: number; texture: number; alphaMode: number; doubleSided: boolean; unlit: boolean;
  cutoff: number; metallic: number; transmission: number; emission: number[]; kernel: number; fresnel: number;
  normalTexture: number; normalScale: number;
}
export interface Texture {
  width: number; height: number; wrapS: number; wrapT: number; nearest: boolean; texels: Uint8Array;
}
export interface Page {
  width: number; height: number; scale: number; light: Uint16Array; direction?: Uint16Array;
  detailWidth: number; detailHeight: number; cells?: Uint32Array; detail?: Uint16Array;
}
export interface Reflector {
  name: string; material: number; packFromReflector: Float64Array; lower: number[]; upper: number[]; flatness: number;
  indices: Uint32Array; nodesX: number; nodesY: number; emitters: Uint32Array; visibility: Uint8Array;
}
export interface Emitter { twoSided: boolean; radiance: number[]; corners: Vec3[]; }
export interface Slice { cosTheta: number; shift: number; width: number[]; lower: number[]; upper: number[]; weights: Float32Array; }
export interface Kernel { size: number; halfExtent: number; weights: Float32Array; sliceSize: number; slices: Slice[]; fits: number[][]; }
export interface Fresnel { table: Float32Array; factor: Float32Array; }
export interface Camera { name: string; eye: Vec3; forward: Vec3; up: Vec3; fov: number; halfHeight: number; }
export interface Path { name: string; fov: number; keys: { time: number; eye: Vec3; forward: Vec3 }[]; }
export interface WalkGrid {
  lower: number[]; cell: number; eyeHeight: number; width: number; height: number; walkable: Uint8Array; floor: Float32Array;
}

export interface Sections {
  sky: number[]; mesh?: Mesh; materials: Material[]; textures: Texture[]; normals: Texture[]; pages: Page[];
  reflectors: Reflector[]; emitters: Emitter[]; kernels: Kernel[]; fresnels: Fresnel[];
  cameras: Camera[]; paths: Path[]; grids: WalkGrid[];
}

const kMaxSide = 32768;
const kMostBytes = 2 ** 30;  // of a section: what a browser may hold

function vec3(r: ByteReader): Vec3 { return r.floats(3) as Vec3; }

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

function readMesh(r: ByteReader): Mesh {
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

function readMaterial(r: ByteReader): Material {
  const name = r.text(), baseColor = r.floats(3), alpha = r.f32(), texture = r.i32();
  const alphaMode = r.choice(2, 'alpha mode'), doubleSided = r.choice(1, 'flag') > 0, unlit = r.choice(1, 'flag') > 0;
  r.choice(0, 'reserved byte');
  const cutoff = r.f32(), metallic = r.f32();
  r.floats(5);
  return {
    name, baseColor, alpha, texture, alphaMode, doubleSided, unlit, cutoff, metallic, transmission: r.f32(), emission: r.floats(3),
    kernel: r.i32(), fresnel: r.i32(), normalTexture: r.i32(), normalScale: r.f32(),
  };
}

function readTexture(r: ByteReader): Texture {
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

function exponent(r: ByteReader): number {
  const value = r.i32();
  if (value < -94 || value > 112) r.fail(`found exponent ${value}, expected -94 to 112`);
  return value;
}

function readPage(r: ByteReader): Page {
  const width = r.size(kMaxSide, 'width'), height = r.size(kMaxSide, 'height'), flags = r.size(1, 'lightmap flags');
  const detailWidth = r.size(16384, 'details'), detailHeight = r.size(16384, 'details');
  const page: Page = { width, height, detailWidth, detailHeight, scale: 2 ** exponent(r), light: halves(r, width * height, false) };
  if (!width || !height) r.fail('found a page without texels');
  if (flags & 1) page.direction = halves(r, width * height, true);
  if (detailWidth > 0) {
    page.cells = r.planesU32(width * height);
    for (const code of page.cells) {
      const side = code >>> 28;
      if (code === 0) continue;
      if (side < 1 || side > 3 || (code & 0x3fff) + (1 << side) >= detailWidth || ((code >>> 14) & 0x3fff) + (1 << side) >= detailHeight)
        r.fail('found a cell outside of the image of details');
    }
    page.detail = halves(r, detailWidth * detailHeight, false);
  }
  exponent(r);
  halves(r, width * height, false);
  r.planes(width * height, 1);
  return page;
}

function readReflector(r: ByteReader): Reflector {
  const name = r.text(), material = r.u32(), matrix = new Float64Array(r.floats(16));
  const lower = r.floats(2), upper = r.floats(2);
  r.f32();
  const flatness = r.f32();
  r.u32s(4);
  const indices = r.u32s(r.count(4)), emitters = r.size(16, 'emitters');
  const nodesX = r.size(kMaxSide, 'nodes'), nodesY = r.size(kMaxSide, 'nodes');
  if (emitters > 0 && (nodesX < 2 || nodesY < 2)) r.fail('found emitters without nodes');
  return {
    name, material, packFromReflector: matrix, lower, upper, flatness, indices, nodesX, nodesY,
    emitters: r.u32s(emitters), visibility: r.planes(nodesX * nodesY * emitters, 1),
  };
}

function readEmitter(r: ByteReader): Emitter {
  const corners = r.choice(4, 'corners'), twoSided = r.choice(1, 'flag') > 0;
  if (corners < 3) r.fail(`found ${corners} corners, expected 3 or 4`);
  return { twoSided, radiance: r.floats(3), corners: Array.from({ length: corners }, () => vec3(r)) };
}

function readSlice(r: ByteReader, size: number): Slice {
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

function readKernel(r: ByteReader): Kernel {
  r.choice(1, 'kernel model');
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

function readFresnel(r: ByteReader): Fresnel {
  r.f32();
  const n = r.u32(), m = r.u32(), sphere = r.size(kMaxSide, 'sphere');
  if (n < 2) r.fail('found a reflectance of fewer than two angles');
  const map = { table: r.planesF32(n, 3), factor: r.planesF32(m, 3) };
  r.planesF32(sphere * sphere, 3);
  return map;
}

function readCamera(r: ByteReader): Camera {
  return { name: r.text(), eye: vec3(r), forward: vec3(r), up: vec3(r), fov: r.f32(), halfHeight: r.f32() };
}

function readPath(r: ByteReader): Path {
  const name = r.text(), fov = r.f32(), count = r.count(28);
  return { name, fov, keys: Array.from({ length: count }, () => ({ time: r.f32(), eye: vec3(r), forward: vec3(r) })) };
}

function readGrid(r: ByteReader): WalkGrid {
  const lower = r.floats(2), cell = r.f32(), eyeHeight = r.f32();
  const width = r.size(kMaxSide, 'width'), height = r.size(kMaxSide, 'height');
  if (!(cell > 0)) r.fail('found a walk grid without cells');
  return { lower, cell, eyeHeight, width, height, walkable: r.planes(width * height, 1), floor: r.planesF32(width * height) };
}

function list<T>(r: ByteReader, count: number, one: (r: ByteReader) => T): T[] {
  const out: T[] = [];
  for (let i = 0; i < count; ++i) out.push(one(r));
  return out;
}

function readSection(kind: string, count: number, r: ByteReader, out: Sections): void {
  switch (kind) {
    case 'SCNE': out.sky = r.floats(3); break;
    case 'MESH': out.mesh = readMesh(r); break;
    case 'MATL': out.materials = list(r, count, readMaterial); break;
    case 'TEXR': out.textures.push(...list(r, count, readTexture)); break;
    case 'NTEX': out.normals.push(...list(r, count, readTexture)); break;
    case 'LMAP': out.pages.push(...list(r, count, readPage)); break;
    case 'RFLT': out.reflectors = list(r, count, readReflector); break;
    case 'EMIT': out.emitters = list(r, count, readEmitter); break;
    case 'KERN': out.kernels = list(r, count, readKernel); break;
    case 'FRES': out.fresnels = list(r, count, readFresnel); break;
    case 'CAMS': out.cameras = list(r, count, readCamera); break;
    case 'PATH': out.paths = list(r, count, readPath); break;
    case 'WALK': out.grids = list(r, count, readGrid); break;
    default: r.fail('found a section that a piece does not have');
  }
  r.end();
}

const magic = [0x8f, 0x4f, 0x52, 0x49, 0x0d, 0x0a, 0x1a, 0x0a];

/** The sections of a piece. Throws PieceError where a byte is not as docs/format.md has it. */
export function readPiece(bytes: Uint8Array, name: string): Sections {
  const fail = (text: string): never => { throw new PieceError(`${name}: ${text}`); };
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const out: Sections = {
    sky: [0, 0, 0], materials: [], textures: [], normals: [], pages: [], reflectors: [], emitters: [], kernels: [],
    fresnels: [], cameras: [], paths: [], grids: [],
  };
  if (bytes.length < 64 || magic.some((m, i) => bytes[i] !== m)) fail('is no piece of a pack');
  if (view.getUint32(8, true) !== 1) fail(`found format version ${view.getUint32(8, true)}, expected 1`);
  const sections = view.getUint32(16, true);
  if (64 + sections * 64 > bytes.length) fail('ends inside its table');
  const u64 = (at: number): number => Number(view.getBigUint64(at, true));
  for (let i = 0; i < sections; ++i) {
    const record = 64 + 64 * i, kind = String.fromCharCode(...bytes.subarray(record, record + 4));
    const codec = view.getUint32(record + 4, true), offset = u64(record + 16), stored = u64(record + 24), raw = u64(record + 32);
    const count = u64(record + 40), label = `${name}, ${kind}`;
    if (offset + stored > bytes.length) fail(`section ${kind} ends outside`);
    if (raw > kMostBytes || raw > stored * 65536 + 65536 || count > raw + 1) fail(`found ${raw} bytes in section ${kind}`);
    let content = bytes.subarray(offset, offset + stored);
    if (codec === 1) {
      try {
        content = decompress(content, new Uint8Array(raw));
      } catch {
        fail(`section ${kind} cannot be decompressed`);
      }
    } else if (codec !== 0) fail(`found codec ${codec}`);
    if (content.length !== raw) fail(`section ${kind}: found ${content.length} bytes, expected ${raw}`);
    readSection(kind, count, new ByteReader(content, label), out);
  }
  return out;
}

/** Refuses a scene whose numbers point nowhere. */
export function checkScene(scene: Sections, textures: number, normals: number): void {
  const fail = (text: string): never => { throw new PieceError(`scene: ${text}`); };
  const within = (index: number, count: number, what: string, least = -1): void => {
    if (index < least || index >= count) fail(`found ${what} ${index} of ${count}`);
  };
  const mesh = scene.mesh;
  if (!mesh) return fail('found no mesh');
  for (const p of mesh.parts) {
    within(p.material, scene.materials.length, 'material', 0);
    within(p.page, scene.pages.length, 'lightmap page');
  }
  for (const m of scene.materials) {
    within(m.texture, textures, 'texture');
    within(m.normalTexture, normals, 'normal texture');
    within(m.kernel, scene.kernels.length, 'kernel');
    within(m.fresnel, scene.fresnels.length, 'Fresnel map');
  }
  for (const r of scene.reflectors) {
    within(r.material, scene.materials.length, 'material', 0);
    for (const i of r.indices) within(i, mesh.positions.length / 3, 'vertex', 0);
    for (const e of r.emitters) within(e, scene.emitters.length, 'emitter', 0);
  }
}
