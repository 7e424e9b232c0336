#include <gtest/gtest.h>

#include <exception>

#include "allocations.h"
#include "guard/cross_check.h"
#include "monitor/warnings.h"
#include "scenes.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

constexpr double kAbove = 2.0;  // height of the tip over the center of a sphere of radius 0.1 [m]
constexpr double kBelow = -2.0;

// A guard as the shell runs it: what is thrown is caught and reported.
class GuardWithoutMemoryTest : public testing::TestWithParam<std::string> {
 protected:
  GuardWithoutMemoryTest() {
    workpieces_.push_back(std::make_shared<const Workpiece>(
        Workpiece{"sphere", 1, Time(100s), {}, "table", wavyHull(/*rings=*/8, /*sectors=*/12, /*phase=*/0.0)}));
    monitor_.setWorkpieces(workpieces_);
  }

  void move(double height) {
    ms_ += 10;
    const Instant now{Time(100s + ms_ * 1ms), SteadyTime(ms_ * 1ms)};
    pose_.stamp = now.stamp;
    pose_.received = now.steady;
    pose_.X_WT.translation().z() = height;
    pose_.bodies[0].X_WB = pose_.X_WT;
    const auto checkpoint = monitor_.checkpoint();
    guard_.sweep(pose_, workpieces_, report_);
    monitor_.swept(report_, {now.stamp, now.steady}, checkpoint, now.steady);
    guard_.predict(1ms, workpieces_, prediction_);
    monitor_.predicted(prediction_, {now.stamp, now.steady}, checkpoint, now);
  }

  // @returns whether the allocation of this number was reached
  bool moveAndFail(double height, size_t number) {
    const FailingAllocation failing(number);
    try {
      move(height);
    } catch (const std::exception& error) {
      guard_.takeBack();
      monitor_.failed(kDetectorFault, error.what(), SteadyTime(ms_ * 1ms));
    }
    return failing.reached();
  }

  Warning warning() const {
    Warning warning;
    monitor_.warning({Time(100s + ms_ * 1ms), SteadyTime(ms_ * 1ms)}, warning);
    return warning;
  }

  int ms_ = 0;
  Workpieces workpieces_;
  PoseWithFrames pose_{{}, {}, Eigen::Isometry3d::Identity(), {{"table", Eigen::Isometry3d::Identity()}}};
  Guard guard_{Tool(ConvexShape::cylinder(0.005, 0.1)), makeDetector(GetParam()), {}};
  SweepReport report_;
  Prediction prediction_;
  WarningMonitor monitor_{{/*pose_timeout=*/100ms, /*mesh_timeout=*/Duration::max(), /*hold_time=*/0ms}};
};

TEST_P(GuardWithoutMemoryTest, IsNotClearAndGoesOnAndLeavesOutNoMotion) {
  bool reached = true;
  for (size_t number = 1; reached; ++number) {
    SCOPED_TRACE(number);
    monitor_.restart();
    guard_.reset();
    for (int i = 0; i < 3; ++i) move(kAbove);
    ASSERT_EQ(warning().level, WarningLevel::kClear);
    reached = moveAndFail(kBelow, number);
    EXPECT_NE(warning().level, WarningLevel::kClear);
    const bool met = warning().level == WarningLevel::kContact;
    move(kBelow);
    EXPECT_TRUE(met || warning().level == WarningLevel::kContact);
    for (int i = 0; i < 60 && warning().level != WarningLevel::kClear; ++i) move(kBelow);
    EXPECT_EQ(warning().level, WarningLevel::kClear);
    if (HasFailure()) return;
  }
}

TEST(QuerySamplerWithoutMemoryTest, KeepsAllOfAQueryOrNothing) {
  const auto workpiece = std::make_shared<const Workpiece>(
      Workpiece{"sphere", 1, {}, {}, "table", wavyHull(/*rings=*/8, /*sectors=*/12, /*phase=*/0.0)});
  Detection found;
  found.triangles.assign(100, 7);
  bool reached = true;
  for (size_t number = 1; reached; ++number) {
    QuerySampler sampler(/*every=*/1);
    sampler.setWorkpieces({workpiece});
    bool threw = false;
    {
      const FailingAllocation failing(number);
      try {
        sampler.offer("a name that does not fit in a short string", Submesh(workpiece->mesh_M), {}, found);
      } catch (const std::bad_alloc&) {
        threw = true;
      }
      reached = failing.reached();
    }
    EXPECT_EQ(sampler.waiting(), !threw) << number;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, GuardWithoutMemoryTest, testing::Values("halfspace", "select", "reference"),
                         [](const auto& detector) { return detector.param; });

}  // namespace
}  // namespace sweep_guard_core
