// Sharp light as shaders read it.
import * as v from './vec';
import { makeTexture } from './gl';
import { powerOf } from './sharp_elements';
import type { SharpLight } from './types';
import type { Vec3 } from './vec';

export const sharpColumns = 4096;  // of its textures
const rowsFor = (n: number): number => Math.max(Math.ceil(n / sharpColumns), 1);
export const sharpRows = (light: SharpLight): number => Math.max(rowsFor(light.words.length), rowsFor(light.triangles.length / 9 * 4));

export interface GpuSharp { suns: boolean; words: WebGLTexture; triangles: WebGLTexture; lamps: WebGLTexture; }
export function uploadSharp(gl: WebGL2RenderingContext, light: SharpLight, factors: Vec3[], unit: number): GpuSharp {
  const corners = light.triangles.length / 3, rows = rowsFor(light.words.length), ofTriangles = rowsFor(corners / 3 * 4);
  const words = new Uint32Array(rows * sharpColumns), triangles = new Float32Array(4 * ofTriangles * sharpColumns);
  words.set(light.words);
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
