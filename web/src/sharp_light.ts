// Sharp light as shaders read it.
import * as v from './vec';
import { makeTexture } from './gl';
import { powerOf, sunPlaces } from './sharp_elements';
import type { SharpLight } from './types';
import type { Vec3 } from './vec';

export const sharpColumns = 4096;  // of its textures
const rowsFor = (n: number): number => Math.max(Math.ceil(n / sharpColumns), 1);
const halfDisks = 2 * sharpColumns;
/** Of the texture of triangles, where profiles begin; at last its end. */
function profileRows(light: SharpLight): number[] {
  const rows = [rowsFor(light.triangles.length / 9 * 4)];
  for (const p of light.profiles) rows.push(rows.at(-1)! + rowsFor(p.candela.length));
  return rows;
}
export const sharpRows = (light: SharpLight): number => Math.max(rowsFor(light.words.length + halfDisks), profileRows(light).at(-1)!);

export interface GpuSharp { suns: boolean; words: WebGLTexture; triangles: WebGLTexture; lamps: WebGLTexture; }
export function uploadSharp(gl: WebGL2RenderingContext, light: SharpLight, factors: Vec3[], unit: number): GpuSharp {
  const corners = light.triangles.length / 3, rows = rowsFor(light.words.length + halfDisks), ofProfiles = profileRows(light), ofTriangles = ofProfiles.at(-1)!;
  const words = new Uint32Array(rows * sharpColumns), triangles = new Float32Array(4 * ofTriangles * sharpColumns);
  words.set(light.words, halfDisks);
  // What the shader's half_disk() looks up: by 64 directions about the square |x| + |y| = 1, and by 64 offsets.
  for (let at = 0; at < halfDisks / 2; ++at) {
    const turn = (Math.floor(at / 64) + 0.5) / 16, x = turn < 2 ? 1 - turn : turn - 3, y = (turn < 2 ? 1 : -1) * (1 - Math.abs(x)), size = Math.hypot(x, y);
    sunPlaces.forEach(([px, py], i) => {
      if ((px * x + py * y) / size + ((at % 64) + 0.5) / 32 - 1 >= 0) words[2 * at + (i >> 5)]! |= 1 << (i & 31);
    });
  }
  for (let i = 0; i < corners; ++i) triangles.set(light.triangles.subarray(3 * i, 3 * i + 3), 4 * (i + Math.floor(i / 3)));
  light.profiles.forEach(({ rows: count, columns, candela }, k) => candela.forEach((c, i) => {
    const row = Math.floor(i / columns), next = row * columns + ((i + 1) % columns), down = row + 1 < count ? columns : 0;
    triangles.set([c, candela[i + down]!, candela[next]!, candela[next + down]!], 4 * (ofProfiles[k]! * sharpColumns + i));
  }));
  return {
    suns: light.lamps.some((l) => l.sun),
    words: makeTexture(gl, { width: sharpColumns, height: rows, format: gl.R32UI }, words),
    triangles: makeTexture(gl, { width: sharpColumns, height: ofTriangles, format: gl.RGBA32F }, triangles),
    lamps: uploadLamps(gl, light, factors, unit),
  };
}

/** As lamps shine now; unit: what light is multiplied by. */
export function uploadLamps(gl: WebGL2RenderingContext, light: SharpLight, factors: Vec3[], unit: number): WebGLTexture {
  const ofProfiles = profileRows(light), degree = Math.PI / 180;
  const texels = Float32Array.from(light.lamps.flatMap((l) => {
    const power = v.scale(powerOf(l, factors), unit), p = light.profiles[l.profile], unused = Array<number>(8).fill(0);
    if (l.sun) return [...v.scale(l.direction, -1), 1, 0, 0, 0, 0, ...power, Math.tan(l.angularRadius), ...unused];
    if (!p) return [...l.position, 0, ...l.direction, l.cosOuter, ...power, l.inverseFalloff, ...unused];
    return [
      ...l.position, -p.columns, ...l.direction, p.first * degree, ...power, (p.rows - 1) / ((p.last - p.first) * degree),
      ...l.right, p.rows - 1, ...l.over, ofProfiles[l.profile]!,
    ];
  }));
  return makeTexture(gl, { width: 5, height: light.lamps.length, format: gl.RGBA32F }, texels);
}
