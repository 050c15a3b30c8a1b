#include "player/app/offscreen.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>

#include "formats/query/triangle_hit.h"
#include "player/app/panorama_shot.h"
#include "player/app/shots.h"
#include "player/app/stop.h"
#include "player/gpu/headless.h"
#include "player/navigation/lamps.h"
#include "player/navigation/poses.h"
#include "player/navigation/zone.h"
#include "player/output/exposed.h"
#include "player/output/frame_record.h"
#include "player/output/other.h"
#include "player/output/picture.h"
#include "player/output/video.h"
#include "player/passes/frame.h"
#include "player/scene/live_lamps.h"
#include "player/session/session.h"
#include "player/window/paced_frame.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

class Studio {
 public:
  // other: what it is shown beside, or null.
  Studio(GpuScene& scene, Renderer& renderer, const PlayArguments& arguments, Other* other)
      : scene_(scene),
        renderer_(renderer),
        arguments_(arguments),
        other_(other),
        options_(arguments.frame),
        zone_(planned_zone(scene.pack())) {
    options_.timed = !arguments.stats.empty();
    options_.samples = samples_of_picture(arguments);
    if (arguments.quality == Quality::kFast) {
      options_ = coarse_options(options_);
      scene.make_fewer();
    }
    session_.shown_ev100 = arguments.ev100.value_or(0.0f);
  }

  // What takes seconds is told before: lamps' light from where they were moved to, which the first frame follows.
  Status foretell() const {
    ORIEL_TRY(const std::vector<MoverPose> lamps, lamps_at(scene_.pack(), arguments_.moves, arguments_.time_s));
    for (std::size_t g = 0; g < lamps.size(); ++g) {
      const bool shines = g >= options_.lights.size() || options_.lights[g] != Vec3(0);
      if (shines && !is_rest(lamps[g]))
        fmt::print(stderr, "lamp \"{}\": following the light of {} lights that stand for it (--live-lights)\n",
                   scene_.pack().light_groups[g].name, options_.live.lights.lights);
    }
    return {};
  }

  // Draws it `times` times; the record is the median's.
  Result<FrameRecord> draw(const Shot& shot, int times) {
    ORIEL_TRY_VOID(place(shot.time_s));
    const View view = make_view(shot.camera, size().x, size().y, bounds_with_movers(scene_, options_.poses));
    std::vector<FrameRecord> records;
    for (int i = 0; i < times; ++i) {
      if (stop_requested()) return fail(ErrorCode::kStopped, "", "stopped by the user");
      const auto start = std::chrono::steady_clock::now();
      ORIEL_TRY(const FrameStats stats, renderer_.render(scene_, view, options_));
      glFinish();
      const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
      records.push_back({shot.name, took.count(), stats, zone_.holds(shot.camera.eye)});
    }
    FrameRecord record = median_record(records);
    record.live_s = tell_of_lamps();
    if (!arguments_.stats.empty()) ORIEL_TRY_VOID(count_holes(view, record.stats));
    return record;
  }

