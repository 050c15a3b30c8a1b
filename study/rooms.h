// The rooms of oriel-study: a published method each, as a command of its own.
#pragma once

#include "formats/cli/command.h"
#include "study/support/shown_scene.h"

namespace oriel::study {

// Those of study/shaders, as gpu::add_shader_sources() takes them.
std::span<const gpu::ShaderSource> shader_sources();

// A room's command: its options, and what draws or measures with them. arguments outlive it.
ToolCommand udeshi1999_command();

}  // namespace oriel::study
