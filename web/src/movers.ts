// Movers on the device, placed by the clock and drawn: the twin of player/movers/mover_pass.h. Their bright lights are harmonics:
// they have no shadows, and cast none.
import * as v from './vec';
import { Program, apply, bind, makeTexture } from './gl';
import { fieldLight } from './light_field';
import { moverTable, packFromObject, poseAt } from './mover_light';
import { cutoffOf } from './scene';
import type { FieldLight } from './light_field';
import type { Device, GpuScene, Range } from './scene';
import type { LightField, Mover } from './types';
import type { View } from './view';
import type { Bounds, Mat4, Vec3 } from './vec';

const kWeightsWidth = 2048, moverBits = 0x7f;

interface GpuMover {
  mover: Mover; array: WebGLVertexArrayObject; ranges: Range[]; bounds: Bounds; weights: WebGLTexture;
  packFromObject: Mat4; table?: WebGLTexture; placedAt?: number;
}

/** Attributes of a mesh's vertices, into the bound vertex array; bytes. */
function upload(gl: WebGL2RenderingContext, mover: Mover): number {
  const { mesh, transfer } = mover;
  let bytes = 0;
  const attribute = (at: number, values: ArrayBufferView | undefined, size: number, type: number = gl.FLOAT, normalized = false): void => {
    if (!values) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, type, normalized, 0, 0);
    bytes += values.byteLength;
  };
  attribute(0, mesh.positions, 3);
  attribute(1, mesh.normals, 3);
  attribute(2, mesh.uvs, 2);
  attribute(4, mesh.colors, 4, gl.UNSIGNED_BYTE, true);
  attribute(5, mesh.normalUvs, 2);
  attribute(6, mesh.tangents, 4);
  attribute(7, transfer.cluster, 1, gl.UNSIGNED_BYTE);
  gl.vertexAttrib4f(4, 1, 1, 1, 1);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, mesh.indices, gl.STATIC_DRAW);
  return bytes + mesh.indices.byteLength;
}

export class Movers {
  private readonly movers: (GpuMover | undefined)[] = [];
  private depth!: Program;
  private light!: Program;
  private field?: LightField;
  private shining?: FieldLight;

  constructor(private readonly device: Device, private readonly scene: GpuScene) {}

  get animated(): boolean { return this.movers.some((m) => (m?.mover.keys.length ?? 0) > 1); }
  get some(): boolean { return this.movers.some((m) => m?.table); }

  setField(field: LightField): void {
    this.field = field;
    this.relight();
  }

  /** Lamps shine otherwise, or the light has come. */
  relight(): void {
    if (!this.field) return;
    this.shining = fieldLight(this.field, this.scene.data.groups, this.scene.factors);
    for (const m of this.movers) if (m) delete m.placedAt;
  }

  add(index: number, mover: Mover): void {
    const { gl } = this.device, p = mover.mesh.positions;
    this.depth ??= Program.make(gl, 'depth'), this.light ??= Program.make(gl, 'mover_light');
    const bounds = v.emptyBounds(), ranges: Range[] = [];
    for (const part of mover.mesh.parts) {
      if (part.count === 0) continue;
      const m = this.scene.data.materials[part.material]!;
      if (m.alphaMode === 2) m.alphaMode = 0;  // they hide what is behind; their materials are theirs alone
      const range: Range = { ...part, page: -1, bounds: v.emptyBounds() };
      for (let i = part.first; i < part.first + part.count; ++i) {
        const k = 3 * mover.mesh.indices[i]!;
        v.extend(range.bounds, p[k]!, p[k + 1]!, p[k + 2]!);
      }
      v.extend(bounds, ...range.bounds.lower), v.extend(bounds, ...range.bounds.upper);
      ranges.push(range);
    }
    if (ranges.length === 0) return;
    const array = gl.createVertexArray()!, n = mover.transfer.components, texels = Math.ceil(n / 4), vertices = p.length / 3;
    gl.bindVertexArray(array);
    this.scene.bytes += upload(gl, mover);
    gl.bindVertexArray(null);
    const rows = Math.max(1, Math.ceil((vertices * texels) / kWeightsWidth)), codes = new Int16Array(rows * kWeightsWidth * 4);
    for (let i = 0; i < vertices; ++i) codes.set(mover.transfer.weight.subarray(i * n, i * n + n), i * texels * 4);
    const weights = makeTexture(gl, { width: kWeightsWidth, height: rows, format: gl.RGBA16I }, codes);
    this.movers[index] = { mover, array, ranges, bounds, weights, packFromObject: packFromObject(mover.rest) };
    this.scene.bytes += codes.byteLength;
  }

