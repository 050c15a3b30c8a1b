// The frame: the passes of player/passes in their order, with the mirrored scene in planar reflectors.
import * as v from './vec';
import { Program, apply, bind, makeTarget, makeTexture } from './gl';
import { Reflections } from './reflections';
import { cutoffOf, isPartlyOpaque } from './scene';
import { makeView } from './view';
import type { Device, GpuScene, Range } from './scene';
import type { RasterState } from './gl';
import type { Camera } from './sections';
import type { View } from './view';

export const reflectorBits = 0x7f, seeThroughBit = 0x80;

interface Frame { width: number; height: number; light: WebGLTexture; depth: WebGLTexture; target: WebGLFramebuffer; }
interface Sum { texture: WebGLTexture; target: WebGLFramebuffer; }

/**
 * orders: reflectors on the way of a reflection, 0 is none; mirrors: as many, where all of them are mirrors that leave half of the
 * light; taps: of a kernel; largeOnly: no small reflectors, and no curved ones.
 */
export interface FrameOptions { orders: number; mirrors: number; taps: number; largeOnly: boolean; }
export const wholeFrame: FrameOptions = { orders: 2, mirrors: 16, taps: 48, largeOnly: false };
export const firstFrame: FrameOptions = { orders: 0, mirrors: 0, taps: 12, largeOnly: true };
export const movingFrame: FrameOptions = { orders: 1, mirrors: 1, taps: 12, largeOnly: true };

/** Where the samples of a pixel lie, as most devices have four. */
const pattern: [number, number][] = [[-0.125, -0.375], [0.375, -0.125], [-0.375, 0.125], [0.125, 0.375]];

const kBlock = 16;

export class Renderer {
  private frame?: Frame;
  private sums?: [Sum, Sum];
  private mean?: Sum;  // of the samples' light
  private blocks?: { width: number; height: number; texture: WebGLTexture; target: WebGLFramebuffer };
  private readonly depth: Program;
  private readonly plainDepth: Program;
  private readonly opaque: Program;
  private readonly plain: Program;
  private readonly reflected: Program;
  private readonly transparent: Program;
  private readonly sharp: Map<Program, Program>[];  // the same where lamps' light is computed by pixel; second: some are suns
  private readonly luminance: Program;
  private readonly sky: Program;
  private readonly average: Program;
  private readonly reflections: Reflections;
  private readonly none: WebGLVertexArrayObject;

  constructor(readonly device: Device) {
    const gl = device.gl, make = (name: string, define = ''): Program => Program.make(gl, name, define);
    this.depth = make('depth'), this.plainDepth = make('depth', 'PLAIN');
    this.opaque = make('scene'), this.plain = make('scene', 'PLAIN'), this.reflected = make('scene', 'REFLECTED');
    this.transparent = make('transparent'), this.luminance = make('screen_luminance'), this.sky = make('screen_sky'), this.average = make('screen_average');
    this.sharp = ['SHARP', 'SHARP SUNS'].map((sharp) => new Map([
      [this.opaque, make('scene', sharp)], [this.plain, make('scene', `PLAIN ${sharp}`)], [this.reflected, make('scene', `REFLECTED ${sharp}`)],
      [this.transparent, make('transparent', sharp)],
    ]));
    this.none = gl.createVertexArray()!;
    this.reflections = new Reflections(device, this, this.none);
  }

  /** Begins to compile what the first frame needs. */
  start(): void {
    for (const p of [this.plainDepth, this.plain, this.luminance, this.average]) p.start();
  }
  /** And what the others need. */
  startRest(): void {
    for (const p of [...this.reflections.programs, this.reflected, this.opaque, this.depth, this.transparent, this.sky]) p.start();
  }

