#include "sweep_guard/motion/motion_permission.h"

#include <gtest/gtest.h>

#include <initializer_list>

#include "motion/times.h"
#include "sweep_guard/monitor/reason.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

// At 1000 ms, all inputs are 10 ms old and the level is CLEAR.
class MotionPermissionTest : public testing::Test {
 protected:
  MotionPermissionTest() {
    inputs_.command = received(990);
    inputs_.warning = PermissionInputs::GuardWarning{WarningLevel::kClear, 0, at(990).steady};
    inputs_.planes = PermissionInputs::Planes{received(990), at(1140).stamp};
    inputs_.pose = received(990);
  }

  void expect(Permission permission, PermissionCause cause, int ms = 1000) const {
    const PermissionDecision decision = decidePermission(inputs_, at(ms), limits_);
    EXPECT_EQ(static_cast<int>(decision.permission), static_cast<int>(permission));
    EXPECT_EQ(std::string(textOf(decision.cause)), textOf(cause));
  }

  PermissionInputs inputs_;
  PermissionLimits limits_;
};

TEST_F(MotionPermissionTest, LimitsAFreshCommandAtEveryLevelButUnknown) {
  for (const WarningLevel level :
       {WarningLevel::kClear, WarningLevel::kConsidered, WarningLevel::kReflex, WarningLevel::kContact}) {
    inputs_.warning->level = level;
    inputs_.warning->reasons = kPoseStale;
    expect(Permission::kLimited, PermissionCause::kGuarded);
  }
}

TEST_F(MotionPermissionTest, NeedsACommandThatIsFreshOnBothClocks) {
  limits_.escape_speed = 0.01;  // never for an old command
  inputs_.command = {at(1000).stamp, at(899).steady};
  expect(Permission::kStop, PermissionCause::kOldCommand);
  inputs_.command = {at(899).stamp, at(1000).steady};
  expect(Permission::kStop, PermissionCause::kOldCommand);
  inputs_.command = {at(900).stamp, at(900).steady};
  expect(Permission::kLimited, PermissionCause::kGuarded);
  inputs_.command.reset();
  expect(Permission::kStop, PermissionCause::kNoCommand);
}

TEST_F(MotionPermissionTest, NeedsAWarningWithinTheSilence) {
  inputs_.warning->received = at(850).steady;
  expect(Permission::kLimited, PermissionCause::kGuarded);
  inputs_.warning->received = at(849).steady;
  expect(Permission::kStop, PermissionCause::kWarningSilent);
  inputs_.warning.reset();
  expect(Permission::kStop, PermissionCause::kNoWarning);
}

TEST_F(MotionPermissionTest, NeedsALevel) {
  inputs_.warning->level = WarningLevel::kUnknown;
  expect(Permission::kStop, PermissionCause::kUnknown);
}

TEST_F(MotionPermissionTest, NeedsPlanesWithinTheSilence) {
  inputs_.planes->timestamps.received = at(850).steady;
  expect(Permission::kLimited, PermissionCause::kGuarded);
  inputs_.planes->timestamps.received = at(849).steady;
  expect(Permission::kStop, PermissionCause::kPlanesSilent);
  inputs_.planes.reset();
  expect(Permission::kStop, PermissionCause::kNoPlanes);
}

TEST_F(MotionPermissionTest, NeedsPlanesThatAreValid) {
  inputs_.planes->valid_until = at(1000).stamp;
  expect(Permission::kLimited, PermissionCause::kGuarded);
  inputs_.planes->valid_until = at(999).stamp;
  expect(Permission::kStop, PermissionCause::kPlanesExpired);
}

TEST_F(MotionPermissionTest, NeedsAPoseWithinTheSilence) {
  inputs_.pose->received = at(850).steady;
  expect(Permission::kLimited, PermissionCause::kGuarded);
  inputs_.pose->received = at(849).steady;
  expect(Permission::kStop, PermissionCause::kPoseSilent);
  inputs_.pose.reset();
  expect(Permission::kStop, PermissionCause::kNoPose);
}

TEST_F(MotionPermissionTest, NeedsAPoseThatIsNotOldByItsStamp) {
  inputs_.pose->stamp = at(500).stamp;
  expect(Permission::kLimited, PermissionCause::kGuarded);
  inputs_.pose->stamp = at(499).stamp;
  expect(Permission::kStop, PermissionCause::kOldPose);
}

