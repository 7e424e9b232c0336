// What is intended elsewhere changes no digit.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <numeric>

#include "guard/guard_results.h"
#include "monitor/warnings.h"
#include "scenes.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

std::string textOf(double value) {
  char text[32];
  std::snprintf(text, sizeof text, " %.17g", value);
  return text;
}

std::string textOf(const TriangleSet& triangles) {
  std::string text = " [";
  for (const std::uint32_t triangle : triangles) text += ' ' + std::to_string(triangle);
  return text + " ]";
}

std::string textOf(const Eigen::Vector3d& v) { return textOf(v.x()) + textOf(v.y()) + textOf(v.z()); }

std::string textOf(const std::vector<SweptVolume>& volumes) {
  std::string text;
  for (const SweptVolume& volume : volumes) {
    text += textOf(volume.margin) + textOf(volume.box.half_extents) + textOf(volume.box.X_MB.translation());
    for (const HalfSpace& clip : volume.clips_B) text += textOf(clip.normal()) + textOf(clip.offset());
  }
  return text + '\n';
}

std::string textOf(const SweepReport& report) {
  std::string text = "report" + std::to_string(report.end.time_since_epoch().count());
  for (const SweptObject& object : report.objects) {
    const SweepResult& result = object.result;
    text += textOf(result.triangles) + textOf(result.not_ruled_out) + textOf(result.margin) +
            std::to_string(result.inside) + textOf(result.volumes_M);
    for (const TriangleContact& contact : result.in_contact) {
      text += std::to_string(contact.triangle) + ' ' + std::to_string(contact.piece) +
              textOf(contact.impact.time_of_impact) + textOf(contact.impact.point_M) + textOf(contact.impact.normal_M) +
              textOf(contact.impact.depth) + '\n';
    }
  }
  return text;
}

std::string textOf(const Prediction& prediction) {
  std::string text = "prediction" + std::to_string(prediction.sweeps_made);
  for (const PredictedObject& object : prediction.objects) {
    text += textOf(object.reflex) + textOf(object.considered) + textOf(object.volumes_M);
    for (const PredictedSweep& sweep : object.sweeps) {
      text += std::to_string(sweep.from.count()) + ' ' + std::to_string(sweep.contact) + textOf(sweep.deviations) +
              ' ' + std::to_string(sweep.tool_piece.value_or(99)) + '\n';
    }
  }
  return text;
}

std::string textOf(const Warning& warning) {
  return "warning " + warning.text + ' ' + warning.mesh_id + ' ' + std::to_string(warning.tool_piece.value_or(99)) +
         textOf(warning.triangles) + textOf(warning.probability) + '\n';
}

Tool randomToolOfLinks(Random& random) {
  const ConvexShape one = randomTool(random, 0.03);
  if (random.chance(0.3)) return Tool(one);
  return Tool({{"bit", one}, {"shaft", randomTool(random, 0.05).placed(random.pose({0.02, 0.0, 0.0}))}});
}

// Through a hull that breathes, along a path that bends.
template <typename Intend>
std::string answers(std::uint64_t seed, const Intend& intend) {
  Random random(seed);
  GuardOptions options;
  options.clock = [] { return SteadyTime(); };
  options.sweep.fine = random.chance(0.9);
  Guard guard(randomToolOfLinks(random), makeDetector("halfspace"), options);
  WarningMonitor monitor({100ms, Duration::max(), 300ms});
  TriangleMesh mesh = wavyHull(14, 20, 0.0);
  Eigen::Isometry3d X_WT = random.pose({0.0, 0.0, 0.25});
  const Motion step = handMotion(random);
  const Eigen::Vector3d velocity =
      0.006 * (random.inBox({0.05, 0.05, 0.05}) - Eigen::Vector3d(0, 0, 0.25)).normalized();
  std::string text;
  double path_length = 0.0;
  for (int i = 0; i < 40; ++i) {
    if (i % 3 == 2) {
      std::vector<float> positions = streamedPositions(wavyHull(14, 20, 0.02 * i));
      mesh.deform(positions);
      path_length += 0.01;
    }
    const Instant now{Time(100s + i * 20ms), SteadyTime(100s + i * 20ms)};
    const auto workpiece = std::make_shared<const Workpiece>(
        Workpiece{"hull", 1, now.stamp, now.steady, "table", mesh, static_cast<std::uint64_t>(i / 3), path_length});
    const Workpieces workpieces = {workpiece};
    monitor.setWorkpieces(workpieces);
    intend(guard, *workpiece);
    X_WT.translation() += velocity;
    X_WT.linear() = X_WT.linear() * Eigen::AngleAxisd(0.2 * step.angle(), step.axis_T()).toRotationMatrix();
    const PoseWithFrames pose{now.stamp, now.steady, X_WT, {{"table", Eigen::Isometry3d::Identity()}}};
    const SweepReport report = reportOf(guard, pose, workpieces);
    const Prediction prediction = predictionOf(guard, 5ms, workpieces);
    monitor.swept(report, {now.stamp, now.steady}, monitor.checkpoint(), now.steady);
    monitor.predicted(prediction, {now.stamp, now.steady}, monitor.checkpoint(), now);
    text += textOf(report) + textOf(prediction) + textOf(warningOf(monitor, now));
  }
  return text;
}

TriangleSet everyTriangleOf(const Workpiece& workpiece) {
  TriangleSet all(workpiece.mesh_M.triangles().size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

// For a comparison with another build: SWEEP_GUARD_ANSWERS=FILE writes what the scenes answer.
void keep(const std::string& text) {
  const char* const file = std::getenv("SWEEP_GUARD_ANSWERS");
  if (file != nullptr) std::ofstream(file, std::ios::app) << text;
}

TEST(IntentionFreeTest, WhatIsIntendedElsewhereChangesNoDigit) {
  size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const std::string nothing = answers(seed, [](Guard&, const Workpiece&) {});
    const std::string elsewhere = answers(seed, [](Guard& guard, const Workpiece& workpiece) {
      const auto triangles = workpiece.mesh_M.sharedTriangles();
      const auto copy = std::make_shared<const std::vector<Triangle>>(*triangles);
      const TriangleSet all = everyTriangleOf(workpiece);
      guard.intend(std::make_shared<const Intentions>(Intentions{
          {"other", triangles, all, 0.5}, {"hull", copy, all, 0.5}, {"hull", triangles, all, 0.5, {"camera"}}}));
    });
    EXPECT_EQ(nothing, elsewhere) << "seed " << seed;
    contacts += nothing.find("CONTACT") != std::string::npos ? 1 : 0;
    keep(nothing);
  }
  EXPECT_GT(contacts, 12U);
}

// The comparison would notice an intention that counts.
TEST(IntentionFreeTest, WhatIsIntendedHereChangesTheAnswer) {
  const std::string nothing = answers(1, [](Guard&, const Workpiece&) {});
  const std::string everywhere = answers(1, [](Guard& guard, const Workpiece& workpiece) {
    guard.intend(std::make_shared<const Intentions>(
        Intentions{{"hull", workpiece.mesh_M.sharedTriangles(), everyTriangleOf(workpiece), 0.5}}));
  });
  EXPECT_NE(nothing, everywhere);
}

}  // namespace
}  // namespace sweep_guard_core
