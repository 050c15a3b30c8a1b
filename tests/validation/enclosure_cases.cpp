// Closed enclosures, plates and furnaces: all bounces.
#include "bake/trace/accel.h"
#include "tests/validation/suite.h"

namespace oriel::validation {
namespace {

const std::vector<std::string> kFaces{"x0", "x1", "y0", "y1", "z0", "z1"};

Case new_case(const std::string& id, const std::string& label, Scene scene, double texel_m, double lux_error) {
  Case c;
  c.id = id;
  c.label = label;
  c.scene = std::move(scene);
  c.texel_m = texel_m;
  c.lux_error = lux_error;
  return c;
}

// A room of one material, from the suite where it has this scene.
Scene uniform_room(const Suite& suite, const std::string& file, const DVec3& size, const DVec3& rho,
                   const DVec3& exitance) {
  if (auto scene = suite.scene(file)) return std::move(*scene);
  QuadScene scene;
  scene.room(size, std::vector<std::uint32_t>(6, scene.material(rho, exitance)));
  return scene.finish();
}

Reading everywhere(const std::string& name, double expected, double tolerance) {
  Reading r = mean_over(name, kFaces, expected, tolerance);
  r.over = Over::kWorst;
  return r;
}

void add_uniform(const Suite& suite, bool thorough, std::vector<Case>& cases) {
  const Json& j = suite.find("ENC-01");
  for (std::size_t i = 0; i < j["inputs"]["reflectances"].size(); ++i) {
    const std::string rho = j["inputs"]["reflectances"][i].dump();
    Case c = new_case("ENC-01", "rho " + rho,
                      uniform_room(suite, "ENC-01_rho" + rho, DVec3(1),
                                   DVec3(j["inputs"]["reflectances"][i].get<double>()), DVec3(1)),
                      thorough ? 0.1 : 0.25, 0.0035);
    const double e = j["expected"]["irradiance"][i].get<double>();
    c.readings.push_back(everywhere("worst point", e, e * j["tolerance"]["rel"].get<double>()));
    cases.push_back(c);
  }
  const Json& rgb = suite.find("ENC-03");
  Case c = new_case("ENC-03", "rho .95 .6 .05", suite.scene("ENC-03").value(), thorough ? 0.2 : 0.5, 0.0035);
  for (int k = 0; k < 3; ++k) {
    // B = M + ρE
    const double b = rgb["expected"]["B"][static_cast<std::size_t>(k)].get<double>();
    Reading r = everywhere(fmt::format("worst point, {}", "RGB"[k]), b, b * rgb["tolerance"]["rel"].get<double>());
    r.channel = k;
    r.scale = rgb["inputs"]["rho"][static_cast<std::size_t>(k)].get<double>();
    r.offset = rgb["inputs"]["emission"][static_cast<std::size_t>(k)].get<double>();
    c.readings.push_back(r);
  }
  cases.push_back(c);
}

void add_points(const Json& j, Case& c) {
  for (std::size_t i = 0; i < j["inputs"]["points"].size(); ++i) {
    const Json& point = j["inputs"]["points"][i];
    const double e = j["expected"]["point_irradiance"][i].get<double>();
    c.readings.push_back(at("point " + point["p"].dump(), probe(point["p"], point["n"]), e,
                            e * j["tolerance"]["rel_point"].get<double>()));
  }
}

void add_boxes(const Suite& suite, bool thorough, std::vector<Case>& cases) {
  for (const char* id : {"ENC-04", "ENC-08"}) {
    const Json& j = suite.find(id);
    Case c = new_case(id, j["title"].get<std::string>(), suite.scene(id).value(), thorough ? 0.01 : 0.02, 0.003);
    for (const auto& [face, e] : j["expected"]["mean_irradiance_per_face"].items()) {
      std::vector<std::string> nodes{face};
      if (id == std::string("ENC-08") && face == "z1") nodes = {"z1_lit", "z1_dark"};
      c.readings.push_back(mean_over("mean " + face, nodes, e.get<double>(),
                                     e.get<double>() * j["tolerance"]["rel_mean"].get<double>()));
    }
    add_points(j, c);
    cases.push_back(c);
  }
}

// Integrating sphere: a spot light lays its flux on a part of the wall; elsewhere there is indirect light alone.
void add_sphere(const Suite& suite, bool thorough, std::vector<Case>& cases) {
  const Json& j = suite.find("ENC-09");
  const double radius = j["inputs"]["R"].get<double>(), flux = j["inputs"]["Phi"].get<double>();
  for (std::size_t i = 0; i < j["inputs"]["rho"].size(); ++i) {
    QuadScene scene;
    scene.parts().sphere("sphere", scene.material(DVec3(j["inputs"]["rho"][i].get<double>())), Vec3(0),
                         static_cast<float>(radius), 4, true);
    Light spot;
    spot.type = LightType::kSpot;
    spot.direction = {1, 0, 0};
    spot.outer_cone_rad = 0.4f;
    const double ci = 1, co = std::cos(0.4);
    spot.intensity = Vec3(static_cast<float>(flux / (2 * kPiD * ((1 - ci) + (ci - co) / 3))));
    scene.parts().scene().lights = {spot};
    Case c = new_case("ENC-09", "rho " + j["inputs"]["rho"][i].dump(), scene.finish(), thorough ? 0.05 : 0.1, 0.006);
    const double e = j["expected"]["E_indirect"][i].get<double>();
    for (const std::uint32_t t : {100u, 1500u, 4000u}) {
      const DVec3 p(point_on(c.scene, t, Vec2(1.0f / 3))), n(geometric_normal(c.scene, t));
      if (p.x > 0.8 * radius) continue;  // in the spot
      c.readings.push_back(at(fmt::format("triangle {}", t), {p, n, 1}, e, e * j["tolerance"]["rel"].get<double>()));
    }
    cases.push_back(c);
  }
}

void add_plates(const Suite& suite, bool thorough, std::vector<Case>& cases) {
  for (const char* id : {"PLT-01", "PLT-02", "PLT-04", "PLT-05"}) {
    const Json& j = suite.find(id);
    const bool strips = j["inputs"].contains("x");
    const double gap = strips ? j["inputs"]["gap"].get<double>() : id == std::string("PLT-04") ? 1.0 : 0.4;
    Case c = new_case(id, j["title"].get<std::string>(), suite.scene(id).value(), thorough ? 0.025 : 0.05, 0.002);
    if (strips) c.texel_m = thorough ? 0.05 : 0;  // 60 m long
    const double rel = j["tolerance"]["rel"].get<double>();
    for (std::size_t side = 0; side < 2; ++side) {
      const auto radiosity = [&](Reading r) {
        r.offset = j["inputs"]["emission"][side].get<double>();
        r.scale = j["inputs"]["rho"][side].get<double>();
        r.tolerance = rel * r.expected;
        c.readings.push_back(r);
      };
      const std::string b = side == 0 ? "B1" : "B2";
      const Json& where = strips ? j["inputs"]["x"] : j["inputs"]["points_xy"];
      for (std::size_t i = 0; i < where.size(); ++i) {
        const DVec3 p(strips ? where[i].get<double>() : where[i][0].get<double>(),
                      strips ? 0.25 : where[i][1].get<double>(), side == 0 ? 0 : gap);
        const Probe probe{from_case(p), DVec3(0, side == 0 ? 1 : -1, 0), 1};
        radiosity(at(fmt::format("{} at {}", b, where[i].dump()), probe, j["expected"][b][i].get<double>(), 0));
      }
      // Of an infinite strip the mean is one across its width; near a finite strip's ends it is not.
      if (!strips)
        radiosity(
            mean_over("mean " + b, {side == 0 ? "plate1" : "plate2"}, j["expected"]["mean_" + b].get<double>(), 0));
    }
    cases.push_back(c);
  }
}

void add_furnaces(const Suite& suite, bool thorough, std::vector<Case>& cases) {
  const Json& sink = suite.find("FUR-01");
  Case c = new_case("FUR-01", "white room, black floor", suite.scene("FUR-01").value(), thorough ? 0.025 : 0.05, 0.004);
  c.readings.push_back(mean_over("floor", {"z0"}, sink["expected"]["mean_irradiance_floor"].get<double>(),
                                 sink["tolerance"]["rel"].get<double>()));
  cases.push_back(c);

  const Json& white = suite.find("FUR-03");
  QuadScene open;
  const auto all = open.material(DVec3(1));
  open.quad("floor", all, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  open.parts().box("block", all, Vec3(-0.6f, 0, -0.6f), Vec3(-0.1f, 0.5f, -0.1f));
  open.parts().sphere("sphere", all, Vec3(0.4f, 0.35f, 0.4f), 0.3f, 2);
  open.parts().scene().sky = Vec3(white["inputs"]["environment_radiance"].get<float>());
  c = new_case("FUR-03", "white objects under a white sky", open.finish(), 0.1, 0.0025);
  const double e = white["expected"]["irradiance"].get<double>();
  const double tolerance = e * white["tolerance"]["rel"].get<double>();
  for (const DVec2& p : {DVec2(0.8, 0.8), DVec2(0, 0.4), DVec2(0.4, -0.1), DVec2(-0.8, 0)})
    c.readings.push_back(at(fmt::format("floor at {}, {}", p.x, p.y), {{p.x, 0, p.y}, {0, 1, 0}, 1}, e, tolerance));
  c.readings.push_back(mean_over("sphere", {"sphere"}, e, tolerance));
  cases.push_back(c);

  const Json& grey = suite.find("FUR-04");
  for (std::size_t i = 0; i < grey["inputs"]["rho"].size(); ++i) {
    QuadScene box;
    const double rho = grey["inputs"]["rho"][i].get<double>();
    box.parts().box("box", box.material(DVec3(rho)), Vec3(-0.5f), Vec3(0.5f));
    box.parts().scene().sky = Vec3(grey["inputs"]["environment_radiance"].get<float>());
    c = new_case("FUR-04", fmt::format("rho {}", rho), box.finish(), 0.25, 0.001);
    const double b = grey["expected"]["B"][i].get<double>();
    Reading r = mean_over("worst point", {"box"}, b, b * grey["tolerance"]["rel"].get<double>());
    r.over = Over::kWorst;
    r.scale = rho;
    c.readings.push_back(r);
    cases.push_back(c);
  }

  const Json& corner = suite.find("FUR-05");
  QuadScene two;
  const auto half = two.material(DVec3(corner["inputs"]["rho"].get<double>()));
  two.quad("square1", half, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  two.quad("square2", half, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  two.parts().scene().sky = Vec3(corner["inputs"]["environment_radiance"].get<float>());
  c = new_case("FUR-05", "two squares in a corner", two.finish(), thorough ? 0.02 : 0.05, 0.002);
  const double mean = corner["expected"]["mean_irradiance"].get<double>();
  c.readings.push_back(
      mean_over("mean", {"square1", "square2"}, mean, mean * corner["tolerance"]["rel_mean"].get<double>()));
  for (std::size_t i = 0; i < corner["inputs"]["points"].size(); ++i) {
    const Json& p = corner["inputs"]["points"][i];
    const double at_point = corner["expected"]["point_irradiance"][i].get<double>();
    c.readings.push_back(at("point " + p.dump(), {from_case(vec(p)), DVec3(0, 1, 0), 1}, at_point,
                            at_point * corner["tolerance"]["rel_point"].get<double>()));
  }
  cases.push_back(c);
}

}  // namespace

std::vector<Case> enclosure_cases(const Suite& suite, bool thorough) {
  std::vector<Case> cases;
  add_uniform(suite, thorough, cases);
  add_boxes(suite, thorough, cases);
  add_sphere(suite, thorough, cases);
  add_plates(suite, thorough, cases);
  add_furnaces(suite, thorough, cases);
  for (Case& c : cases) c.rule = thorough ? 24 : 8;
  return cases;
}

}  // namespace oriel::validation
