#include "bake/cli/commands.h"
#include "bake/run/option_table.h"
#include "bake/run/option_values.h"
#include "formats/core/file.h"
#include "formats/core/process.h"
#include "trade/html.h"
#include "trade/sweep.h"
#include "trade/table.h"

namespace oriel {
namespace {

constexpr const char* kTradeFooter = R"(Examples:
  oriel-bake trade gallery.glb -o gallery-trade --quick            minutes
  oriel-bake trade gallery.glb -o gallery-trade                    all settings of all knobs
  oriel-bake trade gallery.glb -o gallery-trade --time 30min       as much as fits; the same command goes on

Writes trade.html to look at, trade.csv and trade.json. What is finished stays in DIR/runs and is not run again.)";

// Sweeps, and writes trade.json, trade.csv and trade.html; also what is known where the user stops it.
Status run_trade(const trade::TradeOptions& options, BakeSession& session) {
  stop_on_signals(session.context, {}, OnStop::kKeep);
  const auto note = [&](const std::string& text) { session.note(text); };
  const auto& folder = options.output;
  ORIEL_TRY(const trade::Trade found, trade::sweep(options, session.context, note));
  for (const std::string& skipped : found.plan.skipped) note("not varied: " + skipped);
  ORIEL_TRY_VOID(write_text_atomically(folder / "trade.json", trade::trade_json(found)));
  ORIEL_TRY_VOID(write_text_atomically(folder / "trade.csv", trade::trade_csv(found)));
  ORIEL_TRY_VOID(write_text_atomically(folder / "trade.html", trade::trade_html(found)));
  note(fmt::format("wrote {}: {} configurations; {} parts run, {} found finished, {} left",
                   (folder / "trade.html").string(), found.rows.size(), found.started, found.reused, found.left));
  if (session.context.stopped()) return fail(ErrorCode::kStopped, folder.string(), "stopped; the same command goes on");
  return {};
}

struct TradeArguments {
  trade::TradeOptions options;
  ImportOptions import;       // checked here, and forwarded as typed
  bool reproducible = false;  // likewise
};

std::vector<Option> sweep_options(trade::TradeOptions& o) {
  constexpr const char* kSweep = "Sweep";
  return {
      scene_argument(o.scene),
      {"-o,--output", kSweep, "Folder of the results; made where it is missing", path(o.output, "DIR"), Use::kRequired},
      {"--quick", kSweep, "Few settings of each knob, coarser texels and references: minutes", flag(o.quick),
       Use::kEveryday},
      {"--time", kSweep, "Start nothing more after so long; the same command goes on later",
       quantity(o.time_s, "TIME", parse_duration, time_text), Use::kEveryday},
      {"--texel", kSweep,
       "Lightmap texel of the default (twice that with --quick). Default: 10 cm, or a hundredth of a smaller scene's "
       "diagonal",
       quantity(o.texel_m, "LENGTH", parse_length,
                [](double metres) { return metres > 0 ? fmt::format("{}m", metres) : std::string(); }),
       Use::kEveryday},
      {"--camera", kSweep,
       "Whose frames are judged, as oriel-play takes it; repeatable. Default: those of the scene that see most of its "
       "reflectors (2 with --quick, else 4), or eyes on its floors",
       texts(o.cameras, "CAMERA"), Use::kEveryday},
  };
}

}  // namespace

ToolCommand trade_command(BakeSession& session) {
  const auto args = std::make_shared<TradeArguments>();
  args->import.clear_sky = true;  // as the programs that it starts have it
  ToolCommand out{
      .name = "trade",
      .help = "Measures on the scene what methods and knobs cost and err, and shows which are best for their cost",
      .footer = kTradeFooter,
      .options = sweep_options(args->options)};
  std::vector<Option> forwarded = light_options(args->import);
  append(forwarded, mover_options(args->import));
  append(forwarded, scene_options(args->import, args->reproducible));
  append(out.options, forwarded);
  append(out.options, run_options(session));
  forwarded.push_back(run_options(session)[0]);  // threads; the seed and the log are the sweep's own
  out.settle = [args, &session, forwarded](const Given& given) -> Status {
    trade::TradeOptions& o = args->options;
    o.seed = session.seed;
    o.forwarded = given.words(forwarded);
    ORIEL_TRY(o.programs, program_beside(""));
    return {};
  };
  out.run = [args, &session] { return run_trade(args->options, session); };
  return out;
}

}  // namespace oriel
