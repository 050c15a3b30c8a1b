// The sections of a piece, which has the format of a pack (docs/notes/format.md), and whether they fit together.
import { decompress } from 'fzstd';
import { ByteReader, PieceError } from './bytes';
import {
  readMesh, readMaterial, readEmissionTexture, readMetalness, readSky, readTexture, readPage, readReflector, readEmitter, readKernel, readFresnel, readCamera, readPath, readGrid, readGroup, readPageGroups, readDay, readCurved, readSurround, list, mostGroups,
} from './elements';
import { readField, readMover } from './mover_elements';
import { readSharp } from './sharp_elements';
import type { LightField, Mover, Page, PageGroups, Sections } from './types';

export type * from './types';

const kMostBytes = 2 ** 30;  // of a section: what a browser may hold

function readSection(kind: string, count: number, r: ByteReader, out: Sections): void {
  switch (kind) {
    case 'SCNE': out.sky = r.floats(3); break;
    case 'MESH': out.mesh = readMesh(r); break;
    case 'MATL': out.materials = list(r, count, readMaterial); break;
    case 'ETEX': out.emissionTextures = list(r, count, readEmissionTexture); break;
    case 'METL': out.metalness = list(r, count, readMetalness); break;
    case 'TEXR': out.textures.push(...list(r, count, readTexture)); break;
    case 'NTEX': out.normals.push(...list(r, count, readTexture)); break;
    case 'LMAP': out.pages.push(...list(r, count, readPage)); break;
    case 'SHRP': out.sharp = readSharp(r); break;
    case 'RFLT': out.reflectors = list(r, count, readReflector); break;
    case 'EMIT': out.emitters = list(r, count, readEmitter); break;
    case 'KERN': out.kernels = list(r, count, readKernel); break;
    case 'FRES': out.fresnels = list(r, count, readFresnel); break;
    case 'CAMS': out.cameras = list(r, count, readCamera); break;
    case 'PATH': out.paths = list(r, count, readPath); break;
    case 'CRFL': out.curved = list(r, count, readCurved); break;
    case 'SMAP': out.surrounds.push(...list(r, count, readSurround)); break;
    case 'MOVR': out.movers.push(...list(r, count, readMover)); break;
    case 'PROB': out.field = readField(r); break;
    case 'LGRP': out.groups = list(r, count, readGroup); break;
    case 'GLMP': out.pageGroups.push(...list(r, count, readPageGroups)); break;
    case 'DAYH': out.day = readDay(r); break;
    case 'SKYM': out.skyMap = readSky(r); break;
    case 'WALK': out.grids = list(r, count, readGrid); break;
    default: r.fail('found a section that a piece does not have');
  }
  r.end();
}

const magic = [0x8f, 0x4f, 0x52, 0x49, 0x0d, 0x0a, 0x1a, 0x0a];

/** The sections of a piece. Throws PieceError where a byte is not as docs/notes/format.md has it. */
export function readPiece(bytes: Uint8Array, name: string): Sections {
  const fail = (text: string): never => { throw new PieceError(`${name}: ${text}`); };
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const out: Sections = {
    sky: [0, 0, 0], materials: [], emissionTextures: [], metalness: [], textures: [], normals: [], pages: [], reflectors: [], emitters: [], kernels: [],
    fresnels: [], cameras: [], paths: [], grids: [], groups: [], pageGroups: [], curved: [], surrounds: [], movers: [],
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
export function checkScene(scene: Sections, textures: number, normals: number, surrounds: number): void {
  const fail = (text: string): never => { throw new PieceError(`scene: ${text}`); };
  const within = (index: number, count: number, what: string, least = -1): void => {
    if (index < least || index >= count) fail(`found ${what} ${index} of ${count}`);
  };
  const mesh = scene.mesh;
  if (!mesh) return fail('found no mesh');
  if (scene.pages.some((p) => p.sharpAt)) fail('found sharp light on coarse pages');
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
  for (const e of scene.emissionTextures) {
    within(e.material, scene.materials.length, 'material', 0);
    within(e.texture, textures, 'texture', 0);
  }
  for (const m of scene.metalness) {
    within(m.material, scene.materials.length, 'material', 0);
    within(m.texture, textures, 'texture');
  }
  for (const r of scene.reflectors) {
    within(r.material, scene.materials.length, 'material', 0);
    for (const i of r.indices) within(i, mesh.positions.length / 3, 'vertex', 0);
    for (const e of r.emitters) within(e, scene.emitters.length, 'emitter', 0);
  }
  for (const c of scene.curved) {
    within(c.material, scene.materials.length, 'material', 0);
    within(c.map, surrounds, 'surround map', 0);
    for (const i of c.indices) within(i, mesh.positions.length / 3, 'vertex', 0);
  }
  if (scene.groups.length > mostGroups) fail(`found ${scene.groups.length} light groups, expected at most ${mostGroups}`);
  for (const g of scene.groups) {
    for (const m of g.materials) within(m, scene.materials.length, 'material', 0);
    for (const e of g.emitters) within(e, scene.emitters.length, 'emitter', 0);
  }
}

/** Refuses light whose lamps are not those that the scene's groups name. */
export function checkField(field: LightField, scene: Sections): void {
  for (const g of scene.groups)
    for (const b of g.brightLights)
      if (b >= field.lights.length) throw new PieceError(`group '${g.name}': found bright light ${b} of ${field.lights.length}`);
}

/** Refuses a mover whose materials are not those of the scene. */
export function checkMover(mover: Mover, scene: Sections): void {
  for (const p of mover.mesh.parts)
    if (p.material >= scene.materials.length) throw new PieceError(`mover '${mover.name}': found material ${p.material} of ${scene.materials.length}`);
}

/** Refuses groups' light that is of another page, or of other groups. */
export function checkPageGroups(groups: PageGroups, scene: Sections, page: Page | undefined): void {
  const fail = (text: string): never => { throw new PieceError(`light of groups on page ${groups.page}: ${text}`); }, n = scene.groups.length;
  if (!page) return fail(`found no such page among ${scene.pages.length}`);
  if (groups.width !== page.width || groups.height !== page.height || groups.detailWidth !== page.detailWidth || groups.detailHeight !== page.detailHeight)
    fail(`found ${groups.width} x ${groups.height} texels, expected ${page.width} x ${page.height} and as many details`);
  for (const rest of [groups.rest, groups.restOfDetail]) for (const g of rest) if (g >= n) fail(`found group ${g} of ${n}`);
  for (const other of groups.others) if (other.group >= n) fail(`found group ${other.group} of ${n}`);
}
