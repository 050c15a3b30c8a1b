#include "trade/sweep.h"

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/image/comparison.h"
#include "formats/pack/reader.h"
#include "trade/frames.h"
#include "trade/front.h"
#include "trade/process.h"

namespace oriel::trade {
namespace {
namespace fs = std::filesystem;

constexpr int kFrameWidth = 720, kFrameHeight = 480;  // of frames that are timed
constexpr int kTimes = 3;                             // that each is drawn; the median counts
constexpr int kSupersampling = 2;                     // player's pixels on each axis of a reference's

using Arguments = std::vector<std::string>;

void append(Arguments& to, const Settings& settings) {
  for (const auto& [option, value] : settings) to.insert(to.end(), {option, value});
}

Result<std::string> read_text(const fs::path& file) {
  ORIEL_TRY(const Bytes bytes, read_file(file));
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

// Seconds of the last stage that a log of --json-log tells of: the tracing, without the program's start.
Result<double> traced_seconds(const fs::path& log) {
  ORIEL_TRY(const std::string text, read_text(log));
  double seconds = -1;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const auto line = Json::parse(text.substr(at, end - at)).value_or(Json());
    if (line.is_object() && line.value("event", "") == "progress") seconds = line.value("seconds", seconds);
    at = end + 1;
  }
  if (seconds < 0) return invalid(log.string(), "found no progress line of oriel-bake render");
  return seconds;
}

class Sweep {
 public:
  Sweep(const TradeOptions& options, const Store& store, Units& units, Context& context, bool player)
      : o_(options), store_(store), units_(units), context_(context) {
    trade_.scene = options.scene.filename().string();
    trade_.width = kFrameWidth;
    trade_.height = kFrameHeight;
    trade_.frames = player;
  }

  Result<Trade> run() {
    ORIEL_TRY_VOID(survey_scene());
    units_.count(true);
    ORIEL_TRY_VOID(measure_all());
    units_.count(false);
    trade_.rows.clear();
    ORIEL_TRY_VOID(measure_all());
    std::erase_if(trade_.rows, [](const Row& row) { return row.measures.empty() && row.failure.empty(); });
    mark_fronts();
    trade_.started = units_.started();
    trade_.reused = units_.reused();
    trade_.left = units_.left();
    return std::move(trade_);
  }

 private:
  std::string bake_program() const { return (o_.programs / "oriel-bake").string(); }
  std::string play_program() const { return (o_.programs / "oriel-play").string(); }
  std::string preview_program() const { return (o_.programs / "oriel-preview").string(); }
  fs::path log(const std::string& key) const { return store_.file(key, ".log"); }
  fs::path pack(const std::string& key) const { return store_.file(key, ".oriel"); }
  fs::path picture(const std::string& key, std::size_t camera) const {
    return store_.file(key, fmt::format("-{}.png", camera));
  }

  // A first bake, as quick as can be, tells what the scene has.
  Status survey_scene() {
    constexpr std::size_t kQuickCameras = 2, kCameras = 4;
    const Settings settings{
        {"--texel", "50cm"}, {"--samples", "16"}, {"--views", "1"}, {"--map-resolution", "16"}, {"--sh-bands", "2"}};
    const std::string key = bake_key(settings, o_.seed, "");
    ORIEL_TRY(const Measures known,
              units_.once("survey", "what the scene has", key, [&] { return bake(key, settings, o_.seed, ""); }));
    if (!known.bake) return fail(ErrorCode::kStopped, "", "stopped by the user");
    ORIEL_TRY(const Pack found, read_pack(pack(key)));
    trade_.facts = survey(found, o_.quick ? kQuickCameras : kCameras);
    if (!o_.cameras.empty()) trade_.facts.cameras = o_.cameras;
    const double texel = o_.texel_m > 0 ? o_.texel_m : fitting_texel_m(trade_.facts.diagonal_m);
    trade_.plan = plan_trade(trade_.facts, texel, o_.quick);
    return {};
  }

  Status measure_all() {
    references_.clear();
    for (const std::string& camera : trade_.facts.cameras) {
      ORIEL_TRY(references_.emplace_back(), render(camera, trade_.plan.reference_paths, o_.seed + 1));
    }
    for (const Configuration& configuration : trade_.plan.configurations) {
      Row row{configuration, {}, {}, {}, {}};
      const Status measured = configuration.paths > 0          ? measure_paths(row)
                              : !configuration.preview.empty() ? measure_preview(row)
                                                               : measure_pack(row);
      if (!measured) {
        if (measured.error().code == ErrorCode::kIo) return measured;
        row.failure = measured.error().text();
        context_.warning("trade-incomplete", configuration.name() + ": " + row.failure);
      }
      trade_.rows.push_back(std::move(row));
    }
    return {};
  }

