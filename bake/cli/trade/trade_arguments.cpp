#include "bake/cli/trade/trade_arguments.h"

#include <algorithm>
#include <array>

#include "bake/cli/option_groups.h"
#include "bake/run/options.h"
#include "bake/trade/page/html.h"
#include "bake/trade/page/table.h"
#include "formats/core/file.h"

namespace oriel {
namespace {

constexpr const char* kFooter = R"(Examples:
  oriel-bake trade gallery.glb -o gallery-trade --quick            minutes
  oriel-bake trade gallery.glb -o gallery-trade                    all settings of all knobs
  oriel-bake trade gallery.glb -o gallery-trade --time 30min       as much as fits; the same command goes on

Writes trade.html to look at, trade.csv and trade.json. What is finished stays in DIR/runs and is not run again.)";

// The seed and the log are the sweep's own business.
bool is_forwarded(const CLI::Option& option) {
  static const std::array<std::string, 4> kOwn = {"--seed", "--quiet", "--json-log", "--help"};
  return option.count() > 0 && std::find(kOwn.begin(), kOwn.end(), option.get_name()) == kOwn.end();
}

Status write_text(const std::filesystem::path& file, const std::string& text) {
  return write_file_atomically(file, std::as_bytes(std::span(text)));
}

}  // namespace

CLI::App* add_trade(CLI::App& app, TradeTexts& texts, TradeArguments& args) {
  CLI::App* trade = app.add_subcommand(
      "trade", "Measures on the scene what methods and knobs cost and err, and shows which are best for their cost");
  trade->footer(kFooter);
  trade::TradeOptions& out = args.options;
  trade->add_option("SCENE", out.scene, "The scene: .glb, or .gltf with its buffers and textures")->required();
  trade->add_option("-o,--output", out.output, "Folder of the results; made where it is missing")
      ->type_name("DIR")
      ->required();
  trade->add_flag("--quick", out.quick, "Few settings of each knob, coarser texels and references: minutes");
  trade->add_option("--time", texts.time, "Start nothing more after so long; the same command goes on later")
      ->type_name("TIME");
  trade
      ->add_option(
          "--texel", texts.texel,
          "Lightmap texel of the default (twice that with --quick). Default: 10 cm, or a hundredth of a smaller "
          "scene's diagonal")
      ->type_name("LENGTH");
  trade
      ->add_option("--camera", out.cameras,
                   "Whose frames are judged, as oriel-play takes it; repeatable. Default: those of the scene that see "
                   "most of its reflectors (2 with --quick, else 4), or eyes on its floors")
      ->type_name("CAMERA")
      ->allow_extra_args(false);
  texts.trade = trade;
  texts.own = trade->get_options().size();
  return trade;
}

Status resolve_trade(const TradeTexts& texts, std::uint64_t seed, TradeArguments& args) {
  trade::TradeOptions& out = args.options;
  if (!texts.time.empty()) {
    ORIEL_TRY(out.time_s, parse_duration(texts.time));
  }
  if (!texts.texel.empty()) {
    ORIEL_TRY(out.texel_m, parse_length(texts.texel));
  }
  out.seed = seed;
  const auto options = texts.trade->get_options();
  for (std::size_t i = texts.own; i < options.size(); ++i)
    if (is_forwarded(*options[i]))
      for (std::string& word : as_typed(*options[i])) out.forwarded.push_back(std::move(word));
  std::error_code error;
  out.programs = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return fail(ErrorCode::kRuntime, "/proc/self/exe", "cannot be read: {}", error.message());
  return {};
}

Status run_trade(const TradeArguments& args, Context& context, const std::function<void(const std::string&)>& note) {
  const auto& folder = args.options.output;
  ORIEL_TRY(const trade::Trade found, trade::sweep(args.options, context, note));
  for (const std::string& skipped : found.plan.skipped) note("not varied: " + skipped);
  ORIEL_TRY_VOID(write_text(folder / "trade.json", trade::trade_json(found)));
  ORIEL_TRY_VOID(write_text(folder / "trade.csv", trade::trade_csv(found)));
  ORIEL_TRY_VOID(write_text(folder / "trade.html", trade::trade_html(found)));
  note(fmt::format("wrote {}: {} configurations; {} parts run, {} found finished, {} left",
                   (folder / "trade.html").string(), found.rows.size(), found.started, found.reused, found.left));
  if (context.stopped()) return fail(ErrorCode::kStopped, folder.string(), "stopped; the same command goes on");
  return {};
}

}  // namespace oriel
