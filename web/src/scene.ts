// A pack's pieces on the device.
import * as v from './vec';
import { Program, bind, makeTexture } from './gl';
import { trianglesOf, uploadEmitters } from './emitters';
import { halfToFloat } from './bytes';
import { cutoutMips } from './cutout_mips';
import { meanFactor, relit, skyOfDay } from './lights';
import { Movers } from './movers';
import { sharpLux } from './sharp_elements';
import { uploadLamps, uploadSharp } from './sharp_light';
import { uploadSurround } from './surround';
import { lobeRows, lobeTexels, makeTaps } from './kernel';
import type { ReflectorEmitters } from './emitters';
import type { GpuSharp } from './sharp_light';
import type { GpuSurround } from './surround';
import type { Emitter, EmissionTexture, Material, Metalness, Page, PageGroups, Sections, SharpLight, SkyMap, Surround, Texture } from './sections';
import type { Bounds, Mat4, Vec3 } from './vec';

export interface Range { first: number; count: number; material: number; page: number; bounds: Bounds; }
/** from: its first one in the mesh's indices; ordered: for which view. */
export interface SeeThrough extends Range { from: number; ordered?: string; }
export interface GpuReflector {
  index: number; material: number; first: number; count: number; packFromReflector: Mat4; reflectorFromPack: Mat4;
  corners: Vec3[]; size: number; flatness: number; emitters?: ReflectorEmitters; dark: Range[];
  query?: WebGLQuery; asked: boolean; visible: boolean;
}
export interface GpuCurved extends Range { map: number; }
export interface GpuKernel { taps: WebGLTexture; count: number; rows: number; median: number; lobes?: WebGLTexture; }
interface Light { light: WebGLTexture; scale: number; bytes: number; direction?: WebGLTexture; cells?: WebGLTexture; detail?: WebGLTexture; sharpAt?: WebGLTexture; }

export interface Device {
  gl: WebGL2RenderingContext;
  color: number;     // the format of light
  linear: number;    // the filter of images of it
  closest: number;   // 1 / distance is never smaller where something is seen
}

/** What the device can do; throws where it cannot draw light. */
export function makeDevice(gl: WebGL2RenderingContext): Device {
  const full = gl.getExtension('EXT_color_buffer_float') && gl.getExtension('EXT_float_blend') && gl.getExtension('OES_texture_float_linear');
  if (!full && !gl.getExtension('EXT_color_buffer_float') && !gl.getExtension('EXT_color_buffer_half_float'))
    throw new Error('This device cannot draw light of more than eight bits.');
  return { gl, color: full ? gl.RGBA32F : gl.RGBA16F, linear: gl.LINEAR, closest: full ? 1e-15 : 1e-7 };
}

export class GpuScene {
  readonly bounds: Bounds = v.emptyBounds();
  readonly opaque: Range[] = [];
  readonly transparent: SeeThrough[] = [];
  readonly reflectors: GpuReflector[] = [];
  readonly curved: GpuCurved[];
  readonly surrounds: GpuSurround[] = [];
  readonly movers: Movers;
  readonly unit: number;  // what light is multiplied by, so that it fits the device's numbers
  bytes = 0;              // of textures and vertices
  private readonly array: WebGLVertexArrayObject;
  private readonly textures: (WebGLTexture | undefined)[] = [];
  private readonly normals: (WebGLTexture | undefined)[] = [];
  private readonly pages: Light[] = [];
  private readonly shown: Page[] = [];        // as lamps shine now
  private readonly pageGroups: PageGroups[] = [];
  private sharp?: GpuSharp & { light: SharpLight };
  factors: Vec3[];               // by light group
  private emission: number[][];               // by material; of unlit ones what shows their colour, cd/m2
  readonly unlitWhite: number;
  sky: number[];
  skyMap?: { texture: WebGLTexture; scale: number };  // by direction, of `sky`
  private readonly white: WebGLTexture;
  private readonly flat: WebGLTexture;
  private readonly zero: WebGLTexture;
  private readonly reflectance: WebGLTexture;
  private readonly kernels = new Map<string, GpuKernel>();