  drawScreen(): void {
    const { gl } = this.device;
    gl.bindVertexArray(this.none);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  private ensure(width: number, height: number): Frame {
    if (this.frame?.width === width && this.frame.height === height) return this.frame;
    const { gl, color } = this.device;
    for (const old of [this.frame?.light, this.frame?.depth, ...[...(this.sums ?? []), this.mean].map((s) => s?.texture)]) if (old) gl.deleteTexture(old);
    for (const old of [this.frame?.target, ...[...(this.sums ?? []), this.mean].map((s) => s?.target)]) if (old) gl.deleteFramebuffer(old);
    const light = makeTexture(gl, { width, height, format: color }), depth = makeTexture(gl, { width, height, format: gl.DEPTH24_STENCIL8 });
    const sum = (format: number): Sum => {
      const texture = makeTexture(gl, { width, height, format });
      return { texture, target: makeTarget(gl, texture) };
    };
    this.sums = [sum(gl.RGBA16F), sum(gl.RGBA16F)], this.mean = sum(color);
    this.frame = { width, height, light, depth, target: makeTarget(gl, light, depth) };
    return this.frame;
  }

  /** Sample `sample` of a picture into the frame. */
  draw(scene: GpuScene, camera: Camera, width: number, height: number, sample: number | undefined, options: FrameOptions): void {
    const { gl } = this.device, frame = this.ensure(width, height);
    const view = makeView(camera, width, height, scene.movers.bounds(), sample === undefined ? [0, 0] : pattern[sample % 4]);
    const begin = (): void => {
      gl.bindFramebuffer(gl.FRAMEBUFFER, frame.target);
      gl.viewport(0, 0, width, height);
    };
    begin();
    this.clear([...scene.sky.map((s) => s * scene.unit), 1]);
    const shown = scene.opaque.filter((r) => v.mayBeVisible(view.clipFromPack, r.bounds));
    this.drawDepth(scene, view, shown);
    scene.movers.drawDepth(view);
    const target = { view, begin, inFrame: true, mirrors: 0, reflectance: 1, share: 1, texture: frame.light, values: 0 };
    const marked = this.reflections.drawMasks(scene, target, options);
    for (const m of marked) if (m.value > 0) this.reflections.draw(scene, target, m, options);
    const curved = this.reflections.curved.draw(scene, target, options);
    begin();
    this.drawSky(scene, view, 1);
    this.drawOpaque(scene, view, shown, new Set([...marked.filter((m) => m.value > 0).map((m) => m.reflector.material), ...curved.materials]));
    scene.movers.drawLight(view, false);
    this.drawTransparent(scene, view);
    for (const m of marked) if (m.value === 0) this.reflections.draw(scene, target, m, options);
    begin();
    this.reflections.curved.add(scene, target, curved.later, options);
  }

  clear(color: number[]): void {
    const { gl } = this.device;
    apply(gl, { depthWrite: true, stencilWrite: 0xff });
    gl.clearColor(color[0]!, color[1]!, color[2]!, color[3]!);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
  }

  /** The sky by direction where nothing is: the twin of ScenePass::draw_sky(). */
  drawSky(scene: GpuScene, view: View, alpha: number): void {
    if (!scene.skyMap) return;
    const { gl } = this.device, c = view.clipFromView, m = view.viewFromPack;
    // Of a view space direction the pack's, as a column.
    const column = (x: number, y: number, z: number, w: number): number[] =>
      [...[0, 1, 2].map((i) => m[4 * i]! * x + m[4 * i + 1]! * y + m[4 * i + 2]! * z), w];
    apply(gl, { depthTest: true });
    this.sky.use();
    bind(gl, 'u_sky', scene.skyMap.texture);
    this.sky.set('u_color', scene.sky.map((s) => s * scene.unit * scene.skyMap!.scale));
    this.sky.set('u_direction_from_clip',
      [...column(1 / c[0]!, 0, 0, 0), ...column(0, 1 / c[5]!, 0, 0), 0, 0, 0, 0, ...column(c[8]! / c[0]!, c[9]! / c[5]!, -1, 1)]);
    this.sky.set('u_eye', view.eye);
    this.sky.set('u_size', [view.width, view.height]);
    this.sky.set('u_alpha', alpha);
    gl.depthRange(1, 1);
    this.drawScreen();
    gl.depthRange(0, 1);
  }

  drawDepth(scene: GpuScene, view: View, shown: Range[]): void {
    scene.bindGeometry();
    for (const range of shown) {
      const m = scene.data.materials[range.material]!, program = cutoffOf(m) < 0 ? this.plainDepth : this.depth;
      apply(this.device.gl, { depthTest: true, depthWrite: true, color: false, cull: !m.doubleSided, mirrored: view.mirrored });
      program.use();
      program.set('u_clip_from_pack', view.clipFromPack);
      program.set('u_alpha', m.alpha);
      program.set('u_alpha_cutoff', cutoffOf(m));
      scene.bindBase(m.texture);
      scene.draw(range);
    }
  }

  private programFor(range: Range, scene: GpuScene, program: Program): Program {
    return scene.isSharp(range) ? this.sharp[Number(scene.hasSuns)]!.get(program)! : program;
  }

  private setFrame(program: Program, scene: GpuScene, view: View, distance: boolean): void {
    const sharp = scene.hasSharp ? this.sharp[Number(scene.hasSuns)]!.get(program) : undefined;
    if (sharp) this.setFrame(sharp, scene, view, distance);
    program.use();
    program.set('u_clip_from_pack', view.clipFromPack);
    program.set('u_eye', view.eye);
    program.set('u_change_scale', [0, 0]);
    program.set('u_alpha_kind', distance ? (view.ortho ? 2 : 1) : 0);
    const m = view.viewFromPack;
    program.set('u_depth_row', [-m[2]!, -m[6]!, -m[10]!, -m[14]!]);
    program.set('u_closest', this.device.closest);
    scene.bindGeometry();
  }

  private drawRanges(scene: GpuScene, view: View, shown: Range[], plain: Program, reflective: Set<number>, state: RasterState,
                     distance: boolean): void {
    const { gl } = this.device;
    for (const program of [plain, this.opaque]) this.setFrame(program, scene, view, distance);
    for (const range of shown) {
      const m = scene.data.materials[range.material]!, partly = isPartlyOpaque(m);
      const twice = reflective.has(range.material) || (partly && !distance), stencilRead = partly ? seeThroughBit : reflectorBits;
      const program = this.programFor(range, scene, m.normalTexture < 0 && cutoffOf(m) < 0 && !m.unlit && !scene.picture(range.material) && !scene.metalness(range.material) ? plain : this.opaque);
      program.use();
      scene.setSurface(program, range);
      program.set('u_weights', [1, 1, 1]);
      apply(gl, { ...state, cull: !m.doubleSided, stencilRead, stencilFunc: twice ? gl.EQUAL : undefined });
      scene.draw(range);
      if (!twice) continue;
      program.set('u_weights', [1, 0, 1]);
      apply(gl, { ...state, cull: !m.doubleSided, stencilRead, stencilFunc: gl.NOTEQUAL, blend: distance ? undefined : 'add' });
      scene.draw(range);
    }
  }

  private drawOpaque(scene: GpuScene, view: View, shown: Range[], reflective: Set<number>): void {
    this.drawRanges(scene, view, shown, this.plain, reflective, { depthTest: true }, false);
  }

  /** The opaque scene as a mirror shows it: alpha tells 1 / distance. dark: emitters that shine in closed form. */
  drawReflected(scene: GpuScene, view: View, shown: Range[], dark: Range[], reflective: Set<number>): void {
    const state = { depthTest: true, depthWrite: true, mirrored: view.mirrored };
    this.drawRanges(scene, view, shown, this.reflected, reflective, state, true);
    for (const range of dark) {
      const m = scene.data.materials[range.material]!, program = this.programFor(range, scene, m.normalTexture < 0 && cutoffOf(m) < 0 && !m.unlit && !scene.metalness(range.material) ? this.reflected : this.opaque);
      program.use();
      scene.setSurface(program, range);
      program.set('u_weights', [1, 1, 0]);
      apply(this.device.gl, { ...state, cull: !m.doubleSided });
      scene.draw(range);
    }
  }

  drawTransparent(scene: GpuScene, view: View): void {
    const { gl } = this.device, m = view.viewFromPack;
    const towards: v.Vec3 = [m[2]!, m[6]!, m[10]!], depth = (r: Range): number => v.dot(towards, v.centre(r.bounds));
    const sorted = scene.transparent.filter((r) => v.mayBeVisible(view.clipFromPack, r.bounds)).sort((a, b) => depth(a) - depth(b));
    if (sorted.length === 0) return;
    this.setFrame(this.transparent, scene, view, false);
    for (const range of sorted) {
      const program = this.programFor(range, scene, this.transparent);
      program.use();
      scene.setSurface(program, range);
      const material = scene.data.materials[range.material]!, covers = material.alphaMode === 2 && material.transmission <= 0;
      const state: RasterState = { depthTest: true, alpha: false, mirrored: view.mirrored, stencilRead: seeThroughBit, cull: !material.doubleSided };
      const draw = (more: RasterState, dimming: boolean, undirected: number): void => {
        apply(gl, { ...state, ...more });
        program.set('u_dimming', dimming);
        program.set('u_weights', [1, undirected, 1]);
        scene.draw(range);
      };
      if (covers) scene.orderFarToNear(range, towards);
      else draw({ blend: 'multiply' }, true, 0);
      const blend = covers ? 'cover' : 'add';
      draw({ blend, stencilFunc: view.mirrored ? undefined : gl.EQUAL }, false, 1);
      if (!view.mirrored) draw({ blend, stencilFunc: gl.NOTEQUAL }, false, 0);
    }
  }

  white = 1.2;  // cd/m2 shown as white

  /** Adds a share of the frame's light to the mean of those before, if there are some. */
  addToMean(share: number, first: boolean): void {
    const { gl } = this.device, frame = this.frame!;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.mean!.target);
    gl.viewport(0, 0, frame.width, frame.height);
    apply(gl, first ? {} : { blend: 'add' });
    if (!first) gl.blendFunc(gl.ONE, gl.ONE);  // alpha too: what is unlit does not count
    this.average.use();
    this.average.set('u_share', share);
    this.average.set('u_encode', false);
    this.average.set('u_before_weight', 0);
    this.average.set('u_scale', [1, 1]);
    bind(gl, 'u_frame', frame.light);
    this.drawScreen();
    this.average.set('u_share', 0);
  }

