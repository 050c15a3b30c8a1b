#include "bake/material/plot.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/core/text.h"

namespace oriel {
namespace {

constexpr double kDegree = kPiD / 180;
constexpr int kPlotted[] = {0, 60, 80};  // incidences of the lobes' pictures, degrees
constexpr int kSide = 61;                // of such a picture

std::string index_text(const ComplexIndex& i) {
  return i.k > 0 ? fmt::format("{:.3f}+{:.3f}i", i.n, i.k) : fmt::format("{:.3f}", i.n);
}

std::string reflectance_csv(const FresnelMap& map) {
  std::string text = "angle_deg,cos_theta,r,g,b\n";
  for (int half = 0; half <= 180; ++half) {
    const double cos_theta = half == 180 ? 0 : std::cos(0.5 * half * kDegree);
    const Vec3 r = fresnel_lookup(map, static_cast<float>(cos_theta));
    text += fmt::format("{},{:.6f},{:.5f},{:.5f},{:.5f}\n", 0.5 * half, cos_theta, r.r, r.g, r.b);
  }
  return text;
}

// Half angle of the cone around the mirror direction that holds a share of the lobe; linear between the table's
// entries.
double cone_deg(const KernelSlice& slice, double share) {
  const double last = static_cast<double>(slice.radial.size() - 1);
  std::size_t i = 1;
  while (i + 1 < slice.radial.size() && slice.radial[i] < share) ++i;
  const double low = slice.radial[i - 1], high = slice.radial[i];
  const double at = (static_cast<double>(i - 1) + (high > low ? (share - low) / (high - low) : 0)) / last;
  return 2 * std::atan(at * at * slice.radial_extent / 2) / kDegree;
}

void add_incidences(const LobeFunction& lobe, double alpha, std::string& incidence, std::string& radial) {
  for (const int angle : {0, 15, 30, 45, 60, 70, 75, 80, 85, 89}) {
    const KernelSlice s = make_slice(lobe, alpha, angle == 0 ? 1 : std::cos(angle * kDegree));
    incidence +=
        fmt::format("{},{:.6f},{:.5f},{:.3f},{:.3f},{:.3f},{:.5f},{:.5f},{:.5f}\n", angle, s.cos_theta, s.albedo,
                    s.tilt_rad / kDegree, cone_deg(s, 0.5), cone_deg(s, 0.9), s.shift, s.width.x, s.width.y);
    for (std::size_t i = 0; i < s.radial.size(); ++i) {
      const double root = static_cast<double>(i) / static_cast<double>(s.radial.size() - 1);
      radial += fmt::format("{},{:.4f},{:.5f}\n", angle, 2 * std::atan(root * root * s.radial_extent / 2) / kDegree,
                            s.radial[i]);
    }
  }
}

// Even in mirror coordinates, out to where most of the energy lies at normal incidence.
std::string lobe_csv(const LobeFunction& lobe, double alpha, int angle) {
  const double c = angle == 0 ? 1 : std::cos(angle * kDegree), reach = std::min(6 * alpha, 2.0);
  const DVec3 wo(std::sqrt(1 - c * c), 0, c);
  std::vector<double> values;
  for (int i = 0; i < kSide * kSide; ++i) {
    const DVec3 wi = from_mirror_coordinates(c, (DVec2(i % kSide, i / kSide) / (kSide - 1.0) * 2.0 - 1.0) * reach);
    values.push_back(lobe(wo, wi, glm::normalize(wo + wi)));
  }
  const double peak = *std::max_element(values.begin(), values.end());
  std::string text = "across,along,share_of_peak\n";
  for (int i = 0; i < kSide * kSide; ++i)
    text += fmt::format("{:.5f},{:.5f},{:.5f}\n", ((i % kSide) / (kSide - 1.0) * 2 - 1) * reach,
                        ((i / kSide) / (kSide - 1.0) * 2 - 1) * reach, values[static_cast<std::size_t>(i)] / peak);
  return text;
}

std::string script(const NamedMaterial& material) {
  const std::string& name = material.name;
  std::string lobes;
  for (const int angle : kPlotted)
    lobes += fmt::format(
        "set title 'at {0} degrees'\n"
        "set size ratio -1\nunset grid\nset xlabel 'across'\nset ylabel 'along, towards the normal'\n"
        "plot '{1}_lobe_{0}.csv' skip 1 using 1:2:3 with image notitle, \\\n"
        "  $mirror with points pt 1 ps 1.6 lw 5 lc 'white' notitle, "
        "$mirror with points pt 1 ps 1.4 lw 2 lc 'black' notitle\n",
        angle, name);
  return fmt::format(
      R"(set datafile separator ','
set terminal pngcairo size 700,480 font 'sans,11'
set output '{0}_reflectance.png'
set title 'R of {0}, alpha {1}'
set grid
set key bottom
set xlabel 'angle between reflected vector and normal, degrees'
set ylabel 'reflectance'
plot [-90:90] [0:1.02] for [side in '-1 1'] for [k=3:5] '{0}_reflectance.csv' skip 1 using (side*$1):k with lines \
  lc rgb word('red #109010 blue', k-2) lw 2 title (side > 0 ? word('R G B', k-2) : '')
reset
set datafile separator ','
set terminal pngcairo size 1300,400 font 'sans,11'
set output '{0}_kernel.png'
set multiplot layout 1,4 title 'K of {0}, alpha {1}'
set palette defined (0 '#000020', 0.05 '#203080', 0.3 '#c04060', 1 '#ffffc0')
unset colorbox
set key bottom right
set tics scale 0.5
set autoscale fix
$mirror << end
0,0
end
{2}set title 'share within a cone'
set size noratio
set grid
set xlabel 'half angle, degrees'
unset ylabel
plot [0:90] [0:1] for [a in '0 60 80'] '{0}_radial.csv' skip 1 \
  using (strcol(1) eq a ? $2 : 1/0):3 with lines lw 2 title a.' degrees'
unset multiplot
)",
      name, material.lobe.alpha, lobes);
}

}  // namespace

