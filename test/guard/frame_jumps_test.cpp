#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "guard/fake_detector.h"
#include "guard/guard_results.h"
#include "guard/times.h"

namespace sweep_guard_core {
namespace {

Eigen::Isometry3d shifted(double x) { return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)); }

std::shared_ptr<const Workpiece> farTriangleIn(const std::string& frame) {
  return std::make_shared<const Workpiece>(Workpiece{"in " + frame, 0, atSecond(0.0), SteadyTime{}, frame,
                                                     TriangleMesh({{-1, -1, 5}, {1, -1, 5}, {0, 1, 5}}, {{0, 1, 2}})});
}

// A tool, a tray and the world, with the default limits of 5 m/s and 20 rad/s.
class FrameJumpsTest : public testing::Test {
 protected:
  static PoseWithFrames poseAt(double seconds, double tool, double tray) {
    PoseWithFrames pose{atSecond(seconds), SteadyTime(fromSeconds(seconds)), shifted(tool), {}};
    pose.X_WM = {{"world", shifted(0.0)}, {"tray", shifted(tray)}};
    return pose;
  }

  std::set<std::string> jumpsTo(const PoseWithFrames& pose) {
    std::set<std::string> frames;
    for (const auto& [frame, speed] : reportOf(guard_, pose, workpieces_).jumps) frames.insert(frame);
    return frames;
  }
  std::set<std::string> jumpsTo(double seconds, double tool, double tray) {
    return jumpsTo(poseAt(seconds, tool, tray));
  }

  const std::set<std::string> none_ = {};
  const Workpieces workpieces_ = {farTriangleIn("world"), farTriangleIn("tray")};
  FakeDetector::Record record_;
  Guard guard_{Tool::cylinder(0.005, 0.1), std::make_unique<FakeDetector>(record_), {}};
};

TEST_F(FrameJumpsTest, AToolThatJumpsDoesSoAgainstEachFrame) {
  EXPECT_EQ(jumpsTo(1.00, 0.0, 0.0), none_);
  EXPECT_EQ(jumpsTo(1.01, 0.0, 0.0), none_);
  EXPECT_EQ(jumpsTo(1.02, 0.5, 0.0), (std::set<std::string>{"tray", "world"}));
  EXPECT_EQ(jumpsTo(1.03, 0.5, 0.0), none_) << "it stays there";
}

TEST_F(FrameJumpsTest, AWorkpieceThatJumpsDoesSoAlone) {
  jumpsTo(1.00, 0.0, 0.0);
  EXPECT_EQ(jumpsTo(1.01, 0.0, 0.5), std::set<std::string>{"tray"});
  PoseWithFrames turned = poseAt(1.02, 0.0, 0.5);
  turned.X_WM["tray"].linear() = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitX()).toRotationMatrix();
  EXPECT_EQ(jumpsTo(turned), std::set<std::string>{"tray"});
}

TEST_F(FrameJumpsTest, ABaseThatCarriesToolAndTrayJumpsAgainstTheWorldOnly) {
  jumpsTo(1.00, 0.2, 0.0);
  EXPECT_EQ(jumpsTo(1.01, 1.2, 1.0), std::set<std::string>{"world"});
}

TEST_F(FrameJumpsTest, MotionWithinTheLimitsIsNone) {
  for (const double period : {0.001, 0.01, 0.05}) {
    guard_.reset();
    for (int i = 0; i < 100; ++i) {
      const double jitter = i % 2 == 0 ? 0.4 * std::min(period, 0.002) : 0.0;
      ASSERT_EQ(jumpsTo(1.0 + period * i + jitter, 2.0 * period * i, -2.0 * period * i), none_)
          << period << ", pose " << i;
    }
  }
}

TEST_F(FrameJumpsTest, AJumpAmongPassedPosesIsReportedOnce) {
  jumpsTo(1.0, 0.0, 0.0);
  for (int ms = 1; ms < 10; ++ms) guard_.pass(poseAt(1.0 + 1e-3 * ms, 0.0, ms < 5 ? 0.0 : 0.7));
  EXPECT_EQ(jumpsTo(1.01, 0.0, 0.7), std::set<std::string>{"tray"});
  EXPECT_EQ(jumpsTo(1.011, 0.0, 0.7), none_);
}

// The tray is placed 3 m from where it was: the way of the last 50 ms is swept there once more, in no time.
TEST_F(FrameJumpsTest, AWayThatIsRepeatedWhereSomethingWasPlacedAnewIsNone) {
  const double speed = 4.9;  // [m/s]
  for (int i = 0; i < 10; ++i) EXPECT_EQ(jumpsTo(1.0 + 0.05 * i, 0.05 * speed * i, 0.0), none_);
  PoseWithFrames old = poseAt(1.5, 0.5 * speed, 0.0);
  old.stamp -= Duration(1);
  guard_.pass(old);
  for (const double time : {0.45, 0.46, 0.49}) {
    PoseWithFrames again = poseAt(1.5, speed * time, 3.0);
    again.anew = PlacedAnew{/*tool=*/false, {"tray"}, /*goes_on=*/time > 0.45};
    guard_.pass(again);
  }
  for (int i = 10; i < 20; ++i) EXPECT_EQ(jumpsTo(1.0 + 0.05 * i, 0.05 * speed * i, 3.0), none_) << i;
}

// Whatever it was that jumped, and in however many parts: 2.6 rad within 8 ms are not 20 rad/s from there on.
TEST_F(FrameJumpsTest, PredictionIsRightAgainTwoPosesAfterAJump) {
  for (int i = 0; i < 100; ++i) jumpsTo(1.0 + 0.008 * i, 1e-3 * i, 0.0);
  for (int part = 1; part <= 100; ++part) {
    PoseWithFrames pose = poseAt(1.792 + 8e-5 * part, 0.099 + 1e-5 * part, 0.0);
    pose.X_WT.linear() = Eigen::AngleAxisd(0.026 * part, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.bodies = {{pose.X_WT}};
    pose.jump = "joint 'wrist' jumped: 130 rad/s";
    if (part < 100) {
      guard_.pass(pose);
    } else {
      EXPECT_EQ(reportOf(guard_, pose, workpieces_).jump, pose.jump);
    }
  }
  PoseWithFrames next = poseAt(1.808, 0.101, 0.0);
  next.X_WT.linear() = Eigen::AngleAxisd(2.6, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  next.bodies = {{next.X_WT}};
  EXPECT_EQ(reportOf(guard_, next, workpieces_).jump, "");
  const PredictedPath path = guard_.predictMotion({}, fromSeconds(0.1)).path;
  ASSERT_FALSE(path.empty());
  const Moved moved = movedBetween(next.X_WT, path.back().X_WT);
  EXPECT_NEAR(moved.distance, 0.0125, 0.005);
  EXPECT_LT(moved.turn, 0.05);
}

}  // namespace
}  // namespace sweep_guard_core
