// A guard and its monitor run twice in one process, with the same recorded poses and deformations in the same order on an
// injected clock. Everything that they say is compared bit by bit.
#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "data_path.h"
#include "evaluation/simulated_node.h"
#include "guard/guard_results.h"
#include "monitor/warnings.h"
#include "recording/recording.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_evaluation {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::Guard;
using sweep_guard_core::Instant;
using sweep_guard_core::Prediction;
using sweep_guard_core::StampedPose;
using sweep_guard_core::SweepReport;
using sweep_guard_core::Time;
using sweep_guard_core::TriangleMesh;
using sweep_guard_core::Warning;
using sweep_guard_core::Workpiece;

constexpr int kCells = 12;       // along a side of the sheet
constexpr double kSide = 0.3;    // [m]
constexpr size_t kPoses = 3000;  // of the recording
constexpr size_t kPosesPerUpdate = 7;

// The bits of what was said, one line for each message.
class Transcript {
 public:
  void add(const SweepReport& report) {
    line_ << "sweep " << report.start.time_since_epoch().count() << ' ' << report.end.time_since_epoch().count();
    for (const auto& object : report.objects) {
      add(object.result.margin);
      for (const auto triangle : object.result.triangles) line_ << ' ' << triangle;
      for (const auto triangle : object.result.not_ruled_out) line_ << " met " << triangle;
      for (const auto& contact : object.result.in_contact) {
        ++contacts_;
        line_ << " contact " << contact.triangle << ' ' << contact.piece;
        add(contact.impact.time_of_impact);
        add(contact.impact.depth);
        for (int i = 0; i < 3; ++i) add(contact.impact.point_M[i]);
        for (int i = 0; i < 3; ++i) add(contact.impact.normal_M[i]);
      }
    }
    end();
  }

  void add(const Prediction& prediction) {
    line_ << "prediction " << prediction.stamp.time_since_epoch().count() << ' ' << prediction.sweeps_made;
    for (const auto& object : prediction.objects) {
      for (const auto& sweep : object.sweeps) {
        line_ << ' ' << sweep.from.count() << (sweep.contact ? " contact" : "");
        add(sweep.deviations);
      }
      for (const auto triangle : object.triangles()) line_ << ' ' << triangle;
    }
    end();
  }

  void add(const Warning& warning) {
    line_ << "warning " << static_cast<int>(warning.level) << ' ' << warning.reasons << ' ' << warning.text << ' '
          << warning.mesh_id << ' ' << warning.covered_until.time_since_epoch().count();
    if (warning.time_to_collision) line_ << " in " << warning.time_to_collision->count();
    add(warning.probability);
    for (const auto triangle : warning.triangles) line_ << ' ' << triangle;
    end();
  }

  const std::vector<std::string>& lines() const { return lines_; }
  size_t contacts() const { return contacts_; }

 private:
  void add(double number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof(bits));
    line_ << ' ' << std::hex << bits << std::dec;
  }

  void end() {
    lines_.push_back(line_.str());
    line_.str("");
  }

  std::ostringstream line_;
  std::vector<std::string> lines_;
  size_t contacts_ = 0;
};

// A sheet that sways, across the recorded path in its middle.
class Sheet {
 public:
  explicit Sheet(const Eigen::Isometry3d& X_WS) : X_WS_(X_WS) {
    std::vector<sweep_guard_core::Triangle> triangles;
    for (std::uint32_t row = 0; row < kCells; ++row) {
      for (std::uint32_t column = 0; column < kCells; ++column) {
        const std::uint32_t corner = row * (kCells + 1) + column;
        triangles.push_back({corner, corner + 1, corner + kCells + 2});
        triangles.push_back({corner, corner + kCells + 2, corner + kCells + 1});
      }
    }
    piece_ = std::make_shared<const Workpiece>(
        Workpiece{"sheet", 1, Time(), {}, kFrame, TriangleMesh(verticesAt(0.0), triangles)});
  }

