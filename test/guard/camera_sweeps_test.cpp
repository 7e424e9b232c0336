#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "guard/guard_results.h"
#include "guard/times.h"
#include "scenes.h"
#include "sweep_guard/geometry/grid.h"

namespace sweep_guard_core {
namespace {

constexpr double kPixel = 0.01;  // [m], of a camera that looks along z from far away
constexpr float kFar = 1.0F;
const Grid kGrid(48, 24);

// Returns the depth of a pixel at x, y [m].
using Depth = std::function<float(double x, double y)>;

Depth wall() {
  return [](double, double) { return kFar; };
}

// A hand of 80 mm before the wall, whose left edge is at `left` [m].
Depth hand(double left) {
  return [left](double x, double) { return x >= left && x <= left + 0.08 ? 0.5F : kFar; };
}

Depth plane(float depth) {
  return [depth](double, double) { return depth; };
}

bool isStep(float one, float other) { return std::abs(one - other) > 0.1F; }

// What comes nearer by up to `reach` moves, as in DepthSurface.
class Camera {
 public:
  std::shared_ptr<const Workpiece> see(double seconds, const Depth& depth) {
    Workpiece image{"camera", 0, atSecond(seconds), SteadyTime(fromSeconds(seconds)), "table", TriangleMesh(kGrid)};
    std::vector<float> places(3 * kGrid.places());
    for (std::uint32_t row = 0; row < 24; ++row) {
      for (std::uint32_t column = 0; column < 48; ++column) {
        float* const p = &places[3 * size_t{kGrid.place(column, row)}];
        p[0] = static_cast<float>(kPixel * column);
        p[1] = static_cast<float>(kPixel * row);
        p[2] = depth(p[0], p[1]);
      }
    }
    std::vector<float> before = last_.empty() ? places : last_;
    for (size_t i = 2; i < places.size(); i += 3)
      before[i] = std::abs(places[i] - before[i]) <= reach_ ? before[i] : places[i];
    last_ = places;
    std::vector<std::uint64_t> existing = existingIn(places, image.mesh_M.triangles());
    image.mesh_M.deform(places, before, existing);
    image.of_camera = true;
    image.updates = number_++;
    return std::make_shared<const Workpiece>(std::move(image));
  }
  void skip() { ++number_; }

 private:
  static std::vector<std::uint64_t> existingIn(const std::vector<float>& places,
                                               const std::vector<Triangle>& triangles) {
    std::vector<std::uint64_t> existing(kGrid.tiles(), 0);
    for (size_t i = 0; i < triangles.size(); ++i) {
      const auto& [a, b, c] = triangles[i];
      const auto z = [&](std::uint32_t vertex) { return places[3 * size_t{vertex} + 2]; };
      const bool exists = a != b && !isStep(z(a), z(b)) && !isStep(z(b), z(c)) && !isStep(z(a), z(c));
      if (exists) existing[i / 64] |= std::uint64_t{1} << i % 64;
    }
    return existing;
  }

  float reach_ = 0.2F;
  std::vector<float> last_;
  std::uint64_t number_ = 0;
};

class CameraSweepsTest : public testing::Test {
 protected:
  // A sphere at a place [m].
  SweepReport sweepTo(double seconds, const Eigen::Vector3d& place, const std::shared_ptr<const Workpiece>& image) {
    return reportOf(guard_, poseAt(seconds, place), {image});
  }
  // The tool has come no further.
  SweepReport sweepAgain(double seconds, const Eigen::Vector3d& place, const std::shared_ptr<const Workpiece>& image) {
    SweepReport report;
    guard_.sweep(poseAt(seconds, place), {image}, report, /*arrived=*/false);
    return report;
  }
  static PoseWithFrames poseAt(double seconds, const Eigen::Vector3d& place) {
    return {atSecond(seconds),
            SteadyTime(fromSeconds(seconds)),
            placedAt(place),
            {{"table", Eigen::Isometry3d::Identity()}}};
  }

