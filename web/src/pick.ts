// What is under a point of the picture.
import * as v from './vec';
import { axesOf } from './view';
import type { GpuScene } from './scene';
import type { Camera } from './sections';
import type { Vec3 } from './vec';

export interface Hit { at: Vec3; normal: Vec3; distance: number; lux: number; }

/** x, y: 0 to 1 from the upper left. */
export function rayThrough(camera: Camera, x: number, y: number, aspect: number): { from: Vec3; way: Vec3 } {
  const { right, up, forward } = axesOf(camera), half = camera.fov === 0 ? camera.halfHeight : Math.tan(0.5 * camera.fov);
  const aside = v.add(v.scale(right, (2 * x - 1) * half * aspect), v.scale(up, (1 - 2 * y) * half));
  return camera.fov === 0 ? { from: v.add(camera.eye, aside), way: forward } : { from: camera.eye, way: v.normalize(v.add(forward, aside), forward) };
}

export function pick(scene: GpuScene, from: Vec3, way: Vec3): Hit | undefined {
  const mesh = scene.data.mesh!, p = mesh.positions, at = (i: number): Vec3 => v.at(p, i);
  let best: { t: number; index: number; u: number; w: number; page: number; normal: Vec3 } | undefined;
  for (const part of mesh.parts) {
    const twoSided = scene.data.materials[part.material]!.doubleSided;
    for (let i = part.first; i < part.first + part.count; i += 3) {
      const a = at(mesh.indices[i]!), ab = v.sub(at(mesh.indices[i + 1]!), a), ac = v.sub(at(mesh.indices[i + 2]!), a);
      const q = v.cross(way, ac), det = v.dot(ab, q);
      if (det === 0 || (det < 0 && !twoSided)) continue;
      const s = v.sub(from, a), u = v.dot(s, q) / det, r = v.cross(s, ab), w = v.dot(way, r) / det, t = v.dot(ac, r) / det;
      if (u < 0 || w < 0 || u + w > 1 || t <= 1e-4 || (best && t >= best.t)) continue;
      best = { t, index: i, u, w, page: part.page, normal: v.normalize(v.cross(ab, ac), [0, 1, 0]) };
    }
  }
  if (!best) return undefined;
  const { t, index, u, w, page, normal } = best, uv = mesh.lightmapUvs;
  const mix = (k: number): number => [0, 1, 2].reduce((sum, c) => sum + uv[2 * mesh.indices[index + c]! + k]! * [1 - u - w, u, w][c]!, 0);
  const place = v.add(from, v.scale(way, t));
  return { at: place, normal, distance: t, lux: page < 0 ? 0 : scene.luxAt(page, mix(0), mix(1), place, normal) };
}
