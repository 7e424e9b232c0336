// Poses and a mesh against an oracle: no point that lies in the moving tool may be left out. The oracle samples the exact motion
// in long double and shares no code with the guard (test/soundness).
#include <array>
#include <deque>
#include <memory>
#include <vector>

#include "guard/workpiece_store.h"
#include "require.h"
#include "soundness/body.h"
#include "soundness/exact_motion.h"
#include "sweep_guard/guard/guard.h"
#include "target.h"

namespace sweep_guard_fuzz {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::Duration;
using sweep_guard_core::PoseWithFrames;
using sweep_guard_core::SteadyTime;
using sweep_guard_core::Time;
using sweep_guard_core::soundness::Bodies;
using sweep_guard_core::soundness::Body;
using sweep_guard_core::soundness::Matrix3r;
using sweep_guard_core::soundness::Real;
using sweep_guard_core::soundness::Vector3r;
using Vertices = std::vector<Eigen::Vector3d>;

constexpr int kMaxSteps = 10;
constexpr int kSamples = 6;       // of a motion from pose to pose
constexpr Real kCertain = 1e-9L;  // less deep than this, rounding may decide [m]
const std::string kFrame = "table";
const std::string kId = "liver";

double lengthFrom(Input& input, double largest) { return largest * (1 + input.byte()) / 256.0; }

Eigen::Vector3d placeFrom(Input& input, double largest) {
  const double x = input.fraction();
  const double y = input.fraction();
  return largest * Eigen::Vector3d(x, y, input.fraction());
}

Eigen::Quaterniond rotationFrom(Input& input) {
  const Eigen::Vector3d axis = placeFrom(input, 1.0);
  const double angle = axis.norm() == 0.0 ? 0.0 : 3.2 * input.fraction();
  return Eigen::Quaterniond(
      Eigen::AngleAxisd(angle, axis.norm() == 0.0 ? Eigen::Vector3d::UnitX() : axis.normalized()));
}

Eigen::Isometry3d poseFrom(Input& input, double largest) {
  const Eigen::Vector3d place = placeFrom(input, largest);
  return Eigen::Translation3d(place) * rotationFrom(input);
}

Body bodyFrom(Input& input) {
  Body body;
  const int kind = input.byte();
  body.kind = std::array{Body::Kind::kCylinder, Body::Kind::kSphere, Body::Kind::kBox}[static_cast<size_t>(kind % 3)];
  body.radius = lengthFrom(input, 0.05);
  body.length = lengthFrom(input, 0.2);
  for (int i = 0; i < 3; ++i) body.half_extents[i] = lengthFrom(input, 0.05);
  if (kind % 8 > 3) body.X_TS = poseFrom(input, 0.05);
  if (kind % 16 > 7) body.padding = lengthFrom(input, 0.01);
  return body;
}

// What the oracle knows of the workpiece since the last sweep: places of its vertices, the oldest first.
struct Placed {
  Time stamp;
  Vertices vertices;
};

class Scene {
 public:
  explicit Scene(Input input) : input_(input) {
    for (int count = 1 + input_.below(2); count > 0; --count) tool_.push_back(bodyFrom(input_));
    reach_ = static_cast<Real>(sweep_guard_core::soundness::extentOf(tool_));
    for (int count = 3 * (1 + input_.below(4)); count > 0; --count) vertices_.push_back(placeFrom(input_, 0.2));
    sweep_guard_core::GuardOptions options;
    options.sweep.volume = static_cast<sweep_guard_core::VolumeKind>(input_.below(3));
    options.sweep.margin = input_.flag() ? lengthFrom(input_, 0.005) : 0.0;
    options.clock = [] { return SteadyTime(); };  // there is always time
    guard_ = std::make_unique<sweep_guard_core::Guard>(
        sweep_guard_core::soundness::toolOf(tool_),
        sweep_guard_core::makeDetector(input_.flag() ? "reference" : "halfspace"), options);
  }

  void run() {
    addWorkpiece();
    pose_.X_WM[kFrame] = Eigen::Isometry3d::Identity();
    for (int step = 0; step < kMaxSteps && !input_.atEnd(); ++step) {
      const int how = input_.byte();
      now_ += milliseconds(10);
      if (how % 4 == 3) moveMesh(how / 64);
      movePose(how / 4 % 8);
      if (how / 32 % 2 == 1 && step + 1 < kMaxSteps) {
        guard_->pass(pose_);
        remember();
      } else {
        remember();
        sweep();
      }
    }
  }

 private:
  Time stampOf(Duration time) const { return Time(time); }