  std::shared_ptr<const Workpiece> at(const Instant& now) {
    Workpiece next = *piece_;
    std::vector<float> positions;
    for (const Eigen::Vector3d& vertex : verticesAt(sweep_guard_core::toSeconds(now.stamp.time_since_epoch()))) {
      for (int i = 0; i < 3; ++i) positions.push_back(static_cast<float>(vertex[i]));
    }
    next.mesh_M.deform(positions);
    next.stamp = now.stamp;
    next.received = now.steady;
    sweep_guard_core::countUpdate(*piece_, next);
    piece_ = std::make_shared<const Workpiece>(std::move(next));
    return piece_;
  }

 private:
  std::vector<Eigen::Vector3d> verticesAt(double time) const {
    std::vector<Eigen::Vector3d> vertices;
    for (int row = 0; row <= kCells; ++row) {
      for (int column = 0; column <= kCells; ++column) {
        const double x = kSide * (static_cast<double>(column) / kCells - 0.5);
        const double y = kSide * (static_cast<double>(row) / kCells - 0.5);
        vertices.emplace_back(X_WS_ * Eigen::Vector3d(x, y, 0.01 * std::sin(20.0 * x + 3.0 * std::fmod(time, 100.0))));
      }
    }
    return vertices;
  }

  const Eigen::Isometry3d X_WS_;
  std::shared_ptr<const Workpiece> piece_;
};

Transcript run(const std::vector<StampedPose>& poses, const std::string& detector) {
  Guard guard(sweep_guard_core::Tool(sweep_guard_core::ConvexShape::cylinder(0.005, 0.1)),
              sweep_guard_core::makeDetector(detector), withoutTimeLimit({}));
  sweep_guard_core::WarningMonitor monitor(
      {std::chrono::milliseconds(100), std::chrono::milliseconds(500), std::chrono::milliseconds(500)});
  Sheet sheet(poses[poses.size() / 2].X_WT);
  std::shared_ptr<const Workpiece> workpiece;
  Transcript transcript;
  for (size_t i = 0; i < poses.size(); ++i) {
    const Instant at = instantOf(poses[i].stamp);
    if (i % kPosesPerUpdate == 0) {
      workpiece = sheet.at(at);
      monitor.setWorkpieces({workpiece});
    }
    const auto checkpoint = monitor.checkpoint();
    const SweepReport report =
        reportOf(guard, {at.stamp, at.steady, poses[i].X_WT, {{kFrame, Eigen::Isometry3d::Identity()}}}, {workpiece});
    const Prediction prediction = predictionOf(guard, Duration(0), {workpiece});
    monitor.swept(report, {at.stamp, at.steady}, checkpoint, at.steady);
    monitor.predicted(prediction, {at.stamp, at.steady}, checkpoint, at);
    transcript.add(report);
    transcript.add(prediction);
    transcript.add(warningOf(monitor, at));
  }
  return transcript;
}

class DeterminismTest : public testing::TestWithParam<const char*> {};

TEST_P(DeterminismTest, TheSameInputsInTheSameOrderGiveTheSameBitsOnRecordedHands) {
  const std::filesystem::path data = dataPath("motion");
  if (!std::filesystem::exists(data)) GTEST_SKIP() << missing(data);
  for (const char* const name : {"handheld_stylus_15hz.txt", "handheld_vicon.txt", "robot_arm.txt"}) {
    std::vector<StampedPose> poses = sweep_guard_recording::readRecording(data / name, "").poses;
    poses.resize(std::min(poses.size(), kPoses));
    const Transcript first = run(poses, GetParam());
    const Transcript second = run(poses, GetParam());
    EXPECT_GT(first.contacts(), 0U) << name;
    ASSERT_EQ(first.lines().size(), 3 * poses.size());
    for (size_t i = 0; i < first.lines().size(); ++i) ASSERT_EQ(first.lines()[i], second.lines()[i]) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Detectors, DeterminismTest, testing::Values("reference", "halfspace"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace sweep_guard_evaluation
