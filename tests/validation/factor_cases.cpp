// View factors: with exitance 1 on the one surface, the mean illuminance on the other is the factor from it.
#include "tests/validation/suite.h"

namespace oriel::validation {
namespace {

constexpr int kSegments = 1024;  // of a disk

// F12 of two rectangles: mean over the first of light from the second.
Case rectangles(const std::string& label, const DVec3 first[3], const DVec3 second[3], double expected,
                double tolerance) {
  QuadScene scene;
  scene.quad("A1", scene.material(DVec3(0)), first[0], first[1], first[2]);
  scene.quad("A2", scene.material(DVec3(0), DVec3(1)), second[0], second[1], second[2]);
  Case c;
  c.label = label;
  c.scene = scene.finish();
  c.readings.push_back(mean_over("F12", {"A1"}, expected, tolerance));
  c.lux_error = 0.002;
  return c;
}

// A disk of the given radius around `center`, facing -z, with the area of the true disk.
void add_disk(QuadScene& scene, double radius, const DVec3& center) {
  const double step = 2 * kPiD / kSegments, reach = radius * std::sqrt(step / std::sin(step));
  std::vector<Vec3> positions{Vec3(from_case(center))};
  std::vector<UVec3> triangles;
  for (int i = 0; i < kSegments; ++i) {
    positions.push_back(Vec3(from_case(center + reach * DVec3(std::cos(i * step), std::sin(i * step), 0))));
    const auto k = static_cast<std::uint32_t>(i);
    triangles.emplace_back(0, (k + 1) % kSegments + 1, k + 1);
  }
  const std::vector<Vec3> normals(positions.size(), Vec3(from_case(DVec3(0, 0, -1))));
  scene.parts().mesh("disk", scene.material(DVec3(0), DVec3(1)), positions, normals, triangles);
}

// Readings at points of the plane z = 0 under a disk. They are on no surface, so a small one far off keeps the scene
// from being the disk alone.
Case under_disk(const std::string& label, double radius, double height) {
  QuadScene scene;
  add_disk(scene, radius, {0, 0, height});
  Case c;
  c.id = label;
  c.scene = scene.finish();
  c.lux_error = 0.0002;
  return c;
}

Probe upward(double x) {
  return {from_case(DVec3(x, 0, 0)), DVec3(0, 1, 0), 1};
}

void add_disks(const Suite& suite, std::vector<Case>& cases) {
  const Json& point = suite.find("VF-06");
  const double tolerance = point["tolerance"]["abs"].get<double>();
  for (std::size_t i = 0; i < point["inputs"]["point_disk"].size(); ++i) {
    const Json& in = point["inputs"]["point_disk"][i];
    Case c = under_disk("VF-06 point", in["R"].get<double>(), in["h"].get<double>());
    c.readings.push_back(at(fmt::format("R {} h {}", in["R"].dump(), in["h"].dump()), upward(0),
                            point["expected"]["F_point"][i].get<double>(), tolerance));
    cases.push_back(c);
  }
  for (std::size_t i = 0; i < point["inputs"]["disk_disk"].size(); ++i) {
    const Json& in = point["inputs"]["disk_disk"][i];
    Case c = under_disk("VF-06 disks", in["r2"].get<double>(), in["h"].get<double>());
    Reading r = at(fmt::format("r1 {} r2 {} h {}", in["r1"].dump(), in["r2"].dump(), in["h"].dump()), upward(0),
                   point["expected"]["F12_disks"][i].get<double>(), tolerance);
    r.probes.clear();  // the midpoint rule in r²: rings of one area
    constexpr int kRings = 256;
    for (int k = 0; k < kRings; ++k) {
      r.probes.push_back(upward(in["r1"].get<double>() * std::sqrt((k + 0.5) / kRings)));
      r.probes.back().weight = 1.0 / kRings;
    }
    c.lux_error = 0.001;
    c.readings.push_back(r);
    cases.push_back(c);
  }
  const Json& off = suite.find("VF-07");
  for (std::size_t i = 0; i < off["inputs"]["cases"].size(); ++i) {
    const Json& in = off["inputs"]["cases"][i];
    Case c = under_disk("VF-07", in["r"].get<double>(), in["h"].get<double>());
    c.readings.push_back(at(fmt::format("a {} r {} h {}", in["a"].dump(), in["r"].dump(), in["h"].dump()),
                            upward(in["a"].get<double>()), off["expected"]["F"][i].get<double>(),
                            off["tolerance"]["abs"].get<double>()));
    cases.push_back(c);
  }
}

void add_spheres(const Suite& suite, std::vector<Case>& cases) {
  const Json& j = suite.find("VF-08");
  for (std::size_t i = 0; i < j["inputs"]["cases"].size(); ++i) {
    const Json& in = j["inputs"]["cases"][i];
    const double angle = in["theta_deg"].get<double>() * kPiD / 180, d = in["d"].get<double>();
    QuadScene scene;
    scene.parts().sphere("sphere", scene.material(DVec3(0), DVec3(1)),
                         Vec3(from_case(d * DVec3(std::sin(angle), 0, std::cos(angle)))), in["R"].get<float>(), 5);
    Case c;
    c.id = "VF-08";
    c.scene = scene.finish();
    c.lux_error = 0.0002;
    c.readings.push_back(at(fmt::format("R {} d {} theta {}", in["R"].dump(), in["d"].dump(), in["theta_deg"].dump()),
                            upward(0), j["expected"]["F"][i].get<double>(), j["tolerance"]["abs"].get<double>()));
    cases.push_back(c);
  }
}

}  // namespace

std::vector<Case> factor_cases(const Suite& suite) {
  std::vector<Case> cases;
  const auto add = [&](const char* id, const auto& make) {
    const Json& j = suite.find(id);
    for (std::size_t i = 0; i < j["inputs"]["cases"].size(); ++i) {
      cases.push_back(
          make(j["inputs"]["cases"][i], j["expected"]["F12"][i].get<double>(), j["tolerance"]["abs"].get<double>()));
      cases.back().id = id;
    }
  };
  const auto opposed = [](const Json& in, double expected, double tolerance) {
    const double a = in["a"].get<double>(), b = in["b"].get<double>(), c = in["c"].get<double>();
    const DVec3 first[] = {{0, 0, 0}, {a, 0, 0}, {0, b, 0}}, second[] = {{0, 0, c}, {0, b, 0}, {a, 0, 0}};
    return rectangles(fmt::format("opposed {} x {}, distance {}", a, b, c), first, second, expected, tolerance);
  };
  add("VF-01", opposed);
  add("VF-02", [](const Json& in, double expected, double tolerance) {
    const double w = in["w"].get<double>(), h = in["h"].get<double>(), l = in["l"].get<double>();
    const DVec3 first[] = {{0, 0, 0}, {w, 0, 0}, {0, l, 0}}, second[] = {{0, 0, 0}, {0, l, 0}, {0, 0, h}};
    return rectangles(fmt::format("perpendicular, w {} h {} l {}", w, h, l), first, second, expected, tolerance);
  });
  add("VF-03", opposed);
  add_disks(suite, cases);
  add_spheres(suite, cases);
  return cases;
}

}  // namespace oriel::validation
