#include "sweep_guard/detection/submesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "mesh_orders.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

class ClusterBoxesTest : public testing::TestWithParam<MeshOrdering> {
 protected:
  const TriangleMesh hull_ = GetParam().of(wavyHull(40, 60, 0.5));

  // To points all over the triangles.
  double leastDistance(const Submesh& part, const Eigen::Vector3d& p_M) const {
    double least = std::numeric_limits<double>::infinity();
    part.forEachTriangle([&](std::uint32_t triangle) {
      const auto& [a, b, c] = hull_.triangles()[triangle];
      for (int i = 0; i <= 4; ++i) {
        for (int k = 0; i + k <= 4; ++k) {
          const Eigen::Vector3d q_M =
              0.25 * (i * hull_.vertex(a) + k * hull_.vertex(b) + (4 - i - k) * hull_.vertex(c));
          least = std::min(least, (q_M - p_M).norm());
        }
      }
    });
    return least;
  }
};

TEST_P(ClusterBoxesTest, AreNoFartherFromAPointThanAnyTriangle) {
  Random random(1);
  SubmeshFinder finder;
  ClusterBoxes boxes;
  int apart = 0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d corner = random.inBox({0.1, 0.1, 0.1});
    const Submesh part = finder.find(hull_, Eigen::AlignedBox3d(corner).extend(corner + random.inBox({0.1, 0.1, 0.1})));
    boxes.around(part);
    const Eigen::Vector3d p_M = random.inBox({0.5, 0.5, 0.5});
    const double distance = boxes.distanceFrom(p_M);
    const double least = leastDistance(part, p_M);
    EXPECT_LE(distance, least);
    apart += !part.empty() && distance > 0.7 * least;
  }
  EXPECT_GT(apart, 30);
}

TEST_P(ClusterBoxesTest, OfNothingAreInfinitelyFar) {
  SubmeshFinder finder;
  ClusterBoxes boxes;
  boxes.around(hull_);
  EXPECT_LT(boxes.distanceFrom(Eigen::Vector3d::Zero()), 1.0);
  boxes.around(finder.find(hull_, Eigen::AlignedBox3d(Eigen::Vector3d(5, 5, 5), Eigen::Vector3d(6, 6, 6))));
  EXPECT_EQ(boxes.distanceFrom(Eigen::Vector3d::Zero()), std::numeric_limits<double>::infinity());
}

INSTANTIATE_TEST_SUITE_P(AllOrders, ClusterBoxesTest, testing::ValuesIn(meshOrderings()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace sweep_guard_core
