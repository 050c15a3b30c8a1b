// What planar reflectors show: the mirrored scene (M), blurred (K) and modulated (R); the twin of
// player/passes/reflection_renderer.h, with images in images.
import * as v from './vec';
import { Program, apply, bind, makeTarget, makeTexture } from './gl';
import { CurvedReflections } from './curved';
import { clipFromViewTo, partOf, projectPolygon, withNearPlane } from './view';
import type { Renderer, FrameOptions } from './frame';
import type { Device, GpuKernel, GpuReflector, GpuScene } from './scene';
import type { RasterState } from './gl';
import type { Rect, View } from './view';

const reflectorBits = 0x7f, seeThroughBit = 0x80;

export interface Target {
  view: View; begin: () => void; inFrame: boolean; mirrors: number; reflectance: number; share: number; texture: WebGLTexture;
  values: number;  // of the stencil, that reflectors have taken
}
export interface Marked { reflector: GpuReflector; screen: Rect; value: number; }  // value 0: see-through, or in an image

interface ImageRect { origin: [number, number]; width: number; height: number; coarse: number; }
interface Image {
  width: number; height: number; color: WebGLTexture; blurred: WebGLTexture; depth: WebGLTexture;
  target: WebGLFramebuffer; level: WebGLFramebuffer;
}

const kLeastReflectance = 0.01, kLeastShown = 1e-3, kMirroring = 0.5, kEdgeOn = 1e-5, kLargeShare = 0.02, kBlur = 6, kWideBlur = 16 / 6;

const shareOf = (r: Rect): number => 0.25 * (r.upper[0] - r.lower[0]) * (r.upper[1] - r.lower[1]);

export class Reflections {
  private readonly mask: Program;
  private readonly compose: Program;
  private readonly convolve: Program;
  private readonly emitters: Program;
  private readonly glints: Program;
  private readonly pull: Program;
  private readonly blur: Program;
  readonly curved: CurvedReflections;
  private readonly images: Image[] = [];

  constructor(private readonly device: Device, private readonly renderer: Renderer, private readonly none: WebGLVertexArrayObject) {
    const { gl } = device;
    this.mask = Program.make(gl, 'reflector_mask'), this.compose = Program.make(gl, 'reflector_compose');
    this.convolve = Program.make(gl, 'reflector_convolve'), this.emitters = Program.make(gl, 'reflector_emitters');
    this.glints = Program.make(gl, 'reflector_emitters_sharp');
    this.curved = new CurvedReflections(device, renderer);
    this.pull = Program.make(gl, 'screen_pull'), this.blur = Program.make(gl, 'screen_convolve');
  }

  get programs(): Program[] { return [this.mask, this.compose, this.convolve, this.emitters, this.glints, this.pull, this.blur]; }

  /** Marks the reflectors that are seen in the target, whose depth is there. */
  drawMasks(scene: GpuScene, target: Target, options: FrameOptions): Marked[] {
    const out: Marked[] = [], { gl } = this.device, view = target.view;
    target.values = 0;
    if (options.orders === 0) return out;
    for (const reflector of scene.reflectors) {
      const eye = v.transform(reflector.reflectorFromPack, view.eye);
      if (reflector.count === 0 || eye[2] <= (view.ortho ? kEdgeOn : kEdgeOn * reflector.size)) continue;
      const screen = projectPolygon(view.clipFromPack, reflector.corners);
      if (!screen || (options.largeOnly && target.share * shareOf(screen) < kLargeShare)) continue;
      const seeThrough = scene.isTransparent(reflector.material), left = target.reflectance * scene.reflectanceOf(reflector.material);
      if (!target.inFrame && (seeThrough || left < kLeastReflectance || left * target.share * shareOf(screen) < kLeastShown)) continue;
      if (target.mirrors >= options.orders && (left < kMirroring || scene.kernel(reflector.material, options.taps).count > 1)) continue;
      if (!seeThrough && target.values + 1 >= reflectorBits) continue;
      const value = seeThrough ? 0 : ++target.values;
      this.drawMask(scene, reflector, view, value, target.inFrame);
      if (target.inFrame && !reflector.visible) {
        if (!seeThrough) this.drawMask(scene, reflector, view, 0, false, true);
        continue;
      }
      out.push({ reflector, screen, value });
    }
    gl.disable(gl.STENCIL_TEST);
    return out;
  }

