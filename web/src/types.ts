// What a piece holds, as the viewer uses it; docs/notes/format.md tells what the numbers mean.
import type { Vec3 } from './vec';

export interface Part { name: string; first: number; count: number; material: number; page: number; }
export interface Mesh {
  origin: Vec3;
  positions: Float32Array; normals: Float32Array; uvs: Float32Array; lightmapUvs: Float32Array;
  colors?: Uint8Array; normalUvs?: Float32Array; tangents?: Float32Array;
  indices: Uint32Array; parts: Part[];
}
export interface Material {
  name: string; baseColor: number[]; alpha: number; texture: number; alphaMode: number; doubleSided: boolean; unlit: boolean;
  cutoff: number; metallic: number; f0: number[]; transmission: number; emission: number[]; kernel: number; fresnel: number;
  normalTexture: number; normalScale: number;
}
/** RGB9E5 over `scale`, by direction, times Sections.sky: formats/assets/sky_map.h. */
export interface SkyMap { width: number; height: number; scale: number; light: Uint32Array; }
/** The picture that a material shines with: its radiance is emission · texel / mean. */
export interface EmissionTexture { material: number; texture: number; mean: number[]; }
/** Where a material is metal: alpha of the texture, or of texture -1 all as much as its metallic. */
export interface Metalness { material: number; texture: number; dielectric: number[]; }
export interface Texture {
  width: number; height: number; wrapS: number; wrapT: number; nearest: boolean; texels: Uint8Array;
}
export interface Page {
  width: number; height: number; scale: number; light: Uint16Array; direction?: Uint16Array;
  detailWidth: number; detailHeight: number; cells?: Uint32Array; detail?: Uint16Array;
  sharpAt?: Uint32Array;  // its light is then without sharp light
}
export interface SharpLamp {
  sun: boolean; position: Vec3; direction: Vec3; intensity: Vec3; cosOuter: number; inverseFalloff: number; angularRadius: number; group: number;
  profile: number; right: Vec3; over: Vec3;  // -1: it has none
}
/** Candela: rows of vertical angles, degrees, of columns all around. */
export interface LampProfile { first: number; last: number; rows: number; columns: number; candela: Float32Array; }
/** triangles: nine numbers each. records: by word, whether one begins there. */
export interface SharpLight { profiles: LampProfile[]; lamps: SharpLamp[]; words: Uint32Array; triangles: Float32Array; records: Uint8Array; }
export interface Reflector {
  name: string; material: number; packFromReflector: Float64Array; lower: number[]; upper: number[]; flatness: number;
  indices: Uint32Array; nodesX: number; nodesY: number; emitters: Uint32Array; visibility: Uint8Array;
}
export interface Emitter { twoSided: boolean; radiance: number[]; corners: Vec3[]; }
export interface Slice { cosTheta: number; shift: number; width: number[]; lower: number[]; upper: number[]; weights: Float32Array; }
export interface Kernel { size: number; halfExtent: number; weights: Float32Array; sliceSize: number; slices: Slice[]; fits: number[][]; }
export interface Fresnel { table: Float32Array; factor: Float32Array; }
export interface Camera { name: string; eye: Vec3; forward: Vec3; up: Vec3; fov: number; halfHeight: number; }
export interface Path { name: string; fov: number; keys: { time: number; eye: Vec3; forward: Vec3 }[]; }
export interface WalkGrid {
  lower: number[]; cell: number; eyeHeight: number; width: number; height: number; walkable: Uint8Array; floor: Float32Array;
}

export interface LightGroup {
  name: string; lamps: string[]; value: number; color: Vec3; ownColor: Vec3; materials: Uint32Array; emitters: Uint32Array;
  brightLights: Uint32Array; sky: boolean; reflectors: Float32Array; surrounds: Float32Array; probes: Float32Array;
}
/** Codes are halves without their last four bits, by texel and by point of the details. */
export interface PageGroups {
  page: number; width: number; height: number; detailWidth: number; detailHeight: number; scale: number; rest: Uint8Array;
  restOfDetail: Uint8Array; others: { group: number; light: Uint16Array; detail: Uint16Array }[];
}

export interface CurvedReflector { name: string; material: number; map: number; indices: Uint32Array; }
/** light: RGB9E5 over `scale`; inverseDistance: 1/m, 0: sky. */
export interface Surround {
  centre: Vec3; size: number; scale: number; light: Uint32Array; inverseDistance: Float32Array; valid: Uint8Array;
}

export interface Pose { position: Vec3; rotation: number[]; }  // a unit quaternion x, y, z, w
export interface Transfer {
  bands: number; channels: number; clusters: number; components: number; basis: Float32Array; weightScale: Float32Array;
  cluster: Uint8Array; weight: Int16Array;
}
export interface Mover { name: string; rest: Pose; keys: { time: number; pose: Pose }[]; mesh: Mesh; transfer: Transfer; }
export interface BrightLight {
  kind: number; twoSided: boolean; intensity: Vec3; position: Vec3; direction: Vec3; innerCone: number; outerCone: number;
  angularRadius: number; corners: Vec3[];
}
/** cells: children and eight probes each. bright, kept: 64 bits a probe. harmonics: coefficient by coefficient over all probes. */
export interface LightField {
  bands: number; depthSide: number; depthCap: number; lower: Vec3; cell: Vec3; size: number[]; cells: Uint32Array;
  positions: Float32Array; valid: Uint8Array; bright: Uint32Array; kept: Uint32Array; harmonics: Float32Array;
  depth: Uint16Array; depthSquared: Uint16Array; lights: BrightLight[];
}

/** Sun and sky by the hour: groups of which texels hold the mean. group of a night: one that there is not. */
export interface Day { clock: string; shown: number; hours: { hour: number; group: number; sky: number[] }[]; }

export interface Sections {
  day?: Day;
  sharp?: SharpLight; skyMap?: SkyMap;
  movers: Mover[]; field?: LightField;
  curved: CurvedReflector[]; surrounds: Surround[];
  groups: LightGroup[]; pageGroups: PageGroups[]; sky: number[]; mesh?: Mesh; materials: Material[]; emissionTextures: EmissionTexture[]; metalness: Metalness[]; textures: Texture[]; normals: Texture[]; pages: Page[];
  reflectors: Reflector[]; emitters: Emitter[]; kernels: Kernel[]; fresnels: Fresnel[];
  cameras: Camera[]; paths: Path[]; grids: WalkGrid[];
}