  std::string bake_key(const Settings& settings, std::uint64_t seed, const std::string& reference) const {
    Arguments what{"bake", std::to_string(seed), reference};
    append(what, settings);
    return store_.key(what);
  }

  // Bakes the unit's pack, and compares its texels with the reference's, if there is one.
  Result<Measures> bake(const std::string& key, const Settings& settings, std::uint64_t seed,
                        const std::string& reference) {
    const fs::path report = store_.file(key, ".report");
    Arguments arguments{
        bake_program(), o_.scene.string(), "-o",  pack(key).string(), "--report", report.string(),     "--require",
        "nothing",      "--cache",         "off", "--quiet",          "--seed",   std::to_string(seed)};
    append(arguments, settings);
    arguments.insert(arguments.end(), o_.forwarded.begin(), o_.forwarded.end());
    ORIEL_TRY(const Finished finished, run_program(arguments, log(key), context_.stop));
    ORIEL_TRY(const std::string text, read_text(report));
    ORIEL_TRY(const double seconds, read_bake_seconds(text));
    std::error_code error;
    fs::remove(report, error);
    Measures measures;
    measures.bake = BakeCost{seconds, finished.cpu_seconds, fs::file_size(pack(key), error)};
    if (reference.empty()) return measures;
    ORIEL_TRY(const Pack baked, read_pack(pack(key)));
    ORIEL_TRY(const Pack truth, read_pack(pack(reference)));
    ORIEL_TRY(measures.texels, texel_error(baked, truth));
    return measures;
  }

  // The key of the unbiased bake with texels of that size; made where it is missing.
  Result<std::string> texel_reference(const std::string& texel) {
    Settings settings = trade_.plan.reference;
    settings["--texel"] = texel;
    // With another seed the texels would be others; paths have streams of their own.
    const std::string key = bake_key(settings, o_.seed, "");
    ORIEL_TRY_VOID(units_.once("reference bake", fmt::format("reference of {} texels", texel), key,
                               [&] { return bake(key, settings, o_.seed, ""); }));
    return key;
  }

  Status measure_pack(Row& row) {
    const Configuration& c = row.configuration;
    ORIEL_TRY(const std::string reference, texel_reference(c.bake.at("--texel")));
    const std::string key = bake_key(c.bake, o_.seed, reference);
    if (!units_.counting() && !fs::exists(pack(reference))) return {};  // no time for it
    ORIEL_TRY(row.measures,
              units_.once("bake", "bake " + c.name(), key, [&] { return bake(key, c.bake, o_.seed, reference); }));
    if (!trade_.frames || (!units_.counting() && !row.measures.bake)) return {};
    const Result<Measures> played = play(row, key);
    if (!played && c.knob == "default") {
      trade_.frames = false;
      context_.warning("trade-incomplete", "frames are left out: " + played.error().text());
      return {};
    }
    if (!played) return tl::unexpected<Error>(played.error());
    row.measures.frame_ms = played->frame_ms;
    row.measures.renderer = played->renderer;
    row.measures.frames = played->frames;
    return {};
  }

  Result<Measures> play(Row& row, const std::string& pack_key) {
    const Configuration& c = row.configuration;
    Arguments what{"play", pack_key};
    append(what, c.play);
    what.insert(what.end(), references_.begin(), references_.end());
    const std::string key = store_.key(what);
    for (std::size_t i = 0; i < references_.size(); ++i) row.pictures.push_back(picture(key, i));
    return units_.once("play", "frames of " + c.name(), key, [&] { return play_frames(c, pack_key, key); });
  }

