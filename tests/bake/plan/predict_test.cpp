// The cost model where it is exact, and predictions where they must be close.
#include <gtest/gtest.h>

#include "bake/plan/predict.h"

namespace oriel {
namespace {

TEST(TexelWork, ReturnsWhatItWasMadeOf) {
  for (const auto& [edges, surfaces] : {std::pair{3.0, 2.0}, {0.0, 2.0}, {5.0, 0.0}}) {
    const double n[2] = {1600, 6400}, w[2] = {edges * 40 + surfaces * 1600, edges * 80 + surfaces * 6400};
    const TexelWork fit = fit_work(n, w);
    EXPECT_NEAR(fit.edges, edges, 1e-9);
    EXPECT_NEAR(fit.surfaces, surfaces, 1e-9);
    EXPECT_NEAR(fit.at(1e6), edges * 1e3 + surfaces * 1e6, 1e-3);
  }
}

TEST(TexelWork, NeverFallsBelowNothing) {
  // Less work for more texels, and work that grows faster than texels: the finer pilot counts.
  EXPECT_NEAR(fit_work({100, 400}, {20, 20}).at(40000), 200, 1e-9);
  EXPECT_NEAR(fit_work({100, 400}, {1, 40}).at(40000), 4000, 1e-9);
  EXPECT_NEAR(fit_work({100, 100}, {7, 7}).at(200), 14, 1e-9) << "as many texels";
  EXPECT_EQ(fit_work({100, 400}, {0, 0}).at(1e6), 0);
}

}  // namespace
}  // namespace oriel
