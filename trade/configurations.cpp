#include "trade/configurations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace oriel::trade {
namespace {

using Texts = std::vector<std::string>;

class Planner {
 public:
  Planner(const SceneFacts& facts, double texel_m, bool quick) : facts_(facts), texel_m_(texel_m), quick_(quick) {
    default_.knob = "default";
    default_.bake = {{"--error", "2%"}, {"--texel", length_text(texel_m)}};
  }

  TradePlan plan() {
    TradePlan out;
    out.reference = {{"--estimator", "reference"},
                     {"--samples", std::to_string(reference_samples())},
                     {"--only", facts_.movers ? "radiosity,transfer" : "radiosity"}};
    out.reference_paths = quick_ ? 256 : 1024;
    out.width = quick_ ? 240 : 360;
    out.height = quick_ ? 160 : 240;
    configurations_.push_back(default_);
    light();
    reflections();
    movers();
    no_bake();
    paths();
    out.configurations = std::move(configurations_);
    out.skipped = std::move(skipped_);
    return out;
  }

 private:
  // Paths from each texel of a reference: so many in all that it takes about a minute of one core (quick), or ten;
  // small scenes get a better one.
  unsigned reference_samples() const {
    const double paths = quick_ ? 32e6 : 320e6, texels = facts_.area_m2 / (texel_m_ * texel_m_);
    const double wanted = std::clamp(paths / std::max(texels, 1.0), 512.0, 16384.0);
    return 1u << static_cast<unsigned>(std::lround(std::log2(wanted)));
  }

  Texts either(Texts few, Texts many) const { return quick_ ? std::move(few) : std::move(many); }

  void add(const std::string& knob, const std::string& setting, const Settings& bake, const Settings& play) {
    Configuration c = default_;
    c.knob = knob;
    c.setting = setting;
    for (const auto& [option, value] : bake) c.bake[option] = value;
    if (c.bake.contains("--samples")) c.bake.erase("--error");
    c.play = play;
    configurations_.push_back(std::move(c));
  }

  void skip(const std::string& knobs, const std::string& why) { skipped_.push_back(knobs + ": " + why); }

  void light() {
    for (const std::string& error : either({"10", "5"}, {"10", "5", "1"}))
      add("error", error + " %", {{"--error", error + "%"}}, {});
    for (const std::string& samples : either({"64"}, {"16", "64", "256"}))
      add("reference estimator", samples + " paths", {{"--estimator", "reference"}, {"--samples", samples}}, {});
    for (const double factor : quick_ ? std::vector<double>{2} : std::vector<double>{2, 0.5}) {
      const std::string texel = length_text(factor * texel_m_);
      add("texel", texel, {{"--texel", texel}}, {});
    }
  }

  void reflections() {
    if (!facts_.planar && !facts_.curved) {
      skip("views, map resolution, reflections, maps, blur",
           "no reflector that people can see, so there is nothing that they change");
      return;
    }
    planar();
    glossy();
    for (const std::string& size : either({"128"}, {"64", "128", "256"}))
      add("map resolution", size, {{"--map-resolution", size}}, {});
    add("reflections", "off", {}, {{"--reflections", "off"}});
  }

  void planar() {
    if (!facts_.planar) {
      skip("views, reflections geometry, maps", "no planar reflector");
      return;
    }
    const Settings maps_baked{{"--reflections", "maps"}};
    add("reflections", "maps", maps_baked, {});
    add("reflections", "geometry", {{"--reflections", "geometry"}}, {});
    for (const std::string& views : either({"2"}, {"1", "2", "4"})) add("views", views, {{"--views", views}}, {});
    for (const std::string& maps : either({"1"}, {"1", "4", "8"})) add("maps", maps, maps_baked, {{"--maps", maps}});
  }

  void glossy() {
    if (!facts_.glossy) {
      skip("blur", "no glossy reflector: every one is a mirror");
      return;
    }
    add("blur", "off", {}, {{"--blur", "off"}});
  }

  void movers() {
    if (!facts_.movers) {
      skip("sh bands, mover lights, shade", "nothing moves");
      return;
    }
    for (const std::string& bands : either({"3"}, {"2", "3", "4"})) add("sh bands", bands, {{"--sh-bands", bands}}, {});
    add("mover lights", "harmonics", {}, {{"--mover-lights", "harmonics"}});
    if (!quick_) add("mover lights", "unshadowed", {}, {{"--mover-lights", "unshadowed"}});
    for (const std::string& lights : either({"0"}, {"0", "32", "512"})) add("shade", lights, {}, {{"--shade", lights}});
  }

  void no_bake() {
    for (const unsigned passes : {1u, 16u}) {
      Configuration c;
      c.knob = "no bake";
      c.setting = fmt::format("{} pass{}", passes, passes == 1 ? "" : "es");
      c.preview = {{"--passes", std::to_string(passes)}};
      configurations_.push_back(std::move(c));
    }
  }

  void paths() {
    for (const unsigned samples : quick_ ? std::vector<unsigned>{4, 16} : std::vector<unsigned>{1, 4, 16, 64}) {
      Configuration c;
      c.knob = "reference paths";
      c.setting = fmt::format("{} a pixel", samples);
      c.paths = samples;
      configurations_.push_back(std::move(c));
    }
  }

  const SceneFacts& facts_;
  const double texel_m_;
  const bool quick_;
  Configuration default_;
  std::vector<Configuration> configurations_;
  std::vector<std::string> skipped_;
};

}  // namespace

TradePlan plan_trade(const SceneFacts& facts, double texel_m, bool quick) {
  return Planner(facts, quick ? 2 * texel_m : texel_m, quick).plan();
}

std::string length_text(double metres) {
  return metres >= 0.01 ? fmt::format("{:.4g}cm", 100 * metres) : fmt::format("{:.4g}mm", 1000 * metres);
}

}  // namespace oriel::trade