  Camera camera_;
  Guard guard_{Tool(ConvexShape::sphere(0.01)), makeDetector("reference"), {}};
};

TEST_F(CameraSweepsTest, WhatComesNearerIsMetOnItsWayBetweenTwoImages) {
  EXPECT_FALSE(sweepTo(0.0, {0.2, 0.1, 0.9}, camera_.see(0.0, plane(1.0F))).contact());
  EXPECT_TRUE(sweepTo(0.03, {0.2, 0.1, 0.9}, camera_.see(0.02, plane(0.85F))).contact());
}

TEST_F(CameraSweepsTest, TheWayOfTheToolIsSweptAgainSinceTheImageBefore) {
  EXPECT_FALSE(sweepTo(0.00, {0.2, 0.1, 0.8}, camera_.see(0.0, plane(1.0F))).contact());
  const auto before = camera_.see(0.001, plane(1.0F));
  EXPECT_FALSE(sweepTo(0.01, {0.2, 0.1, 0.9}, before).contact());
  EXPECT_FALSE(sweepTo(0.02, {0.2, 0.1, 0.6}, before).contact());
  EXPECT_TRUE(sweepAgain(0.02, {0.2, 0.1, 0.6}, camera_.see(0.015, plane(0.85F))).contact());
}

TEST_F(CameraSweepsTest, TheFirstImageMeetsThePathSinceItsStamp) {
  Workpiece far = *Camera().see(0.0, plane(9.0F));
  far.id = "other";
  const auto other = std::make_shared<const Workpiece>(far);
  for (const double seconds : {0.0, 0.02}) {
    Guard guard(Tool(ConvexShape::sphere(0.01)), makeDetector("reference"), {});
    reportOf(guard, poseAt(0.0, {0.2, 0.1, 0.9}), {other});
    reportOf(guard, poseAt(0.02, {0.2, 0.1, 1.1}), {other});
    SweepReport report;
    guard.sweep(poseAt(0.02, {0.2, 0.1, 1.1}), {other, Camera().see(seconds, wall())}, report, /*arrived=*/false);
    EXPECT_EQ(report.contact(), seconds == 0.0) << seconds;
  }
}

TEST_F(CameraSweepsTest, AnImageBeforeTheFirstPoseInItsFrameIsReportedAsUnplacedAndMeetsThePathSinceThatPose) {
  const auto image = camera_.see(0.0, wall());
  const SweepReport before =
      reportOf(guard_, {atSecond(0.01), SteadyTime(fromSeconds(0.01)), placedAt({0.2, 0.1, 0.9}), {}}, {image});
  EXPECT_EQ(before.unplaced, Workpieces{image});
  EXPECT_TRUE(before.failures.empty());
  EXPECT_FALSE(sweepTo(0.02, {0.2, 0.1, 0.9}, image).contact());
  EXPECT_TRUE(sweepTo(0.03, {0.2, 0.1, 1.1}, image).contact());
}

TEST_F(CameraSweepsTest, AHandThatCrossesThePathBetweenTwoImagesAtOneMeterPerSecondIsMet) {
  for (const double left : {0.0, 0.04, 0.08, 0.12, 0.16, 0.2}) {
    Guard guard(Tool(ConvexShape::sphere(0.01)), makeDetector("reference"), {});
    Camera camera;
    const auto at = [](double seconds, double z) { return poseAt(seconds, {0.2, 0.1, z}); };
    const auto before = camera.see(0.0, hand(left));
    reportOf(guard, at(0.0, 0.3), {before});
    bool met = reportOf(guard, at(0.02, 0.7), {before}).contact();
    met = reportOf(guard, at(0.034, 0.7), {camera.see(0.033, hand(left + 0.033))}).contact() || met;
    const bool crosses = left + 0.033 + 0.08 > 0.19 && left < 0.21;
    EXPECT_EQ(met, crosses) << left;
  }
}

TEST_F(CameraSweepsTest, WhatHasGoneStaysUntilAPoseAfterTheNewImageIsSwept) {
  const auto with = camera_.see(0.0, hand(0.15));
  EXPECT_FALSE(sweepTo(0.00, {0.2, 0.1, 0.3}, with).contact());
  const auto without = camera_.see(0.03, wall());
  EXPECT_TRUE(sweepTo(0.02, {0.2, 0.1, 0.5}, without).contact());
  EXPECT_TRUE(sweepTo(0.04, {0.2, 0.1, 0.51}, without).contact());
  EXPECT_FALSE(sweepTo(0.05, {0.2, 0.1, 0.5}, without).contact());
}

TEST_F(CameraSweepsTest, EachImageBetweenTwoPosesCounts) {
  sweepTo(0.0, {0.2, 0.1, 0.3}, camera_.see(0.0, wall()));
  EXPECT_FALSE(sweepAgain(0.0, {0.2, 0.1, 0.3}, camera_.see(0.01, hand(0.15))).contact());
  const auto gone = camera_.see(0.02, wall());
  EXPECT_FALSE(sweepAgain(0.0, {0.2, 0.1, 0.3}, gone).contact());
  const SweepReport report = sweepTo(0.03, {0.2, 0.1, 0.7}, gone);
  EXPECT_TRUE(report.contact());
  EXPECT_TRUE(report.complete());
}

TEST_F(CameraSweepsTest, AnImageThatWasNotSweptIsTold) {
  sweepTo(0.0, {0.2, 0.1, 0.3}, camera_.see(0.0, wall()));
  camera_.skip();
  const SweepReport report = sweepTo(0.07, {0.2, 0.1, 0.3}, camera_.see(0.06, wall()));
  EXPECT_FALSE(report.complete());
  EXPECT_EQ(report.objects[0].behind, fromSeconds(0.06));
  EXPECT_TRUE(sweepTo(0.08, {0.2, 0.1, 0.3}, camera_.see(0.075, wall())).complete());
}

TEST_F(CameraSweepsTest, ImagesMoreThanHalfASecondApartAreNotSweptForAllOfTheTime) {
  for (const double seconds : {0.0, 0.4}) {
    EXPECT_TRUE(sweepTo(seconds, {0.2, 0.1, 0.3}, camera_.see(seconds, wall())).complete()) << seconds;
  }
  EXPECT_FALSE(sweepTo(0.95, {0.2, 0.1, 0.3}, camera_.see(0.94, wall())).complete());
}

TEST_F(CameraSweepsTest, OfMoreThanSixteenImagesBetweenTwoPosesTheOldestAreToldAsLeftOut) {
  sweepTo(0.0, {0.2, 0.1, 0.3}, camera_.see(0.0, wall()));
  for (int i = 1; i <= 16; ++i) {
    EXPECT_TRUE(sweepAgain(0.0, {0.2, 0.1, 0.3}, camera_.see(0.01 * i, wall())).complete()) << i;
  }
  const auto newest = camera_.see(0.17, wall());
  sweepAgain(0.0, {0.2, 0.1, 0.3}, newest);
  EXPECT_FALSE(sweepTo(0.18, {0.2, 0.1, 0.3}, newest).complete());
}

// At any time, each vertex may be anywhere on its way, and the sphere on its own.
TEST_F(CameraSweepsTest, WhateverTouchesOnTheWayIsFound) {
  size_t met = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    Camera camera;
    Guard guard(Tool(ConvexShape::sphere(0.01)), makeDetector("reference"), {});
    const auto waves = [&random](float mean) {
      const double a = random.uniform(5.0, 30.0);
      const double b = random.uniform(5.0, 30.0);
      return [=](double x, double y) { return mean + static_cast<float>(0.03 * std::sin(a * x + b * y)); };
    };
    const auto before = camera.see(0.0, waves(1.0F));
    const Eigen::Vector3d from(random.uniform(0.05, 0.4), random.uniform(0.05, 0.2), random.uniform(0.75, 0.95));
    const Eigen::Vector3d to = from + random.inBox({0.02, 0.02, 0.1});
    reportOf(guard, poseAt(0.0, from), {before});
    const auto now = camera.see(0.02, waves(0.9F));
    const SweepReport report = reportOf(guard, poseAt(0.03, to), {now});
    std::set<std::uint32_t> found(report.objects[0].result.not_ruled_out.begin(),
                                  report.objects[0].result.not_ruled_out.end());
    const TriangleMesh& mesh = now->mesh_M;
    Submesh(mesh).forEachTriangle([&](std::uint32_t i) {
      const Triangle& triangle = mesh.triangles()[i];
      for (int sample = 0; sample < 20; ++sample) {
        Eigen::Vector3d p = Eigen::Vector3d::Zero();
        double rest = 1.0;
        for (int corner = 0; corner < 3; ++corner) {
          const double weight = corner == 2 ? rest : random.uniform(0.0, rest);
          const double share = random.uniform(0.0, 1.0);
          const auto vertex = triangle[static_cast<size_t>(corner)];
          p += weight * (share * mesh.vertex(vertex) + (1.0 - share) * mesh.vertexBefore(vertex));
          rest -= weight;
        }
        const double share = random.uniform(0.0, 1.0);
        if ((from + share * (to - from) - p).norm() > 0.0099) continue;
        EXPECT_EQ(found.count(i), 1U) << seed << ' ' << i;
        ++met;
      }
    });
  }
  EXPECT_GT(met, 300U);
}

}  // namespace
}  // namespace sweep_guard_core
