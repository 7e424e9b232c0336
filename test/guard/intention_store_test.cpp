#include "guard/intention_store.h"

#include <gtest/gtest.h>

#include <limits>

#include "refusal.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

constexpr SteadyTime kNow(100s);

// Four triangles around the origin, in the x-y-plane.
TriangleMesh fan(double size = 1.0) {
  return {{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {-size, 0, 0}, {0, -size, 0}},
          {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
}

Workpieces only(const std::string& id, TriangleMesh mesh = fan()) {
  return {std::make_shared<const Workpiece>(Workpiece{id, 1, Time(), SteadyTime(), "table", std::move(mesh)})};
}

IntentionRequest request(std::vector<std::uint32_t> triangles, double depth = 0.01) {
  return {"bone", std::move(triangles), std::nullopt, Eigen::Vector3d::Zero(), depth, {"bit"}};
}

class IntentionStoreTest : public ::testing::Test {
 protected:
  IntentionStoreTest() { store_.follow(only("bone")); }

  std::string refusal(const IntentionRequest& request) {
    return ::refusal([&] { store_.set({request}, kNow); });
  }
  size_t count(SteadyTime at = kNow) { return store_.at(at)->size(); }

  IntentionStore store_;
};

TEST_F(IntentionStoreTest, KeepsTrianglesInOrderAndEachOnce) {
  store_.set({request({3, 1, 3})}, kNow);
  ASSERT_EQ(count(), 1U);
  EXPECT_EQ(store_.at(kNow)->front().triangles, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(store_.at(kNow)->front().depth, 0.01);
}

TEST_F(IntentionStoreTest, ABallMeansTheTrianglesThatLieWhollyInside) {
  IntentionRequest painted = request({});
  painted.radius = 0.75;
  painted.center_M = {0.5, 0.5, 0};
  store_.set({painted}, kNow);
  EXPECT_EQ(store_.at(kNow)->front().triangles, (std::vector<std::uint32_t>{0}));
  painted.radius = 0.7;
  EXPECT_EQ(refusal(painted), "no triangle of 'bone' lies wholly in the ball");
}

TEST_F(IntentionStoreTest, ARegionGrowsByARequestThatIsEqualButForItsTriangles) {
  store_.set({request({0})}, kNow);
  store_.set({request({2})}, kNow);
  ASSERT_EQ(count(), 1U);
  EXPECT_EQ(store_.at(kNow)->front().triangles, (std::vector<std::uint32_t>{0, 2}));
  store_.set({request({1}, 0.02)}, kNow);
  EXPECT_EQ(count(), 2U);
}

TEST_F(IntentionStoreTest, ARequestWithoutTrianglesTakesBackThoseOfItsMesh) {
  Workpieces both = only("bone");
  both.push_back(only("tendon").front());
  store_.follow(both);
  IntentionRequest other = request({1});
  other.mesh_id = "tendon";
  store_.set({request({0}), request({1}, 0.02), other}, kNow);
  ASSERT_EQ(count(), 3U);
  store_.set({request({})}, kNow);
  ASSERT_EQ(count(), 1U);
  EXPECT_EQ(store_.at(kNow)->front().mesh_id, "tendon");
}

TEST_F(IntentionStoreTest, EndsAfterItsDuration) {
  IntentionRequest brief = request({0});
  brief.duration = 2s;
  store_.set({brief}, kNow);
  EXPECT_EQ(count(kNow + 1999ms), 1U);
  EXPECT_EQ(count(kNow + 2s), 0U);
}

TEST_F(IntentionStoreTest, StaysWhileTheTrianglesStay) {
  store_.set({request({0})}, kNow);
  store_.follow(only("bone", fan(2.0)));  // the same triangles, in another mesh
  ASSERT_EQ(count(), 1U);
  store_.set({request({1})}, kNow);
  EXPECT_EQ(count(), 1U);
}

TEST_F(IntentionStoreTest, EndsWhenTheMeshHasOtherTrianglesOrIsRemoved) {
  store_.set({request({0})}, kNow);
  store_.follow(only("bone", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
  EXPECT_EQ(count(), 0U);
  store_.set({request({0})}, kNow);
  store_.follow({});
  EXPECT_EQ(count(), 0U);
  store_.follow(only("bone"));
  EXPECT_EQ(count(), 0U);
}

TEST_F(IntentionStoreTest, RefusesWhatIsUnknownOrOutOfRange) {
  IntentionRequest wrong = request({0});
  wrong.mesh_id = "liver";
  EXPECT_EQ(refusal(wrong), "there is no workpiece 'liver'");
  EXPECT_EQ(refusal(request({4})), "'bone' has no triangle 4");
  for (const double depth : {0.0, -0.01, 0.51, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(refusal(request({0}, depth)), "depth must be above 0 and at most 0.5 m");
  }
  wrong = request({0});
  wrong.duration = -1s;
  EXPECT_EQ(refusal(wrong), "duration must be from 0 to 24 h");
  wrong = request({});
  wrong.radius = 0.0;
  EXPECT_EQ(refusal(wrong), "radius must be above 0");
  wrong.radius = 1.0;
  wrong.center_M.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(wrong), "center of the ball is not finite");
  EXPECT_EQ(count(), 0U);
}

TEST_F(IntentionStoreTest, TakesAllOrNothing) {
  EXPECT_THROW(store_.set({request({0}), request({4})}, kNow), InvalidInput);
  EXPECT_EQ(count(), 0U);
}

TEST_F(IntentionStoreTest, RefusesMoreThan64) {
  for (int i = 0; i < 64; ++i) store_.set({request({0}, 0.01 + 0.001 * i)}, kNow);
  EXPECT_EQ(refusal(request({0}, 0.2)), "64 regions are intended already: take some back");
  EXPECT_EQ(count(), 64U);
}

TEST_F(IntentionStoreTest, ReturnsTheSameObjectUntilSomethingChanges) {
  store_.set({request({0})}, kNow);
  const auto before = store_.at(kNow);
  store_.follow(only("bone"));
  const auto again = store_.at(kNow);
  EXPECT_EQ(store_.at(kNow + 1s), again);
  store_.clear();
  EXPECT_TRUE(store_.at(kNow)->empty());
  EXPECT_EQ(before->size(), 1U);
}

}  // namespace
}  // namespace sweep_guard_core
