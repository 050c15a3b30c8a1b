// (M * K) R of an image that may have fewer pixels than the frame (Bastos et al. 1999, section 8.2.2). What no map tells of is black.
uniform sampler2D u_image;
uniform sampler2D u_sphere;      // R
uniform vec2 u_texture_size;
uniform vec2 u_image_size;       // pixels in use
uniform vec2 u_origin;           // of the image, in its own pixels
uniform float u_reduction;       // pixels of the frame along a side of one
uniform bool u_modulate;         // by R
in vec2 v_sphere;
layout(location = 0) out vec4 o_light;

void main() {
  vec2 at = clamp(gl_FragCoord.xy / u_reduction - u_origin, vec2(0.5), max(u_image_size - 0.5, vec2(0.5)));
  vec4 image = textureLod(u_image, at / u_texture_size, 0.0);
  vec3 light = image.a > 0.0 ? image.rgb : vec3(0.0);
  o_light = vec4(u_modulate ? light * texture(u_sphere, v_sphere).rgb : light, 1.0);
}