  // With a query whether a pixel of it is seen, which the next frame asks: waiting for this one's would stop the device.
  private drawMask(scene: GpuScene, r: GpuReflector, view: View, value: number, inFrame: boolean, clear = false): void {
    const { gl } = this.device;
    if (inFrame && r.asked && gl.getQueryParameter(r.query!, gl.QUERY_RESULT_AVAILABLE)) {
      r.visible = gl.getQueryParameter(r.query!, gl.QUERY_RESULT) > 0;
      r.asked = false;
    }
    const seeThrough = value === 0 && !clear;
    apply(gl, {
      depthTest: true, color: false, cull: true, mirrored: view.mirrored, stencilRef: seeThrough ? seeThroughBit : value,
      stencilWrite: seeThrough ? seeThroughBit : reflectorBits,
    });
    this.mask.use();
    this.mask.set('u_clip_from_pack', view.clipFromPack);
    scene.bindGeometry();
    const ask = inFrame && !r.asked;
    if (ask) gl.beginQuery(gl.ANY_SAMPLES_PASSED, (r.query ??= gl.createQuery()!));
    scene.draw(r);
    if (ask) {
      gl.endQuery(gl.ANY_SAMPLES_PASSED);
      r.asked = true;
    }
  }

  private chooseImage(screen: Rect, median: number, view: View): ImageRect {
    const blur = view.ortho ? 0 : (0.5 * median * 0.5 * view.height) / view.tangents[1];
    const coarse = blur >= kWideBlur * kBlur ? 4 : blur >= kBlur ? 2 : 1, step = blur >= kBlur ? 4 : 1;
    const most = Math.max(view.width, view.height);
    const margin = Math.ceil(Math.min(Math.max(4 * blur, 4), 0.15 * most + 4));
    const edge = (ndc: number, size: number, by: number, round: (x: number) => number): number => step * round(((ndc * 0.5 + 0.5) * size + by) / step);
    const x0 = edge(screen.lower[0], view.width, -margin, Math.floor), y0 = edge(screen.lower[1], view.height, -margin, Math.floor);
    const x1 = edge(screen.upper[0], view.width, margin, Math.ceil), y1 = edge(screen.upper[1], view.height, margin, Math.ceil);
    return { origin: [x0, y0], width: Math.max(x1 - x0, 1), height: Math.max(y1 - y0, 1), coarse };
  }

  private image(level: number, width: number, height: number): Image {
    const old = this.images[level];
    if (old && old.width >= width && old.height >= height) return old;
    const { gl, color, linear } = this.device, power = (n: number, had: number): number => 2 ** Math.ceil(Math.log2(Math.max(n, had, 16)));
    const w = power(width, old?.width ?? 0), h = power(height, old?.height ?? 0);
    if (old) {
      for (const t of [old.color, old.blurred, old.depth]) gl.deleteTexture(t);
      for (const f of [old.target, old.level]) gl.deleteFramebuffer(f);
    }
    const levels = Math.log2(Math.max(w, h)) + 1;
    const texture = makeTexture(gl, { width: w, height: h, levels, format: color, min: gl.LINEAR_MIPMAP_NEAREST, mag: linear });
    const blurred = makeTexture(gl, { width: w, height: h, format: color, min: linear, mag: linear });
    const depth = makeTexture(gl, { width: w, height: h, format: gl.DEPTH24_STENCIL8 });
    return (this.images[level] = { width: w, height: h, color: texture, blurred, depth, target: makeTarget(gl, texture, depth), level: makeTarget(gl, blurred) });
  }

  /** S of one of them into the target: in place of what is there, or added to it. */
  draw(scene: GpuScene, target: Target, marked: Marked, options: FrameOptions): void {
    const r = marked.reflector, kernel = scene.kernel(r.material, options.taps), blurs = kernel.count > 1;
    const rect = this.chooseImage(marked.screen, blurs ? kernel.median : 0, target.view);
    const image = this.image(target.mirrors, rect.width, rect.height);
    this.drawMirrored(scene, target, r, rect, image, options);
    if (blurs) this.makeLevels(rect, image);
    if (blurs && rect.coarse > 1) this.drawBlurred(scene, target.view, r, kernel, rect, image);
    target.begin();
    this.drawComposed(scene, target, marked, kernel, rect, image);
    this.drawEmitters(scene, target, marked, kernel);
  }

