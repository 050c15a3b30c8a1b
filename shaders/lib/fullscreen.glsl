// One triangle that covers the viewport, from vertex numbers 0, 1, 2: no vertex buffer.
vec4 fullscreen_position(int vertex) {
  vec2 corner = vec2(float((vertex & 1) << 2) - 1.0, float((vertex & 2) << 1) - 1.0);
  return vec4(corner, 0.0, 1.0);
}
