// WebGL2 as the passes use it.
import { assembleShader } from './shaders';

/** A unit of its own for each sampler: what is bound for one pass stays for the next. */
const units: Record<string, number> = {
  u_base_texture: 0, u_lightmap: 1, u_reflectance: 2, u_direction: 3, u_normal_texture: 4, u_change: 5, u_cells: 6, u_detail: 7,
  u_surfaces: 8, u_image: 9, u_frame: 9, u_source: 9, u_blurred: 10, u_before: 10, u_taps: 11, u_emission_texture: 11, u_polygons: 12, u_visibility: 13,
  u_seen: 14, u_lobes: 15,
  u_codes: 6, u_table: 7, u_light: 9, u_inverse_distance: 10, u_places: 12, u_normals: 13, u_shaded: 15,
  u_metal_texture: 1, u_sky: 1, u_sharp_at: 16, u_sharp_words: 17, u_sharp_triangles: 18, u_sharp_lamps: 19,
};

/** Compiled from when it is started or first used, and waited for when it is used: meanwhile others compile beside it. */
export class Program {
  private readonly at = new Map<string, { place: WebGLUniformLocation; type: number }>();
  private program?: WebGLProgram;
  private linked = false;
  private constructor(private readonly gl: WebGL2RenderingContext, private readonly name: string, private readonly define: string) {}

  static make(gl: WebGL2RenderingContext, name: string, define = ''): Program { return new Program(gl, name, define); }

  start(): void {
    if (this.program) return;
    const { gl, name } = this, vertex = name.startsWith('screen_') ? 'screen_fullscreen' : name;
    this.program = gl.createProgram()!;
    for (const [type, file] of [[gl.VERTEX_SHADER, `${vertex}.vert`], [gl.FRAGMENT_SHADER, `${name}.frag`]] as const) {
      const shader = gl.createShader(type)!;
      gl.shaderSource(shader, assembleShader(`passes/${file}`, this.define));
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
  }

  private finish(): void {
    this.start();
    this.linked = true;
    const { gl } = this, program = this.program!;
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
      const logs = gl.getAttachedShaders(program)!.map((s) => gl.getShaderInfoLog(s)).join('');
      throw new Error(`shader ${this.name} ${this.define}: ${logs}${gl.getProgramInfoLog(program)}`);
    }
    gl.useProgram(program);
    const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) as number;
    for (let i = 0; i < count; ++i) {
      const info = gl.getActiveUniform(program, i)!, place = gl.getUniformLocation(program, info.name)!;
      this.at.set(info.name, { place, type: info.type });
      const unit = units[info.name];
      const sampler = [gl.SAMPLER_2D, gl.INT_SAMPLER_2D, gl.UNSIGNED_INT_SAMPLER_2D].includes(info.type as 35678);  // u_cells is a size elsewhere
      if (sampler && unit !== undefined) gl.uniform1i(place, unit);
    }
  }

  use(): void {
    if (!this.linked) this.finish();
    this.gl.useProgram(this.program!);
  }
  set(name: string, value: number | boolean | ArrayLike<number>): void {
    const found = this.at.get(name), gl = this.gl;
    if (!found) return;
    const list = typeof value === 'object' ? Float32Array.from(value) : undefined, one = Number(value);
    switch (found.type) {
      case gl.FLOAT: gl.uniform1f(found.place, one); break;
      case gl.INT: case gl.BOOL: gl.uniform1i(found.place, one); break;
      case gl.INT_VEC2: gl.uniform2i(found.place, list![0]!, list![1]!); break;
      case gl.FLOAT_VEC2: gl.uniform2fv(found.place, list!); break;
      case gl.FLOAT_VEC3: gl.uniform3fv(found.place, list!); break;
      case gl.FLOAT_VEC4: gl.uniform4fv(found.place, list!); break;
      case gl.FLOAT_MAT4: gl.uniformMatrix4fv(found.place, false, list!); break;
    }
  }
}

export interface TextureShape {
  width: number; height: number; format: number; levels?: number; min?: number; mag?: number; wrapS?: number; wrapT?: number;
}

