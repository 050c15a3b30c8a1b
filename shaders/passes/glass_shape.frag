// The surface of a body of glass as seen from its centre: the outward normal, a: how far away it is.
uniform vec3 u_centre;
in vec3 v_position;
in vec3 v_normal;
layout(location = 0) out vec4 o_shape;

void main() { o_shape = vec4(v_normal, distance(v_position, u_centre)); }