  void addWorkpiece() {
    std::vector<sweep_guard_core::Triangle> triangles;
    for (std::uint32_t i = 0; i < vertices_.size(); i += 3) triangles.push_back({i, i + 1, i + 2});
    sweep_guard_core::TriangleMesh mesh(vertices_, triangles);
    store_.set({kId, 1, stampOf(now_), SteadyTime(now_), kFrame, mesh}, stampOf(now_));
    meshes_.push_back({stampOf(now_), vertices_});
  }

  // Between two poses.
  void moveMesh(int how) {
    const Eigen::Vector3d shift = placeFrom(input_, how % 2 == 0 ? 0.02 : 0.3);
    const size_t bent = static_cast<size_t>(input_.byte()) % vertices_.size();
    std::vector<float> positions;
    for (Eigen::Vector3d& vertex : vertices_) {
      vertex += shift;
      if (how > 1 && &vertex == &vertices_[bent]) vertex += 2.0 * shift;
      for (int axis = 0; axis < 3; ++axis) {
        positions.push_back(static_cast<float>(vertex[axis]));
        vertex[axis] = static_cast<double>(positions.back());
      }
    }
    const Time stamp = stampOf(now_ - milliseconds(5));
    store_.deform({kId, 1, stamp, SteadyTime(now_ - milliseconds(5)), kFrame, positions}, stampOf(now_));
    meshes_.push_back({stamp, vertices_});
  }

  void movePose(int how) {
    pose_.stamp = stampOf(now_);
    pose_.received = SteadyTime(now_);
    if (how % 4 != 1) pose_.X_WT.pretranslate(placeFrom(input_, 0.1));
    if (how % 4 > 1) pose_.X_WT = pose_.X_WT * rotationFrom(input_);
    pose_.bodies = {{pose_.X_WT}};
    if (how == 7) pose_.X_WM[kFrame] = frame_ = poseFrom(input_, 0.05);
    if (how == 6) {
      pose_.X_WM.erase(kFrame);
    } else {
      pose_.X_WM[kFrame] = frame_;
    }
  }

  void remember() {
    if (pose_.X_WM.count(kFrame) != 0) path_.push_back(pose_);
  }

  void sweep() {
    guard_->sweep(pose_, store_.snapshot(), report_);
    require(report_.failures.empty(), "no sweep fails");
    const bool placed = pose_.X_WM.count(kFrame) != 0;
    require(placed == report_.unplaced.empty() && placed != report_.objects.empty(), "what has a frame is swept");
    if (!placed) return;
    // Before its first sweep a workpiece is not CLEAR, and only where it is then counts.
    if (!swept_) meshes_.erase(meshes_.begin(), meshes_.end() - 1);
    swept_ = true;
    judge(report_.objects[0].result);
    path_.erase(path_.begin(), path_.end() - 1);
    meshes_.erase(meshes_.begin(), meshes_.end() - 1);
    if (input_.below(4) == 3) predict();
  }

  static bool contains(const sweep_guard_core::TriangleSet& triangles, std::uint32_t triangle) {
    return std::binary_search(triangles.begin(), triangles.end(), triangle);
  }

  void judge(const sweep_guard_core::SweepResult& result) const {
    require(std::is_sorted(result.triangles.begin(), result.triangles.end()), "triangles are in order");
    for (const std::uint32_t triangle : result.not_ruled_out) {
      require(contains(result.triangles, triangle), "what is not ruled out is a candidate");
    }
    for (const auto& contact : result.in_contact) {
      require(contains(result.not_ruled_out, contact.triangle), "what is in contact is not ruled out");
      require(contact.impact.time_of_impact >= 0.0 && contact.impact.time_of_impact <= 1.0,
              "an impact is in its sweep");
    }
    if (path_.size() == 1) return judge(result, path_[0], path_[0]);
    for (size_t i = 1; i < path_.size(); ++i) judge(result, path_[i - 1], path_[i]);
  }

