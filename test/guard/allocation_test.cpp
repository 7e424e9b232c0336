#include "allocations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/pool.h"
#include "common/xyz.h"
#include "guard/cross_check.h"
#include "guard/workpiece_store.h"
#include "mesh_orders.h"
#include "monitor/warnings.h"
#include "scenes.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

constexpr int kWarm = 3000;  // [ms]
constexpr int kEnd = 4000;
constexpr int kPeriod = 20;
constexpr double kTurn = 2.0 * M_PI;
constexpr double kClear = 2.0;  // [m]
constexpr double kNear = 0.107;
constexpr double kContact = 0.095;
const std::string kFrame = "a frame whose name is too long to be kept in place";

struct Configuration {
  std::string name;
  std::string detector = "halfspace";
  VolumeKind volume = VolumeKind::kObbPlanes;
  bool several_parts = false;
  std::string predictor = "direct";
  bool time_is_short = false;
  bool large_and_shuffled = false;
};

void PrintTo(const Configuration& configuration, std::ostream* out) { *out << configuration.name; }

ConvexShape at(const Eigen::Vector3d& p_T, const ConvexShape& shape) {
  return shape.placed(Eigen::Isometry3d(Eigen::Translation3d(p_T)));
}

Tool toolOf(const Configuration& configuration) {
  const ConvexShape drill = ConvexShape::cylinder(0.005, 0.1);
  if (!configuration.several_parts) return Tool(drill);
  const ConvexShape wedge = ConvexShape::hull({{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.02}, {0.01, 0.01, 0}});
  return Tool({{"drill", drill},
               {"handle", at({0, 0, -0.12}, ConvexShape::box({0.01, 0.02, 0.03}))},
               {"knob", at({0.02, 0, -0.01}, ConvexShape::sphere(0.006))},
               {"wedge", at({-0.02, 0, -0.02}, wedge)}});
}

// A tool that circles over or in a wavy workpiece once a second, at 1 kHz; a deformation, and a look ahead, every 20
// ms. Each pose is followed by a warning. Every query is offered to a cross-check.
class SteadyStateTest : public testing::TestWithParam<Configuration> {
 protected:
  SteadyStateTest() {
    for (int ms = 0; ms < kEnd; ms += kPeriod) sent_.push_back(positions(ms));
    const TriangleMesh mesh_M = wavyWorkpiece(/*phase=*/0.0);
    workpieces_.push_back(
        snapshots_.add({"a workpiece of a long name", 1, Time(100s), {}, kFrame, deformed(mesh_M, sent_[0])}));
  }

  // The large one has clusters in groups, and is renumbered.
  static TriangleMesh wavyWorkpiece(double phase) {
    if (!GetParam().large_and_shuffled) return wavyHull(/*rings=*/11, /*sectors=*/20, phase);
    return meshOrderings().back().of(wavyHull(/*rings=*/30, /*sectors=*/40, phase));
  }

  static std::vector<float> positions(int ms) {
    const TriangleMesh mesh_M = wavyWorkpiece(std::sin(1e-3 * kTurn * ms));
    std::vector<float> positions;
    for (size_t i = 0; i < mesh_M.vertexCount(); ++i) {
      for (const double x : xyz(mesh_M.vertex(i))) positions.push_back(static_cast<float>(x));
    }
    return positions;
  }

  // What is done takes no time, or all there is.
  GuardOptions options() {
    GuardOptions options;
    options.sweep.volume = GetParam().volume;
    options.predictor.predictor = GetParam().predictor;
    options.clock = [this] { return clock_ += GetParam().time_is_short ? 1s : 0s; };
    return options;
  }

  static Instant now(int ms) { return {Time(100s + ms * 1ms), SteadyTime(ms * 1ms)}; }

  const PoseWithFrames& pose(int ms, double height) {
    const double t = 1e-3 * kTurn * ms;
    pose_.stamp = now(ms).stamp;
    pose_.received = now(ms).steady;
    pose_.X_WT.linear() = Eigen::AngleAxisd(M_PI + 0.2 * std::sin(2 * t), Eigen::Vector3d::UnitX()).toRotationMatrix();
    pose_.X_WT.translation() = Eigen::Vector3d(0.02 * std::cos(t), 0.02 * std::sin(t), height);
    pose_.bodies[0].X_WB = pose_.X_WT;
    return pose_;
  }

  // As the node does with a message.
  void deform(int ms) {
    const auto any = [](const Workpiece& /*one*/) { return true; };
    auto next = snapshots_.take(any);
    if (!next) next = snapshots_.add(*workpieces_[0]);
    positions_ = sent_[static_cast<size_t>(ms / kPeriod)];
    next->mesh_M.deform(positions_);
    next->stamp = now(ms).stamp;
    next->received = now(ms).steady;
    countUpdate(*workpieces_[0], *next);
    workpieces_[0] = next;
    monitor_.setWorkpieces(workpieces_);
  }

  void cycle(int ms, double height) {
    if (ms % kPeriod == 0) deform(ms);
    const Timestamps timestamps{now(ms).stamp, now(ms).steady};
    sampler_.setWorkpieces(workpieces_);
    guard_.sweep(pose(ms, height), workpieces_, report_);
    monitor_.swept(report_, timestamps, monitor_.checkpoint(), now(ms).steady);
    if (ms % kPeriod == 0) {
      guard_.predict(5ms, workpieces_, prediction_);
      monitor_.predicted(prediction_, timestamps, monitor_.checkpoint(), now(ms));
    }
    monitor_.warning(now(ms), warning_);
    if (sampler_.waiting()) sampler_.take(query_);
  }