TEST_F(MotionPermissionTest, NeedsPlanesOfAllWorkpiecesForAKnownTool) {
  limits_.escape_speed = 0.01;  // never with these
  inputs_.planes->tool_known = false;
  expect(Permission::kStop, PermissionCause::kNoTool);
  inputs_.planes->complete = false;
  expect(Permission::kStop, PermissionCause::kIncomplete);
}

class EscapeTest : public MotionPermissionTest {
 protected:
  EscapeTest() {
    limits_.escape_speed = 0.01;
    inputs_.warning->level = WarningLevel::kUnknown;
  }
};

TEST_F(EscapeTest, NeedsAnEscapeSpeed) {
  expect(Permission::kEscape, PermissionCause::kUnknown);
  limits_.escape_speed = 0.0;
  expect(Permission::kStop, PermissionCause::kUnknown);
}

TEST_F(EscapeTest, IsLeftWhenTheGuardKnowsAgain) {
  inputs_.warning->level = WarningLevel::kContact;
  expect(Permission::kLimited, PermissionCause::kGuarded);
}

TEST_F(EscapeTest, NeedsPlanesThatAreYoungOnBothClocks) {
  inputs_.planes->timestamps = received(500);
  expect(Permission::kEscape, PermissionCause::kUnknown);
  inputs_.planes->timestamps = {at(499).stamp, at(500).steady};
  expect(Permission::kStop, PermissionCause::kUnknown);
  inputs_.planes->timestamps = {at(500).stamp, at(499).steady};
  expect(Permission::kStop, PermissionCause::kUnknown);
  inputs_.planes.reset();
  expect(Permission::kStop, PermissionCause::kUnknown);
}

TEST_F(EscapeTest, NeedsReasonsWithWhichThePlanesAreThoseOfAllSurfaces) {
  for (std::uint32_t reason = kNoPose; reason <= kJump; reason <<= 1U) {
    inputs_.warning->reasons = reason;
    const bool incomplete = reason == kNoMesh || reason == kMeshInvalid || reason == kTfFail || reason == kTimeJump ||
                            reason == kDetectorFault || reason == kNotSwept;
    expect(incomplete ? Permission::kStop : Permission::kEscape, PermissionCause::kUnknown);
  }
}

TEST_F(EscapeTest, IsPossibleWhileTheGuardIsSilent) {
  inputs_.warning->level = WarningLevel::kClear;
  inputs_.warning->received = at(800).steady;
  expect(Permission::kEscape, PermissionCause::kWarningSilent);
  inputs_.warning->reasons = kNotSwept;
  expect(Permission::kStop, PermissionCause::kWarningSilent);
  inputs_.warning.reset();
  expect(Permission::kStop, PermissionCause::kNoWarning);
}

TEST_F(EscapeTest, IsPossibleWithPlanesThatAreSilentOrExpired) {
  inputs_.warning->level = WarningLevel::kClear;
  inputs_.planes->timestamps = received(600);
  expect(Permission::kEscape, PermissionCause::kPlanesSilent);
  inputs_.planes = PermissionInputs::Planes{received(990), at(999).stamp};
  expect(Permission::kEscape, PermissionCause::kPlanesExpired);
}

TEST_F(EscapeTest, NeedsAPoseThatIsYoungOnBothClocks) {
  inputs_.pose = received(500);
  expect(Permission::kEscape, PermissionCause::kUnknown);
  inputs_.pose = {at(499).stamp, at(500).steady};
  expect(Permission::kStop, PermissionCause::kUnknown);
  inputs_.pose = {at(500).stamp, at(499).steady};
  expect(Permission::kStop, PermissionCause::kUnknown);
  inputs_.pose.reset();
  expect(Permission::kStop, PermissionCause::kUnknown);
}

TEST(PermissionCauseTest, EveryCauseHasWords) {
  for (int cause = 0; cause <= static_cast<int>(PermissionCause::kNoTool); ++cause) {
    EXPECT_GT(std::string(textOf(static_cast<PermissionCause>(cause))).size(), 5U) << cause;
  }
}

}  // namespace
}  // namespace sweep_guard_core
