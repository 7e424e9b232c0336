#include "monitor/warning_monitor_fixture.h"

namespace sweep_guard_core {
namespace {

TEST_F(WarningMonitorTest, ARefusedMeshCountsUntilItsNextGoodOne) {
  monitor_.meshRefused("liver", "NaN vertex", at(1000).steady);
  EXPECT_EQ(reasonsAt(1000), kMeshInvalid);
  monitor_.meshAccepted("spleen", at(1000).steady);
  sweep(reportOf(workpieces_), 1050);
  EXPECT_EQ(reasonsAt(1050), kMeshInvalid);
  monitor_.meshAccepted("liver", at(1000).steady);
  EXPECT_EQ(levelAt(1050), WarningLevel::kClear);
}

// What the refused mesh announced is still unknown, however good the vertices of the one before are.
TEST_F(WarningMonitorTest, ARefusedMeshIsNotClearedByVertices) {
  monitor_.meshRefused("liver", "too large", at(1000).steady);
  monitor_.verticesRefused("liver", "wrong revision", at(1000).steady);
  monitor_.verticesAccepted("liver", at(1000).steady);
  sweep(reportOf(workpieces_), 1050);
  EXPECT_EQ(reasonsAt(1050), kMeshInvalid);
  EXPECT_TRUE(has(warningOf(monitor_, at(1050)).text, "too large"));
  monitor_.meshAccepted("liver", at(1000).steady);
  EXPECT_EQ(levelAt(1050), WarningLevel::kClear);
}

TEST_F(WarningMonitorTest, RefusedVerticesAreClearedByGoodVerticesAndByAMesh) {
  monitor_.verticesRefused("liver", "NaN vertex", at(1000).steady);
  EXPECT_EQ(reasonsAt(1000), kMeshInvalid);
  monitor_.verticesAccepted("liver", at(1000).steady);
  EXPECT_EQ(levelAt(1000), WarningLevel::kClear);
  monitor_.verticesRefused("liver", "NaN vertex", at(1000).steady);
  monitor_.meshAccepted("liver", at(1000).steady);
  EXPECT_EQ(levelAt(1000), WarningLevel::kClear);
}

// Nobody knows where it is: as long as it is neither sent well nor removed, nothing is clear.
TEST_F(WarningMonitorTest, ARefusedMeshOfAnUnknownWorkpieceIsNotForgotten) {
  monitor_.meshRefused("ghost", "NaN vertex", at(1000).steady);
  EXPECT_NE(reasonsAt(1000000) & kMeshInvalid, 0U);
}

TEST_F(WarningMonitorTest, AFloodOfRefusedMeshesIsNotClearWhenSomeAreAccepted) {
  for (int i = 0; i < 2000; ++i) monitor_.meshRefused("ghost" + std::to_string(i), "no mesh", at(1000).steady);
  for (int i = 0; i < 50; ++i) monitor_.meshAccepted("ghost" + std::to_string(i), at(1000).steady);
  EXPECT_NE(reasonsAt(1000) & kMeshInvalid, 0U);
}

// A mesh is converted after it was received, and refused sooner than the mesh before it is accepted.
TEST_F(WarningMonitorTest, ARefusalOutlastsMessagesThatWereReceivedBefore) {
  monitor_.meshRefused("liver", "NaN vertex", at(1002).steady);
  monitor_.verticesRefused("liver", "wrong revision", at(1002).steady);
  monitor_.meshAccepted("liver", at(1001).steady);
  monitor_.verticesAccepted("liver", at(1003).steady);
  EXPECT_EQ(reasonsAt(1003), kMeshInvalid);
  EXPECT_FALSE(monitor_.meshProblems(at(1003), {"liver"}).empty());
  monitor_.meshAccepted("liver", at(1003).steady);
  EXPECT_EQ(reasonsAt(1003), 0U);
}

// Of which of them it was, nobody knows any more.
TEST_F(WarningMonitorTest, ARefusedMeshBeyondThoseThatAreKeptIsNeverAccepted) {
  const auto ghost = [](int i) { return "ghost" + std::to_string(i); };
  for (int i = 0; i < 1025; ++i) monitor_.meshRefused(ghost(i), "no mesh", at(1000).steady);
  EXPECT_EQ(monitor_.meshProblems(at(1000), {"liver"}),
            "no mesh (and more than 1024 other workpieces: start the guard again)");
  for (int i = 0; i < 1024; ++i) monitor_.meshAccepted(ghost(i), at(1000).steady);
  EXPECT_EQ(reasonsAt(1000), kMeshInvalid);
  monitor_.restart();
  EXPECT_NE(reasonsAt(1000) & kMeshInvalid, 0U);
}

TEST_F(WarningMonitorTest, EveryWorkpieceThatThereMayBeIsRefusedAndAcceptedForItself) {
  const auto id = [](int i) { return "one" + std::to_string(i); };
  for (int i = 0; i < 1000; ++i) monitor_.verticesRefused(id(i), "NaN vertex", at(1000).steady);
  EXPECT_EQ(monitor_.meshProblems(at(1000), {"liver"}), "");
  for (int i = 0; i < 1000; ++i) monitor_.verticesAccepted(id(i), at(1000).steady);
  EXPECT_EQ(reasonsAt(1000), 0U);
}

TEST_F(WarningMonitorTest, AFloodOfRefusedMeshesHidesNone) {
  for (int i = 0; i < 2000; ++i) monitor_.meshRefused("ghost" + std::to_string(i), "no mesh", at(1000).steady);
  monitor_.meshRefused("liver", "'liver' refused: NaN vertex", at(1000).steady);
  EXPECT_NE(monitor_.meshProblems(at(1000), {"liver"}), "");
  EXPECT_LT(monitor_.meshProblems(at(1000), {}).size(), 200U);
  EXPECT_LT(warningOf(monitor_, at(1000)).text.size(), 200U);
}

}  // namespace
}  // namespace sweep_guard_core
