// What a pass adds to the frame: reflected irradiance, emission, and the sky where nothing is seen.
uniform sampler2D u_place, u_diffuse, u_emission, u_light, u_traced;
uniform sampler2D u_sky;
uniform bool u_sky_image;
uniform vec3 u_sky_color;
uniform float u_sky_turn;  // radians
uniform mat4 u_pack_from_clip;
uniform vec4 u_eye;
uniform vec2 u_size;
uniform float u_emits, u_traces;  // 1, or 0 to leave it out
layout(location = 0) out vec4 o_sum;

vec3 sky() {
  if (!u_sky_image) return u_sky_color;
  vec4 beyond = u_pack_from_clip * vec4(2.0 * gl_FragCoord.xy / u_size - 1.0, 0.0, 1.0);
  vec3 d = u_eye.w > 0.0 ? normalize(beyond.xyz / beyond.w - u_eye.xyz) : -u_eye.xyz;
  float u = 0.5 + (atan(d.z, d.x) + u_sky_turn) / 6.28318531;
  return texture(u_sky, vec2(u, atan(length(d.xz), d.y) / 3.14159265)).rgb;
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  if (texelFetch(u_place, at, 0).a == 0.0) {
    o_sum = vec4(sky(), 1.0);
    return;
  }
  vec3 light = texelFetch(u_diffuse, at, 0).rgb * texelFetch(u_light, at, 0).rgb;
  o_sum = vec4(light + u_emits * texelFetch(u_emission, at, 0).rgb + u_traces * texelFetch(u_traced, at, 0).rgb, 1.0);
}
