// What costs least for its error: the fronts of the trade.
#pragma once

#include <span>

#include "trade/measures.h"

namespace oriel::trade {

struct CostError {
  double cost = 0, error = 0;
};

// The Pareto front: indices of the points that no other one matches in both and beats in one, by ascending cost; of
// equal points the first. Points that are not finite are on no front.
std::vector<std::size_t> pareto_front(std::span<const CostError> points);

// One kind of cost against one kind of error.
struct FrontKind {
  const char* id;
  const char* title;
  const char* cost_label;    // with its unit
  const char* error_label;   // errors are shares; shown in %
  const char *cost, *error;  // names of quantities()

  std::optional<double> cost_of(const Measures& measures) const;  // in the label's unit
  std::optional<double> error_of(const Measures& measures) const;
};

std::span<const FrontKind> front_kinds();

}  // namespace oriel::trade