  private drawMirrored(scene: GpuScene, target: Target, r: GpuReflector, rect: ImageRect, image: Image, options: FrameOptions): void {
    const { gl, closest } = this.device, outer = target.view;
    const begin = (): void => {
      gl.bindFramebuffer(gl.FRAMEBUFFER, image.target);
      gl.viewport(0, 0, rect.width, rect.height);
    };
    begin();
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(0, 0, rect.width, rect.height);
    this.renderer.clear([...scene.sky.map((s) => s * scene.unit), closest]);
    gl.disable(gl.SCISSOR_TEST);
    const view = this.mirroredView(scene, r, outer, rect);
    this.renderer.drawSky(scene, view, closest);
    const shown = scene.opaque.filter((range) => v.mayBeVisible(view.clipFromPack, range.bounds));
    const dark = r.dark.filter((range) => v.mayBeVisible(view.clipFromPack, range.bounds));
    const inside: Target = {
      view, begin, inFrame: false, mirrors: target.mirrors + 1, texture: image.color, values: 0,
      reflectance: target.reflectance * scene.reflectanceOf(r.material),
      share: (target.share * view.width * view.height) / (outer.width * outer.height),
    };
    if (inside.mirrors < options.mirrors) {
      this.renderer.drawDepth(scene, view, shown);
      const marked = this.drawMasks(scene, inside, options), curved = this.curved.draw(scene, inside, options);
      this.renderer.drawReflected(scene, view, shown, dark, new Set([...marked.map((m) => m.reflector.material), ...curved.materials]));
      for (const m of marked) this.draw(scene, inside, m, options);
      begin();
      this.curved.add(scene, inside, curved.later, options);
    } else {
      this.renderer.drawReflected(scene, view, shown, dark, new Set());
    }
    if (scene.movers.some) {
      scene.movers.drawDepth(view);
      scene.movers.drawLight(view, true);
    }
    this.renderer.drawTransparent(scene, view);
  }

  private mirroredView(scene: GpuScene, r: GpuReflector, outer: View, rect: ImageRect): View {
    const mirror = v.identity();
    mirror[10] = -1;
    const viewFromReflector = v.multiply(outer.viewFromPack, r.packFromReflector);
    const viewFromPack = v.multiply(v.multiply(viewFromReflector, mirror), r.reflectorFromPack);
    const eye = v.transform(r.reflectorFromPack, outer.eye);
    eye[2] = -eye[2];
    let far = 0;
    const b = scene.bounds;
    for (let i = 0; i < 8; ++i) {
      const corner = v.point(viewFromPack, [i & 1 ? b.upper[0] : b.lower[0], i & 2 ? b.upper[1] : b.lower[1], i & 4 ? b.upper[2] : b.lower[2]]);
      far = Math.max(far, -1.01 * corner[2]);
    }
    const view = partOf(outer, rect.origin, rect.width, rect.height);
    view.far = Math.max(outer.far, far);
    view.mirrored = !outer.mirrored;
    view.viewFromPack = viewFromPack;
    view.eye = v.transform(r.packFromReflector, eye);
    view.clipFromView = clipFromViewTo(view, view.far);
    const m = r.reflectorFromPack;  // the reflector's height, a little above it: without the reflector itself
    view.clipFromPack = withNearPlane(v.multiply(view.clipFromView, viewFromPack), [m[2]!, m[6]!, m[10]!, m[14]! - r.flatness - 1e-5 * r.size]);
    return view;
  }

