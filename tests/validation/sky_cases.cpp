// CIE 171:2006, daylight: 5.9 to 5.13. Percent of what the sky sheds on open level ground.
#include "scenes/sky.h"
#include "tests/validation/suite.h"

namespace oriel::validation {
namespace {

// The sun stands 60° high, so 30° off the zenith; towards +y of the case (azimuth 0, north) or -y.
constexpr double kElevation = 60;

SkyImage sky_image(int type, double azimuth_deg, double ground, std::uint32_t height) {
  const FloatImage image = *sample::make_sky({.type = type,
                                              .elevation_deg = kElevation,
                                              .azimuth_deg = azimuth_deg,
                                              .horizontal_lux = 100,
                                              .ground = ground,
                                              .height = height});
  SkyImage sky{image.width, image.height, {}, 0};
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) sky.texels.emplace_back(image.pixels[i]);
  return sky;
}

struct DaylightCase {
  const Json& j;
  std::string id, quantity;
  double rel;
};

void add_points(const DaylightCase& d, const Json& exact, const Json& published, Case& c) {
  for (const auto& [name, value] : exact.items()) {
    const Json& p = d.j["inputs"]["points"][name];
    const double e = value.get<double>();
    const bool wall = name == "A" && d.j["tolerance"].contains("rel_wall_A");
    double tolerance = e * (wall ? d.j["tolerance"]["rel_wall_A"].get<double>() : d.rel);
    if (d.j["tolerance"].contains("abs")) tolerance = std::max(tolerance, d.j["tolerance"]["abs"].get<double>());
    Reading r = at(name, probe(p["p"], p["n"]), e, tolerance);
    if (published.contains(name)) r.published = published[name].get<double>();
    c.readings.push_back(r);
  }
}

// 5.9: a square hole in the roof of a black room.
Scene roof_room(const Json& in) {
  const DVec3 size = vec(in["room"]);
  const double w = in["w"].get<double>();
  QuadScene scene;
  const auto black = scene.material(DVec3(0));
  scene.room(size, std::vector<std::uint32_t>(6, black), "z1");
  const DVec2 half(0.5 * w / size.y, 0.5 * w / size.x);
  scene.quad_with_hole("z1", black, {0, 0, size.z}, {0, size.y, 0}, {size.x, 0, 0}, DVec2(0.5) - half,
                       DVec2(0.5) + half);
  return scene.finish();
}

// 5.11 and 5.13: a window in the wall y = 0, and over it a black mask of that depth.
Scene facade_room(const Json& in, double mask_depth) {
  const DVec3 size = vec(in["room"]);
  QuadScene scene;
  const auto black = scene.material(DVec3(0));
  scene.room(size, std::vector<std::uint32_t>(6, black), "y0");
  const auto share = [&](std::size_t k) {
    return DVec2(in["opening_z"][k].get<double>() / size.z, in["opening_x"][k].get<double>() / size.x);
  };
  scene.quad_with_hole("y0", black, DVec3(0), {0, 0, size.z}, {size.x, 0, 0}, share(0), share(1));
  constexpr double kEndless = 100;  // metres of mask to either side
  if (mask_depth > 0) scene.quad("mask", black, {-kEndless, -mask_depth, 3}, {0, mask_depth, 0}, {2 * kEndless, 0, 0});
  return scene.finish();
}

Case daylight(const DaylightCase& d, const std::string& label, Scene scene, SkyImage sky) {
  Case c;
  c.id = d.id;
  c.label = label;
  c.scene = std::move(scene);
  c.scene.sky_image = std::move(sky);
  c.lux_error = 0.003;
  return c;
}

}  // namespace

std::vector<Case> sky_cases(const Suite& suite, bool thorough) {
  const std::uint32_t height = thorough ? 1024 : 512;
  std::vector<Case> cases;
  for (const char* id : {"CIE-5.9-1x1-a", "CIE-5.9-4x4-a", "CIE-5.11-2x1-a"}) {
    const Json& j = suite.find(id);
    const bool facade = j["inputs"].contains("opening_x");
    const DaylightCase d{j, id, facade ? "SC_plus_ERC_percent" : "SC_percent", j["tolerance"]["rel"].get<double>()};
    for (const auto& [type, exact] : j["expected"][d.quantity].items()) {
      if (!thorough && type != "1" && type != "12") continue;
      cases.push_back(daylight(d, "sky " + type, facade ? facade_room(j["inputs"], 0) : roof_room(j["inputs"]),
                               sky_image(std::stoi(type), facade ? 180 : 0, facade ? 0.3 : 0, height)));
      add_points(d, exact, j["expected"]["published"][type], cases.back());
    }
  }
  const Json& masked = suite.find("CIE-5.13-v");
  const DaylightCase d{masked, "CIE-5.13-v", "SC_percent", masked["tolerance"]["rel"].get<double>()};
  for (const auto& [depth, types] : masked["expected"][d.quantity].items())
    for (const auto& [type, exact] : types.items()) {
      if (!thorough && type != "12") continue;
      cases.push_back(daylight(d, "mask " + depth + ", sky " + type, facade_room(masked["inputs"], std::stod(depth)),
                               sky_image(std::stoi(type), 180, 0, height)));
      add_points(d, exact, Json::object(), cases.back());
    }
  return cases;
}

}  // namespace oriel::validation
