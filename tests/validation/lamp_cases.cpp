// CIE 171:2006, lamps: 5.2 to 5.8.
#include "tests/validation/suite.h"

namespace oriel::validation {
namespace {

double published(const Json& table, const std::string& key) {
  return table.contains(key) ? table[key].get<double>() : std::numeric_limits<double>::quiet_NaN();
}

// Readings at named points, with the printed table beside them.
void add_named(const Json& j, const char* quantity, double scale, Case& c) {
  const Json& exact = j["expected"][quantity];
  const Json none = Json::object(),
             &table = j["expected"].contains("published_table") ? j["expected"]["published_table"] : none;
  for (const auto& [name, p] : j["inputs"]["points"].items()) {
    const double e = exact[name].get<double>();
    const Probe where = p.is_array() ? Probe{from_case(vec(p)), DVec3(0, 1, 0), 1} : probe(p["p"], p["n"]);
    Reading r = at(name, where, e, e * j["tolerance"]["rel"].get<double>());
    r.scale = scale;
    r.published = published(table, name);
    c.readings.push_back(r);
  }
}

// 5.2: a source of 1000 cd · cos θ three metres above the plane, as a square of 1 cm that looks down.
Case lambertian_source(const Suite& suite) {
  const Json& j = suite.find("CIE-5.2-a");
  constexpr double kSide = 0.01;
  QuadScene scene;
  scene.quad("lamp", scene.material(DVec3(0), DVec3(kPiD * 1000 / (kSide * kSide))), {-kSide / 2, -kSide / 2, 3},
             {0, kSide, 0}, {kSide, 0, 0});
  scene.quad("floor", scene.material(DVec3(0)), {-1, -1, 0}, {4, 0, 0}, {0, 4, 0});
  Case c;
  c.id = "CIE-5.2-a";
  c.scene = scene.finish();
  c.lux_error = 2e-5;
  add_named(j, "E_lux", 1, c);
  return c;
}

Case tilted_receivers(const Suite& suite) {
  const Json& j = suite.find("CIE-5.2-b");
  Case c;
  c.id = "CIE-5.2-b";
  c.scene = suite.scene("CIE-5.2-b").value();
  c.lux_error = 1e-5;
  for (std::size_t i = 0; i < j["inputs"]["receivers"].size(); ++i) {
    const Json& r = j["inputs"]["receivers"][i];
    const double e = j["expected"]["E_lux"][i].get<double>();
    c.readings.push_back(at(r["p"].dump(), probe(r["p"], r["n"]), e,
                            std::max(j["tolerance"]["abs"].get<double>(), e * j["tolerance"]["rel"].get<double>())));
  }
  return c;
}

// 5.3: a lamp flush in the ceiling of a black room.
Case ceiling_lamp(const Suite& suite) {
  const Json& j = suite.find("CIE-5.3-a");
  const DVec3 size = vec(j["inputs"]["room"]);
  const Json& corners = j["inputs"]["light"]["corners"];
  const DVec3 low = vec(corners[0]), high = vec(corners[2]);
  QuadScene scene;
  const auto black = scene.material(DVec3(0));
  scene.room(size, std::vector<std::uint32_t>(6, black), "z1");
  scene.quad_with_hole("z1", black, {0, 0, size.z}, {0, size.y, 0}, {size.x, 0, 0}, DVec2(low.y, low.x) / 4.0,
                       DVec2(high.y, high.x) / 4.0);
  scene.quad("light", scene.material(DVec3(0), DVec3(j["inputs"]["light"]["exitance_lm_m2"].get<double>())), low,
             {0, high.y - low.y, 0}, {high.x - low.x, 0, 0});
  Case c;
  c.id = "CIE-5.3-a";
  c.scene = scene.finish();
  c.texel_m = 0.0125;
  c.lux_error = 0.0005;
  add_named(j, "E_lux", 1, c);
  return c;
}

// 5.4: all flux of a lamp arrives. In lumens.
Case flux(const Suite& suite, const std::string& id) {
  const Json& j = suite.find(id);
  const DVec3 size = vec(j["inputs"]["room"]);
  Case c;
  c.id = id;
  c.scene = suite.scene(id).value();
  c.texel_m = 0.1;
  c.lux_error = 0.001;
  c.rule = 32;  // one lamp hangs 0.4 m under the ceiling
  std::vector<std::string> faces;
  for (const auto& [face, lm] : j["expected"]["flux_per_face_lm"].items()) {
    faces.push_back(face);
    const double e = lm.get<double>();
    Reading r = mean_over("lm on " + face, {face}, e, e * j["tolerance"]["rel_face"].get<double>());
    r.scale = face[0] == 'x' ? size.y * size.z : face[0] == 'y' ? size.x * size.z : size.x * size.y;
    c.readings.push_back(r);
  }
  const double total = j["expected"]["total_flux_lm"].get<double>();
  Reading r = mean_over("lm in total", faces, total, total * j["tolerance"]["rel_total"].get<double>());
  r.scale = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
  c.readings.push_back(r);
  return c;
}

// 5.6: light from a diffuse surface, in percent of its own. The suite's second scene also holds the upright receiver,
// which hides half of the endless ground from the level points: there the ground stands alone.
Case reflection(const Suite& suite, const std::string& id) {
  const Json& j = suite.find(id);
  Case c;
  c.id = id;
  if (id == "CIE-5.6-a") {
    c.scene = suite.scene(id).value();
    c.texel_m = 0.05;
  } else {
    const DVec3 low = vec(j["inputs"]["S2"]["corners"][0]), high = vec(j["inputs"]["S2"]["corners"][2]);
    QuadScene ground;
    ground.quad("S2", ground.material(DVec3(0), DVec3(1)), low, {high.x - low.x, 0, 0}, {0, high.y - low.y, 0});
    c.scene = ground.finish();
  }
  c.lux_error = 0.0005;
  add_named(j, "E_over_Ehz_rho_percent", 100, c);
  return c;
}

// 5.8: interreflection in a closed cube.
void add_interreflection(const Suite& suite, std::vector<Case>& cases) {
  const Json& j = suite.find("CIE-5.8-a");
  for (const Json& reflectance : j["inputs"]["reflectances"]) {
    const std::string rho = reflectance.dump();
    Case c;
    c.id = "CIE-5.8-a";
    c.label = "rho " + rho;
    if (auto scene = suite.scene("CIE-5.8-a_rho" + rho)) {
      c.scene = std::move(*scene);
    } else {
      QuadScene room;
      room.room(vec(j["inputs"]["room"]),
                std::vector<std::uint32_t>(6, room.material(DVec3(reflectance.get<double>()))));
      room.point_light(vec(j["inputs"]["source"]["position"]), j["inputs"]["source"]["flux_lm"].get<double>());
      c.scene = room.finish();
    }
    c.texel_m = 0.4;
    c.lux_error = 0.003;
    c.rule = 6;
    const std::vector<std::string> faces{"x0", "x1", "y0", "y1", "z0", "z1"};
    for (const auto& [quantity, part] :
         {std::pair{"mean_E_indirect_lux", Part::kIndirect}, {"mean_E_total_lux", Part::kTotal}}) {
      const double e = j["expected"][quantity][rho].get<double>();
      Reading r =
          mean_over(part == Part::kTotal ? "total" : "indirect", faces, e, e * j["tolerance"]["rel"].get<double>());
      r.part = part;
      if (part == Part::kIndirect) r.published = published(j["expected"]["published_table"], rho);
      c.readings.push_back(r);
    }
    cases.push_back(c);
  }
}

}  // namespace

std::vector<Case> lamp_cases(const Suite& suite) {
  std::vector<Case> cases{lambertian_source(suite),      tilted_receivers(suite),  ceiling_lamp(suite),
                          flux(suite, "CIE-5.4-a"),      flux(suite, "CIE-5.4-b"), reflection(suite, "CIE-5.6-a"),
                          reflection(suite, "CIE-5.6-c")};
  add_interreflection(suite, cases);
  return cases;
}

}  // namespace oriel::validation
