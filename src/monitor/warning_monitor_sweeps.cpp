#include "sweep_guard/monitor/warning_monitor.h"

#include <algorithm>

#include "common/stage_clock.h"
#include "monitor/faults.h"
#include "monitor/swept_workpieces.h"
#include "monitor/workpiece_warnings.h"

namespace sweep_guard_core {

void WarningMonitor::swept(const SweepReport& report, const Timestamps& pose, const Checkpoint& checkpoint,
                           SteadyTime now) {
  const InStage stage(Stage::kMonitor);
  {
    const Lock lock(mutex_);
    if (epoch_ != checkpoint.epoch) return sweptBeforeJump(report, checkpoint, now);
    faults_->endBefore(checkpoint.faults, now);
    addFailures(report.failures, "detection on");
    for (const std::string& frame : report.passed_over) {
      faults_->add(kPosesUnswept, "transforms of '" + frame + "' are so late that tool poses were left out");
    }
    inputs_.pose = pose;
    workpieces_->swept(report);
    if (report.complete()) swept_until_ = report.end;
    if (updateContact(report, now, inputs_.contact)) warnings_->endAcknowledgements();
    updateIntended(report, inputs_.intended);
    noteJump(report, now);
    if (report.backlog > limits_.overload) {
      inputs_.overload = now;
      inputs_.backlog = report.backlog;
    }
  }
  if (!report.failures.empty()) on_fault_();
}

// What its source names goes before the frames that it is seen from.
void WarningMonitor::noteJump(const SweepReport& report, SteadyTime now) {
  if (!report.jump.empty()) {
    inputs_.jump = WarningInputs::Event{report.jump, now};
  } else if (!report.jumps.empty()) {
    const auto slower = [](const auto& a, const auto& b) { return a.second.speed < b.second.speed; };
    const auto& [frame, speed] = *std::max_element(report.jumps.begin(), report.jumps.end(), slower);
    inputs_.jump = WarningInputs::Event{"the tool jumped against '" + frame + "': " + inWords(speed), now};
  }
}

void WarningMonitor::sweptBeforeJump(const SweepReport& report, const Checkpoint& checkpoint, SteadyTime now) {
  const bool counts = isToBeSweptLocked(checkpoint) && report.unintendedContact();
  if (!counts || !updateContact(report, now, inputs_.contact)) return;
  inputs_.contact->lasting = false;
  warnings_->endAcknowledgements();
}

void WarningMonitor::predicted(const Prediction& prediction, const Timestamps& pose, const Checkpoint& checkpoint,
                               const Instant& now, Duration took) {
  const InStage stage(Stage::kMonitor);
  {
    const Lock lock(mutex_);
    if (epoch_ != checkpoint.epoch) return;
    inputs_.look_ahead = took;
    addFailures(prediction.failures, "predicting contact with");
    if (checkpoint.faults < placed_anew_) return;
    beginCoverage(prediction);
    warnings_->update(prediction, pose, workpieces_->newest(), now);
    coverage_->pose = pose;
    coverage_->covered_until = prediction.coveredUntil();
    inputs_.seen = prediction.seen;
    if (prediction.seen && *prediction.seen < limits_.min_seen)
      inputs_.unseen = WarningInputs::Unseen{*prediction.seen, now.steady};
  }
  if (!prediction.failures.empty()) on_fault_();
}

void WarningMonitor::addFailures(const std::vector<SweepFailure>& failures, const char* what) {
  for (const SweepFailure& failure : failures) {
    faults_->add(kDetectorFault, std::string(what) + " '" + failure.workpiece->id + "' failed: " + failure.reason);
  }
}

// Covers nothing until the contacts are known: there may be no memory for them.
void WarningMonitor::beginCoverage(const Prediction& prediction) {
  if (!coverage_) coverage_.emplace();
  coverage_->covered_until = {};
  coverage_->tested.clear();
  for (const PredictedObject& object : prediction.objects) coverage_->tested.push_back(object.workpiece);
}

// Poses may come faster than predictions: an older prediction counts while its pose is not stale.
Time WarningMonitor::coveredUntil(const Instant& now) const {
  if (!coverage_ || coverage_->pose.stamp > swept_until_ || stale(coverage_->pose, now, limits_.pose_timeout)) {
    return swept_until_;
  }
  const bool all = workpieces_->allCount(coverage_->tested, now.steady);
  return all ? std::max(swept_until_, coverage_->covered_until) : swept_until_;
}

std::string WarningMonitor::whyNotAcknowledged(const std::string& id, const Instant& now) const {
  const Progress progress = readProgress();
  const Lock lock(mutex_);
  return whyNotAcknowledgedLocked(id, now, progress);
}

std::string WarningMonitor::whyNotAcknowledgedLocked(const std::string& id, const Instant& now,
                                                     const Progress& progress) const {
  Warning warning;
  computeLocked(now, progress, warning);
  if (warning.level != WarningLevel::kConsidered) return "only CONSIDERED can be acknowledged, not " + warning.text;
  if (findWorkpiece(workpieces_->newest(), id) != nullptr && warnings_->isWarnedOf(id, now)) return {};
  return "there is no warning of '" + id + "': " + warning.text;
}

std::string WarningMonitor::acknowledge(const std::string& id, const Instant& now) {
  const Progress progress = readProgress();
  const Lock lock(mutex_);
  std::string refusal = whyNotAcknowledgedLocked(id, now, progress);
  if (refusal.empty()) warnings_->acknowledge(*findWorkpiece(workpieces_->newest(), id), now);
  return refusal;
}

void WarningMonitor::endAcknowledgement(const std::string& id) {
  const Lock lock(mutex_);
  warnings_->endAcknowledgement(id);
}

std::vector<std::string> WarningMonitor::acknowledged(SteadyTime now) const {
  const Lock lock(mutex_);
  return warnings_->acknowledged(now);
}

}  // namespace sweep_guard_core