  constructor(readonly device: Device, readonly data: Sections) {
    const gl = device.gl, mesh = data.mesh!, brightest = Math.max(1, ...data.materials.flatMap((m) => m.emission), ...data.sky);
    this.emission = data.materials.map((m) => m.unlit && !m.emission.some((c) => c > 0) ? [1, 1, 1] : m.emission), this.sky = data.sky;
    this.unlitWhite = Math.max(...this.emission.filter((_, m) => data.materials[m]!.unlit).flat(), 0) || 1;
    this.factors = data.groups.map(() => [1, 1, 1]);
    this.unit = device.color === gl.RGBA32F ? 1 : Math.min(1, 8192 / brightest);
    const indices = this.sortRanges();
    data.reflectors.forEach((_, i) => this.addReflector(i, indices));
    this.movers = new Movers(device, this);
    this.curved = data.curved.map((c) => ({ ...this.rangeOf(indices, c.indices, c.material, -1), map: c.map }));
    this.array = gl.createVertexArray()!;
    gl.bindVertexArray(this.array);
    const attribute = (at: number, values: ArrayBufferView | undefined, size: number, type: number = gl.FLOAT): void => {
      if (!values) return;
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, size, type, type === gl.UNSIGNED_BYTE, 0, 0);
      this.bytes += values.byteLength;
    };
    attribute(0, mesh.positions, 3);
    attribute(1, mesh.normals, 3);
    attribute(2, mesh.uvs, 2);
    attribute(3, mesh.lightmapUvs, 2);
    attribute(4, mesh.colors, 4, gl.UNSIGNED_BYTE);
    attribute(5, mesh.normalUvs, 2);
    attribute(6, mesh.tangents, 4);
    gl.vertexAttrib4f(4, 1, 1, 1, 1);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint32Array(indices), gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    this.bytes += 4 * indices.length;
    const one = (format: number, texel: ArrayBufferView): WebGLTexture => makeTexture(gl, { width: 1, height: 1, format }, texel);
    this.white = one(gl.SRGB8_ALPHA8, new Uint8Array([255, 255, 255, 255]));
    this.flat = one(gl.RGBA8, new Uint8Array([128, 128, 255, 255]));
    this.zero = one(gl.R32UI, new Uint32Array([0]));
    this.reflectance = this.uploadReflectance();
    data.pages.forEach((page, i) => this.setPage(i, page));
    bind(gl, 'u_surfaces', this.zero);
    bind(gl, 'u_cells', this.zero);
    bind(gl, 'u_seen', this.zero);
  }

  isTransparent(material: number): boolean {
    const m = this.data.materials[material]!;
    return m.alphaMode === 2 || m.transmission > 0;
  }

  private rangeOf(indices: number[], from: ArrayLike<number>, material: number, page: number): Range {
    const range: Range = { first: indices.length, count: from.length, material, page, bounds: v.emptyBounds() }, p = this.data.mesh!.positions;
    for (let i = 0; i < from.length; ++i) {
      const k = from[i]!;
      indices.push(k);
      v.extend(range.bounds, p[3 * k]!, p[3 * k + 1]!, p[3 * k + 2]!);
    }
    return range;
  }

  private facesInward(indices: number[], range: Range): boolean {
    const p = this.data.mesh!.positions, middle = v.centre(range.bounds);
    const at = (i: number): v.Vec3 => v.sub(v.at(p, indices[i]!), middle);
    let volume = 0;
    for (let i = range.first; i < range.first + range.count; i += 3) volume += v.dot(at(i), v.cross(at(i + 1), at(i + 2)));
    return volume < 0;
  }

  private sortRanges(): number[] {
    const mesh = this.data.mesh!, indices: number[] = [];
    const parts = mesh.parts.filter((p) => p.count > 0).sort((a, b) => a.material - b.material || a.page - b.page);
    for (const part of parts) {
      const range = this.rangeOf(indices, mesh.indices.subarray(part.first, part.first + part.count), part.material, part.page);
      const transparent = this.isTransparent(part.material);
      if (transparent) this.transparent.push({ ...range, from: part.first });
      if (!transparent || isPartlyOpaque(this.data.materials[part.material]!)) this.opaque.push(range);
      v.extend(this.bounds, ...range.bounds.lower);
      v.extend(this.bounds, ...range.bounds.upper);
    }
    // As in the player: of both sides of a shell the inside first.
    const inward = new Map(this.transparent.map((r) => [r, this.facesInward(indices, r)]));
    this.transparent.sort((a, b) => Number(inward.get(b)) - Number(inward.get(a)));
    return indices;
  }

  private addReflector(index: number, indices: number[]): void {
    const { gl } = this.device, r = this.data.reflectors[index]!, m = r.packFromReflector, inverse = v.inverseRigid(m);
    const size = Math.hypot(r.upper[0]! - r.lower[0]!, r.upper[1]! - r.lower[1]!);
    const xs = [r.lower[0]!, r.upper[0]!, r.upper[0]!, r.lower[0]!], ys = [r.lower[1]!, r.lower[1]!, r.upper[1]!, r.upper[1]!];
    const range = this.rangeOf(indices, r.indices, r.material, -1), dark: Range[] = [];
    for (const e of r.emitters)
      for (const found of trianglesOf(this.data.emitters[e]!, this.data.mesh!, this.data.materials))
        if (!this.isTransparent(found.part.material)) dark.push(this.rangeOf(indices, found.indices, found.part.material, found.part.page));
    this.reflectors.push({
      index, material: r.material, first: range.first, count: range.count, packFromReflector: m, reflectorFromPack: inverse,
      corners: xs.map((x, i) => v.point(m, [x, ys[i]!, 0])), size, flatness: r.flatness, dark,
      emitters: uploadEmitters(gl, r, this.data.emitters, inverse, size, this.unit), asked: false, visible: true,
    });
  }

  private uploadReflectance(): WebGLTexture {
    const maps = this.data.fresnels, width = Math.max(1, ...maps.map((f) => f.table.length / 3)), height = Math.max(maps.length, 1);
    const texels = new Float32Array(4 * width * height);
    maps.forEach((map, row) => {
      for (let i = 0; i < map.table.length / 3; ++i) texels.set(map.table.subarray(3 * i, 3 * i + 3), 4 * (row * width + i));
    });
    return makeTexture(this.device.gl, { width, height, format: this.device.gl.RGBA32F }, texels);
  }

  /** A finer page in place of the one that was there. */
  setPage(index: number, page: Page): void {
    this.data.pages[index] = page;
    this.uploadPage(index);
  }

  setPageGroups(groups: PageGroups): void {
    this.pageGroups[groups.page] = groups;
    this.uploadPage(groups.page);
  }

  /** To be had before the pages that need it. */
  setSharp(light: SharpLight): void {
    const { gl } = this.device;
    this.sharp = { light, ...uploadSharp(gl, light, this.factors, this.unit) };
    bind(gl, 'u_sharp_words', this.sharp.words);
    bind(gl, 'u_sharp_triangles', this.sharp.triangles);
    bind(gl, 'u_sharp_lamps', this.sharp.lamps);
    this.bytes += 4 * light.words.length + 16 / 3 * light.triangles.length;
  }
  get hasSharp(): boolean { return !!this.sharp; }
  get hasSuns(): boolean { return !!this.sharp?.suns; }
  isSharp(range: Range): boolean { return !!this.pages[range.page]?.sharpAt; }

  /** By group, how many times what was baked its lamps shine: what BakedLamps of player/scene/lights.h does. */
  setLights(factors: Vec3[]): void {
    const { groups, emitters } = this.data, changed: Emitter[] = emitters.slice();
    const times = (light: number[], factor: Vec3): number[] => light.map((x, i) => x * factor[i]!);
    this.factors = factors;
    groups.forEach((group, g) => {
      for (const m of group.materials) this.emission[m] = times(this.data.materials[m]!.emission, factors[g]!);
      for (const e of group.emitters) changed[e] = { ...emitters[e]!, radiance: times(emitters[e]!.radiance, factors[g]!) };
      if (group.sky) this.sky = times(this.data.sky, factors[g]!);
    });
    if (this.data.day) this.sky = skyOfDay(this.data.day, factors);
    for (const r of this.reflectors) {
      const old = r.emitters;
      if (!old) continue;
      for (const texture of [old.polygons, old.visibility, old.seen]) this.device.gl.deleteTexture(texture);
      r.emitters = uploadEmitters(this.device.gl, this.data.reflectors[r.index]!, changed, r.reflectorFromPack, r.size, this.unit);
    }
    if (this.sharp) {
      this.device.gl.deleteTexture(this.sharp.lamps);
      bind(this.device.gl, 'u_sharp_lamps', this.sharp.lamps = uploadLamps(this.device.gl, this.sharp.light, factors, this.unit));
    }
    this.data.pages.forEach((_, i) => this.uploadPage(i));
    this.surrounds.forEach((s, i) => { s.tint = meanFactor(groups, factors, 'surrounds', i); });
    this.movers.relight();
  }

  private uploadPage(index: number): void {
    const page = relit(this.data.pages[index]!, this.pageGroups[index], this.factors);
    if (page === this.shown[index]) return;
    this.shown[index] = page;
    const { gl } = this.device, old = this.pages[index];
    for (const texture of [old?.light, old?.direction, old?.cells, old?.detail, old?.sharpAt]) if (texture) gl.deleteTexture(texture);
    this.bytes -= old?.bytes ?? 0;
    const before = this.bytes;
    const halves = (texels: Uint16Array, width: number, height: number): WebGLTexture => {
      this.bytes += texels.byteLength;
      return makeTexture(gl, { width, height, format: gl.RGB16F, min: gl.LINEAR, mag: gl.LINEAR }, texels);
    };
    const light: Light = { light: halves(page.light, page.width, page.height), scale: page.scale, bytes: 0 };
    if (page.direction) light.direction = halves(page.direction, page.width, page.height);
    if (page.detail && page.cells) {
      light.cells = makeTexture(gl, { width: page.width, height: page.height, format: gl.R32UI }, page.cells);
      light.detail = halves(page.detail, page.detailWidth, page.detailHeight);
      this.bytes += page.cells.byteLength;
    }
    if (page.sharpAt) {
      light.sharpAt = makeTexture(gl, { width: page.width, height: page.height, format: gl.R32UI }, page.sharpAt);
      this.bytes += page.sharpAt.byteLength;
    }
    light.bytes = this.bytes - before;
    this.pages[index] = light;
  }

  setTexture(index: number, texture: Texture, normal: boolean): void {
    const { gl } = this.device, wraps = [gl.REPEAT, gl.CLAMP_TO_EDGE, gl.MIRRORED_REPEAT];
    const levels = Math.floor(Math.log2(Math.max(texture.width, texture.height))) + 1;
    const out = makeTexture(gl, {
      width: texture.width, height: texture.height, levels, format: normal ? gl.RGBA8 : gl.SRGB8_ALPHA8, min: gl.LINEAR_MIPMAP_LINEAR,
      mag: texture.nearest ? gl.NEAREST : gl.LINEAR, wrapS: wraps[texture.wrapS], wrapT: wraps[texture.wrapT],
    }, texture.texels);
    const cutoff = normal ? undefined : this.cutoffIn(index), t = texture.texels;
    let cuts = false;
    for (let i = 3; i < t.length && cutoff !== undefined && !cuts; i += 4) cuts = t[i]! < 255;
    if (cuts) {
      cutoutMips(texture, cutoff!).forEach((mip, l) => {
        gl.texSubImage2D(gl.TEXTURE_2D, l + 1, 0, 0, mip.width, mip.height, gl.RGBA, gl.UNSIGNED_BYTE, mip.texels);
      });
    } else gl.generateMipmap(gl.TEXTURE_2D);
    (normal ? this.normals : this.textures)[index] = out;
    this.bytes += (texture.texels.byteLength * 4) / 3;
  }

  /** Of alpha in a texture, what materials cut out with it: 0 where it blends; nothing where some show all of it. */
  private cutoffIn(texture: number): number | undefined {
    let out: number | undefined;
    for (const m of this.data.materials) {
      if (m.texture !== texture) continue;
      if (m.alphaMode === 0) return undefined;
      if (m.alphaMode === 2) out ??= 0;
      else if (!out) {
        if (!(m.cutoff > 0)) return undefined;
        out = m.alpha > 0 ? m.cutoff / m.alpha : 2;
      }
    }
    return out;
  }

  setSky(map: SkyMap): void {
    const { gl } = this.device, shape = { width: map.width, height: map.height, format: gl.RGB9_E5, min: gl.LINEAR, mag: gl.LINEAR, wrapS: gl.REPEAT };
    this.skyMap = { texture: makeTexture(gl, shape, map.light), scale: map.scale };
    this.bytes += map.light.byteLength;
  }

  setSurround(index: number, map: Surround): void {
    this.surrounds[index] = uploadSurround(this.device.gl, map);
    this.surrounds[index]!.tint = meanFactor(this.data.groups, this.factors, 'surrounds', index);
    this.bytes += 10 * map.light.length;
  }

  /** A normal map of a material, if it has one and what it needs is there. */
  setNormals(program: Program, material: number, has = !!this.data.mesh!.normalUvs): void {
    const m = this.data.materials[material]!, normal = m.normalTexture >= 0 && has ? this.normals[m.normalTexture] : undefined;
    program.set('u_normal_mapped', !!normal);
    program.set('u_normal_scale', m.normalScale);
    bind(this.device.gl, 'u_normal_texture', normal ?? this.flat);
  }

  kernel(material: number, taps: number): GpuKernel {
    const m = this.data.materials[material]!, name = `${m.kernel} ${m.fresnel} ${taps}`, known = this.kernels.get(name);
    if (known) return known;
    const { gl } = this.device, kernel = this.data.kernels[m.kernel], fresnel = this.data.fresnels[m.fresnel], made = makeTaps(kernel, taps, fresnel);
    const out: GpuKernel = {
      taps: makeTexture(gl, { width: made.count, height: made.rows, format: gl.RGBA32F }, made.texels),
      count: made.count, rows: made.rows, median: made.median,
    };
    if (kernel && kernel.fits.length > 0)
      out.lobes = makeTexture(gl, { width: lobeRows, height: 2, format: gl.RGBA32F }, lobeTexels(kernel, fresnel, made.means));
    this.kernels.set(name, out);
    return out;
  }

  /** R at 60 degrees, the largest channel. */
  reflectanceOf(material: number): number {
    const table = this.data.fresnels[this.data.materials[material]!.fresnel]?.table;
    if (!table) return 0;
    const i = 3 * (table.length / 6 | 0);
    return Math.max(table[i]!, table[i + 1]!, table[i + 2]!);
  }

  bindGeometry(): void {
    this.device.gl.bindVertexArray(this.array);
    bind(this.device.gl, 'u_reflectance', this.reflectance);
  }
  /** As bind_far_to_near() of player/scene/gpu_scene.cpp; of the bound geometry. towards: the eye, along the view. */
  orderFarToNear(range: SeeThrough, towards: Vec3): void {
    if (range.ordered === towards.join()) return;
    const { gl } = this.device, { positions, indices } = this.data.mesh!, order = new Uint32Array(range.count);
    const depth = (i: number): number => [0, 1, 2].reduce((sum, k) => sum + v.dot(towards, v.at(positions, indices[i + k]!)), 0);
    const triangles = Array.from({ length: range.count / 3 }, (_, t) => ({ i: range.from + 3 * t, depth: depth(range.from + 3 * t) }));
    triangles.sort((a, b) => a.depth - b.depth).forEach(({ i }, t) => order.set(indices.subarray(i, i + 3), 3 * t));
    gl.bufferSubData(gl.ELEMENT_ARRAY_BUFFER, 4 * range.first, order);
    range.ordered = towards.join();
  }
  draw(range: { first: number; count: number }): void {
    const { gl } = this.device;
    gl.drawElements(gl.TRIANGLES, range.count, gl.UNSIGNED_INT, 4 * range.first);
  }
  bindBase(index: number): void { bind(this.device.gl, 'u_base_texture', this.textures[index] ?? this.white); }

  /** That a material shines with, if any. */
  picture(material: number): EmissionTexture | undefined { return this.data.emissionTextures.find((e) => e.material === material); }

  /** Of opaque materials whose F0 differs from place to place, how. */
  metalness(material: number): Metalness | undefined {
    const m = this.data.materials[material]!;
    return m.fresnel < 0 || m.alphaMode === 2 || m.transmission > 0 ? undefined : this.data.metalness.find((one) => one.material === material);
  }

  /** What shaders/lib/metalness.glsl asks for; returns whether F0 differs. */
  setMetalness(program: Program, material: number): boolean {
    const metal = this.metalness(material), m = this.data.materials[material]!;
    program.set('u_metal_varies', !!metal);
    if (!metal) return false;
    program.set('u_metal', metal.texture >= 0 ? 1 : m.metallic);
    program.set('u_dielectric', metal.dielectric);
    program.set('u_f0', m.f0);
    return true;
  }

  /** R of a reflector, and what shaders/passes/place_reflectance.glsl asks for. */
  setPlaceReflectance(program: Program, material: number): void {
    const m = this.data.materials[material]!;
    this.setReflectance(program, material);
    this.setMetalness(program, material);
    program.set('u_base_color', baseOf(m));
    this.bindBase(m.texture);
    bind(this.device.gl, 'u_metal_texture', this.textures[this.metalness(material)?.texture ?? -1] ?? this.white);
  }

  setReflectance(program: Program, material: number): void {
    const row = this.data.materials[material]!.fresnel;
    program.set('u_reflectance_row', row);
    program.set('u_reflectance_count', row < 0 ? 1 : this.data.fresnels[row]!.table.length / 3);
  }

  /** Albedo, reflectance, emission, normal map and light of a range. */
  setSurface(program: Program, range: Range, hasNormalUvs = !!this.data.mesh!.normalUvs): void {
    const { gl } = this.device, m = this.data.materials[range.material]!, light = this.pages[range.page];
    program.set('u_base_color', baseOf(m));
    program.set('u_alpha_cutoff', cutoffOf(m));
    program.set('u_covers', m.alphaMode === 2);
    program.set('u_transmission', m.transmission);
    const picture = this.picture(range.material), glow = picture && this.textures[picture.texture];
    program.set('u_emission', this.emission[range.material]!.map((e, c) => e * this.unit * (glow ? inverse(picture.mean[c]!) : 1)));
    bind(gl, 'u_emission_texture', this.textures[this.metalness(range.material)?.texture ?? -1] ?? glow ?? this.white);  // a texture has both
    const varies = this.setMetalness(program, range.material);
    program.set('u_diffuse_share', (varies ? 1 : 1 - m.metallic) * (1 - m.transmission));
    program.set('u_unlit', m.unlit);
    this.setReflectance(program, range.material);
    this.bindBase(m.texture);
    this.setNormals(program, range.material, hasNormalUvs);
    bind(gl, 'u_lightmap', light?.light ?? this.white);
    program.set('u_lightmap_scale', light ? light.scale * this.unit : 0);
    program.set('u_directional', !!light?.direction);
    bind(gl, 'u_direction', light?.direction ?? light?.light ?? this.white);
    program.set('u_detailed', !!light?.detail);
    bind(gl, 'u_cells', light?.cells ?? this.zero);
    bind(gl, 'u_detail', light?.detail ?? this.white);
    bind(gl, 'u_sharp_at', light?.sharpAt ?? this.zero);
  }

  /** Irradiance at a vertex-interpolated place of a page, and of the scene, lux. */
  luxAt(page: number, s: number, t: number, place: Vec3, normal: Vec3): number {
    const p = this.shown[page];
    if (!p) return 0;
    const x = Math.min(Math.floor(s * p.width), p.width - 1), y = Math.min(Math.floor(t * p.height), p.height - 1), at = 3 * (y * p.width + x);
    const sharp = p.sharpAt && this.sharp ? sharpLux(this.sharp.light, p, [s, t], place, normal, this.factors) : 0;
    return sharp + p.scale * (0.2126 * halfToFloat(p.light[at]!) + 0.7152 * halfToFloat(p.light[at + 1]!) + 0.0722 * halfToFloat(p.light[at + 2]!));
  }
}

const baseOf = (m: Material): number[] => [...m.baseColor.map((c) => Math.min(Math.max(c, 0), 1)), m.alpha];
const inverse = (x: number): number => (x > 0 ? 1 / x : 0);

/** Blended, and whole in places, where it hides as opaque surfaces do: what rounds to 255 of 8 bits. */
const opaqueAlpha = 254.5 / 255;
export const isPartlyOpaque = (m: Material): boolean => m.alphaMode === 2 && m.alpha >= opaqueAlpha && m.transmission <= 0;

export const cutoffOf = (m: Material): number => (isPartlyOpaque(m) ? opaqueAlpha : m.alphaMode === 1 ? Math.max(m.cutoff, 0) : -1);
