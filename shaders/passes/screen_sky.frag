// The sky where nothing is seen (formats/assets/sky_map.h).
uniform sampler2D u_sky;
uniform vec3 u_color;  // cd/m², that it multiplies
uniform mat4 u_direction_from_clip;  // pack space, from the eye
uniform vec4 u_eye;
uniform vec2 u_size;    // of the view, pixels
const float kMost = 49128.0;  // cd/m2: a sun in it must not ask more of the frame than halves hold
uniform float u_alpha;
layout(location = 0) out vec4 o_light;

void main() {
  vec4 beyond = u_direction_from_clip * vec4(2.0 * gl_FragCoord.xy / u_size - 1.0, 0.0, 1.0);
  vec3 d = u_eye.w > 0.0 ? normalize(beyond.xyz / beyond.w) : -u_eye.xyz;
  vec2 uv = vec2(0.5 + atan(d.z, d.x) / 6.28318531, atan(length(d.xz), d.y) / 3.14159265);
  o_light = vec4(min(u_color * textureLod(u_sky, uv, 0.0).rgb, kMost), u_alpha);
}
