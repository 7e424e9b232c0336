#include "detection/convex_clip.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace sweep_guard_core {
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
    ClippedTriangle triangle({point(), point(), point()});
    for (size_t i = 0; i < kMaxHalfSpaces && !triangle.empty(); ++i) {
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
    ClippedTriangle triangle({point(), point(), point()});
    for (size_t i = 0; i < kMaxHalfSpaces; ++i) {
      const Eigen::Vector3d n = normal();
      triangle.cut(n, n.dot(p_) + 1e-14);
      ASSERT_FALSE(triangle.empty());
    }
  }
}

// A volume in its own frame B, and triangles as large as it, all about it.
class ClipTest : public testing::Test {
 protected:
  ClipTest() {
    volume_.box.half_extents = Eigen::Vector3d(0.5, 0.7, 1.1);
    for (size_t i = 0; i < kMaxClips; ++i) volume_.clips_B.push_back(HalfSpace(random_.direction(), 0.6));
  }

  Eigen::Vector3d point() {
    return {random_.uniform(-2.0, 2.0), random_.uniform(-2.0, 2.0), random_.uniform(-2.0, 2.0)};
  }

  static bool leftByAllPlanes(const SweptVolume& volume, const std::array<Eigen::Vector3d, 3>& corners_B) {
    ClippedTriangle triangle(corners_B);
    volume.forEachHalfSpace([&](const Eigen::Vector3d& normal_B, double offset) {
      if (!triangle.empty()) triangle.cut(normal_B, offset);
    });
    return !triangle.empty();
  }

  Random random_{/*seed=*/2};
  SweptVolume volume_;
};

TEST_F(ClipTest, IsWhatEveryPlaneLeavesButForRounding) {
  const ConvexClip clip(volume_.grown(1e-12));
  const SweptVolume larger = volume_.grown(2e-12);
  int met = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const std::array<Eigen::Vector3d, 3> corners_B = {point(), point(), point()};
    const bool meets = clip.meets(corners_B);
    met += meets ? 1 : 0;
    ASSERT_TRUE(meets || !leftByAllPlanes(volume_, corners_B)) << trial;
    ASSERT_TRUE(!meets || leftByAllPlanes(larger, corners_B)) << trial;
  }
  EXPECT_GT(met, 20000);
  EXPECT_LT(met, 80000);
}

TEST_F(ClipTest, IsNotMetByAnEdgeThatPassesItNarrowly) {
  volume_.clips_B.clear();
  const ConvexClip clip(volume_);
  const Eigen::Vector3d far(30.0, 30.0, 0.0);
  const auto edge = [&](double x, double y) { return clip.meets({Eigen::Vector3d(x, 0.0, 0.0), {0.0, y, 0.0}, far}); };
  EXPECT_TRUE(edge(0.6, 0.7 * 0.6 / 0.1 - 1e-6));
  EXPECT_FALSE(edge(0.6, 0.7 * 0.6 / 0.1 + 1e-6));
}

TEST_F(ClipTest, MeetsATriangleWhoseEdgesAllPassItBy) {
  volume_.clips_B.clear();
  const ConvexClip clip(volume_);
  EXPECT_TRUE(clip.meets({Eigen::Vector3d(-9.0, -9.0, 0.0), Eigen::Vector3d(9.0, -9.0, 0.0), {0.0, 9.0, 0.0}}));
}

}  // namespace
}  // namespace sweep_guard_core
