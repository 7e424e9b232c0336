#include "guard/workpiece_store.h"
#include "refusal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "guard/times.h"

namespace sweep_guard_core {
namespace {

const std::string kId = "liver";
const std::string kFrame = "table";
const std::string kOtherFrame = "bed";
const std::vector<float> kRaised = {0, 0, 2, 1, 0, 2, 0, 1, 2};

Workpiece triangleAt(int stamp) {
  return {kId, 7, atSecond(stamp), {}, kFrame, TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})};
}

// The same vertices with another triangle.
Workpiece turned(int stamp) {
  Workpiece workpiece = triangleAt(stamp);
  workpiece.mesh_M = TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 2, 1}});
  return workpiece;
}

Deformation raised(int stamp) { return {kId, 7, atSecond(stamp), {}, kFrame, kRaised}; }

void setAndRemove(WorkpieceStore& store, int revision) {
  store.set(triangleAt(revision), atSecond(9));
  store.remove(kId, atSecond(5));
}

TEST(WorkpieceStoreTest, CountsUpdatesAndTheirPathLength) {
  WorkpieceStore store;
  store.set(triangleAt(1), atSecond(9));
  store.deform(raised(2), atSecond(9));
  store.set(triangleAt(3), atSecond(9));
  EXPECT_EQ(store.snapshot()[0]->updates, 2U);
  EXPECT_NEAR(store.snapshot()[0]->path_length, 4.0, 1e-6);
  Workpiece moved = triangleAt(4);
  moved.frame = "bed";
  store.set(moved, atSecond(9));
  EXPECT_EQ(store.snapshot()[0]->updates, 0U);
  EXPECT_EQ(*store.frames(), std::set<std::string>{"bed"});
}

TEST(WorkpieceStoreTest, ReusesOnlySnapshotsThatNobodyHolds) {
  WorkpieceStore store;
  store.set(triangleAt(1), atSecond(9));
  store.deform(raised(2), atSecond(9));
  const auto held = store.snapshot()[0];
  std::set<const Workpiece*> used;
  for (int stamp = 3; stamp < 9; ++stamp) {
    store.deform(raised(stamp), atSecond(9));
    used.insert(store.snapshot()[0].get());
  }
  EXPECT_EQ(used.size(), 2U);
  EXPECT_EQ(held->stamp, atSecond(2));
}

TEST(WorkpieceStoreTest, RefusesWhatDoesNotFitAndKeepsTheSnapshot) {
  WorkpieceStore store;
  store.set(triangleAt(2), atSecond(9));
  EXPECT_TRUE(has(refusal([&] { store.set(turned(1), atSecond(9)); }), "older"));
  Workpiece next_revision = triangleAt(1);
  next_revision.revision = 8;
  EXPECT_TRUE(has(refusal([&] { store.set(next_revision, atSecond(9)); }), "older"));
  EXPECT_TRUE(has(refusal([&] { store.deform(raised(1), atSecond(9)); }), "older"));
  Deformation other = raised(3);
  other.revision = 8;
  EXPECT_TRUE(has(refusal([&] { store.deform(other, atSecond(9)); }), "revision 8, their mesh has 7"));
  EXPECT_EQ(store.snapshot()[0]->stamp, atSecond(2));
}

// Too coarse for a contact: of northings in UTM, float32 keeps steps of 0.25 m.
TEST(WorkpieceStoreTest, RefusesVerticesThatAreRoundedByMoreThanTenMillimeters) {
  WorkpieceStore store;
  store.set(triangleAt(1), atSecond(9));
  const auto sentAt = [&](const Eigen::Vector3f& place) {
    std::vector<float> positions = kRaised;
    for (size_t i = 0; i < positions.size(); ++i) positions[i] += place[static_cast<Eigen::Index>(i % 3)];
    return refusal([&] { store.deform({kId, 7, atSecond(2), {}, kFrame, positions}, atSecond(9)); });
  };
  EXPECT_TRUE(has(sentAt({500e3F, 4000e3F, 0}), "float32 rounds coordinates of 4000 km by up to 126 mm: send"));
  EXPECT_TRUE(has(sentAt({0, 0, -270e3F}), "of 270 km by up to 16 mm"));
  EXPECT_TRUE(has(sentAt({132e3F, 132e3F, 0}), "of 132 km by up to 11 mm"));
  EXPECT_EQ(store.snapshot()[0]->stamp, atSecond(1));
  EXPECT_EQ(sentAt({130e3F, 130e3F, 0}), "");
  EXPECT_NEAR(store.snapshot()[0]->mesh_M.rounding(), 0.0055, 1e-4);
  EXPECT_EQ(sentAt({30e3F, 0, 0}), "");
  EXPECT_EQ(sentAt({0, 0, 0}), "");
  EXPECT_LT(store.snapshot()[0]->mesh_M.rounding(), 2e-7);
}

