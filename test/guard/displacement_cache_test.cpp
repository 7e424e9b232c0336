#include "guard/displacement_cache.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

const TriangleMesh kCorner({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});

std::shared_ptr<Workpiece> sheetAt(float z) {
  auto workpiece = std::make_shared<Workpiece>(Workpiece{"sheet", 0, {}, {}, "table", kCorner});
  std::vector<float> positions = {0, 0, z, 1, 0, z, 0, 1, z};
  workpiece->mesh_M.deform(positions);
  return workpiece;
}

double rise(const Displacements& displacements) { return displacements.box_M().center().z(); }

TEST(DisplacementCacheTest, KnowsEachPairOfDeformations) {
  DisplacementCache cache;
  const auto low = sheetAt(0.0F);
  const auto middle = sheetAt(1.0F);
  const auto high = sheetAt(3.0F);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(rise(cache.between(low, middle)), 1.0, 1e-6);
    EXPECT_NEAR(rise(cache.between(low, high)), 3.0, 1e-6);
    EXPECT_NEAR(rise(cache.between(middle, high)), 2.0, 1e-6);
    EXPECT_FALSE(cache.between(high, high).any());
  }
}

// A snapshot never changes; this one does, so that a second look would show.
TEST(DisplacementCacheTest, LooksOnceAtWhatIsAskedForAgainAndAgain) {
  DisplacementCache cache;
  const auto low = sheetAt(0.0F);
  const auto high = sheetAt(1.0F);
  cache.between(low, high);
  std::vector<float> positions = {0, 0, 2, 1, 0, 2, 0, 1, 2};
  high->mesh_M.deform(positions);
  for (int sweep = 0; sweep < 3; ++sweep) {
    EXPECT_NEAR(rise(cache.between(low, high)), 1.0, 1e-6);
    cache.forgetUnused();
  }
  cache.forgetUnused();
  EXPECT_NEAR(rise(cache.between(low, high)), 2.0, 1e-6);
}

TEST(DisplacementCacheTest, KeepsNoDeformationThatNobodyAsksFor) {
  DisplacementCache cache;
  std::weak_ptr<Workpiece> low;
  {
    const auto from = sheetAt(0.0F);
    low = from;
    cache.between(from, sheetAt(1.0F));
  }
  cache.forgetUnused();
  EXPECT_FALSE(low.expired());
  cache.forgetUnused();
  EXPECT_TRUE(low.expired());
}

}  // namespace
}  // namespace sweep_guard_core