  /** Adds the frame, tone-mapped, to `count` that were drawn before; shows their mean, if that is to be seen. */
  show(scene: GpuScene, count: number, width: number, height: number, seen = true): void {
    const scaled = this.frame!.width !== width || this.frame!.height !== height;
    const { gl } = this.device, frame = this.frame!, [a, b] = this.sums!;
    apply(gl, {});
    this.average.use();
    this.average.set('u_exposure', 1 / (this.white * scene.unit));
    this.average.set('u_unlit_exposure', 1 / (scene.unlitWhite * scene.unit));
    this.average.set('u_count', count + 1);
    bind(gl, 'u_frame', frame.light);
    bind(gl, 'u_before', a.texture);
    this.average.set('u_before_weight', count);
    this.average.set('u_encode', false);
    this.average.set('u_scale', [1, 1]);
    gl.bindFramebuffer(gl.FRAMEBUFFER, b.target);
    gl.viewport(0, 0, frame.width, frame.height);
    this.drawScreen();
    this.sums = [b, a];
    if (!seen) return;
    bind(gl, 'u_before', b.texture);
    this.average.set('u_scale', scaled ? [frame.width / width, frame.height / height] : [1, 1]);
    this.average.set('u_before_weight', 1);
    this.average.set('u_encode', true);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    this.drawScreen();
  }