// Stamps from before time went back say nothing about the order.
TEST(WorkpieceStoreTest, AcceptsOlderStampsAfterTimeWentBack) {
  WorkpieceStore store;
  store.set(triangleAt(5), atSecond(9));
  store.deform(raised(2), /*latest=*/atSecond(3));
  store.clearStamps();
  store.set(triangleAt(1), atSecond(9));
  EXPECT_TRUE(store.remove(kId, atSecond(2)));
  EXPECT_FALSE(store.remove(kId, atSecond(2)));
}

// What is part of the tool is no obstacle to it.
TEST(WorkpieceStoreTest, AnAttachedWorkpieceHasNoSnapshotUntilItIsDetached) {
  WorkpieceStore store;
  store.set(triangleAt(1), atSecond(9));
  store.attach(store.snapshot()[0], Eigen::Isometry3d::Identity());
  EXPECT_TRUE(store.snapshot().empty());
  EXPECT_TRUE(store.frames()->empty());
  EXPECT_EQ(store.attached(kId)->workpiece->stamp, atSecond(1));
  EXPECT_FALSE(store.remove(kId, atSecond(2)));
  EXPECT_TRUE(store.attached(kId));
  store.detach(triangleAt(3));
  EXPECT_FALSE(store.attached(kId));
  EXPECT_EQ(store.snapshot().at(0)->stamp, atSecond(3));
}

TEST(WorkpieceStoreTest, AnAttachedWorkpieceHasToKeepItsShape) {
  WorkpieceStore store;
  store.set(triangleAt(1), atSecond(9));
  store.attach(store.snapshot()[0], Eigen::Isometry3d::Identity());
  EXPECT_EQ(store.deform(raised(2), atSecond(9)), UpdateOutcome::kStored);
  EXPECT_EQ(store.set(triangleAt(3), atSecond(9)), UpdateOutcome::kStored);
  const std::vector<float> larger = {0, 0, 2, 1.01F, 0, 2, 0, 1, 2};
  const auto refused = [](const std::function<void()>& update) { return has(refusal(update), "detach it first"); };
  EXPECT_TRUE(refused([&] { store.deform({kId, 7, atSecond(4), {}, kFrame, larger}, atSecond(9)); }));
  EXPECT_TRUE(refused([&] { store.deform({kId, 8, atSecond(4), {}, kFrame, kRaised}, atSecond(9)); }));
  EXPECT_TRUE(refused([&] { store.set(turned(4), atSecond(9)); }));
  EXPECT_TRUE(store.snapshot().empty());
}

