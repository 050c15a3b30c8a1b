// A sweep as one page to read: plots, a table, pictures. It needs neither network nor scripts; a script sorts the table
// where there is one.
#pragma once

#include "trade/sweep.h"

namespace oriel::trade {

// Pictures that cannot be read are left out.
std::string trade_html(const Trade& trade);

}  // namespace oriel::trade
