#include "sweep_guard/detection/convex_clip.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace sweep_guard {
namespace {

// Planes through one line, and a triangle without area on it: which side of a plane its corners lie on is rounding.
class WireTest : public testing::Test {
 protected:
  void next() {
    along_ = random_.direction();
    p_ = random_.direction();
  }
  Eigen::Vector3d point() { return p_ + random_.uniform(-1.0, 1.0) * along_; }
  Eigen::Vector3d normal() { return along_.cross(random_.direction()).normalized(); }

  Random random_{/*seed=*/1};
  Eigen::Vector3d along_;
  Eigen::Vector3d p_;
};

TEST_F(WireTest, OnTheLineThatPlanesShareIsCutByAsManyAsThereMayBe) {
  int left = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    next();
    CutTriangle triangle({point(), point(), point()});
    for (size_t i = 0; i < kMostHalfSpaces && !triangle.empty(); ++i) {
      const Eigen::Vector3d n = normal();
      triangle.cut(n, n.dot(p_));
    }
    left += triangle.empty() ? 0 : 1;
  }
  EXPECT_GT(left, 1000);
}

TEST_F(WireTest, IsNotLostWhereThePlanesAreMovedOutByItsRounding) {
  for (int trial = 0; trial < 10000; ++trial) {
    next();
    CutTriangle triangle({point(), point(), point()});
    for (size_t i = 0; i < kMostHalfSpaces; ++i) {
      const Eigen::Vector3d n = normal();
      triangle.cut(n, n.dot(p_) + 1e-14);
      ASSERT_FALSE(triangle.empty());
    }
  }
}

}  // namespace
}  // namespace sweep_guard