// It is not said to deform by what its sender has rounded.
TEST(WorkpieceStoreTest, AnAttachedWorkpieceKeepsItsShapeThoughItsVerticesAreRounded) {
  WorkpieceStore store;
  store.set(triangleAt(1), atSecond(9));
  store.attach(store.snapshot()[0], Eigen::Isometry3d::Identity());
  const auto at = [&](float place) {
    const double turned = std::sqrt(0.5);
    return std::vector<float>{place,
                              place,
                              0,
                              static_cast<float>(place + turned),
                              static_cast<float>(place + turned),
                              0,
                              static_cast<float>(place - turned),
                              static_cast<float>(place + turned),
                              0};
  };
  const auto answer = [&](const std::vector<float>& positions) {
    return refusal([&] { store.deform({kId, 7, atSecond(2), {}, kFrame, positions}, atSecond(9)); });
  };
  EXPECT_EQ(answer(at(0.0F)), "");
  EXPECT_EQ(answer(at(130'001.0F)), "");
  EXPECT_TRUE(has(answer(at(4'000'001.0F)), "float32 rounds coordinates of 4000 km"));
}

// So that nobody finds the payload neither in the tool nor among the workpieces.
TEST(WorkpieceStoreTest, GivesSnapshotsOnlyBesideAToolWithThePayloadsThatAreAttached) {
  WorkpieceStore store;
  store.set(triangleAt(1), atSecond(9));
  EXPECT_EQ(store.snapshotBeside({}).size(), 1U);
  store.attach(store.snapshot()[0], Eigen::Isometry3d::Identity());
  EXPECT_TRUE(store.snapshotBeside({kId}).empty());
  EXPECT_THROW(store.snapshotBeside({}), Error);
  EXPECT_THROW(store.snapshotBeside({kId, "another"}), Error);
}

TEST(WorkpieceStoreTest, AttachesOnlyWhatIsStillThere) {
  WorkpieceStore store;
  store.set(triangleAt(1), atSecond(9));
  const auto old = store.snapshot()[0];
  store.deform(raised(2), atSecond(9));
  store.set(turned(3), atSecond(9));
  EXPECT_TRUE(has(refusal([&] { store.attach(old, Eigen::Isometry3d::Identity()); }), "was replaced meanwhile"));
  store.remove(kId, atSecond(4));
  EXPECT_TRUE(has(refusal([&] { store.attach(old, Eigen::Isometry3d::Identity()); }), "was replaced meanwhile"));
}

// A latched publisher sends its mesh again whenever a connection is made.
TEST(WorkpieceStoreTest, IgnoresAnOlderCopyOfTheRevisionInForce) {
  int changes = 0;
  WorkpieceStore store([&](const auto&) { ++changes; });
  EXPECT_EQ(store.set(triangleAt(1), atSecond(9)), UpdateOutcome::kStored);
  EXPECT_EQ(store.deform(raised(3), atSecond(9)), UpdateOutcome::kStored);
  const auto before = store.snapshot()[0];
  EXPECT_EQ(store.set(triangleAt(1), atSecond(9)), UpdateOutcome::kIgnored);
  EXPECT_EQ(store.set(triangleAt(2), atSecond(9)), UpdateOutcome::kIgnored);
  EXPECT_EQ(changes, 2);
  EXPECT_EQ(store.snapshot()[0], before);
  EXPECT_EQ(before->stamp, atSecond(3));
  EXPECT_EQ(before->mesh_M.vertex(0).z(), 2.0);
  EXPECT_EQ(before->updates, 1U);
  EXPECT_NEAR(before->path_length, 2.0, 1e-6);
  EXPECT_EQ(store.deform(raised(4), atSecond(9)), UpdateOutcome::kStored);
}

TEST(WorkpieceStoreTest, AnEqualCopyIsNoRefusal) {
  WorkpieceStore store;
  store.set(triangleAt(1), atSecond(9));
  EXPECT_EQ(store.set(triangleAt(1), atSecond(9)), UpdateOutcome::kStored);
}

// Vertices may name another frame than their mesh.
TEST(WorkpieceStoreTest, IgnoresAnOlderCopyOfAMeshWhoseVerticesCameInAnotherFrame) {
  WorkpieceStore store;
  store.set(triangleAt(1), atSecond(9));
  Deformation moved{kId, 7, atSecond(2), {}, kOtherFrame, kRaised};
  store.deform(moved, atSecond(9));
  EXPECT_EQ(store.set(triangleAt(1), atSecond(9)), UpdateOutcome::kIgnored);
  EXPECT_EQ(*store.frames(), std::set<std::string>{kOtherFrame});
}

TEST(WorkpieceStoreTest, IgnoresVerticesFromBeforeTheRemoval) {
  WorkpieceStore store;
  EXPECT_EQ(store.deform(raised(1), atSecond(9)), UpdateOutcome::kUnknownWorkpiece);
  store.set(triangleAt(1), atSecond(9));
  EXPECT_TRUE(store.remove(kId, atSecond(5)));
  EXPECT_EQ(store.deform(raised(4), atSecond(9)), UpdateOutcome::kIgnored);
  EXPECT_EQ(store.deform(raised(5), atSecond(9)), UpdateOutcome::kIgnored);
  EXPECT_EQ(store.deform(raised(6), atSecond(9)), UpdateOutcome::kUnknownWorkpiece);
  EXPECT_TRUE(store.snapshot().empty());
  const std::string other = "spleen";
  EXPECT_EQ(store.deform({other, 7, atSecond(4), {}, kFrame, kRaised}, atSecond(9)), UpdateOutcome::kUnknownWorkpiece);
}

Deformation unchanged(int stamp, const std::string& frame = kFrame, std::uint32_t revision = 7) {
  static const std::vector<float> kNone;
  return {kId, revision, atSecond(stamp), {}, frame, kNone};
}

TEST(WorkpieceStoreTest, WithoutPositionsAnUpdateConfirmsTheSnapshotAndChangesNothing) {
  int changes = 0;
  WorkpieceStore store([&](const auto&) { ++changes; });
  store.set(triangleAt(1), atSecond(9));
  store.deform(raised(2), atSecond(9));
  const auto before = store.snapshot()[0];
  EXPECT_EQ(store.deform(unchanged(2), atSecond(9)), UpdateOutcome::kConfirmed);
  EXPECT_EQ(store.deform(unchanged(5), atSecond(9)), UpdateOutcome::kConfirmed);
  EXPECT_EQ(store.snapshot()[0], before);
  EXPECT_EQ(changes, 2);
  EXPECT_EQ(store.deform(raised(3), atSecond(9)), UpdateOutcome::kStored) << "what it confirms keeps its stamp";
}

// It comes on another topic than the mesh, and may be there first.
TEST(WorkpieceStoreTest, WhatConfirmsAnotherSnapshotIsIgnored) {
  WorkpieceStore store;
  EXPECT_EQ(store.deform(unchanged(1), atSecond(9)), UpdateOutcome::kIgnored);
  store.set(triangleAt(3), atSecond(9));
  EXPECT_EQ(store.deform(unchanged(2), atSecond(9)), UpdateOutcome::kIgnored) << "older";
  EXPECT_EQ(store.deform(unchanged(4, kOtherFrame), atSecond(9)), UpdateOutcome::kIgnored);
  EXPECT_EQ(store.deform(unchanged(4, kFrame, 8), atSecond(9)), UpdateOutcome::kIgnored);
  store.remove(kId, atSecond(5));
  EXPECT_EQ(store.deform(unchanged(6), atSecond(9)), UpdateOutcome::kIgnored);
}

TEST(WorkpieceStoreTest, AnAttachedWorkpieceIsConfirmedToo) {
  WorkpieceStore store;
  store.set(triangleAt(1), atSecond(9));
  store.attach(store.snapshot()[0], Eigen::Isometry3d::Identity());
  EXPECT_EQ(store.deform(unchanged(2), atSecond(9)), UpdateOutcome::kConfirmed);
  EXPECT_EQ(store.deform(unchanged(2, kFrame, 8), atSecond(9)), UpdateOutcome::kIgnored);
}

TEST(WorkpieceStoreTest, ADeformationKeepsThePadding) {
  WorkpieceStore store;
  Workpiece padded = triangleAt(1);
  padded.mesh_M.pad(0.01);
  store.set(padded, atSecond(9));
  store.deform(raised(2), atSecond(9));
  store.deform(raised(3), atSecond(9));
  EXPECT_EQ(store.snapshot()[0]->mesh_M.padding(), 0.01);
}

// `rostopic pub` stamps with 0.
TEST(WorkpieceStoreTest, ARemovalWithoutAStampCountsFromTheNewestVertices) {
  WorkpieceStore store;
  store.set(triangleAt(1), atSecond(9));
  store.deform(raised(3), atSecond(9));
  EXPECT_TRUE(store.remove(kId, Time()));
  EXPECT_EQ(store.deform(raised(3), atSecond(9)), UpdateOutcome::kIgnored);
  EXPECT_EQ(store.deform(raised(4), atSecond(9)), UpdateOutcome::kUnknownWorkpiece);
}

TEST(WorkpieceStoreTest, ARemovedWorkpieceMayComeBackWithAnyStamp) {
  WorkpieceStore store;
  setAndRemove(store, 3);
  EXPECT_EQ(store.set(triangleAt(1), atSecond(9)), UpdateOutcome::kStored);
  EXPECT_EQ(store.deform(raised(2), atSecond(9)), UpdateOutcome::kStored);
}

TEST(WorkpieceStoreTest, ForgetsRemovalsWhenTimeWentBack) {
  WorkpieceStore store;
  setAndRemove(store, 5);
  store.clearStamps();
  EXPECT_EQ(store.deform(raised(1), atSecond(9)), UpdateOutcome::kUnknownWorkpiece);
}

TEST(WorkpieceStoreTest, RemembersTheNewestSixtyFourRemovals) {
  WorkpieceStore store;
  const auto idOf = [](int i) { return "ghost" + std::to_string(i); };
  for (int i = 0; i < 1000; ++i) {
    Workpiece ghost = triangleAt(1);
    ghost.id = idOf(i);
    store.set(ghost, atSecond(9));
    ASSERT_TRUE(store.remove(ghost.id, atSecond(2)));
  }
  for (int i = 0; i < 1000; ++i) {
    const std::string id = idOf(i);
    const auto expected = i < 1000 - 64 ? UpdateOutcome::kUnknownWorkpiece : UpdateOutcome::kIgnored;
    ASSERT_EQ(store.deform({id, 7, atSecond(1), {}, kFrame, kRaised}, atSecond(9)), expected) << id;
  }
}

std::shared_ptr<const Workpiece> imageAt(int seconds) {
  Workpiece image = triangleAt(seconds);
  image.id = "camera";
  image.of_camera = true;
  return std::make_shared<const Workpiece>(std::move(image));
}

TEST(WorkpieceStoreTest, ShowsTheNewestImageOfACamera) {
  WorkpieceStore store;
  for (const int seconds : {1, 2}) store.show(imageAt(seconds), atSecond(9));
  EXPECT_EQ(store.snapshot().at(0)->stamp, atSecond(2));
  EXPECT_THROW(store.show(imageAt(1), atSecond(9)), InvalidInput);
  store.show(imageAt(1), atSecond(1.5));  // time went back
  EXPECT_EQ(store.snapshot().at(0)->stamp, atSecond(1));
}

// A mesh or a keep-alive by the name of a camera would hide what it no longer sees.
TEST(WorkpieceStoreTest, NothingButItsImagesChangesWhatACameraSees) {
  WorkpieceStore store;
  store.show(imageAt(1), atSecond(9));
  Workpiece mesh = triangleAt(2);
  mesh.id = "camera";
  EXPECT_THROW(store.set(mesh, atSecond(9)), InvalidInput);
  EXPECT_THROW(store.deform({mesh.id, 7, atSecond(2), {}, kFrame, kRaised}, atSecond(9)), InvalidInput);
  EXPECT_EQ(store.deform({mesh.id, 7, atSecond(2), {}, kFrame, {}}, atSecond(9)), UpdateOutcome::kIgnored);
  EXPECT_THROW(store.remove("camera", atSecond(2)), InvalidInput);
  EXPECT_EQ(store.snapshot().at(0)->stamp, atSecond(1));
}

TEST(WorkpieceStoreTest, ACameraTakesTheNameOfNoMesh) {
  WorkpieceStore store;
  Workpiece mesh = triangleAt(1);
  mesh.id = "camera";
  store.set(mesh, atSecond(9));
  EXPECT_THROW(store.show(imageAt(2), atSecond(9)), InvalidInput);
}

}  // namespace
}  // namespace sweep_guard_core