  // @param check  called after each cycle
  template <typename Check>
  void expectNoneAt(double height, const Check& check) {
    for (int ms = 0; ms < kWarm; ++ms) cycle(ms, height);
    for (int ms = kWarm; ms < kEnd; ++ms) {
      const Allocations made;
      cycle(ms, height);
      ASSERT_EQ(made.count(), 0U) << "after " << ms << " ms:\n" << made.stacks();
      check();
      if (HasFatalFailure()) return;
    }
  }

  SteadyTime clock_;
  Pool<Workpiece> snapshots_;
  Workpieces workpieces_;
  std::vector<std::vector<float>> sent_;
  std::vector<float> positions_;
  PoseWithFrames pose_{{}, {}, Eigen::Isometry3d::Identity(), {{kFrame, Eigen::Isometry3d::Identity()}}};
  QuerySampler sampler_{/*every=*/1};
  SampledQuery query_;
  Guard guard_{toolOf(GetParam()), sampled(makeDetector(GetParam().detector), GetParam().detector, sampler_),
               options()};
  SweepReport report_;
  Prediction prediction_;
  WarningMonitor monitor_{{/*pose_timeout=*/100ms, /*mesh_timeout=*/500ms, /*hold_time=*/200ms}};
  Warning warning_;
};

TEST_P(SteadyStateTest, AllocatesNothingInTheClear) {
  expectNoneAt(kClear, [&] {
    ASSERT_EQ(warning_.level, WarningLevel::kClear);
    ASSERT_EQ(prediction_.probability(PredictionInterval::kConsidered, std::chrono::seconds(1)), 0.0);
  });
}

TEST_P(SteadyStateTest, AllocatesNothingWhileItWarns) {
  expectNoneAt(kNear, [&] {
    ASSERT_GE(warning_.level, WarningLevel::kConsidered);
    ASSERT_LE(warning_.level, WarningLevel::kReflex);
    ASSERT_TRUE(warning_.tool_piece);
  });
}

TEST_P(SteadyStateTest, AllocatesNothingInContact) {
  expectNoneAt(kContact, [&] {
    ASSERT_EQ(warning_.level, WarningLevel::kContact);
    ASSERT_TRUE(prediction_.firstContact());
  });
}

TEST_P(SteadyStateTest, AllocatesNothingForPosesThatArePassed) {
  for (int ms = 0; ms < 800; ++ms) cycle(ms, kClear);
  for (int round = 0; round < 10; ++round) {
    const int begin = 800 + 8 * round;
    {
      const Allocations made;
      for (int ms = begin; ms < begin + 7; ++ms) guard_.pass(pose(ms, kClear));
      EXPECT_EQ(made.count(), 0U) << made.stacks();
    }
    cycle(begin + 7, kClear);
  }
}

TEST(AttachedPayloadTest, ItsVerticesAllocateNothing) {
  const TriangleMesh payload_M = meshOrderings().back().of(wavyHull(/*rings=*/30, /*sectors=*/40, 0.0));
  const std::string id = "payload";
  WorkpieceStore store([](const Workpieces& /*workpieces*/) {});
  store.set({id, 1, {}, {}, kFrame, payload_M}, {});
  store.attach(store.snapshot().front(), Eigen::Isometry3d::Identity());
  const Eigen::Isometry3d X_MM = Random(/*seed=*/1).pose({0.1, 0.2, 0.3});
  std::vector<float> positions_M;
  for (size_t i = 0; i < payload_M.vertexCount(); ++i) {
    for (const double x : xyz(X_MM * payload_M.vertex(i))) positions_M.push_back(static_cast<float>(x));
  }
  const Allocations made;
  EXPECT_EQ(store.deform({id, 1, {}, {}, kFrame, positions_M}, {}), UpdateOutcome::kStored);
  EXPECT_EQ(made.count(), 0U) << made.stacks();
}

INSTANTIATE_TEST_SUITE_P(
    Each, SteadyStateTest,
    testing::Values(Configuration{"halfspace"},                                                             //
                    Configuration{"select", "select"},                                                      //
                    Configuration{"obb", "halfspace", VolumeKind::kObb},                                    //
                    Configuration{"hull", "halfspace", VolumeKind::kHull},                                  //
                    Configuration{"several_parts", "halfspace", VolumeKind::kObbPlanes, true},              //
                    Configuration{"select_hull_several_parts", "select", VolumeKind::kHull, true},          //
                    Configuration{"polynomial", "halfspace", VolumeKind::kObbPlanes, false, "polynomial"},  //
                    Configuration{"constant_velocity", "halfspace", VolumeKind::kObbPlanes, false, "constant_velocity"},
                    Configuration{"hold", "halfspace", VolumeKind::kObbPlanes, false, "hold"},
                    Configuration{"short_of_time", "halfspace", VolumeKind::kObbPlanes, true, "direct", true},
                    Configuration{"large_and_shuffled", "halfspace", VolumeKind::kObbPlanes, false, "direct", false,
                                  true}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace sweep_guard_core
