#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "data_path.h"
#include "evaluation/obstacle_placement.h"
#include "recording/recording.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_evaluation {
namespace {

using namespace std::chrono_literals;
using namespace sweep_guard_core;

constexpr Duration kHoldTime = 500ms;
const double kDeviations = deviationsAt(PredictionInterval::kReflex, WarningThresholds{}.reflex);
constexpr Duration kReflexInterval = 115ms;  // the interval and a tick
constexpr size_t kObstacles = 6;
const ConvexShape kTool = ConvexShape::cylinder(0.005, 0.1);

Instant instantOf(Time time) { return {time, SteadyTime(time.time_since_epoch())}; }

/// REFLEX by one threshold and one expected contact for all workpieces: the rule before CONSIDERED had thresholds.
class SingleThreshold {
 public:
  void predicted(const Prediction& prediction, Time now) {
    if (start_ && left(now) <= kReflexInterval) ended_ = now - sinceEnd(now);
    start_.reset();
    for (const PredictedObject& object : prediction.objects) {
      const auto warns = [](const PredictedSweep& one) { return one.contact || one.deviations <= kDeviations; };
      const auto sweep = std::find_if(object.sweeps.begin(), object.sweeps.end(), warns);
      if (sweep == object.sweeps.end()) continue;
      const Time start = prediction.stamp + sweep->from;
      start_ = std::min(start_.value_or(start), start);
    }
    end_ = prediction.coveredUntil();
  }

  bool isReflexAt(Time now) const {
    const bool current = start_ && sinceEnd(now) <= kHoldTime && left(now) <= kReflexInterval;
    return current || (ended_ && now - *ended_ <= kHoldTime);
  }

 private:
  Duration sinceEnd(Time now) const { return std::max(Duration::zero(), now - end_); }
  Duration left(Time now) const { return *start_ - now + sinceEnd(now); }

  std::optional<Time> start_;  // of the earliest contact
  std::optional<Time> ended_;
  Time end_;
};

/// Runs a guard along a recording, beside obstacles that stay for its whole length.
class Session {
 public:
  explicit Session(const std::vector<StampedPose>& poses) {
    for (const ObstaclePlacement& each : placeObstacles(RecordedMotion(poses), kTool, kObstacles, 1)) {
      const Instant at = instantOf(poses.front().stamp);
      const std::string id = std::to_string(workpieces_.size());
      workpieces_.push_back(
          std::make_shared<const Workpiece>(Workpiece{id, 1, at.stamp, at.steady, "world", meshOf(each.obstacle)}));
    }
    monitor_.setWorkpieces(workpieces_);
  }

  void addPose(const StampedPose& pose) {
    for (Time time = newest_ + 10ms; time < pose.stamp && time < newest_ + 2s; time += 10ms) compareAt(time);
    const Instant at = instantOf(pose.stamp);
    guard_.sweep({at.stamp, at.steady, pose.X_WT, {{"world", Eigen::Isometry3d::Identity()}}}, workpieces_, report_);
    guard_.predict(Duration(0), workpieces_, prediction_);
    monitor_.swept(report_, {at.stamp, at.steady}, {}, at.steady);
    monitor_.predicted(prediction_, {at.stamp, at.steady}, {}, at);
    before_.predicted(prediction_, at.stamp);
    compareAt(pose.stamp);
    newest_ = pose.stamp;
  }

  size_t differences = 0;
  size_t in_reflex = 0;

 private:
  static GuardOptions withoutTimeLimit() {
    GuardOptions options;
    options.clock = [] { return SteadyTime(); };
    return options;
  }

  void compareAt(Time time) {
    monitor_.warning(instantOf(time), warning_);
    if (warning_.level == WarningLevel::kContact) return;
    const bool reflex = warning_.level == WarningLevel::kReflex;
    in_reflex += reflex ? 1 : 0;
    differences += reflex == before_.isReflexAt(time) ? 0 : 1;
  }

  Workpieces workpieces_;
  Guard guard_{Tool(kTool), makeDetector("halfspace"), withoutTimeLimit()};
  WarningMonitor monitor_{{100ms, Duration::max(), kHoldTime}};
  SingleThreshold before_;
  SweepReport report_;
  Prediction prediction_;
  Warning warning_;
  Time newest_;
};

constexpr size_t kPoses = 5000;

class ReflexTraceTest : public testing::TestWithParam<const char*> {};

TEST_P(ReflexTraceTest, IsThatOfOneThresholdForAll) {
  const std::filesystem::path file = dataPath("motion") / GetParam();
  if (!std::filesystem::exists(file)) GTEST_SKIP() << missing(file);
  auto poses = sweep_guard_recording::readRecording(file, "").poses;
  poses.resize(std::min(poses.size(), kPoses));
  Session session(poses);
  for (const StampedPose& pose : poses) session.addPose(pose);
  EXPECT_EQ(session.differences, 0U);
  EXPECT_GT(session.in_reflex, 0U);
}

INSTANTIATE_TEST_SUITE_P(Recordings, ReflexTraceTest,
                         testing::Values("handheld_camera_fr2_desk.txt", "handheld_rig_room1.txt",
                                         "handheld_stylus_15hz.txt", "handheld_vicon.txt", "robot_arm.txt"),
                         [](const auto& test) { return std::filesystem::path(test.param).stem().string(); });

}  // namespace
}  // namespace sweep_guard_evaluation