  /** Where they are at a time, and the light that they meet there. */
  place(seconds: number): void {
    const { gl } = this.device;
    for (const m of this.movers) {
      if (!m || !this.shining) continue;
      const time = m.mover.keys.length > 1 ? seconds : 0;
      if (m.placedAt === time) continue;
      m.placedAt = time;
      m.packFromObject = packFromObject(poseAt(m.mover, time));
      if (m.table) gl.deleteTexture(m.table);
      const { components, clusters } = m.mover.transfer, table = moverTable(this.shining, m.mover.transfer, m.bounds, m.packFromObject);
      m.table = makeTexture(gl, { width: 3 * (components + 1), height: clusters, format: gl.RGBA32F }, table.map((x) => x * this.scene.unit));
    }
  }

  /** Of the scene with the movers where they are. */
  bounds(): Bounds {
    const scene = this.scene.bounds, out: Bounds = { lower: [...scene.lower], upper: [...scene.upper] };
    for (const m of this.movers)
      for (let i = 0; m?.table && i < 8; ++i) {
        const { lower, upper } = m.bounds, at: Vec3 = [i & 1 ? upper[0] : lower[0], i & 2 ? upper[1] : lower[1], i & 4 ? upper[2] : lower[2]];
        v.extend(out, ...v.point(m.packFromObject, at));
      }
    return out;
  }

  drawDepth(view: View): void {
    this.each(view, this.depth, (range) => {
      const m = this.scene.data.materials[range.material]!;
      apply(this.device.gl, { depthTest: true, depthWrite: true, color: false, cull: !m.doubleSided, mirrored: view.mirrored });
      this.depth.set('u_alpha', m.alpha);
      this.depth.set('u_alpha_cutoff', cutoffOf(m));
      this.scene.bindBase(m.texture);
    });
  }

  /** Over that depth; distance: into the image of a mirror. */
  drawLight(view: View, distance: boolean): void {
    if (!this.some) return;
    const m = view.viewFromPack;
    this.light.use();
    this.light.set('u_eye', view.eye);
    this.light.set('u_alpha_kind', distance ? (view.ortho ? 2 : 1) : 0);
    this.light.set('u_depth_row', [-m[2]!, -m[6]!, -m[10]!, -m[14]!]);
    this.light.set('u_closest', this.device.closest);
    this.light.set('u_changed', false);
    this.light.set('u_weights', [1, 1, 1]);
    this.each(view, this.light, (range, mover) => {
      const state = { depthTest: true, stencilRef: moverBits, stencilWrite: moverBits, mirrored: view.mirrored };
      apply(this.device.gl, { ...state, cull: !this.scene.data.materials[range.material]!.doubleSided });
      this.scene.setSurface(this.light, range, !!mover.mesh.normalUvs);
    });
  }

  private each(view: View, program: Program, set: (range: Range, mover: Mover) => void): void {
    const { gl } = this.device;
    for (const m of this.movers) {
      if (!m?.table) continue;
      const clip = v.multiply(view.clipFromPack, m.packFromObject), half = m.bounds.upper.map((u, a) => 0.5 * (u - m.bounds.lower[a]!));
      this.scene.bindGeometry();  // for what is bound with it
      gl.bindVertexArray(m.array);
      program.use();
      program.set('u_clip_from_pack', clip);
      program.set('u_pack_from_object', m.packFromObject);
      program.set('u_box_center', v.centre(m.bounds));
      program.set('u_box_scale', half.map((h) => (h > 0 ? 1 / h : 0)));
      program.set('u_components', m.mover.transfer.components);
      for (const range of m.ranges) {
        if (!v.mayBeVisible(clip, range.bounds)) continue;
        set(range, m.mover);
        bind(gl, 'u_codes', m.weights);  // after the surface, whose details lie at these units
        bind(gl, 'u_table', m.table);
        this.scene.draw(range);
      }
    }
  }
}
