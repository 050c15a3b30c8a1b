// oriel-study: draws and measures a scene as five published systems did. docs/study/ has a page for each.
#include "study/rooms.h"

namespace oriel::study {
namespace {

constexpr const char* kFooter = R"(
Exit codes:
  0  done
  1  usage: an unknown option, command or value
  2  a file cannot be read or written
  3  the scene or the pack is invalid
  4  failed at run time: memory, OpenGL

docs/study/ has a page for each method: what it is, what the paper says of it and what is measured here.)";

}  // namespace
}  // namespace oriel::study

int main(int argc, char** argv) {
  using namespace oriel;
  using namespace oriel::study;
  gpu::add_shader_sources(shader_sources());
  ShownArguments arguments;
  Herf1997Settings herf1997;
  const CommandLine line{
      ORIEL_VERSION,
      {.name = "oriel-study",
       .help = "oriel-study: draws and measures a scene as published systems did, to compare with.",
       .footer = kFooter,
       .options = {},
       .commands = {barczak2006_command(arguments), bastos1999_command(arguments), diefenbach1997_command(arguments),
                    herf1997_command(arguments, herf1997), udeshi1999_command(), phong_fit_command()}}};
  return run_program(line, argc, argv);
}
