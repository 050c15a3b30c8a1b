// The commands of oriel-bake. Each holds its own arguments.
#pragma once

#include "bake/cli/session.h"

namespace oriel {

ToolCommand bake_command(BakeSession& session);  // what oriel-bake does without a command
ToolCommand plan_command(BakeSession& session);
ToolCommand worker_command(BakeSession& session);
ToolCommand verify_command(BakeSession& session);
ToolCommand submit_command(BakeSession& session);
ToolCommand key_command(BakeSession& session);
ToolCommand cache_command(BakeSession& session);
ToolCommand lux_command(BakeSession& session);
ToolCommand render_command(BakeSession& session);
ToolCommand preview_command(BakeSession& session);
ToolCommand trade_command(BakeSession& session);

// Becomes oriel-preview with these words. Error kRuntime where that cannot be started.
Status start_preview(std::vector<std::string> words);

}  // namespace oriel
