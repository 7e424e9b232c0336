#include "simulation/elastic/elastic_workpiece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "data_path.h"
#include "meshes.h"
#include "refusal.h"
#include "simulation/workpiece.h"

namespace sweep_guard_simulation {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using sweep_guard_core::ForceLaw;
using sweep_guard_core::Interpenetration;
using sweep_guard_core::InterpenetrationFinder;
using sweep_guard_core::Tool;
using sweep_guard_core::TriangleMesh;

constexpr double kRate = 60.0;  // [Hz]

Workpiece::Options resting() {
  Workpiece::Options options;
  options.size = 0.25;
  options.amplitude = 0.0;
  return options;
}

ElasticWorkpiece::Options damped() {
  ElasticWorkpiece::Options options;
  options.motion.step = 1.0 / kRate;
  options.motion.damping = 10.0;
  return options;
}

/// A tool above the highest point of a workpiece along z.
class Indentation {
 public:
  Indentation(const Workpiece& rest, const ElasticWorkpiece::Options& options, double stiffness = 1e7)
      : rest_(rest.positions(0.0)), triangles_(rest.triangles()), workpiece_(rest_, triangles_, options), tip_(top()) {
    law_.stiffness = stiffness;
    workpiece_.setTool(Tool::cylinder(0.01, 0.15), law_);
  }

  void hold(double depth, double seconds) {
    for (int i = 0; i < std::lround(seconds * kRate); ++i) workpiece_.advance(poseAt(depth));
  }
  void moveTo(double depth, double seconds) {
    const double from = depth_;
    const long steps = std::lround(seconds * kRate);
    for (long i = 1; i <= steps; ++i) {
      workpiece_.advance(poseAt(from + (depth - from) * static_cast<double>(i) / static_cast<double>(steps)));
    }
  }

  /// Returns what tool and workpiece have in common now.
  Interpenetration found() const {
    std::vector<Vector3d> vertices;
    const std::vector<float> positions = workpiece_.positions();
    for (size_t i = 0; i < positions.size(); i += 3) {
      vertices.emplace_back(positions[i], positions[i + 1], positions[i + 2]);
    }
    return InterpenetrationFinder(Tool::cylinder(0.01, 0.15).pieces()[0].shape_T)
        .find(TriangleMesh(vertices, triangles_), Eigen::Translation3d(tip_ - Vector3d(0, 0, depth_)) * down());
  }

  const std::vector<float>& rest() const { return rest_; }
  const ElasticWorkpiece& workpiece() const { return workpiece_; }
  const ForceLaw& law() const { return law_; }

 private:
  static Eigen::Quaterniond down() { return {0.0, 1.0, 0.0, 0.0}; }
  Isometry3d poseAt(double depth) {
    depth_ = depth;
    return Eigen::Translation3d(tip_ - Vector3d(0, 0, depth)) * down();
  }
  Vector3d top() const {
    Vector3d top = Vector3d::Constant(-1.0);
    for (size_t i = 0; i < rest_.size(); i += 3) {
      if (rest_[i + 2] > top.z()) top = Vector3d(rest_[i], rest_[i + 1], rest_[i + 2]);
    }
    return top;
  }

