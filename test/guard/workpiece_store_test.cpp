#include "guard/workpiece_store.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace sweep_guard_core {
namespace {

const std::string kId = "liver";
const std::string kFrame = "table";
const std::vector<float> kRaised = {0, 0, 2, 1, 0, 2, 0, 1, 2};

Time at(int second) { return Time(std::chrono::seconds(second)); }

Workpiece triangle(int stamp) {
  return {kId, 7, at(stamp), {}, kFrame, TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})};
}

Deformation raised(int stamp) { return {kId, 7, at(stamp), {}, kFrame, kRaised}; }

TEST(WorkpieceStoreTest, CountsUpdatesAndTheirPathLength) {
  WorkpieceStore store;
  store.set(triangle(1), at(9));
  store.deform(raised(2), at(9));
  store.set(triangle(3), at(9));
  EXPECT_EQ(store.snapshot()[0]->updates, 2U);
  EXPECT_NEAR(store.snapshot()[0]->path_length, 4.0, 1e-6);
  Workpiece moved = triangle(4);
  moved.frame = "bed";
  store.set(moved, at(9));
  EXPECT_EQ(store.snapshot()[0]->updates, 0U);
  EXPECT_EQ(*store.frames(), std::set<std::string>{"bed"});
}

TEST(WorkpieceStoreTest, ReusesOnlySnapshotsThatNobodyHolds) {
  WorkpieceStore store;
  store.set(triangle(1), at(9));
  store.deform(raised(2), at(9));
  const auto held = store.snapshot()[0];
  std::set<const Workpiece*> used;
  for (int stamp = 3; stamp < 9; ++stamp) {
    store.deform(raised(stamp), at(9));
    used.insert(store.snapshot()[0].get());
  }
  EXPECT_EQ(used.size(), 2U);
  EXPECT_EQ(held->stamp, at(2));
}

TEST(WorkpieceStoreTest, RefusesWhatDoesNotFitAndKeepsTheSnapshot) {
  WorkpieceStore store;
  EXPECT_TRUE(has(refusal([&] { store.deform(raised(1), at(9)); }), "before their mesh"));
  store.set(triangle(2), at(9));
  EXPECT_TRUE(has(refusal([&] { store.set(triangle(1), at(9)); }), "older"));
  EXPECT_TRUE(has(refusal([&] { store.deform(raised(1), at(9)); }), "older"));
  Deformation other = raised(3);
  other.revision = 8;
  EXPECT_TRUE(has(refusal([&] { store.deform(other, at(9)); }), "revision 8, their mesh has 7"));
  EXPECT_EQ(store.snapshot()[0]->stamp, at(2));
}

// Stamps from before time went back say nothing about the order.
TEST(WorkpieceStoreTest, AcceptsOlderStampsAfterTimeWentBack) {
  WorkpieceStore store;
  store.set(triangle(5), at(9));
  store.deform(raised(2), /*latest=*/at(3));
  store.clearStamps();
  store.set(triangle(1), at(9));
  EXPECT_TRUE(store.remove(kId));
  EXPECT_FALSE(store.remove(kId));
}

}  // namespace
}  // namespace sweep_guard_core