  private makeLevels(rect: ImageRect, image: Image): void {
    const { gl } = this.device, levels = Math.ceil(Math.log2(Math.max(rect.width, rect.height))) + 1;
    const size = (n: number, level: number): number => Math.max(1, (n + (1 << level) - 1) >> level);
    apply(gl, {});
    this.pull.use();
    this.pull.set('u_reach', 1e30);
    gl.bindFramebuffer(gl.FRAMEBUFFER, image.level);
    for (let level = 1; level < levels; ++level) {
      bind(gl, 'u_source', image.color);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_BASE_LEVEL, level - 1);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAX_LEVEL, level - 1);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, image.color, level);
      this.pull.set('u_source_size', [size(rect.width, level - 1), size(rect.height, level - 1)]);
      gl.viewport(0, 0, size(rect.width, level), size(rect.height, level));
      this.renderer.drawScreen();
    }
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, image.blurred, 0);
    bind(gl, 'u_source', image.color);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_BASE_LEVEL, 0);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAX_LEVEL, levels - 1);
  }

  private setConvolution(program: Program, scene: GpuScene, view: View, r: GpuReflector, kernel: GpuKernel, rect: ImageRect, image: Image): void {
    const { gl } = this.device, m = v.multiply(view.viewFromPack, r.packFromReflector);
    const normal = v.normalize([m[8]!, m[9]!, m[10]!], [0, 0, 1]), aside = [view.centre[0] / view.tangents[0], view.centre[1] / view.tangents[1]];
    program.set('u_ndc_from_image', [2 / view.width, 2 / view.height, (2 * rect.origin[0]) / view.width - 1 + aside[0]!, (2 * rect.origin[1]) / view.height - 1 + aside[1]!]);
    program.set('u_tangents', view.tangents);
    program.set('u_ortho', view.ortho ? 1 : 0);
    program.set('u_plane_normal', normal);
    program.set('u_plane_offset', v.dot(normal, [m[12]!, m[13]!, m[14]!]));
    program.set('u_farthest', 1e4 * Math.max(v.radius(scene.bounds), 1e-12));
    program.set('u_constant_footprint', -1);
    program.set('u_median', kernel.median);
    program.set('u_coarse', rect.coarse);
    program.set('u_pixels_per_tangent', (0.5 * view.height) / view.tangents[1]);
    bind(gl, 'u_image', image.color);
    bind(gl, 'u_taps', kernel.taps);
    program.set('u_image_size', [rect.width, rect.height]);
    program.set('u_texture_size', [image.width, image.height]);
    program.set('u_tap_count', kernel.count);
    program.set('u_tap_rows', kernel.rows);
  }

  private drawBlurred(scene: GpuScene, view: View, r: GpuReflector, kernel: GpuKernel, rect: ImageRect, image: Image): void {
    const { gl } = this.device;
    gl.bindFramebuffer(gl.FRAMEBUFFER, image.level);
    gl.viewport(0, 0, Math.floor(rect.width / rect.coarse), Math.floor(rect.height / rect.coarse));
    apply(gl, {});
    this.blur.use();
    this.setConvolution(this.blur, scene, view, r, kernel, rect, image);
    gl.bindVertexArray(this.none);
    this.renderer.drawScreen();
  }

  private where(target: Target, marked: Marked, withDistance: boolean): RasterState {
    const state: RasterState = { depthTest: true, cull: true, mirrored: target.view.mirrored };
    if (target.inFrame && marked.value > 0)
      return { ...state, stencilFunc: this.device.gl.EQUAL, stencilRef: marked.value, stencilRead: reflectorBits };
    return { ...state, blend: 'add', alpha: withDistance };
  }

  private setReflector(program: Program, scene: GpuScene, target: Target, r: GpuReflector): void {
    const m = r.packFromReflector;
    scene.bindGeometry();
    program.set('u_clip_from_pack', target.view.clipFromPack);
    program.set('u_eye', target.view.eye);
    program.set('u_normal', [m[8]!, m[9]!, m[10]!]);
    scene.setPlaceReflectance(program, r.material);
    program.set('u_modulate', true);
  }

  private drawComposed(scene: GpuScene, target: Target, marked: Marked, kernel: GpuKernel, rect: ImageRect, image: Image): void {
    const { gl } = this.device, r = marked.reflector, distance = !target.inFrame && scene.reflectanceOf(r.material) > kMirroring;
    const program = kernel.count > 1 ? this.convolve : this.compose;
    apply(gl, this.where(target, marked, distance));
    program.use();
    program.set('u_origin', rect.origin);
    program.set('u_missing', [0, 0, 0]);
    program.set('u_with_distance', distance);
    this.setReflector(program, scene, target, r);
    bind(gl, 'u_blurred', image.blurred);
    this.setConvolution(program, scene, target.view, r, kernel, rect, image);
    scene.draw(r);
  }

  private drawEmitters(scene: GpuScene, target: Target, marked: Marked, kernel: GpuKernel): void {
    const { gl } = this.device, r = marked.reflector, e = r.emitters;
    if (!e) return;
    const shape = scene.data.reflectors[r.index]!, program = kernel.lobes ? this.emitters : this.glints;
    program.use();
    bind(gl, 'u_polygons', e.polygons);
    bind(gl, 'u_visibility', e.visibility);
    bind(gl, 'u_seen', e.seen);
    if (kernel.lobes) bind(gl, 'u_lobes', kernel.lobes);
    program.set('u_cells', [e.cellsX, e.cellsY]);
    program.set('u_lower', shape.lower.map((x) => x / r.size));
    program.set('u_upper', shape.upper.map((x) => x / r.size));
    const m = r.reflectorFromPack.slice();
    for (let c = 0; c < 4; ++c) for (let row = 0; row < 3; ++row) m[4 * c + row]! /= r.size;
    program.set('u_emitters_from_pack', m);
    if (kernel.lobes) program.set('u_lobe_rows', 33);
    this.setReflector(program, scene, target, r);
    apply(gl, { ...this.where(target, marked, false), blend: 'add', alpha: false });
    scene.draw(r);
  }
}