  // The mean of the frames of a lens that is open for a while; the record is the last one's, with the time of all.
  Result<FrameRecord> draw_exposed(const Shot& shot) {
    const LensSettings& lens = arguments_.lens;
    const float focus_m = lens.focus_m > 0 || lens.aperture_m <= 0 ? lens.focus_m : distance_ahead(shot.camera);
    const auto n = static_cast<std::uint32_t>(lens.frames);
    const auto start = std::chrono::steady_clock::now();
    FrameStats stats;
    FrameMean mean;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (stop_requested()) return fail(ErrorCode::kStopped, "", "stopped by the user");
      const ExposurePoint at = exposure_point(i, n);
      const float time_s = shot.time_s + at.time * lens.shutter_s;
      ORIEL_TRY_VOID(place(time_s));
      options_.look = i;
      const Camera camera = shot.camera_at && lens.shutter_s > 0 ? shot.camera_at(time_s) : shot.camera;
      const View view = lens_view(camera, size(), bounds_with_movers(scene_, options_.poses),
                                  {0.5f * lens.aperture_m * at.lens, focus_m, at.pixel});
      ORIEL_TRY(stats, renderer_.render(scene_, view, options_));
      mean.add(renderer_.read_frame());
    }
    options_.look = 0;
    ORIEL_TRY_VOID(renderer_.take_light(mean.mean()));
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    return FrameRecord{shot.name, took.count(), stats, zone_.holds(shot.camera.eye), tell_of_lamps()};
  }

  // In a frame of its own: it reads images back.
  Status count_holes(const View& view, FrameStats& stats) {
    FrameOptions counting = options_;
    counting.count_holes = true;
    ORIEL_TRY(const FrameStats counted, renderer_.render(scene_, view, counting));
    stats.reflected_pixels = counted.reflected_pixels;
    stats.holes = counted.holes;
    stats.mirror_pixels = counted.mirror_pixels;
    return {};
  }

  // The exposure of the frame that was drawn last. Along a path it follows the light as eyes do.
  Result<float> expose(const Shot& shot) {
    if (!arguments_.ev100) {
      ORIEL_TRY(const std::optional<float> metered, renderer_.meter());
      if (!std::isfinite(shot.since_last_s)) session_.metered = false;  // a picture of its own
      adapt_exposure(metered, shot.since_last_s, session_);
    }
    return session_.shown_ev100;
  }

  // Into its file, if it has one, and as the next frame of a film.
  Status keep(const Shot& shot, VideoWriter* film) {
    if (shot.file.empty() && film == nullptr) return {};
    ORIEL_TRY(const float ev100, expose(shot));
    const PictureNotes notes{shot.camera, scene_.pack().mesh.origin, shot.name, ev100, arguments_.curve};
    if (other_ != nullptr)
      ORIEL_TRY_VOID(
          other_->draw({shot.camera, scene_.pack().mesh.origin, renderer_.frame_size().x, renderer_.frame_size().y,
                        options_, arguments_.moves, arguments_.time_s + shot.time_s}));
    if (!shot.file.empty()) ORIEL_TRY_VOID(write(shot.file, notes));
    if (film == nullptr) return {};
    ORIEL_TRY(ByteImage frame, as_shown(notes));
    return film->add(std::move(frame));
  }

  void tell(const Shot& shot, const FrameRecord& record) const {
    fmt::print(stderr, "{}: {}x{} in {:.1f} ms, EV {:.2f}, {} ({})\n", shot.file.empty() ? "frame" : shot.file,
               arguments_.width, arguments_.height, record.ms, session_.shown_ev100,
               describe(record.stats, record.in_zone), shot.name);
  }

 private:
  // Seconds that their light took.
  double tell_of_lamps() const {
    double seconds = 0;
    for (const LiveReport& report : scene_.take_live_reports()) {
      fmt::print(stderr, "{}\n", text_of(report));
      seconds += report.seconds;
    }
    return seconds;
  }

  IVec2 size() const { return arguments_.supersample * IVec2(arguments_.width, arguments_.height); }

  // Movers and lamps, so long into a path.
  Status place(float time_s) {
    ORIEL_TRY(options_.poses, poses_at(scene_.pack(), arguments_.moves, arguments_.time_s + time_s));
    ORIEL_TRY(options_.lamps, lamps_at(scene_.pack(), arguments_.moves, arguments_.time_s + time_s));
    return {};
  }

  // Along the view, to what is in the middle of the picture; the scene's size where nothing is.
  float distance_ahead(const Camera& camera) const {
    const auto found = first_triangle(scene_.pack().mesh, camera.eye, glm::normalize(camera.forward));
    return found ? found->distance : glm::distance(scene_.bounds().lower, scene_.bounds().upper);
  }

  Status write(const fs::path& file, const PictureNotes& notes) {
    const auto n = static_cast<std::uint32_t>(arguments_.supersample);
    if (other_ != nullptr) return other_->write_beside(renderer_, arguments_.divider, file.string(), notes, n);
    return write_picture(renderer_, file.string(), notes, n);
  }

  Result<ByteImage> as_shown(const PictureNotes& notes) {
    const auto n = static_cast<std::uint32_t>(arguments_.supersample);
    if (other_ != nullptr) return other_->shown_beside(renderer_, arguments_.divider, notes, n);
    return shown_picture(renderer_, notes, n);
  }

  GpuScene& scene_;
  Renderer& renderer_;
  const PlayArguments& arguments_;
  Other* other_;
  FrameOptions options_;
  Session session_;  // for its exposure
  const Zone zone_;
};

// How far a long work is: a line on a terminal that changes, elsewhere one for each tenth.
class Progress {
 public:
  explicit Progress(std::size_t total) : total_(total) {}
  void step() {
    ++done_;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double rate = static_cast<double>(done_) / std::max(seconds, 1e-9);
    const std::size_t tenths = 10 * done_ / total_;
    if (!terminal_ && tenths == 10 * (done_ - 1) / total_) return;
    fmt::print(stderr, "{}[{:#<{}}{:.<{}}] {}/{}, {:.1f} frames/s, {:.0f} s left{}", terminal_ ? "\r" : "", "",
               2 * tenths, "", 2 * (10 - tenths), done_, total_, rate, static_cast<double>(total_ - done_) / rate,
               terminal_ && done_ < total_ ? "  " : "\n");
  }

