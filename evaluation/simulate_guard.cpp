#include "evaluation/simulate_guard.h"

#include <algorithm>
#include <deque>
#include <list>
#include <utility>

#include "evaluation/command_feed.h"
#include "evaluation/progress.h"
#include "evaluation/simulated_node.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Instant;
using sweep_guard_core::Prediction;
using sweep_guard_core::StampedPose;
using sweep_guard_core::SweepReport;
using sweep_guard_core::Time;
using sweep_guard_core::WarningMonitor;
using sweep_guard_core::Workpiece;
using sweep_guard_recording::LevelTrace;

namespace {

/// Monitors one placement during its episode.
class ActivePlacement {
 public:
  ActivePlacement(size_t index, const ObstaclePlacement& placement, const GuardSimulationOptions& options)
      : index_(index), end_(placement.end) {
    const Instant at = instantOf(placement.begin);
    workpiece_ = std::make_shared<const Workpiece>(
        Workpiece{std::to_string(index), 1, at.stamp, at.steady, kFrame, meshOf(placement.obstacle)});
    for (const double min_probability : options.min_probabilities) {
      sweep_guard_core::WarningLimits limits = options.limits;
      limits.thresholds = sweep_guard_core::WarningThresholds::ofMinProbability(min_probability);
      monitors_.emplace_back(limits).setWorkpieces({workpiece_});
      traces_.emplace_back();
    }
  }

  size_t index() const { return index_; }
  Time end() const { return end_; }
  const std::shared_ptr<const Workpiece>& workpiece() const { return workpiece_; }
  const std::vector<LevelTrace>& traces() const { return traces_; }

  void report(const SweepReport& report, const Prediction& prediction) {
    const Instant at = instantOf(report.end);
    for (WarningMonitor& monitor : monitors_) {
      monitor.swept(report, {at.stamp, at.steady}, {}, at.steady);
      monitor.predicted(prediction, {at.stamp, at.steady}, {}, at);
    }
  }

  void recordLevel(Time time) {
    for (size_t i = 0; i < traces_.size(); ++i) {
      monitors_[i].warning(instantOf(time), warning_);
      traces_[i].add(time, warning_.level);
    }
  }

 private:
  size_t index_;
  Time end_;
  std::shared_ptr<const Workpiece> workpiece_;
  std::deque<WarningMonitor> monitors_;  // by threshold
  sweep_guard_core::Warning warning_;
  std::vector<LevelTrace> traces_;
};

class GuardSimulation {
 public:
  GuardSimulation(const std::vector<ObstaclePlacement>& placements, const GuardSimulationOptions& options)
      : placements_(placements),
        options_(options),
        commands_(options.commands),
        guard_(sweep_guard_core::Tool(options.tool), sweep_guard_core::makeDetector("reference"),
               withoutTimeLimit(options.guard)),
        levels_(options.min_probabilities.size(), std::vector<LevelTrace>(placements.size())) {}

  void addPose(const StampedPose& pose) {
    recordLevelsBefore(pose.stamp);
    begin(pose.stamp);
    sweep(pose);
    end(pose.stamp);
    newest_ = pose.stamp;
  }

  std::vector<std::vector<LevelTrace>> levels() && { return std::move(levels_); }

 private:
  void recordLevelsBefore(Time stamp) {
    for (Time time = newest_ + kWatchdogPeriod; !active_.empty() && time < stamp; time += kWatchdogPeriod) {
      for (ActivePlacement& placement : active_) placement.recordLevel(time);
    }
  }

  void begin(Time stamp) {
    for (; next_ < placements_.size() && placements_[next_].begin <= stamp; ++next_) {
      active_.emplace_back(next_, placements_[next_], options_);
    }
  }

  void sweep(const StampedPose& pose) {
    sweep_guard_core::Workpieces workpieces;
    for (const ActivePlacement& placement : active_) workpieces.push_back(placement.workpiece());
    const Instant at = instantOf(pose.stamp);
    SweepReport report;
    commands_.sendUntil(pose.stamp, guard_);
    guard_.sweep({at.stamp, at.steady, pose.X_WT, {{kFrame, Eigen::Isometry3d::Identity()}}}, workpieces, report);
    if (active_.empty()) return;
    Prediction prediction;
    guard_.predict(sweep_guard_core::Duration(0), workpieces, prediction);
    distribute(report, prediction);
    for (ActivePlacement& placement : active_) placement.recordLevel(pose.stamp);
  }

  /// Passes to each placement the results of its own workpiece.
  void distribute(SweepReport& report, Prediction& prediction) {
    auto swept = std::exchange(report.objects, {});
    auto predicted = std::exchange(prediction.objects, {});
    size_t i = 0;
    for (ActivePlacement& placement : active_) {
      report.objects.clear();
      report.objects.push_back(std::move(swept[i]));
      prediction.objects.clear();
      if (!predicted.empty()) prediction.objects.push_back(std::move(predicted[i]));
      placement.report(report, prediction);
      ++i;
    }
  }

  void end(Time stamp) {
    for (const ActivePlacement& placement : active_) {
      if (placement.end() > stamp) continue;
      for (size_t i = 0; i < levels_.size(); ++i) levels_[i][placement.index()] = placement.traces()[i];
    }
    active_.remove_if([&](const ActivePlacement& placement) { return placement.end() <= stamp; });
  }

  const std::vector<ObstaclePlacement>& placements_;
  const GuardSimulationOptions& options_;
  CommandFeed commands_;
  sweep_guard_core::Guard guard_;
  Time newest_;
  size_t next_ = 0;  // placement
  std::list<ActivePlacement> active_;
  std::vector<std::vector<LevelTrace>> levels_;
};

}  // namespace

std::vector<std::vector<LevelTrace>> simulateGuard(const std::vector<StampedPose>& poses,
                                                   const std::vector<ObstaclePlacement>& placements,
                                                   const GuardSimulationOptions& options, const Progress& progress) {
  GuardSimulation simulation(placements, options);
  addPoses(poses, progress, [&](const StampedPose& pose) { simulation.addPose(pose); });
  return std::move(simulation).levels();
}

}  // namespace sweep_guard_evaluation
