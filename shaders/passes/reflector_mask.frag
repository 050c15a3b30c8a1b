// A reflector's region in the stencil: no colour.
void main() {}