  /** Log2 luminance that the look of the frame, or of the samples' mean, asks for (player/passes/display_pass.cpp); nothing where all is black. */
  meter(scene: GpuScene, mean = false): number | undefined {
    const { gl } = this.device, frame = this.frame!, width = Math.ceil(frame.width / kBlock), height = Math.ceil(frame.height / kBlock);
    if (this.blocks?.width !== width || this.blocks.height !== height) {
      const texture = makeTexture(gl, { width, height, format: this.device.color });
      this.blocks = { width, height, texture, target: makeTarget(gl, texture) };
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.blocks.target);
    gl.viewport(0, 0, width, height);
    apply(gl, {});
    this.luminance.use();
    bind(gl, 'u_frame', mean ? this.mean!.texture : frame.light);
    this.luminance.set('u_frame_size', [frame.width, frame.height]);
    this.luminance.set('u_block', kBlock);
    this.drawScreen();
    const sums = new Float32Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, sums);
    const log = logLuminance(sums, width, height);
    return log === undefined ? undefined : log - Math.log2(scene.unit);
  }
}

/** The twin of log_luminance_of() in player/passes/display_pass.cpp. */
export function logLuminance(sums: Float32Array, width: number, height: number): number | undefined {
  const blocks: { log: number; weight: number }[] = [];
  let all = 0;
  for (let i = 0; i < width * height; ++i) {
    const sum = sums[4 * i]!, count = sums[4 * i + 1]!;
    if (!(count > 0) || !Number.isFinite(sum)) continue;
    const x = (2 * (i % width) + 1) / width - 1, y = (2 * Math.floor(i / width) + 1) / height - 1;
    const weight = count * (0.1 + Math.exp((-0.5 * (x * x + y * y)) / 0.25));
    blocks.push({ log: sum / count, weight });
    all += weight;
  }
  if (blocks.length === 0) return undefined;
  blocks.sort((a, b) => a.log - b.log);
  let run = 0, bright = blocks[blocks.length - 1]!.log;
  for (const b of blocks) {
    run += b.weight;
    if (run >= 0.9 * all) {
      bright = b.log;
      break;
    }
  }
  let sum = 0, weight = 0;
  for (const b of blocks) if (b.log >= bright - 7) sum += b.log * b.weight, weight += b.weight;
  return sum / weight;
}
