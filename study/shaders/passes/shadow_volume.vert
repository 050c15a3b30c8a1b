// Sides of shadow volumes: every other vertex is thrown to infinity away from the light.
layout(location = 0) in vec4 a_place;  // w: 1 to be thrown
uniform mat4 u_clip_from_pack;
uniform vec4 u_light;  // homogeneous
invariant gl_Position;

void main() {
  vec4 place = a_place.w > 0.5 ? vec4(a_place.xyz * u_light.w - u_light.xyz, 0.0) : vec4(a_place.xyz, 1.0);
  gl_Position = u_clip_from_pack * place;
}
