// The player's own shaders, as text: one source for desktop and browser.
import lib_color from '../../shaders/lib/color.glsl';
import lib_distance_alpha from '../../shaders/lib/distance_alpha.glsl';
import lib_fill from '../../shaders/lib/fill.glsl';
import lib_fullscreen from '../../shaders/lib/fullscreen.glsl';
import lib_kernel from '../../shaders/lib/kernel.glsl';
import lib_lightmap_uv from '../../shaders/lib/lightmap_uv.glsl';
import lib_lobe_light from '../../shaders/lib/lobe_light.glsl';
import lib_lit_surface from '../../shaders/lib/lit_surface.glsl';
import lib_metalness from '../../shaders/lib/metalness.glsl';
import lib_mirrored from '../../shaders/lib/mirrored.glsl';
import lib_normal_map from '../../shaders/lib/normal_map.glsl';
import lib_octahedral from '../../shaders/lib/octahedral.glsl';
import lib_reflectance from '../../shaders/lib/reflectance.glsl';
import lib_shading from '../../shaders/lib/shading.glsl';
import lib_sharp_light from '../../shaders/lib/sharp_light.glsl';
import lib_surround from '../../shaders/lib/surround.glsl';
import lib_taken_light from '../../shaders/lib/taken_light.glsl';
import lib_texture_along from '../../shaders/lib/texture_along.glsl';
import lib_tonemap from '../../shaders/lib/tonemap.glsl';
import lib_transfer from '../../shaders/lib/transfer.glsl';
import pass_mover_light_frag from '../../shaders/passes/mover_light.frag';
import pass_mover_light_vert from '../../shaders/passes/mover_light.vert';
import pass_curved_light_frag from '../../shaders/passes/curved_light.frag';
import pass_curved_light_vert from '../../shaders/passes/curved_light.vert';
import pass_curved_lobe_glsl from '../../shaders/passes/curved_lobe.glsl';
import pass_curved_surface_frag from '../../shaders/passes/curved_surface.frag';
import pass_curved_surface_vert from '../../shaders/passes/curved_surface.vert';
import pass_depth_frag from '../../shaders/passes/depth.frag';
import pass_depth_vert from '../../shaders/passes/depth.vert';
import pass_lightmap_glsl from '../../shaders/passes/lightmap.glsl';
import pass_opaque_glsl from '../../shaders/passes/opaque.glsl';
import pass_reflector_compose_frag from '../../shaders/passes/reflector_compose.frag';
import pass_reflector_compose_vert from '../../shaders/passes/reflector_compose.vert';
import pass_reflector_convolve_frag from '../../shaders/passes/reflector_convolve.frag';
import pass_reflector_convolve_vert from '../../shaders/passes/reflector_convolve.vert';
import pass_reflector_emitters_frag from '../../shaders/passes/reflector_emitters.frag';
import pass_reflector_emitters_glsl from '../../shaders/passes/reflector_emitters.glsl';
import pass_reflector_emitters_sharp_frag from '../../shaders/passes/reflector_emitters_sharp.frag';
import pass_reflector_emitters_sharp_vert from '../../shaders/passes/reflector_emitters_sharp.vert';
import pass_reflector_emitters_vert from '../../shaders/passes/reflector_emitters.vert';
import pass_reflector_mask_frag from '../../shaders/passes/reflector_mask.frag';
import pass_reflector_mask_vert from '../../shaders/passes/reflector_mask.vert';
import pass_reflector_reflectance_glsl from '../../shaders/passes/reflector_reflectance.glsl';
import pass_place_reflectance from '../../shaders/passes/place_reflectance.glsl';
import pass_reflector_surface_glsl from '../../shaders/passes/reflector_surface.glsl';
import pass_scene_frag from '../../shaders/passes/scene.frag';
import pass_scene_vert from '../../shaders/passes/scene.vert';
import pass_screen_blur_width_glsl from '../../shaders/passes/screen_blur_width.glsl';
import pass_screen_convolve_glsl from '../../shaders/passes/screen_convolve.glsl';
import pass_screen_convolve_frag from '../../shaders/passes/screen_convolve.frag';
import pass_screen_curved_frag from '../../shaders/passes/screen_curved.frag';
import pass_screen_fullscreen_vert from '../../shaders/passes/screen_fullscreen.vert';
import pass_screen_luminance_frag from '../../shaders/passes/screen_luminance.frag';
import pass_screen_sky_frag from '../../shaders/passes/screen_sky.frag';
import pass_screen_pull_frag from '../../shaders/passes/screen_pull.frag';
import pass_surface_glsl from '../../shaders/passes/surface.glsl';
import pass_surface_vertex_glsl from '../../shaders/passes/surface_vertex.glsl';
import pass_transparent_frag from '../../shaders/passes/transparent.frag';
import pass_transparent_vert from '../../shaders/passes/transparent.vert';
import web_average from '../shaders/average.frag';