  Result<Measures> play_frames(const Configuration& c, const std::string& pack_key, const std::string& key) {
    Measures measures;
    const fs::path numbers = store_.file(key, ".numbers");
    Arguments common{play_program(), pack(pack_key).string(), "--offscreen"};
    append(common, c.play);
    Arguments timing = common;
    for (const std::string& camera : trade_.facts.cameras) timing.insert(timing.end(), {"--camera", camera});
    timing.insert(timing.end(), {"--size", fmt::format("{}x{}", kFrameWidth, kFrameHeight), "--frames",
                                 std::to_string(kTimes), "--stats", numbers.string()});
    ORIEL_TRY_VOID(run_program(timing, log(key), context_.stop));
    ORIEL_TRY(const std::string stats, read_text(numbers));
    ORIEL_TRY_VOID(read_frame_times(stats, measures));
    for (std::size_t i = 0; i < references_.size(); ++i) {
      Arguments comparing = common;
      const std::string size =
          fmt::format("{}x{}", kSupersampling * trade_.plan.width, kSupersampling * trade_.plan.height);
      comparing.insert(comparing.end(),
                       {"--camera", trade_.facts.cameras[i], "--compare", store_.file(references_[i], ".exr").string(),
                        "--size", size, "--json", numbers.string(), "-o", picture(key, i).string()});
      ORIEL_TRY_VOID(run_program(comparing, log(key), context_.stop));
      ORIEL_TRY(const std::string json, read_text(numbers));
      ORIEL_TRY(CameraError frame, read_comparison(trade_.facts.cameras[i], json));
      measures.frames.push_back(std::move(frame));
    }
    std::error_code ignored;
    fs::remove(numbers, ignored);
    return measures;
  }

  // The key of a path-traced frame; made where it is missing. Its time is that of tracing.
  Result<std::string> render(const std::string& camera, unsigned paths, std::uint64_t seed) {
    const TradePlan& plan = trade_.plan;
    Arguments settings{"--camera",  camera,
                       "--size",    fmt::format("{}x{}", plan.width, plan.height),
                       "--samples", std::to_string(paths),
                       "--seed",    std::to_string(seed)};
    Arguments what{"render"};
    what.insert(what.end(), settings.begin(), settings.end());
    const std::string key = store_.key(what);
    const std::string label = fmt::format("path-traced frame '{}', {} paths a pixel", camera, paths);
    const std::string kind = paths == plan.reference_paths ? "reference frame" : "traced frame";
    ORIEL_TRY_VOID(units_.once(kind, label, key, [&] { return trace_frame(key, settings); }));
    return key;
  }

  Result<Measures> trace_frame(const std::string& key, const Arguments& settings) {
    Arguments arguments{bake_program(), "render", o_.scene.string(), "-o", store_.file(key, ".exr").string(),
                        "--json-log"};
    arguments.insert(arguments.end(), settings.begin(), settings.end());
    arguments.insert(arguments.end(), o_.forwarded.begin(), o_.forwarded.end());
    ORIEL_TRY_VOID(run_program(arguments, log(key), context_.stop));
    ORIEL_TRY(const double seconds, traced_seconds(log(key)));
    Measures measures;
    measures.frame_ms = 1000 * seconds;
    return measures;
  }

  // Frames of few paths beside the references; their time is scaled to the pixels of the frames that are timed.
  Status measure_paths(Row& row) {
    double ms = 0;
    for (std::size_t i = 0; i < references_.size(); ++i) {
      const std::string& camera = trade_.facts.cameras[i];
      ORIEL_TRY(const std::string frame, render(camera, row.configuration.paths, o_.seed + 2));
      const std::string key = store_.key({"compare", frame, references_[i]});
      row.pictures.push_back(picture(key, i));
      ORIEL_TRY(const Measures measured,
                units_.once("compare", fmt::format("'{}' of {}", camera, row.configuration.name()), key,
                            [&] { return compare_paths(camera, frame, references_[i], picture(key, i)); }));
      if (units_.counting()) continue;
      if (measured.frames.empty()) return {};  // no time for it
      ms += *measured.frame_ms / static_cast<double>(references_.size());
      row.measures.frames.push_back(measured.frames[0]);
      if (row.measures.frames.size() == references_.size()) row.measures.frame_ms = ms;
    }
    return {};
  }

  Result<Measures> compare_paths(const std::string& camera, const std::string& frame, const std::string& reference,
                                 const fs::path& file) const {
    const auto traced = store_.find(frame);
    if (!traced || !traced->frame_ms) return fail(ErrorCode::kStopped, "", "there was no time to trace the frame");
    ORIEL_TRY(PlayedFrame played, read_traced_frame(store_.file(frame, ".exr")));
    ORIEL_TRY(const LayeredImage truth, read_layered_exr(store_.file(reference, ".exr")));
    const double pixels = static_cast<double>(played.total.width) * played.total.height;
    Measures measures;
    measures.frame_ms = *traced->frame_ms * kFrameWidth * kFrameHeight / pixels;
    ORIEL_TRY_VOID(compare_whole(camera, played, truth, file, measures));
    return measures;
  }

