#include "player/output/frame_record.h"

#include <algorithm>

#include "formats/core/color.h"
#include "formats/core/file.h"
#include "formats/core/json.h"

namespace oriel {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

Json as_json(const FrameRecord& record) {
  const FrameStats& s = record.stats;
  Json passes;
  for (std::size_t i = 0; i < kPassNames.size(); ++i) passes[kPassNames[i]] = s.ms[i];
  return {{"camera", record.camera},
          {"ms", record.ms},
          {"live_s", record.live_s},
          {"pass_ms", passes},
          {"draws", s.draws},
          {"triangles", s.triangles},
          {"groups_seen", s.groups_seen},
          {"groups", s.groups},
          {"reflectors", s.reflectors},
          {"glass", s.glass},
          {"mirrored_glass", s.mirrored_glass},
          {"maps", s.maps},
          {"image_pixels", s.image_pixels},
          {"map_bytes", s.map_bytes},
          {"image_bytes", s.image_bytes},
          {"most_image_bytes", s.most_image_bytes},
          {"coarser_images", s.coarser_images},
          {"missing_images", s.missing_images},
          {"reflected_pixels", s.reflected_pixels},
          {"holes", s.holes},
          {"mirror_pixels", s.mirror_pixels},
          {"shade",
           {{"lights", s.shade.lights},
            {"prepare_s", s.shade.prepare_s},
            {"cells", s.shade.cells},
            {"pairs", s.shade.pairs},
            {"maps", s.shade.maps},
            {"faces", s.shade.faces},
            {"cells_ms", s.shade.cells_ms},
            {"maps_ms", s.shade.maps_ms},
            {"light_ms", s.shade.light_ms}}},
          {"in_zone", record.in_zone}};
}

}  // namespace

std::string describe(const FrameStats& stats, bool in_zone) {
  std::string text =
      fmt::format("{} draws, {} triangles, {} reflectors, {} maps, {:.1f} MB of maps", stats.draws, stats.triangles,
                  stats.reflectors, stats.maps, static_cast<double>(stats.map_bytes) * 1e-6);
  if (stats.coarser_images + stats.missing_images > 0)
    text += fmt::format(", {:.1f} MB of images, {} coarser, {} left out", static_cast<double>(stats.image_bytes) * 1e-6,
                        stats.coarser_images, stats.missing_images);
  if (stats.glass + stats.mirrored_glass > 0)
    text += fmt::format(", {} bodies of glass, {} in reflectors", stats.glass, stats.mirrored_glass);
  if (stats.groups > 0) text += fmt::format(", {} of {} groups may be seen", stats.groups_seen, stats.groups);
  if (const ShadeStats& shade = stats.shade; shade.lights > 0) {
    text += fmt::format(", shade of movers in {} lights, made in {:.1f} s", shade.lights, shade.prepare_s);
    if (shade.cells > 0) text += fmt::format(", over {} cells", shade.cells);
  }
  for (std::size_t i = 0; i < kPassNames.size(); ++i)
    if (stats.ms[i] > 0) text += fmt::format(", {} {:.1f} ms", kPassNames[i], stats.ms[i]);
  return text + (in_zone ? "" : ", outside the zone that reflections were planned for");
}

FrameRecord median_record(const std::vector<FrameRecord>& records) {
  FrameRecord out = records.back();
  const auto middle = [&](const auto& value) {
    std::vector<double> values;
    for (const FrameRecord& record : records) values.push_back(value(record));
    return median(std::move(values));
  };
  out.ms = middle([](const FrameRecord& r) { return r.ms; });
  for (std::size_t i = 0; i < kPassNames.size(); ++i)
    out.stats.ms[i] = middle([i](const FrameRecord& r) { return r.stats.ms[i]; });
  return out;
}

void FlickerMeter::add(const std::vector<float>& light) {
  std::vector<float> log2_light(light.size() / 3);
  double mean = 0;
  for (std::size_t i = 0; i < log2_light.size(); ++i) {
    log2_light[i] = luminance(Vec3(light[3 * i], light[3 * i + 1], light[3 * i + 2]));
    mean += log2_light[i];
  }
  const double floor = std::max(0.01 * mean / static_cast<double>(std::max<std::size_t>(log2_light.size(), 1)), 1e-9);
  for (float& v : log2_light) v = std::log2(v + static_cast<float>(floor));
  if (++added_ > 2 && last_.size() == log2_light.size() && before_last_.size() == last_.size()) {
    double sum = 0;
    for (std::size_t i = 0; i < last_.size(); ++i)
      sum += std::fabs(double{before_last_[i]} - 2.0 * last_[i] + log2_light[i]);
    sum /= static_cast<double>(std::max<std::size_t>(last_.size(), 1));
    sum_ += sum;
    ++frames_;
    if (sum > worst_) {
      worst_ = sum;
      worst_frame_ = added_ - 2;
    }
  }
  before_last_ = std::exchange(last_, std::move(log2_light));
}

Status write_stats(const std::string& file, const PlayArguments& arguments, const std::string& renderer,
                   const std::vector<FrameRecord>& records, const FlickerMeter* flicker) {
  Json out{{"pack", arguments.pack},
           {"renderer", renderer},
           {"width", arguments.width},
           {"height", arguments.height},
           {"options", options_json(arguments)},
           {"frames", Json::array()}};
  for (const FrameRecord& record : records) out["frames"].push_back(as_json(record));
  if (!records.empty()) out["median"] = as_json(median_record(records));
  if (flicker != nullptr) {
    out["flicker"] = {{"mean", flicker->mean()}, {"worst", flicker->worst()}, {"worst_frame", flicker->worst_frame()}};
  }
  const std::string text = out.dump(1) + "\n";
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  return write_file_atomically(file, Bytes(bytes, bytes + text.size()));
}

}  // namespace oriel
