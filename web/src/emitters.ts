// Emitters that glossy reflectors show in closed form: the twin of player/scene/gpu_emitters.h and emitter_ranges.h.
import * as v from './vec';
import { makeTexture } from './gl';
import type { Emitter, Mesh, Material, Part, Reflector } from './sections';
import type { Mat4, Vec3 } from './vec';

export interface ReflectorEmitters { polygons: WebGLTexture; visibility: WebGLTexture; seen: WebGLTexture; cellsX: number; cellsY: number; }

function beforePlane(emitter: Emitter, reflectorFromPack: Mat4, size: number): Vec3[][] {
  const corners = emitter.corners.map((c) => v.scale(v.point(reflectorFromPack, c), 1 / size));
  const kept = corners.flatMap((a, i) => {
    const b = corners[(i + 1) % corners.length]!, out: Vec3[] = a[2] >= 0 ? [a] : [];
    if (a[2] >= 0 !== b[2] >= 0) out.push(v.add(a, v.scale(v.sub(b, a), a[2] / (a[2] - b[2]))));
    return out;
  });
  const polygons: Vec3[][] = [];
  if (kept.length >= 3) polygons.push([kept[0]!, kept[1]!, kept[2]!, kept[Math.min(kept.length - 1, 3)]!]);
  if (kept.length === 5) polygons.push([kept[0]!, kept[3]!, kept[4]!, kept[4]!]);
  return polygons;
}

export function uploadEmitters(gl: WebGL2RenderingContext, r: Reflector, emitters: Emitter[], reflectorFromPack: Mat4, size: number,
                               unit: number): ReflectorEmitters | undefined {
  if (r.emitters.length === 0 || !(size > 0)) return undefined;
  const cellsX = r.nodesX - 1, cellsY = r.nodesY - 1, cells = cellsX * cellsY;
  const polygons: number[] = [], visibility = new Uint8Array(4 * cells * r.emitters.length), seen = new Uint32Array(4 * cells);
  r.emitters.forEach((index, e) => {
    const emitter = emitters[index]!, nodes = r.visibility.subarray(e * r.nodesX * r.nodesY);
    const bits = beforePlane(emitter, reflectorFromPack, size).map((c) => {
      const number = emitter.twoSided ? -(e + 1) : e + 1;
      polygons.push(...c[0]!, ...c[1]!, ...c[2]!, ...c[3]!, ...emitter.radiance.map((x) => x * unit), number);
      return polygons.length / 16 - 1;
    });
    for (let y = 0; y < cellsY; ++y)
      for (let x = 0; x < cellsX; ++x) {
        const at = y * r.nodesX + x, cell = y * cellsX + x;
        const corners = [nodes[at]!, nodes[at + 1]!, nodes[at + r.nodesX]!, nodes[at + r.nodesX + 1]!];
        visibility.set(corners, 4 * (e * cells + cell));
        if (corners.some((c) => c > 0)) for (const bit of bits) seen[4 * cell + (bit >> 5)]! |= 1 << (bit & 31);
      }
  });
  if (polygons.length === 0) return undefined;
  return {
    cellsX, cellsY,
    polygons: makeTexture(gl, { width: 4, height: polygons.length / 16, format: gl.RGBA32F }, new Float32Array(polygons)),
    visibility: makeTexture(gl, { width: cellsX, height: cellsY * r.emitters.length, format: gl.RGBA8 }, visibility),
    seen: makeTexture(gl, { width: cellsX, height: cellsY, format: gl.RGBA32UI }, seen),
  };
}

/** The triangles of a mesh that lie in an emitter, by part. */
export function trianglesOf(emitter: Emitter, mesh: Mesh, materials: Material[]): { part: Part; indices: number[] }[] {
  const c = emitter.corners, n = c.length;
  let area: Vec3 = [0, 0, 0], size = 0;
  c.forEach((corner, i) => {
    area = v.add(area, v.cross(v.sub(corner, c[0]!), v.sub(c[(i + 1) % n]!, c[0]!)));
    size = Math.max(size, v.length(v.sub(c[(i + 1) % n]!, corner)));
  });
  const normal = v.normalize(area, [0, 0, 0]), tolerance = v.length(normal) > 0 ? 1e-3 * size : -1;
  const inwards = c.map((corner, i) => v.normalize(v.cross(normal, v.sub(c[(i + 1) % n]!, corner)), [0, 0, 0]));
  const holds = (index: number): boolean => {
    const p = v.at(mesh.positions, index);
    return Math.abs(v.dot(v.sub(p, c[0]!), normal)) <= tolerance && c.every((corner, i) => v.dot(v.sub(p, corner), inwards[i]!) >= -tolerance);
  };
  const out: { part: Part; indices: number[] }[] = [];
  for (const part of mesh.parts) {
    if (materials[part.material]!.emission.every((e) => e === 0)) continue;
    const indices: number[] = [];
    for (let i = part.first; i < part.first + part.count; i += 3) {
      const triangle = [...mesh.indices.subarray(i, i + 3)];
      if (triangle.every(holds)) indices.push(...triangle);
    }
    if (indices.length > 0) out.push({ part, indices });
  }
  return out;
}
