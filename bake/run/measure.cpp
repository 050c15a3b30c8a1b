#include "bake/run/measure.h"
#include "bake/run/prepare.h"

#include "bake/jobs/parallel.h"
#include "bake/run/options.h"
#include "bake/run/pipeline.h"
#include "formats/core/file.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

Result<std::vector<MeasurePoint>> points_of(const MeasureJob& job, const Scene& scene) {
  if (job.points.empty()) return grid_points(scene, job.grid);
  ORIEL_TRY(const Bytes bytes, read_file(job.points));
  return parse_points({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, job.points.string());
}

// Names the buried lines of a table; leaves such points of a grid out.
Status settle_buried(const MeasureJob& job, Measurement& m, Context& context) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < m.points.size(); ++i) {
    if (m.results[i].buried && !job.points.empty())
      context.warning("buried-point", fmt::format("{}:{}: the point lies inside a closed body: it is measured there",
                                                  job.points.string(), m.points[i].line));
    if (m.results[i].buried && job.points.empty()) continue;
    m.points[kept] = m.points[i];
    m.results[kept++] = m.results[i];
  }
  if (kept == 0)
    return fail(ErrorCode::kUsage, "--grid " + job.grid.node,
                "found all {} points inside closed bodies, expected some in the open", m.points.size());
  if (kept < m.points.size())
    context.warning("buried-point", fmt::format("--grid {}: left out {} of {} points, which lie inside closed bodies",
                                                job.grid.node, m.points.size() - kept, m.points.size()));
  m.points.resize(kept);
  m.results.resize(kept);
  return {};
}

void warn_about_noise(const LuxOptions& options, const Measurement& m, Context& context) {
  if (options.relative_error <= 0) return;
  const auto missed = std::count_if(m.results.begin(), m.results.end(), [](const auto& r) { return !r.converged; });
  if (missed > 0)
    context.warning(
        "error-missed",
        fmt::format(
            "{} of {} points miss the error of {:.3g} % after {} paths: raise --samples or read their error column",
            missed, m.points.size(), 100 * options.relative_error, m.results[0].samples));
}

}  // namespace

Result<Measurement> measure(const MeasureJob& job, Context& context) {
  ORIEL_TRY(const ImportedScene imported, import_gltf(job.scene, job.import, context));
  const Scene& scene = imported.scene;
  Measurement m;
  ORIEL_TRY(m.points, points_of(job, scene));
  ORIEL_TRY(const Accel accel, Accel::build(scene, {job.reproducible, thread_count(context)}));
  const LightSet lights(scene, &accel);
  warn_about_light(scene, lights, context);
  ORIEL_TRY(m.results, illuminance_at({accel, lights, {}}, m.points, job.lux, context));
  ORIEL_TRY_VOID(settle_buried(job, m, context));
  warn_about_noise(job.lux, m, context);
  return m;
}

Result<GridSpec> parse_grid(const std::string& text) {
  const std::size_t second = text.rfind(',');
  const std::size_t first =
      second == std::string::npos || second == 0 ? std::string::npos : text.rfind(',', second - 1);
  if (first == std::string::npos || first == 0)
    return fail(ErrorCode::kUsage, "", "found '{}', expected NODE,spacing,height such as floor,50cm,85cm", text);
  GridSpec grid;
  grid.node = text.substr(0, first);
  ORIEL_TRY(grid.spacing_m, parse_length(text.substr(first + 1, second - first - 1)));
  const std::string height = text.substr(second + 1);
  grid.height_m = 0;
  // 0, in any unit, is on the face itself; a length is more than that.
  const bool zero = height == "0" || height == "0m" || height == "0cm" || height == "0mm";
  if (!zero) {
    ORIEL_TRY(grid.height_m, parse_length(height));
  }
  return grid;
}

}  // namespace oriel
