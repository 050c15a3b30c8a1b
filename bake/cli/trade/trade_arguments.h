// The command line of `oriel-bake trade`, and what it does.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "bake/jobs/context.h"
#include "bake/trade/sweep.h"

namespace oriel {

struct TradeArguments {
  bool wanted = false;  // the subcommand was asked for
  trade::TradeOptions options;
};

// Values as typed, until resolve_trade() turns them into options.
struct TradeTexts {
  std::string time, texel;
  CLI::App* trade = nullptr;
  std::size_t own = 0;  // options before this one are the sweep's, those after it every program's
};

// Adds the subcommand with its own options. The caller adds those that go to every bake and reference frame after it.
CLI::App* add_trade(CLI::App& app, TradeTexts& texts, TradeArguments& args);
// After parsing. Error kUsage.
Status resolve_trade(const TradeTexts& texts, std::uint64_t seed, TradeArguments& args);
// Sweeps, and writes trade.json, trade.csv and trade.html. Errors: as sweep(); kStopped where the user stopped it,
// after writing what is known.
Status run_trade(const TradeArguments& args, Context& context, const std::function<void(const std::string&)>& note);

}  // namespace oriel