// The layout and type that a sized format's texels have in memory.
function layoutOf(gl: WebGL2RenderingContext, format: number): [number, number] {
  switch (format) {
    case gl.RGB16F: return [gl.RGB, gl.HALF_FLOAT];
    case gl.RGBA16F: return [gl.RGBA, gl.HALF_FLOAT];
    case gl.RGBA32F: return [gl.RGBA, gl.FLOAT];
    case gl.RGB9_E5: return [gl.RGB, gl.UNSIGNED_INT_5_9_9_9_REV];
    case gl.R32F: return [gl.RED, gl.FLOAT];
    case gl.R32UI: return [gl.RED_INTEGER, gl.UNSIGNED_INT];
    case gl.RGBA16I: return [gl.RGBA_INTEGER, gl.SHORT];
    case gl.RGBA32UI: return [gl.RGBA_INTEGER, gl.UNSIGNED_INT];
    case gl.DEPTH24_STENCIL8: return [gl.DEPTH_STENCIL, gl.UNSIGNED_INT_24_8];
    default: return [gl.RGBA, gl.UNSIGNED_BYTE];
  }
}

export function makeTexture(gl: WebGL2RenderingContext, shape: TextureShape, texels: ArrayBufferView | null = null): WebGLTexture {
  const texture = gl.createTexture()!, [layout, type] = layoutOf(gl, shape.format);
  gl.activeTexture(gl.TEXTURE0);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  gl.texStorage2D(gl.TEXTURE_2D, shape.levels ?? 1, shape.format, shape.width, shape.height);
  if (texels) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, shape.width, shape.height, layout, type, texels);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, shape.min ?? gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, shape.mag ?? gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, shape.wrapS ?? gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, shape.wrapT ?? gl.CLAMP_TO_EDGE);
  return texture;
}

export function bind(gl: WebGL2RenderingContext, sampler: string, texture: WebGLTexture): void {
  gl.activeTexture(gl.TEXTURE0 + units[sampler]!);
  gl.bindTexture(gl.TEXTURE_2D, texture);
}

export function makeTarget(gl: WebGL2RenderingContext, color: WebGLTexture, depth?: WebGLTexture, second?: WebGLTexture): WebGLFramebuffer {
  const framebuffer = gl.createFramebuffer()!;
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color, 0);
  if (second) {
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT1, gl.TEXTURE_2D, second, 0);
    gl.drawBuffers([gl.COLOR_ATTACHMENT0, gl.COLOR_ATTACHMENT1]);
  }
  if (depth) gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_STENCIL_ATTACHMENT, gl.TEXTURE_2D, depth, 0);
  return framebuffer;
}

/** All that drawing depends on besides programs, textures and vertices; what is left out is off. */
export interface RasterState {
  depthTest?: boolean; depthWrite?: boolean; color?: boolean; alpha?: boolean; cull?: boolean; mirrored?: boolean;
  blend?: 'add' | 'multiply' | 'cover'; stencilFunc?: number; stencilRef?: number; stencilRead?: number; stencilWrite?: number;
}
export function apply(gl: WebGL2RenderingContext, s: RasterState): void {
  const set = (what: number, on: boolean): void => { if (on) gl.enable(what); else gl.disable(what); };
  set(gl.DEPTH_TEST, !!s.depthTest);
  gl.depthFunc(gl.LEQUAL);
  gl.depthMask(!!s.depthWrite);
  const color = s.color ?? true;
  gl.colorMask(color, color, color, color && (s.alpha ?? true));
  set(gl.CULL_FACE, !!s.cull);
  gl.cullFace(gl.BACK);
  gl.frontFace(s.mirrored ? gl.CW : gl.CCW);
  set(gl.BLEND, !!s.blend);
  if (s.blend === 'add') gl.blendFuncSeparate(gl.ONE, gl.ONE, gl.ONE, gl.ZERO);
  if (s.blend === 'multiply') gl.blendFuncSeparate(gl.ZERO, gl.SRC_COLOR, gl.ZERO, gl.ONE);
  if (s.blend === 'cover') gl.blendFuncSeparate(gl.ONE, gl.ONE_MINUS_SRC_ALPHA, gl.ZERO, gl.ONE);
  set(gl.STENCIL_TEST, s.stencilFunc !== undefined || !!s.stencilWrite);
  gl.stencilFunc(s.stencilFunc ?? gl.ALWAYS, s.stencilRef ?? 0, s.stencilRead ?? 0xff);
  gl.stencilMask(s.stencilWrite ?? 0);
  gl.stencilOp(gl.KEEP, gl.KEEP, gl.REPLACE);
}
