#include "sweep_guard/motion/motion_permission.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <memory>
#include <optional>

#include "motion/times.h"
#include "sweep_guard/monitor/reason.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

// At 1000 ms, all inputs are 10 ms old and the level is CLEAR.
class MotionPermissionTest : public testing::Test {
 protected:
  MotionPermissionTest() {
    inputs_.warning = MotionInputs::GuardWarning{WarningLevel::kClear, 0, at(990).steady};
    planes_->timestamps = received(990);
    planes_->valid_until = at(1140).stamp;
    planes_->complete = true;
    inputs_.planes = planes_;
    inputs_.tool = std::make_shared<ToolBalls>();
    inputs_.pose = MotionInputs::ToolPose{Eigen::Isometry3d::Identity(), received(990)};
  }

  void expect(Permission permission, PermissionCause cause, int ms = 1000) const {
    const PermissionDecision decision = decidePermission(inputs_, command_, at(ms), limits_);
    EXPECT_EQ(static_cast<int>(decision.permission), static_cast<int>(permission));
    EXPECT_EQ(std::string(textOf(decision.cause)), textOf(cause));
  }

  // The tool may move with the oldest value, and stops at the next older one.
  template <typename TimePoint>
  void expectLimit(TimePoint& value, TimePoint oldest, TimePoint older, PermissionCause cause) {
    value = oldest;
    expect(Permission::kLimited, PermissionCause::kGuarded);
    value = older;
    expect(Permission::kStop, cause);
  }

  std::optional<Timestamps> command_ = received(990);
  const std::shared_ptr<PlaneSet> planes_ = std::make_shared<PlaneSet>();
  MotionInputs inputs_;
  MotionGuardOptions limits_;
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
  command_ = {at(1000).stamp, at(899).steady};
  expect(Permission::kStop, PermissionCause::kOldCommand);
  command_ = {at(899).stamp, at(1000).steady};
  expect(Permission::kStop, PermissionCause::kOldCommand);
  command_ = {at(900).stamp, at(900).steady};
  expect(Permission::kLimited, PermissionCause::kGuarded);
  command_.reset();
  expect(Permission::kStop, PermissionCause::kNoCommand);
}

TEST_F(MotionPermissionTest, NeedsAWarningWithinTheSilence) {
  expectLimit(inputs_.warning->received, at(850).steady, at(849).steady, PermissionCause::kWarningSilent);
  inputs_.warning.reset();
  expect(Permission::kStop, PermissionCause::kNoWarning);
}

TEST_F(MotionPermissionTest, NeedsALevel) {
  inputs_.warning->level = WarningLevel::kUnknown;
  expect(Permission::kStop, PermissionCause::kUnknown);
}

TEST_F(MotionPermissionTest, WhereNoCameraSeesAloneIsNoReasonToStop) {
  inputs_.warning->reasons = kNotSeen;
  expect(Permission::kLimited, PermissionCause::kUnseen);
  inputs_.warning->level = WarningLevel::kUnknown;
  inputs_.warning->reasons = kNotSeen | kOverload;
  expect(Permission::kLimited, PermissionCause::kUnseen);
  inputs_.warning->reasons = kNotSeen | kPoseStale;
  expect(Permission::kStop, PermissionCause::kUnknown);
  inputs_.warning->reasons = kOverload;
  expect(Permission::kStop, PermissionCause::kUnknown);
}

TEST_F(MotionPermissionTest, NeedsPlanesWithinTheSilence) {
  expectLimit(planes_->timestamps.received, at(850).steady, at(849).steady, PermissionCause::kPlanesSilent);
  inputs_.planes.reset();
  expect(Permission::kStop, PermissionCause::kNoPlanes);
}

TEST_F(MotionPermissionTest, NeedsPlanesThatAreValid) {
  expectLimit(planes_->valid_until, at(1000).stamp, at(999).stamp, PermissionCause::kPlanesExpired);
}

TEST_F(MotionPermissionTest, NeedsAPoseWithinTheSilence) {
  expectLimit(inputs_.pose->timestamps.received, at(850).steady, at(849).steady, PermissionCause::kPoseSilent);
  inputs_.pose.reset();
  expect(Permission::kStop, PermissionCause::kNoPose);
}

TEST_F(MotionPermissionTest, NeedsAPoseThatIsNotOldByItsStamp) {
  expectLimit(inputs_.pose->timestamps.stamp, at(500).stamp, at(499).stamp, PermissionCause::kOldPose);
}

TEST_F(MotionPermissionTest, NeedsPlanesOfAllWorkpiecesForAKnownTool) {
  limits_.escape_speed = 0.01;  // never with these
  inputs_.tool.reset();
  expect(Permission::kStop, PermissionCause::kNoTool);
  planes_->complete = false;
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
  planes_->timestamps = received(500);
  expect(Permission::kEscape, PermissionCause::kUnknown);
  planes_->timestamps = {at(499).stamp, at(500).steady};
  expect(Permission::kStop, PermissionCause::kUnknown);
  planes_->timestamps = {at(500).stamp, at(499).steady};
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
  planes_->timestamps = received(600);
  expect(Permission::kEscape, PermissionCause::kPlanesSilent);
  planes_->timestamps = received(990);
  planes_->valid_until = at(999).stamp;
  expect(Permission::kEscape, PermissionCause::kPlanesExpired);
}

TEST_F(EscapeTest, NeedsAPoseThatIsYoungOnBothClocks) {
  inputs_.pose->timestamps = received(500);
  expect(Permission::kEscape, PermissionCause::kUnknown);
  inputs_.pose->timestamps = {at(499).stamp, at(500).steady};
  expect(Permission::kStop, PermissionCause::kUnknown);
  inputs_.pose->timestamps = {at(500).stamp, at(499).steady};
  expect(Permission::kStop, PermissionCause::kUnknown);
  inputs_.pose.reset();
  expect(Permission::kStop, PermissionCause::kUnknown);
}

TEST(PermissionCauseTest, EveryCauseHasWords) {
  for (int cause = 0; cause <= static_cast<int>(PermissionCause::kDeviceSilent); ++cause) {
    EXPECT_GT(std::string(textOf(static_cast<PermissionCause>(cause))).size(), 5U) << cause;
  }
}

}  // namespace
}  // namespace sweep_guard_core
