#include "evaluation/guard_findings.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "common/xyz.h"
#include "evaluation/command_feed.h"
#include "evaluation/progress.h"
#include "evaluation/simulated_node.h"
#include "guard/contact_probability.h"
#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Duration;
using sweep_guard_core::Instant;
using sweep_guard_core::PredictedObject;
using sweep_guard_core::Prediction;
using sweep_guard_core::StampedPose;
using sweep_guard_core::SweepReport;
using sweep_guard_core::Time;
using sweep_guard_core::TriangleMesh;
using sweep_guard_core::WarningLimits;
using sweep_guard_core::Workpiece;
using sweep_guard_core::Workpieces;
using sweep_guard_recording::LevelTrace;

namespace {

constexpr double kRounding = 1e-4;  // [m]

// With vertices in float32 as streamed ones are, so that all workpieces have the same margin.
std::shared_ptr<const Workpiece> workpieceOf(const std::string& id, TriangleMesh mesh_W) {
  std::vector<float> positions;
  for (size_t i = 0; i < mesh_W.vertexCount(); ++i) {
    for (const double coordinate : sweep_guard_core::xyz(mesh_W.vertex(i)))
      positions.push_back(static_cast<float>(coordinate));
  }
  mesh_W.deform(positions);
  return std::make_shared<const Workpiece>(Workpiece{id, 1, {}, {}, kFrame, mesh_W});
}

/// Stands for any object: the level does not depend on its shape once it is swept.
TriangleMesh anyMesh() { return TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}); }

/// Returns how far a tool point may be off along the axes of W [m].
Eigen::Vector3d deviationsOf(const sweep_guard_core::Matrix6d& covariance, double radius) {
  const double turn = std::sqrt(covariance.bottomRightCorner<3, 3>().trace());
  const Eigen::Vector3d position = covariance.topLeftCorner<3, 3>().diagonal().cwiseMax(0.0).cwiseSqrt();
  return sweep_guard_core::kMaxDeviations * (position.array() + radius * turn);
}

class FindingsRecorder {
 public:
  FindingsRecorder(const std::vector<TriangleMesh>& objects_W, const GuardSimulationOptions& options)
      : options_(options),
        commands_(options.commands),
        tool_(options.tool),
        radius_(tool_.bounds_T().min().cwiseAbs().cwiseMax(tool_.bounds_T().max().cwiseAbs()).norm()),
        guard_(tool_, sweep_guard_core::makeDetector("reference"), withoutTimeLimit(options.guard)) {
    for (const TriangleMesh& mesh_W : objects_W) {
      workpieces_.push_back(workpieceOf(std::to_string(workpieces_.size()), mesh_W));
      bounds_W_.push_back(mesh_W.bounds_M());
    }
    findings_.objects.resize(objects_W.size());
    pending_.resize(objects_W.size());
  }

  void addPose(const StampedPose& pose) {
    sweep(pose);
    predict(pose);
    store();
    findings_.stamps.push_back(pose.stamp);
    findings_.lengths.push_back(prediction_.path.empty() ? Duration(0) : prediction_.path.back().ahead);
    newest_ = pose;
  }

  GuardFindings findings() && { return std::move(findings_); }

 private:
  void sweep(const StampedPose& pose) {
    const Eigen::Isometry3d& X_WT_before = newest_ ? newest_->X_WT : pose.X_WT;
    Eigen::AlignedBox3d reach_W(pose.X_WT.translation());
    reach_W.extend(X_WT_before.translation());
    const double margin = radius_ + options_.guard.sweep.margin + kRounding;
    choose({reach_W.min().array() - margin, reach_W.max().array() + margin});
    const Instant at = instantOf(pose.stamp);
    commands_.sendUntil(pose.stamp, guard_);
    guard_.sweep({at.stamp, at.steady, pose.X_WT, {{kFrame, Eigen::Isometry3d::Identity()}}}, chosen_, report_);
    for (size_t i = 0; i < numbers_.size(); ++i) {
      if (report_.objects[i].result.contact()) pending(numbers_[i]).contact = true;
    }
  }

  void predict(const StampedPose& pose) {
    const sweep_guard_core::HorizonOptions& horizon = options_.guard.horizon;
    const auto motion = guard_.predictMotion(Duration(0), horizon.considered + horizon.reserve);
    prediction_.path = motion.path;
    choose(reachOf(pose, motion.path));
    if (numbers_.empty()) return;
    guard_.predict(Duration(0), chosen_, prediction_);
    for (size_t i = 0; i < numbers_.size(); ++i) addSweeps(prediction_.objects[i], numbers_[i]);
  }

  /// Returns a box around everything that the tool may meet along a predicted path.
  Eigen::AlignedBox3d reachOf(const StampedPose& pose, const sweep_guard_core::PredictedPath& path) const {
    Eigen::AlignedBox3d reach_W;
    Eigen::Isometry3d X_WT = pose.X_WT;
    Eigen::Vector3d deviations = Eigen::Vector3d::Zero();
    for (const auto& next : path) {
      const Eigen::Vector3d before = deviations;
      deviations = deviationsOf(next.covariance, radius_);
      const double arc = sweep_guard_core::chordError(radius_, sweep_guard_core::Motion{X_WT, next.X_WT}.angle());
      const double margin = radius_ + arc + options_.guard.sweep.margin + kRounding;
      const Eigen::Vector3d around = deviations.cwiseMax(before).array() + margin;
      for (const Eigen::Isometry3d& end : {X_WT, next.X_WT}) {
        reach_W.extend(Eigen::AlignedBox3d(end.translation() - around, end.translation() + around));
      }
      X_WT = next.X_WT;
    }
    return reach_W;
  }

