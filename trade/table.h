// A sweep as tables for other programs (docs/trade.md tells the fields).
#pragma once

#include <string>

#include "trade/sweep.h"

namespace oriel::trade {

std::string trade_json(const Trade& trade);
// RFC 4180, a header line, a row a configuration; what was not measured is empty.
std::string trade_csv(const Trade& trade);

// Options as typed: "--error 2% --texel 20cm".
std::string options_text(const Settings& settings);

}  // namespace oriel::trade
