// Reflections on curved surfaces: the twin of player/reflections/curved_pass.h, which tells why light is found by pixel first.
import * as v from './vec';
import { Program, apply, bind, makeTarget, makeTexture } from './gl';
import { projectPolygon } from './view';
import type { Renderer, FrameOptions } from './frame';
import type { Target } from './reflections';
import type { Device, GpuCurved, GpuScene } from './scene';
import type { RasterState } from './gl';
import type { Vec3 } from './vec';

const reflectorBits = 0x7f, seeThroughBit = 0x80, kWideLobe = 0.03;

interface Canvas {
  width: number; height: number; places: WebGLTexture; normals: WebGLTexture; depth: WebGLTexture; light: WebGLTexture;
  surfaces: WebGLFramebuffer; shaded: WebGLFramebuffer;
}
interface Shown { curved: GpuCurved; value: number; }

export class CurvedReflections {
  private mask!: Program;
  private surface!: Program;
  private shade!: Program;
  private light!: Program;
  private shadedLight!: Program;
  private made = false;
  private canvas?: Canvas;

  constructor(private readonly device: Device, private readonly renderer: Renderer) {}

  /** Once they are wanted: compiling takes time, and the first frame waits for it. */
  private make(): void {
    const { gl } = this.device;
    this.made = true;
    this.mask = Program.make(gl, 'reflector_mask'), this.surface = Program.make(gl, 'curved_surface');
    this.shade = Program.make(gl, 'screen_curved'), this.light = Program.make(gl, 'curved_light');
    this.shadedLight = Program.make(gl, 'curved_light', 'SHADED');
  }

  /** Opaque ones in the frame are drawn, all others marked; which must be added later, and materials of all that are opaque. */
  draw(scene: GpuScene, target: Target, options: FrameOptions): { later: GpuCurved[]; materials: number[] } {
    const later: GpuCurved[] = [], materials: number[] = [], shown: Shown[] = [], { view } = target;
    if (options.largeOnly || scene.surrounds.length === 0) return { later, materials };
    if (!this.made) this.make();
    for (const curved of scene.curved) {
      if (curved.count === 0 || !scene.surrounds[curved.map] || !v.mayBeVisible(view.clipFromPack, curved.bounds)) continue;
      const seeThrough = scene.isTransparent(curved.material);
      if (seeThrough ? !target.inFrame : target.values + 1 >= reflectorBits) continue;
      const value = seeThrough ? seeThroughBit : ++target.values;
      if (!seeThrough) materials.push(curved.material);
      if (seeThrough || !target.inFrame) {
        this.drawMask(scene, target, curved, value, seeThrough ? seeThroughBit : reflectorBits);
        later.push(curved);
      } else {
        shown.push({ curved, value });
      }
    }
    if (shown.length > 0) this.drawShown(scene, target, shown, options);
    return { later, materials };
  }

  /** (M * K) R of those, added to what is there. */
  add(scene: GpuScene, target: Target, later: GpuCurved[], options: FrameOptions): void {
    for (const curved of later) this.drawLight(scene, target, curved, this.light, { blend: 'add', alpha: false }, options);
  }

  private state(target: Target, more: RasterState): RasterState {
    return { depthTest: true, cull: true, mirrored: target.view.mirrored, ...more };
  }

  private drawMask(scene: GpuScene, target: Target, curved: GpuCurved, value: number, bits: number): void {
    apply(this.device.gl, this.state(target, { color: false, stencilRef: value, stencilWrite: bits }));
    this.mask.use();
    this.mask.set('u_clip_from_pack', target.view.clipFromPack);
    scene.bindGeometry();
    scene.draw(curved);
  }

  private drawShown(scene: GpuScene, target: Target, shown: Shown[], options: FrameOptions): void {
    const { gl, color } = this.device;
    const exact = color === gl.RGBA32F;  // places want whole floats; else light is found triangle by triangle
    if (exact) this.shadeAll(scene, target, shown, options);
    target.begin();
    for (const { curved, value } of shown) {
      const state: RasterState = { stencilRef: value, stencilWrite: reflectorBits };
      if (exact) {
        this.shadedLight.use();
        this.shadedLight.set('u_id', value);
        bind(gl, 'u_shaded', this.canvas!.light);
        bind(gl, 'u_normals', this.canvas!.normals);
      }
      this.drawLight(scene, target, curved, exact ? this.shadedLight : this.light, state, options);
    }
  }

  private drawLight(scene: GpuScene, target: Target, curved: GpuCurved, program: Program, state: RasterState, options: FrameOptions): void {
    apply(this.device.gl, this.state(target, state));
    program.use();
    this.setLobe(program, scene, target, curved, options);
    this.setNormals(program, scene, target, curved);
    program.set('u_modulate', true);
    scene.setPlaceReflectance(program, curved.material);
    scene.bindGeometry();
    scene.draw(curved);
  }