  void choose(const Eigen::AlignedBox3d& reach_W) {
    numbers_.clear();
    chosen_.clear();
    for (size_t i = 0; i < bounds_W_.size(); ++i) {
      if (!reach_W.intersects(bounds_W_[i])) continue;
      numbers_.push_back(i);
      chosen_.push_back(workpieces_[i]);
    }
  }

  void addSweeps(const PredictedObject& object, size_t number) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const sweep_guard_core::PredictedSweep& sweep : object.sweeps) {
      if (!sweep.contact && sweep.deviations >= nearest) continue;
      nearest = std::min(nearest, sweep.deviations);
      pending(number);
      findings_.objects[number].sweeps.push_back(sweep);
    }
  }

  ObjectFindings::AtPose& pending(size_t number) {
    if (!pending_[number]) {
      pending_[number] = ObjectFindings::AtPose{findings_.stamps.size(), false, 0};
      found_.push_back(number);
    }
    return *pending_[number];
  }

  void store() {
    for (const size_t number : found_) {
      ObjectFindings& object = findings_.objects[number];
      pending_[number]->sweeps_end = object.sweeps.size();
      object.poses.push_back(*pending_[number]);
      pending_[number].reset();
    }
    found_.clear();
  }

  const GuardSimulationOptions& options_;
  CommandFeed commands_;
  const sweep_guard_core::Tool tool_;
  const double radius_;
  sweep_guard_core::Guard guard_;
  Workpieces workpieces_;
  std::vector<Eigen::AlignedBox3d> bounds_W_;
  GuardFindings findings_;
  std::optional<StampedPose> newest_;
  // Of the pose that is added:
  std::vector<size_t> numbers_;  // of the objects to test
  Workpieces chosen_;            // the same objects
  SweepReport report_;
  Prediction prediction_;
  std::vector<size_t> found_;
  std::vector<std::optional<ObjectFindings::AtPose>> pending_;
};

/// Gives the findings about one object to a monitor, pose by pose.
class FindingsPlayer {
 public:
  FindingsPlayer(const GuardFindings& findings, size_t object, const WarningLimits& limits)
      : findings_(findings),
        object_(findings.objects[object]),
        workpiece_(workpieceOf(std::to_string(object), anyMesh())),
        monitor_(limits) {
    monitor_.setWorkpieces({workpiece_});
  }

  LevelTrace levels() && {
    size_t pose = 0;
    for (next_ = 0; next_ < object_.poses.size();) {
      if (!active_) pose = object_.poses[next_].pose;
      play(pose++);
    }
    for (; active_ && pose < findings_.stamps.size(); ++pose) play(pose);
    record(std::max(newest_, findings_.stamps.back()));
    return std::move(levels_);
  }

 private:
  void play(size_t pose) {
    const Time stamp = findings_.stamps[pose];
    if (active_) {
      for (Time time = newest_ + kWatchdogPeriod; time < stamp; time += kWatchdogPeriod) record(time);
    }
    report(pose, stamp);
    record(stamp);
    active_ = warning_.level >= sweep_guard_core::WarningLevel::kConsidered || stamp < predicted_until_;
  }

  void report(size_t pose, Time stamp) {
    const bool found = next_ < object_.poses.size() && object_.poses[next_].pose == pose;
    const Instant at = instantOf(stamp);
    report_.start = report_.end = stamp;
    report_.objects.resize(1);
    report_.objects[0].workpiece = workpiece_;
    report_.objects[0].interval_start = stamp;
    report_.objects[0].result.not_ruled_out.clear();
    if (found && object_.poses[next_].contact) report_.objects[0].result.not_ruled_out.push_back(0);
    monitor_.swept(report_, {at.stamp, at.steady}, {}, at.steady);
    predict(pose, stamp, found);
    monitor_.predicted(prediction_, {at.stamp, at.steady}, {}, at);
    if (found) ++next_;
  }

  void predict(size_t pose, Time stamp, bool found) {
    prediction_.stamp = stamp;
    prediction_.path.clear();
    prediction_.objects.clear();
    if (findings_.lengths[pose] == Duration(0)) return;
    prediction_.path.push_back({findings_.lengths[pose]});
    PredictedObject& object = prediction_.objects.emplace_back();
    object.workpiece = workpiece_;
    if (!found) return;
    for (size_t i = object_.sweepsBegin(next_); i < object_.poses[next_].sweeps_end; ++i) {
      object.sweeps.push_back(object_.sweeps[i]);
      predicted_until_ = stamp + findings_.lengths[pose];
    }
  }

  void record(Time time) {
    monitor_.warning(instantOf(time), warning_);
    levels_.add(time, warning_.level);
    newest_ = time;
  }

  const GuardFindings& findings_;
  const ObjectFindings& object_;
  const std::shared_ptr<const Workpiece> workpiece_;
  sweep_guard_core::WarningMonitor monitor_;
  bool active_ = false;  // the level is high, or may become so without anything found
  size_t next_ = 0;      // of object_.poses
  Time newest_;
  Time predicted_until_;
  SweepReport report_;
  Prediction prediction_;
  sweep_guard_core::Warning warning_;
  LevelTrace levels_;
};

}  // namespace

GuardFindings findContacts(const std::vector<StampedPose>& poses, const std::vector<TriangleMesh>& objects_W,
                           const GuardSimulationOptions& options, const Progress& progress) {
  FindingsRecorder recorder(objects_W, options);
  addPoses(poses, progress, [&](const StampedPose& pose) { recorder.addPose(pose); });
  return std::move(recorder).findings();
}

LevelTrace levelsOf(const GuardFindings& findings, size_t object, const WarningLimits& limits) {
  return FindingsPlayer(findings, object, limits).levels();
}

}  // namespace sweep_guard_evaluation