  // Frames without a bake beside the references: what one waits for is the program and its passes.
  Status measure_preview(Row& row) {
    const Configuration& c = row.configuration;
    if (!trade_.frames || !fs::exists(preview_program())) return {};
    Arguments what{"preview", std::to_string(o_.seed)};
    append(what, c.preview);
    what.insert(what.end(), references_.begin(), references_.end());
    const std::string key = store_.key(what);
    for (std::size_t i = 0; i < references_.size(); ++i) row.pictures.push_back(picture(key, i));
    ORIEL_TRY(row.measures, units_.once("preview", "frames of " + c.name(), key, [&] { return preview(c, key); }));
    return {};
  }

  Result<Measures> preview(const Configuration& c, const std::string& key) {
    Measures measures;
    measures.bake = BakeCost{};
    measures.frame_ms = 0;
    const fs::path frame = store_.file(key, ".exr");
    const double cameras = static_cast<double>(references_.size()), width = trade_.plan.width,
                 height = trade_.plan.height;
    for (std::size_t i = 0; i < references_.size(); ++i) {
      const std::string& camera = trade_.facts.cameras[i];
      Arguments drawing{preview_program(),
                        o_.scene.string(),
                        "--offscreen",
                        "--stats",
                        "--camera",
                        camera,
                        "--size",
                        fmt::format("{}x{}", width, height),
                        "-o",
                        frame.string(),
                        "--seed",
                        std::to_string(o_.seed)};
      append(drawing, c.preview);
      drawing.insert(drawing.end(), o_.forwarded.begin(), o_.forwarded.end());
      ORIEL_TRY_VOID(run_program(drawing, log(key), context_.stop));
      ORIEL_TRY(const std::string told, read_text(log(key)));
      ORIEL_TRY(const PreviewTimes times, read_preview_times(told.substr(std::min(told.find('{'), told.size()))));
      measures.bake->seconds += times.drawn_s / cameras;
      measures.bake->cpu_seconds += times.cpu_s / cameras;
      *measures.frame_ms += times.pass_ms * kFrameWidth * kFrameHeight / (width * height * cameras);
      ORIEL_TRY(PlayedFrame played, read_preview_frame(frame));
      ORIEL_TRY(const LayeredImage truth, read_layered_exr(store_.file(references_[i], ".exr")));
      ORIEL_TRY_VOID(compare_whole(camera, played, truth, picture(key, i), measures));
      measures.frames.back().diffuse = std::numeric_limits<double>::quiet_NaN();
    }
    std::error_code ignored;
    fs::remove(frame, ignored);
    return measures;
  }

  void mark_fronts() {
    for (const FrontKind& kind : front_kinds()) {
      std::vector<CostError> points;
      std::vector<Row*> rows;
      for (Row& row : trade_.rows) {
        const auto cost = kind.cost_of(row.measures), error = kind.error_of(row.measures);
        if (!cost || !error) continue;
        points.push_back({*cost, *error});
        rows.push_back(&row);
      }
      for (const std::size_t i : pareto_front(points)) rows[i]->fronts.push_back(kind.id);
    }
  }

  const TradeOptions& o_;
  const Store& store_;
  Units& units_;
  Context& context_;
  Trade trade_;
  std::vector<std::string> references_;  // keys of the reference frames, by camera
};

}  // namespace

Result<Trade> sweep(const TradeOptions& options, Context& context, const Units::Note& note) {
  const fs::path runs = options.output / "runs";
  std::error_code error;
  fs::create_directories(runs, error);
  if (error) return fail(ErrorCode::kIo, runs.string(), "cannot make the folder: {}", error.message());
  std::vector<fs::path> programs{options.programs / "oriel-bake"};
  const bool player = fs::exists(options.programs / "oriel-play", error);
  if (player) programs.push_back(options.programs / "oriel-play");
  if (fs::exists(options.programs / "oriel-preview", error)) programs.push_back(options.programs / "oriel-preview");
  if (!player)
    context.warning("trade-incomplete",
                    fmt::format("frames are left out: there is no oriel-play in {}", options.programs.string()));
  ORIEL_TRY(const std::string inputs, hash_of(options.scene, options.forwarded, programs));
  const Store store(runs, inputs);
  Units units(store, context, note, options.time_s);
  return Sweep(options, store, units, context, player).run();
}

}  // namespace oriel::trade
