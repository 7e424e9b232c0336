#include "sweep_guard/detection/submesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "detection/float_planes.h"
#include "mesh_orders.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

bool beyondOneSide(const TriangleMesh& mesh_M, const Triangle& triangle, const Eigen::AlignedBox3d& box_M) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto all = [&](const auto& beyond) {
      return std::all_of(triangle.begin(), triangle.end(),
                         [&](std::uint32_t corner) { return beyond(mesh_M.vertex(corner)[axis]); });
    };
    if (all([&](double x) { return x > box_M.max()[axis]; })) return true;
    if (all([&](double x) { return x < box_M.min()[axis]; })) return true;
  }
  return false;
}

Eigen::AlignedBox3d randomBox(Random& random) {
  const Eigen::Vector3d a = random.inBox({0.1, 0.1, 0.1});
  return Eigen::AlignedBox3d(a).extend(a + random.inBox({0.05, 0.05, 0.05}));
}

std::set<std::uint32_t> trianglesOf(const Submesh& part) {
  std::set<std::uint32_t> triangles;
  part.forEachTriangle([&](std::uint32_t triangle) { EXPECT_TRUE(triangles.insert(triangle).second); });
  return triangles;
}

class SubmeshTest : public testing::TestWithParam<MeshOrdering> {
 protected:
  const TriangleMesh hull_ = GetParam().of(wavyHull(40, 60, 0.5));
};

TEST_P(SubmeshTest, TheWholeMeshHasEachTriangleOnce) { EXPECT_EQ(trianglesOf(hull_).size(), hull_.triangles().size()); }

TEST_P(SubmeshTest, LeavesOutMostOfWhatLiesBeyondASideAndNothingElse) {
  Random random(1);
  SubmeshFinder finder;
  double left = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::AlignedBox3d box_M = randomBox(random);
    const std::set<std::uint32_t> part = trianglesOf(finder.find(hull_, floatPlanes(hull_, box_M)));
    left += static_cast<double>(part.size()) / static_cast<double>(hull_.triangles().size()) / 200.0;
    for (std::uint32_t triangle = 0; triangle < hull_.triangles().size(); ++triangle) {
      if (part.count(triangle) == 0) {
        EXPECT_TRUE(beyondOneSide(hull_, hull_.triangles()[triangle], box_M));
      }
    }
  }
  EXPECT_LT(left, 0.3);
}

TEST_P(SubmeshTest, ASubmeshOfASubmeshIsWhatIsWithinBoth) {
  Random random(2);
  SubmeshFinder outer;
  SubmeshFinder inner;
  SubmeshFinder direct;
  for (int i = 0; i < 100; ++i) {
    const Eigen::AlignedBox3d box_M = randomBox(random);
    const simd::Planes planes = floatPlanes(hull_, box_M);
    const Submesh around = outer.find(hull_, floatPlanes(hull_, randomBox(random).extend(box_M)));
    EXPECT_EQ(trianglesOf(inner.find(around, planes)), trianglesOf(direct.find(hull_, planes)));
  }
}

TEST_P(SubmeshTest, OfABoxFarAwayNothingIsLeft) {
  SubmeshFinder finder;
  const Eigen::AlignedBox3d box_M(Eigen::Vector3d(5, 5, 5), Eigen::Vector3d(6, 6, 6));
  const Submesh part = finder.find(hull_, floatPlanes(hull_, box_M));
  EXPECT_TRUE(part.empty());
  EXPECT_TRUE(SubmeshFinder().find(part, floatPlanes(hull_, box_M)).empty());
}

TEST_P(SubmeshTest, OfAnInfiniteBoxAllIsLeft) {
  SubmeshFinder finder;
  const double far = std::numeric_limits<double>::infinity();
  const Eigen::AlignedBox3d box_M(Eigen::Vector3d::Constant(-far), Eigen::Vector3d::Constant(far));
  EXPECT_EQ(trianglesOf(finder.find(hull_, floatPlanes(hull_, box_M))).size(), hull_.triangles().size());
}

INSTANTIATE_TEST_SUITE_P(AllOrders, SubmeshTest, testing::ValuesIn(meshOrderings()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace sweep_guard_core
