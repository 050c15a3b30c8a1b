// Sharp light as shaders read it.
import * as v from './vec';
import { makeTexture } from './gl';
import { powerOf, sunPlaces } from './sharp_elements';
import type { SharpLight } from './types';
import type { Vec3 } from './vec';

export const sharpColumns = 4096;  // of its textures
const rowsFor = (n: number): number => Math.max(Math.ceil(n / sharpColumns), 1);
const halfDisks = 2 * sharpColumns;
export const sharpRows = (light: SharpLight): number => Math.max(rowsFor(light.words.length + halfDisks), rowsFor(light.triangles.length / 9 * 4));

export interface GpuSharp { suns: boolean; words: WebGLTexture; triangles: WebGLTexture; lamps: WebGLTexture; }
export function uploadSharp(gl: WebGL2RenderingContext, light: SharpLight, factors: Vec3[], unit: number): GpuSharp {
  const corners = light.triangles.length / 3, rows = rowsFor(light.words.length + halfDisks), ofTriangles = rowsFor(corners / 3 * 4);
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
  return {
    suns: light.lamps.some((l) => l.sun),
    words: makeTexture(gl, { width: sharpColumns, height: rows, format: gl.R32UI }, words),
    triangles: makeTexture(gl, { width: sharpColumns, height: ofTriangles, format: gl.RGBA32F }, triangles),
    lamps: uploadLamps(gl, light, factors, unit),
  };
}

/** As lamps shine now; unit: what light is multiplied by. */
export function uploadLamps(gl: WebGL2RenderingContext, light: SharpLight, factors: Vec3[], unit: number): WebGLTexture {
  const texels = Float32Array.from(light.lamps.flatMap((l) => {
    const power = v.scale(powerOf(l, factors), unit), sun = [...v.scale(l.direction, -1), 1, 0, 0, 0, 0, ...power, Math.tan(l.angularRadius)];
    return l.sun ? sun : [...l.position, 0, ...l.direction, l.cosOuter, ...power, l.inverseFalloff];
  }));
  return makeTexture(gl, { width: 3, height: light.lamps.length, format: gl.RGBA32F }, texels);
}