 private:
  const std::size_t total_;
  const bool terminal_ = ::isatty(STDERR_FILENO) != 0;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::size_t done_ = 0;
};

// A film's frames become pictures in a folder where nothing can encode them.
PlayArguments without_film(PlayArguments arguments) {
  const fs::path film = std::exchange(arguments.video, {});
  arguments.output = (film.parent_path() / (film.stem().string() + "-frames")).string();
  fmt::print(stderr,
             "oriel-play: ffmpeg is not installed: the frames go to {0}. It makes the film of them: "
             "ffmpeg -framerate {1} -i {0}/%04d.png -pix_fmt yuv420p {2}\n",
             arguments.output, arguments.fps, film.string());
  return arguments;
}

// Draws all shots in order; their records.
Result<std::vector<FrameRecord>> draw_shots(const std::vector<Shot>& shots, const PlayArguments& arguments,
                                            Studio& studio) {
  std::vector<FrameRecord> records;
  for (const Shot& shot : shots) {
    ORIEL_TRY(FrameRecord record,
              arguments.lens.frames > 1 ? studio.draw_exposed(shot) : studio.draw(shot, std::max(arguments.frames, 1)));
    ORIEL_TRY_VOID(studio.keep(shot, nullptr));
    studio.tell(shot, record);
    records.push_back(std::move(record));
  }
  return records;
}

Result<std::vector<FrameRecord>> draw_path(const std::vector<Shot>& shots, const PlayArguments& arguments,
                                           Studio& studio, const Renderer& renderer, FlickerMeter& flicker) {
  std::unique_ptr<VideoWriter> film;
  if (!arguments.video.empty()) {
    ORIEL_TRY(film, VideoWriter::create(arguments.video, arguments.width, arguments.height, arguments.fps));
  }
  std::vector<FrameRecord> records;
  Progress progress(shots.size());
  for (const Shot& shot : shots) {
    ORIEL_TRY(FrameRecord record, arguments.lens.frames > 1 ? studio.draw_exposed(shot) : studio.draw(shot, 1));
    ORIEL_TRY_VOID(studio.keep(shot, film.get()));
    flicker.add(renderer.read_light());
    records.push_back(std::move(record));
    progress.step();
  }
  if (film) ORIEL_TRY_VOID(film->finish());
  fmt::print("{}: {} frames, median {:.1f} ms, flicker {:.4f}, worst {:.4f} at frame {}\n", arguments.path,
             records.size(), median_record(records).ms, flicker.mean(), flicker.worst(), flicker.worst_frame());
  return records;
}

}  // namespace

Status play_offscreen(DeferredPack pack, const PlayArguments& asked) {
  const PlayArguments arguments = !asked.video.empty() && !has_ffmpeg() ? without_film(asked) : asked;
  ORIEL_TRY(const auto context, gpu::HeadlessContext::create());
  ORIEL_TRY(const gpu::Device device, gpu::open_device());
  ORIEL_TRY(const auto scene, GpuScene::create(std::move(pack), device, {false, arguments.gpu_memory}));
  const bool along_path = !arguments.path.empty();
  ORIEL_TRY(auto shots, along_path ? path_shots(*scene, arguments) : choose_shots(*scene, arguments));
  ORIEL_TRY(const auto renderer, Renderer::create(device));
  if (arguments.panorama) return draw_panoramas(shots, arguments, *scene, *renderer);
  std::unique_ptr<Other> other;
  if (!arguments.other.empty()) {
    ORIEL_TRY(other, Other::open(arguments.other, device, {false, arguments.gpu_memory}));
    // A picture is seen from where it was taken.
    const auto taken = other->camera(scene->pack().mesh.origin);
    if (taken && arguments.cameras.empty() && !along_path) shots.front() = {taken->name, *taken, shots.front().file};
  }
  Studio studio(*scene, *renderer, arguments, other.get());
  ORIEL_TRY_VOID(studio.foretell());
  FlickerMeter flicker;
  ORIEL_TRY(const auto records, along_path ? draw_path(shots, arguments, studio, *renderer, flicker)
                                           : draw_shots(shots, arguments, studio));
  if (arguments.stats.empty()) return {};
  return write_stats(arguments.stats, arguments, device.renderer, records, along_path ? &flicker : nullptr);
}

}  // namespace oriel