  void judge(const sweep_guard_core::SweepResult& result, const PoseWithFrames& from, const PoseWithFrames& to) const {
    sweep_guard_core::RelativeMotion relative;
    relative.tool_W.X_MT_start = from.X_WT;
    relative.tool_W.X_MT_end = to.X_WT;
    relative.frame_W.X_MT_start = from.X_WM.at(kFrame);
    relative.frame_W.X_MT_end = to.X_WM.at(kFrame);
    const sweep_guard_core::soundness::ExactMotion motion(relative);
    for (int i = 0; i <= kSamples; ++i) {
      const Real fraction = static_cast<Real>(i) / kSamples;
      const Vector3r origin_M = motion.at(fraction, Vector3r::Zero());
      Matrix3r R_TM;
      for (int axis = 0; axis < 3; ++axis) R_TM.col(axis) = motion.directionInTool(fraction, Vector3r::Unit(axis));
      const Time time = from.stamp + (to.stamp - from.stamp) * i / kSamples;
      forEachPlace(time, [&](const std::vector<Vector3r>& corners_M) {
        for (size_t triangle = 0; 3 * triangle < corners_M.size(); ++triangle) {
          if (!touches(&corners_M[3 * triangle], origin_M, R_TM)) continue;
          const auto index = static_cast<std::uint32_t>(triangle);
          if (contains(result.not_ruled_out, index)) continue;
          broken("triangle " + std::to_string(index) + " was met at " + std::to_string(i) + "/" +
                 std::to_string(kSamples) + " of the motion to " +
                 std::to_string(to.stamp.time_since_epoch() / milliseconds(1)) + " ms, in a sweep of " +
                 std::to_string(path_.size()) + " poses and " + std::to_string(meshes_.size()) + " meshes");
        }
      });
    }
  }

  // Where the vertices may have been at this time: between two updates, anywhere on their way.
  template <typename Visit>
  void forEachPlace(Time time, const Visit& visit) const {
    size_t before = 0;
    while (before + 1 < meshes_.size() && meshes_[before + 1].stamp < time) ++before;
    const bool moves = before + 1 < meshes_.size() && meshes_[before].stamp <= time;
    for (int i = 0; i <= (moves ? 2 : 0); ++i) {
      std::vector<Vector3r> corners_M;
      for (size_t k = 0; k < vertices_.size(); ++k) {
        const Vector3r first = meshes_[before].vertices[k].cast<Real>();
        const Vector3r last = meshes_[moves ? before + 1 : before].vertices[k].cast<Real>();
        corners_M.emplace_back(first + static_cast<Real>(i) / 2 * (last - first));
      }
      visit(corners_M);
    }
  }

  // Whether one of some points of the triangle lies in the tool.
  bool touches(const Vector3r* corners_M, const Vector3r& origin_M, const Matrix3r& R_TM) const {
    std::array<Vector3r, 3> corners_T;
    for (size_t k = 0; k < 3; ++k) corners_T[k] = R_TM * (corners_M[k] - origin_M);
    const auto& [a, b, c] = corners_T;
    const Real across = std::max((b - a).norm(), (c - a).norm());
    if (a.norm() > across + reach_) return false;
    const std::array<Vector3r, 7> points = {a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2, (a + b + c) / 3};
    for (const Body& body : tool_) {
      for (const Vector3r& point : points) {
        if (sweep_guard_core::soundness::depth(body, point) > kCertain) return true;
      }
    }
    return false;
  }

  void predict() {
    guard_->predict(Duration::zero(), store_.snapshot(), prediction_);
    require(prediction_.failures.empty(), "no prediction fails");
    if (prediction_.objects.empty()) return;
    const sweep_guard_core::PredictedObject& object = prediction_.objects[0];
    std::vector<Vector3r> corners_M;
    for (const Eigen::Vector3d& vertex : vertices_) corners_M.emplace_back(vertex.cast<Real>());
    for (const sweep_guard_core::PredictedPose& pose : prediction_.path) {
      const Eigen::Isometry3d X_MT = frame_.inverse() * pose.X_WT;
      const Matrix3r R_TM = X_MT.linear().transpose().cast<Real>();
      for (size_t i = 0; i < corners_M.size(); i += 3) {
        if (!touches(&corners_M[i], X_MT.translation().cast<Real>(), R_TM)) continue;
        const auto first = object.firstContact();
        require(first && *first <= pose.ahead, "no contact along the predicted path is missed");
      }
    }
  }

  Input input_;
  Bodies tool_;
  Real reach_ = 0;     // of the tool
  Vertices vertices_;  // newest places
  std::unique_ptr<sweep_guard_core::Guard> guard_;
  sweep_guard_core::WorkpieceStore store_;
  Duration now_ = std::chrono::seconds(100);
  PoseWithFrames pose_;
  Eigen::Isometry3d frame_ = Eigen::Isometry3d::Identity();
  std::vector<PoseWithFrames> path_;  // since the last sweep, from where it ended
  bool swept_ = false;
  std::vector<Placed> meshes_;  // since the last sweep, from what was swept
  sweep_guard_core::SweepReport report_;
  sweep_guard_core::Prediction prediction_;
};

const Target kSweeps("sweeps", [](Input input) { Scene(input).run(); });

}  // namespace
}  // namespace sweep_guard_fuzz
