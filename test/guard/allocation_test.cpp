#include "allocations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes.h"
#include "sweep_guard/common/pool.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/guard/displacements.h"
#include "sweep_guard/guard/guard.h"

namespace sweep_guard {
namespace {

using namespace std::chrono_literals;

constexpr int kWarm = 3000;  // [ms]
constexpr int kEnd = 4000;
constexpr int kPeriod = 16;
constexpr int kRings = 11;
constexpr int kSectors = 20;
const std::string kFrame = "a frame whose name is too long to be kept in place";

// A drill that circles over or in a wavy workpiece at 1 kHz; a deformation every 16 ms.
class AllocationTest : public testing::Test {
 protected:
  AllocationTest() {
    for (int ms = 0; ms < kEnd; ms += kPeriod) sent_.push_back(positions(ms));
    const TriangleMesh mesh_M = wavyHull(kRings, kSectors, /*phase=*/0.0);
    workpieces_.push_back(
        snapshots_.add({"a workpiece of a long name", 1, Time(100s), {}, kFrame, mesh_M.deformed(sent_[0])}));
  }

  static std::vector<float> positions(int ms) {
    const TriangleMesh mesh_M = wavyHull(kRings, kSectors, std::sin(0.006 * ms));
    std::vector<float> positions;
    for (size_t i = 0; i < mesh_M.vertexCount(); ++i) {
      for (const double x : mesh_M.vertex(i)) positions.push_back(static_cast<float>(x));
    }
    return positions;
  }

  const ToolPose& pose(int ms, double height) {
    const double t = 1e-3 * ms;
    pose_.stamp = Time(100s + ms * 1ms);
    pose_.X_WT.linear() = Eigen::AngleAxisd(M_PI + 0.2 * std::sin(3 * t), Eigen::Vector3d::UnitX()).toRotationMatrix();
    pose_.X_WT.translation() = Eigen::Vector3d(0.02 * std::cos(5 * t), 0.02 * std::sin(5 * t), height);
    return pose_;
  }

  // As the node does with a message.
  void deform(int ms) {
    const auto any = [](const Workpiece& /*one*/) { return true; };
    auto next = snapshots_.take(any);
    if (!next) next = snapshots_.add(*workpieces_[0]);
    positions_ = sent_[static_cast<size_t>(ms / kPeriod)];
    next->mesh_M.deform(positions_);
    next->stamp = Time(100s + ms * 1ms);
    next->updates = workpieces_[0]->updates + 1;
    next->way = workpieces_[0]->way + Displacements(workpieces_[0]->mesh_M, next->mesh_M).farthest();
    workpieces_[0] = next;
  }

  void cycle(int ms, double height) {
    if (ms % kPeriod == 0) deform(ms);
    guard_.sweep(pose(ms, height), workpieces_, report_);
  }

  void expectNoneAt(double height, bool contact) {
    for (int ms = 0; ms < kWarm; ++ms) cycle(ms, height);
    for (int ms = kWarm; ms < kEnd; ++ms) {
      const Allocations made;
      cycle(ms, height);
      ASSERT_EQ(made.count(), 0U) << "after " << ms << " ms:\n" << made.stacks();
      ASSERT_EQ(report_.contact(), contact);
    }
  }

  Pool<Workpiece> snapshots_;
  Workpieces workpieces_;
  std::vector<std::vector<float>> sent_;
  std::vector<float> positions_;
  ToolPose pose_{{}, {}, Eigen::Isometry3d::Identity(), {{kFrame, Eigen::Isometry3d::Identity()}}};
  Guard guard_{Tool::cylinder(0.005, 0.1), makeDetector("halfspace"), {}};
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

TEST_F(AllocationTest, SweepsAndDeformationsInTheClearMakeNone) { expectNoneAt(0.5, /*contact=*/false); }
TEST_F(AllocationTest, SweepsAndDeformationsInContactMakeNone) { expectNoneAt(0.095, /*contact=*/true); }

}  // namespace
}  // namespace sweep_guard
