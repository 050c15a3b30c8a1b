// Counts pixels by stencil: only a query sees what passes.
void main() {}
