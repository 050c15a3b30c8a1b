#include <fmt/format.h>

#include "formats/inspect/extraction.h"

namespace oriel::inspect {
namespace {

// Pixels' mirror coordinates beside their weights.
std::string slice_csv(const KernelSlice& slice, std::uint32_t size) {
  std::string text = "x,y,weight\n";
  for (std::uint32_t i = 0; i < slice.weights.size(); ++i) {
    const DVec2 u = slice_point(slice, (DVec2(i % size, i / size) + 0.5) / double(size));
    text += fmt::format("{:.7g},{:.7g},{}\n", u.x, u.y, slice.weights[i]);
  }
  return text;
}

// Shares within cones around the mirror direction, at every incidence.
std::string radial_csv(const BrdfKernel& kernel) {
  std::string text = "cos_theta,half_angle_deg,share\n";
  for (const KernelSlice& slice : kernel.slices)
    for (std::size_t i = 0; i < slice.radial.size(); ++i) {
      const double root = static_cast<double>(i) / static_cast<double>(slice.radial.size() - 1);
      const double u = root * root * slice.radial_extent;
      text += fmt::format("{},{:.6g},{}\n", slice.cos_theta, 2 * std::atan(u / 2) * 180 / kPiD, slice.radial[i]);
    }
  return text;
}

}  // namespace

Status Extraction::kernels() {
  for (std::size_t i = 0; i < pack_.kernels.size(); ++i) {
    const auto& kernel = pack_.kernels[i];
    const std::string name = fmt::format("brdf_kernel_{:02}", i);
    Json entry{{"kind", "brdf_kernel"},
               {"number", i},
               {"size", kernel.size},
               {"lobe", "D G2 / (4 cos theta_o), D GGX, G2 height-correlated Smith"},
               {"alpha", kernel.alpha},
               {"cos_theta", kernel.cos_theta},
               {"half_extent", kernel.half_extent},
               {"energy_kept", kernel.energy_kept}};
    ORIEL_TRY_VOID(exr(entry, "weights", name + ".exr", {kernel.size, kernel.size, 1, kernel.weights}, "1"));
    ORIEL_TRY_VOID(kernel_slices(kernel, name, entry));
    index_.push_back(std::move(entry));
  }
  return {};
}

Status Extraction::kernel_slices(const BrdfKernel& kernel, const std::string& name, Json& entry) {
  entry["incidences"] = Json::array();
  for (std::size_t k = 0; k < kernel.slices.size(); ++k) {
    const KernelSlice& s = kernel.slices[k];
    Json slice{
        {"cos_theta", s.cos_theta},        {"size", kernel.slice_size},          {"albedo", s.albedo},
        {"energy_kept", s.energy_kept},    {"tilt_deg", s.tilt_rad * 180 / kPi}, {"shift", s.shift},
        {"width", {s.width.x, s.width.y}}, {"lower", {s.lower.x, s.lower.y}},    {"upper", {s.upper.x, s.upper.y}}};
    const std::string file = fmt::format("{}_incidence_{}", name, k);
    ORIEL_TRY_VOID(exr(slice, "weights", file + ".exr", {kernel.slice_size, kernel.slice_size, 1, s.weights}, "1"));
    ORIEL_TRY_VOID(csv(slice, "weights_csv", file + ".csv", slice_csv(s, kernel.slice_size)));
    entry["incidences"].push_back(std::move(slice));
  }
  return kernel.slices.empty() ? Status() : csv(entry, "radial_csv", name + "_radial.csv", radial_csv(kernel));
}

Status Extraction::fresnel_maps() {
  for (std::size_t i = 0; i < pack_.fresnel_maps.size(); ++i) {
    const auto& map = pack_.fresnel_maps[i];
    const std::string name = fmt::format("fresnel_map_{:02}", i);
    Json entry{{"kind", "fresnel_map"}, {"number", i}, {"alpha", map.alpha}};
    const auto entries = static_cast<std::uint32_t>(map.table.size());
    ORIEL_TRY_VOID(exr(entry, "table", name + "_table.exr", rgb_image(entries, 1, map.table), "1"));
    std::string text = "cos_theta,r,g,b\n";
    for (std::size_t k = 0; k < map.table.size(); ++k) {
      const double root = static_cast<double>(k) / static_cast<double>(map.table.size() - 1);
      text += fmt::format("{},{},{},{}\n", root * root, map.table[k].r, map.table[k].g, map.table[k].b);
    }
    ORIEL_TRY_VOID(csv(entry, "table_csv", name + "_table.csv", text));
    index_.push_back(std::move(entry));
  }
  return {};
}

}  // namespace oriel::inspect