const files: Record<string, string> = {
  'lib/color.glsl': lib_color,
  'lib/distance_alpha.glsl': lib_distance_alpha,
  'lib/fill.glsl': lib_fill,
  'lib/fullscreen.glsl': lib_fullscreen,
  'lib/kernel.glsl': lib_kernel,
  'lib/lightmap_uv.glsl': lib_lightmap_uv,
  'lib/lobe_light.glsl': lib_lobe_light,
  'lib/lit_surface.glsl': lib_lit_surface,
  'lib/metalness.glsl': lib_metalness,
  'lib/mirrored.glsl': lib_mirrored,
  'lib/normal_map.glsl': lib_normal_map,
  'lib/octahedral.glsl': lib_octahedral,
  'lib/reflectance.glsl': lib_reflectance,
  'lib/shading.glsl': lib_shading,
  'lib/sharp_light.glsl': lib_sharp_light,
  'lib/surround.glsl': lib_surround,
  'lib/taken_light.glsl': lib_taken_light,
  'lib/texture_along.glsl': lib_texture_along,
  'lib/tonemap.glsl': lib_tonemap,
  'lib/transfer.glsl': lib_transfer,
  'passes/curved_light.frag': pass_curved_light_frag,
  'passes/curved_light.vert': pass_curved_light_vert,
  'passes/curved_lobe.glsl': pass_curved_lobe_glsl,
  'passes/curved_surface.frag': pass_curved_surface_frag,
  'passes/curved_surface.vert': pass_curved_surface_vert,
  'passes/depth.frag': pass_depth_frag,
  'passes/depth.vert': pass_depth_vert,
  'passes/lightmap.glsl': pass_lightmap_glsl,
  'passes/mover_light.frag': pass_mover_light_frag,
  'passes/mover_light.vert': pass_mover_light_vert,
  'passes/opaque.glsl': pass_opaque_glsl,
  'passes/reflector_compose.frag': pass_reflector_compose_frag,
  'passes/reflector_compose.vert': pass_reflector_compose_vert,
  'passes/reflector_convolve.frag': pass_reflector_convolve_frag,
  'passes/reflector_convolve.vert': pass_reflector_convolve_vert,
  'passes/reflector_emitters.frag': pass_reflector_emitters_frag,
  'passes/reflector_emitters.glsl': pass_reflector_emitters_glsl,
  'passes/reflector_emitters_sharp.frag': pass_reflector_emitters_sharp_frag,
  'passes/reflector_emitters_sharp.vert': pass_reflector_emitters_sharp_vert,
  'passes/reflector_emitters.vert': pass_reflector_emitters_vert,
  'passes/reflector_mask.frag': pass_reflector_mask_frag,
  'passes/reflector_mask.vert': pass_reflector_mask_vert,
  'passes/reflector_reflectance.glsl': pass_reflector_reflectance_glsl,
  'passes/place_reflectance.glsl': pass_place_reflectance,
  'passes/reflector_surface.glsl': pass_reflector_surface_glsl,
  'passes/scene.frag': pass_scene_frag,
  'passes/scene.vert': pass_scene_vert,
  'passes/screen_blur_width.glsl': pass_screen_blur_width_glsl,
  'passes/screen_convolve.glsl': pass_screen_convolve_glsl,
  'passes/screen_convolve.frag': pass_screen_convolve_frag,
  'passes/screen_curved.frag': pass_screen_curved_frag,
  'passes/screen_fullscreen.vert': pass_screen_fullscreen_vert,
  'passes/screen_luminance.frag': pass_screen_luminance_frag,
  'passes/screen_sky.frag': pass_screen_sky_frag,
  'passes/screen_pull.frag': pass_screen_pull_frag,
  'passes/surface.glsl': pass_surface_glsl,
  'passes/surface_vertex.glsl': pass_surface_vertex_glsl,
  'passes/transparent.frag': pass_transparent_frag,
  'passes/transparent.vert': pass_transparent_vert,
  'passes/screen_average.frag': web_average,
};

const head = [
  '#version 300 es', 'precision highp float;', 'precision highp int;', 'precision highp sampler2D;',
  'precision highp sampler2DArray;', 'precision highp isampler2D;', 'precision highp usampler2D;', '',
].join('\n');

/** A shader with all that it includes, each file once, as the player assembles it. */
export function assembleShader(name: string, defines = ''): string {
  const done = new Set<string>();
  const append = (file: string): string => {
    if (done.has(file)) return '';
    done.add(file);
    const text = files[file];
    if (text === undefined) throw new Error(`found no shader ${file}`);
    return text.replace(/^#include "([^"]+)".*$/gm, (_, included: string) => append(included));
  };
  return head + defines.split(' ').filter(Boolean).map((d) => `#define ${d}\n`).join('') + append(name);
}
