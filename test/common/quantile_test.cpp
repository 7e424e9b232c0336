#include "sweep_guard/common/quantile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sweep_guard_core {
namespace {

TEST(QuantileTest, InterpolatesBetweenTheSortedValues) {
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.95), 3.85);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(quantile({7}, 0.95), 7.0);
}

TEST(QuantileTest, OfAnEmptySampleIsNaN) { EXPECT_TRUE(std::isnan(quantile({}, 0.5))); }

}  // namespace
}  // namespace sweep_guard_core