  std::vector<float> rest_;
  std::vector<sweep_guard_core::Triangle> triangles_;
  ElasticWorkpiece workpiece_;
  Vector3d tip_;
  double depth_ = -0.01;
  ForceLaw law_;
};

TEST(ElasticWorkpieceTest, RestsWithoutATool) {
  Indentation indentation(Workpiece::hull(1600, resting()), damped());
  indentation.hold(-0.01, 1.0);
  EXPECT_LT(indentation.workpiece().dent(), 1e-9);
  EXPECT_EQ(indentation.workpiece().force_M().norm(), 0.0);
}

TEST(ElasticWorkpieceTest, GivesWayToAToolAndPushesBackAsTheInteractionForceSays) {
  Indentation indentation(Workpiece::hull(1600, resting()), damped());
  indentation.moveTo(0.01, 1.0);
  indentation.hold(0.01, 2.0);
  const Interpenetration found = indentation.found();
  const double force = interactionForce(found, Vector3d::Zero(), indentation.law()).force_T.norm();
  EXPECT_GT(force, 0.5);
  EXPECT_NEAR(indentation.workpiece().force_M().norm(), force, 0.01 * force);
  EXPECT_GT(indentation.workpiece().dent(), 0.008);
  EXPECT_LT(indentation.workpiece().dent(), 0.015);
}

TEST(ElasticWorkpieceTest, StaysCalmUnderAHardContact) {
  Indentation indentation(Workpiece::hull(1600, resting()), damped(), 1e8);
  indentation.moveTo(0.005, 0.5);
  indentation.hold(0.005, 2.0);
  const double held = indentation.workpiece().force_M().norm();
  EXPECT_GT(held, 0.1);
  for (int i = 0; i < 60; ++i) {
    indentation.hold(0.005, 1.0 / kRate);
    EXPECT_NEAR(indentation.workpiece().force_M().norm(), held, 0.02 * held);
  }
}

TEST(ElasticWorkpieceTest, IsFixedAtItsBottom) {
  Indentation indentation(Workpiece::hull(1600, resting()), damped());
  indentation.moveTo(0.01, 0.5);
  const std::vector<float> now = indentation.workpiece().positions();
  const auto& rest = indentation.rest();
  float bottom = 1.0F;
  float top = -1.0F;
  for (size_t i = 2; i < rest.size(); i += 3) {
    bottom = std::min(bottom, rest[i]);
    top = std::max(top, rest[i]);
  }
  for (size_t i = 0; i < rest.size(); i += 3) {
    if (rest[i + 2] > bottom + 0.39F * (top - bottom)) continue;
    for (size_t axis = 0; axis < 3; ++axis) EXPECT_FLOAT_EQ(now[i + axis], rest[i + axis]);
  }
}

void pushTenMillimetersInAndOut(const Workpiece& rest) {
  Indentation indentation(rest, damped());
  indentation.moveTo(0.01, 0.5);
  EXPECT_GT(indentation.workpiece().dent(), 0.008);
  EXPECT_GT(indentation.workpiece().force_M().norm(), 0.1);
  indentation.moveTo(-0.01, 0.5);
  indentation.hold(-0.01, 1.0);
  EXPECT_LT(indentation.workpiece().dent(), 0.0005);
}

TEST(ElasticWorkpieceTest, IsBackAtRestASecondAfterTenMillimetersInAndOut) {
  pushTenMillimetersInAndOut(Workpiece::hull(4384, resting()));
}

TEST(ElasticWorkpieceTest, ALiverIsBackAtRestASecondAfterTenMillimetersInAndOut) {
  const auto path = dataPath("mesh/sofa_liver-smooth.obj");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << missing(path);
  pushTenMillimetersInAndOut(Workpiece::fromFile(path, resting()));
}

TEST(ElasticWorkpieceTest, ASheetGivesWayAndComesBack) {
  const TriangleMesh sheet = sheetMesh(0.2, 30);
  std::vector<float> positions;
  for (size_t i = 0; i < sheet.vertexCount(); ++i) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(sheet.vertex(i)[axis]));
  }
  ElasticWorkpiece::Options options = damped();
  options.fixed_height = 0.0;
  options.up_M = Vector3d::UnitX();
  ElasticWorkpiece workpiece(positions, sheet.triangles(), options);
  ForceLaw law;
  law.stiffness = 1e7;
  workpiece.setTool(Tool::cylinder(0.01, 0.15), law);
  const Eigen::Quaterniond down(0.0, 1.0, 0.0, 0.0);
  for (int i = 1; i <= 60; ++i) workpiece.advance(Eigen::Translation3d(0.0, 0.0, -0.005 * i / 60.0) * down);
  EXPECT_NEAR(workpiece.dent(), 0.005, 0.001);
  for (int i = 0; i < 60; ++i) workpiece.advance(Eigen::Translation3d(0.0, 0.0, 0.01) * down);
  EXPECT_LT(workpiece.dent(), 1e-4);
}

TEST(ElasticWorkpieceTest, RefusesAHeightOutOfRange) {
  ElasticWorkpiece::Options options = damped();
  options.fixed_height = 1.5;
  EXPECT_TRUE(has(refusal([&] { Indentation(Workpiece::hull(100, resting()), options); }), "fixed_height"));
}

}  // namespace
}  // namespace sweep_guard_simulation
