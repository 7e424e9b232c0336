#include "allocations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes.h"
#include "sweep_guard/detection/reference_detector.h"
#include "sweep_guard/guard/guard.h"

namespace sweep_guard {
namespace {

using namespace std::chrono_literals;

const std::string kFrame = "a frame whose name is too long to be kept in place";

// A drill that circles over or in a wavy workpiece at 1 kHz; a deformation every 16 ms.
class AllocationTest : public testing::Test {
 protected:
  AllocationTest() {
    TriangleMesh mesh_M = wavyHull(/*rings=*/11, /*sectors=*/20, /*phase=*/0.0);
    for (std::uint64_t i = 0; i < 64; ++i) {
      std::vector<float> positions;
      const TriangleMesh next_M = wavyHull(11, 20, std::sin(0.1 * static_cast<double>(i)));
      for (size_t k = 0; k < next_M.vertexCount(); ++k) {
        for (const double x : next_M.vertex(k)) positions.push_back(static_cast<float>(x));
      }
      mesh_M = mesh_M.deformed(positions);
      const Time stamp(100s + i * 16ms);
      deformations_.push_back({std::make_shared<const Workpiece>(
          Workpiece{"a workpiece of a long name", 1, stamp, {}, kFrame, mesh_M, i, static_cast<double>(i)})});
    }
  }

  const ToolPose& pose(int ms, double height) {
    const double t = 1e-3 * ms;
    pose_.stamp = Time(100s + ms * 1ms);
    pose_.X_WT.linear() = Eigen::AngleAxisd(M_PI + 0.2 * std::sin(3 * t), Eigen::Vector3d::UnitX()).toRotationMatrix();
    pose_.X_WT.translation() = Eigen::Vector3d(0.02 * std::cos(5 * t), 0.02 * std::sin(5 * t), height);
    return pose_;
  }

  void cycle(int ms, double height) {
    const Workpieces& workpieces = deformations_[static_cast<size_t>(ms / 16) % deformations_.size()];
    guard_.sweep(pose(ms, height), workpieces, report_);
  }

  std::vector<Workpieces> deformations_;
  ToolPose pose_{{}, {}, Eigen::Isometry3d::Identity(), {{kFrame, Eigen::Isometry3d::Identity()}}};
  Guard guard_{Tool::cylinder(0.005, 0.1), std::make_unique<ReferenceDetector>(), {}};
  SweepReport report_;
};

TEST_F(AllocationTest, PassingAPoseMakesNone) {
  for (int ms = 0; ms < 800; ++ms) cycle(ms, 0.5);
  for (int round = 0; round < 10; ++round) {
    const int begin = 800 + 8 * round;
    {
      const Allocations made;
      for (int ms = begin; ms < begin + 7; ++ms) guard_.pass(pose(ms, 0.5));
      EXPECT_EQ(made.count(), 0U) << made.stacks();
    }
    cycle(begin + 7, 0.5);
  }
}

}  // namespace
}  // namespace sweep_guard
