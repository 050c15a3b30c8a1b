// The rooms of oriel-study: a published method each, as a command of its own.
#pragma once

#include "formats/cli/command.h"
#include "study/herf1997/herf1997.h"
#include "study/support/shown_scene.h"

namespace oriel::study {

// Those of study/shaders, as gpu::add_shader_sources() takes them.
std::span<const gpu::ShaderSource> shader_sources();

// A room's command: its options, and what draws or measures with them. arguments outlive it.
ToolCommand diefenbach1997_command(ShownArguments& arguments);
ToolCommand herf1997_command(ShownArguments& arguments, Herf1997Settings& settings);
ToolCommand barczak2006_command(ShownArguments& arguments);
ToolCommand bastos1999_command(ShownArguments& arguments);
ToolCommand udeshi1999_command();
// Not a room: numbers of Diefenbach and Badler's lobe.
ToolCommand phong_fit_command();

}  // namespace oriel::study