std::vector<NamedMaterial> named_materials() {
  std::vector<NamedMaterial> out;
  for (int i = 0; i < kMetalCount; ++i) {
    const auto metal = static_cast<Metal>(i);
    const MetalConstants& constants = constants_of(metal);
    std::string index;
    for (const ComplexIndex& c : constants.rgb) index += (index.empty() ? "" : ", ") + index_text(c);
    out.push_back({constants.name, index, {Vec3(metal_f0(metal)), 1, 0, {.schlick = 0, .metal = metal}}});
  }
  for (const auto& [name, ior] : {std::pair("water", 1.333f), std::pair("glass", 1.5f), std::pair("diamond", 2.417f)})
    out.push_back(
        {name, index_text({ior, 0}), {Vec3(static_cast<float>(dielectric_f0(ior))), 1, 0, {.ior = ior, .schlick = 0}}});
  return out;
}

std::optional<NamedMaterial> material_by_name(std::string_view name) {
  const auto metal = metal_by_name(name);
  const std::string wanted = metal ? constants_of(*metal).name : lower_case(name);
  for (NamedMaterial& material : named_materials())
    if (material.name == wanted) return std::move(material);
  return std::nullopt;
}

std::vector<PlotFile> plot_files(const NamedMaterial& material, FacetModel model) {
  const FresnelMap map = make_fresnel_map({.base = material.lobe});
  const double alpha = material.lobe.alpha;
  const LobeFunction lobe = microfacet_lobe(model, alpha);
  std::string incidence = "angle_deg,cos_theta,albedo,tilt_deg,cone50_deg,cone90_deg,shift,width_across,width_along\n";
  std::string radial = "angle_deg,half_angle_deg,share\n";
  add_incidences(lobe, alpha, incidence, radial);
  std::vector<PlotFile> files{{material.name + "_reflectance.csv", reflectance_csv(map)},
                              {material.name + "_incidence.csv", std::move(incidence)},
                              {material.name + "_radial.csv", std::move(radial)}};
  for (const int angle : kPlotted)
    files.push_back({fmt::format("{}_lobe_{}.csv", material.name, angle), lobe_csv(lobe, alpha, angle)});
  files.push_back({material.name + ".gp", script(material)});
  return files;
}

}  // namespace oriel