  private ensure(width: number, height: number): Canvas {
    const old = this.canvas, { gl } = this.device;
    if (old && old.width >= width && old.height >= height) return old;
    if (old) {
      for (const t of [old.places, old.normals, old.depth, old.light]) gl.deleteTexture(t);
      for (const f of [old.surfaces, old.shaded]) gl.deleteFramebuffer(f);
    }
    const w = Math.max(width, old?.width ?? 0), h = Math.max(height, old?.height ?? 0);
    const make = (format: number): WebGLTexture => makeTexture(gl, { width: w, height: h, format });
    const places = make(gl.RGBA32F), normals = make(gl.RGBA32F), depth = make(gl.DEPTH24_STENCIL8), light = make(gl.RGBA16F);
    return (this.canvas = {
      width: w, height: h, places, normals, depth, light, surfaces: makeTarget(gl, places, depth, normals), shaded: makeTarget(gl, light, depth),
    });
  }

  private shadeAll(scene: GpuScene, target: Target, shown: Shown[], options: FrameOptions): void {
    const { gl } = this.device, { view } = target, canvas = this.ensure(view.width, view.height);
    gl.enable(gl.SCISSOR_TEST);
    const begin = (framebuffer: WebGLFramebuffer, what: number): void => {
      gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
      gl.viewport(0, 0, view.width, view.height);
      gl.scissor(0, 0, view.width, view.height);
      apply(gl, { depthWrite: true, stencilWrite: 0xff });
      gl.clearColor(0, 0, 0, 0);
      gl.clear(what);
    };
    begin(canvas.surfaces, gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    this.surface.use();
    for (const { curved, value } of shown) {
      apply(gl, this.state(target, { depthWrite: true, stencilRef: value, stencilWrite: 0xff }));
      this.setNormals(this.surface, scene, target, curved);
      scene.bindGeometry();
      scene.draw(curved);
    }
    begin(canvas.shaded, gl.COLOR_BUFFER_BIT);
    this.shade.use();
    bind(gl, 'u_places', canvas.places);
    bind(gl, 'u_normals', canvas.normals);
    for (const { curved, value } of shown) {
      apply(gl, { stencilFunc: gl.EQUAL, stencilRef: value });
      this.setLobe(this.shade, scene, target, curved, options);
      this.shade.set('u_id', value);
      this.scissor(target, curved);
      this.renderer.drawScreen();
    }
    gl.disable(gl.SCISSOR_TEST);
  }

  // Only the pixels around its box.
  private scissor(target: Target, curved: GpuCurved): void {
    const { lower, upper } = curved.bounds, { view } = target, box = { x0: 1, y0: 1, x1: -1, y1: -1 };
    for (let side = 0; side < 6; ++side) {
      const axis = side >> 1, a = (axis + 1) % 3, b = (axis + 2) % 3;
      const corners = [0, 1, 2, 3].map((c) => {
        const p: Vec3 = side % 2 === 0 ? [...lower] : [...upper];
        p[a] = c === 1 || c === 2 ? upper[a]! : lower[a]!, p[b] = c >= 2 ? upper[b]! : lower[b]!;
        return p;
      });
      const face = projectPolygon(view.clipFromPack, corners);
      if (!face) continue;
      box.x0 = Math.min(box.x0, face.lower[0]), box.y0 = Math.min(box.y0, face.lower[1]);
      box.x1 = Math.max(box.x1, face.upper[0]), box.y1 = Math.max(box.y1, face.upper[1]);
    }
    const pixel = (ndc: number, size: number, round: (x: number) => number): number => round((ndc * 0.5 + 0.5) * size);
    const x = pixel(box.x0, view.width, Math.floor), y = pixel(box.y0, view.height, Math.floor);
    this.device.gl.scissor(x, y, Math.max(0, pixel(box.x1, view.width, Math.ceil) - x), Math.max(0, pixel(box.y1, view.height, Math.ceil) - y));
  }

  private setNormals(program: Program, scene: GpuScene, target: Target, curved: GpuCurved): void {
    program.set('u_clip_from_pack', target.view.clipFromPack);
    program.set('u_eye', target.view.eye);
    scene.setNormals(program, curved.material);
  }

  private setLobe(program: Program, scene: GpuScene, target: Target, curved: GpuCurved, options: FrameOptions): void {
    const { gl } = this.device, map = scene.surrounds[curved.map]!, kernel = scene.kernel(curved.material, options.taps);
    bind(gl, 'u_light', map.light);
    bind(gl, 'u_inverse_distance', map.inverseDistance);
    bind(gl, 'u_taps', kernel.taps);
    program.set('u_eye', target.view.eye);
    program.set('u_centre', map.centre);
    program.set('u_size', map.size);
    program.set('u_light_scale', map.tint.map((t) => t * map.scale * scene.unit));
    program.set('u_range', map.range);
    program.set('u_tap_count', kernel.count);
    program.set('u_tap_rows', kernel.rows);
    program.set('u_wide', kernel.median >= kWideLobe);
  }
}
