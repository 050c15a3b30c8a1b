#include <fmt/format.h>

#include <cstdio>

#include "formats/analysis/why.h"
#include "formats/inspect/commands.h"
#include "formats/pack/reader.h"

namespace oriel::inspect {

Result<DVec3> parse_place(const std::string& text) {
  DVec3 at(0);
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &at.x, &at.y, &at.z, &rest) == 3 && std::isfinite(at.x + at.y + at.z))
    return at;
  return fail(ErrorCode::kUsage, "--at", "found '{}', expected a place in world metres such as 1.2,0,3.5", text);
}

int why(const std::filesystem::path& path, const WhyRequest& request) {
  const auto at = parse_place(request.at);
  if (!at) return report(at.error());
  const auto from = request.from.empty() ? Result<DVec3>(*at) : parse_place(request.from);
  if (!from) return report(from.error());
  const auto pack = read_pack(path);
  if (!pack) return report(pack.error());
  WhyOptions options;
  if (!request.from.empty()) options.eye = Vec3(*from - pack->mesh.origin);
  const auto found = why_at(*pack, Vec3(*at - pack->mesh.origin), options);
  if (!found)
    return report(
        {ErrorCode::kInvalid,
         fmt::format("no surface is within {} m of {:.3f}, {:.3f}, {:.3f}: the panel of oriel-play (Tab) shows "
                     "places of surfaces under the pointer",
                     options.reach_m, at->x, at->y, at->z),
         path.string()});
  fmt::print("{}", request.json ? why_json(*found) : why_text(*found));
  return 0;
}

}  // namespace oriel::inspect
