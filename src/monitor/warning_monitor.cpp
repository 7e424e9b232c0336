#include "sweep_guard/monitor/warning_monitor.h"

#include <algorithm>

#include "common/stage_clock.h"
#include "guard/cross_check.h"
#include "monitor/faults.h"
#include "monitor/late_frames.h"
#include "monitor/swept_workpieces.h"
#include "monitor/workpiece_warnings.h"

namespace sweep_guard_core {

WarningMonitor::WarningMonitor(const WarningLimits& limits, std::function<void()> on_fault,
                               std::function<std::optional<SteadyTime>()> waiting_since,
                               std::function<const char*()> hung)
    : on_fault_(std::move(on_fault)),
      waiting_since_(std::move(waiting_since)),
      hung_(std::move(hung)),
      limits_(limits),
      faults_(std::make_unique<Faults>(inputs_)),
      late_frames_(std::make_unique<LateFrames>(inputs_)),
      workpieces_(std::make_unique<SweptWorkpieces>(inputs_)),
      warnings_(std::make_unique<WorkpieceWarnings>(inputs_, limits_)),
      refused_meshes_(std::make_unique<Refusals>()),
      refused_vertices_(std::make_unique<Refusals>()) {}

WarningMonitor::~WarningMonitor() = default;

void WarningMonitor::require(const std::set<std::string>& ids) {
  const Lock lock(mutex_);
  inputs_.required.assign(ids.begin(), ids.end());
}

void WarningMonitor::requireTools(const std::vector<std::string>& names) {
  const Lock lock(mutex_);
  inputs_.other_tools.clear();
  for (const std::string& name : names) inputs_.other_tools.push_back({name, {}, {}});
}

WarningInputs::OtherTool* WarningMonitor::findTool(const std::string& name) {
  const auto same = [&](const WarningInputs::OtherTool& tool) { return tool.name == name; };
  const auto found = std::find_if(inputs_.other_tools.begin(), inputs_.other_tools.end(), same);
  return found == inputs_.other_tools.end() ? nullptr : &*found;
}

void WarningMonitor::toolHeard(const std::string& name, const Timestamps& pose) {
  const Lock lock(mutex_);
  WarningInputs::OtherTool* const tool = findTool(name);
  if (tool == nullptr) return;
  tool->newest = pose;
  tool->problem.clear();
}

void WarningMonitor::toolUnknown(const std::string& name, const std::string& problem) {
  {
    const Lock lock(mutex_);
    WarningInputs::OtherTool* const tool = findTool(name);
    if (tool == nullptr) return;
    tool->problem = problem;
  }
  on_fault_();
}

std::vector<WarningInputs::OtherTool> WarningMonitor::otherTools() const {
  const Lock lock(mutex_);
  return inputs_.other_tools;
}

void WarningMonitor::frameHeard(const std::string& frame, Time stamp, const Instant& now) {
  const Lock lock(mutex_);
  late_frames_->add(frame, stamp, now, limits_.pose_timeout);
}

void WarningMonitor::setMovingFrames(const std::set<std::string>& frames) {
  const Lock lock(mutex_);
  late_frames_->keepOnly(frames);
}

WarningMonitor::Checkpoint WarningMonitor::checkpoint() const {
  const Lock lock(mutex_);
  return {epoch_, faults_->count()};
}

void WarningMonitor::fault(Reason reason, const std::string& message) {
  {
    const Lock lock(mutex_);
    faults_->add(reason, message);
  }
  on_fault_();
}

void WarningMonitor::failed(Reason reason, const char* message, SteadyTime now, bool lasting) noexcept {
  const Lock lock(mutex_);
  faults_->addFailure(reason, message, now, lasting);
}

void WarningMonitor::meshRefused(const std::string& id, const std::string& message, SteadyTime received) {
  {
    const Lock lock(mutex_);
    refused_meshes_->add(id, {message, received});
    faults_->set(kMeshInvalid, refusal());
  }
  on_fault_();
}

void WarningMonitor::verticesRefused(const std::string& id, const std::string& message, SteadyTime received) {
  {
    const Lock lock(mutex_);
    refused_vertices_->add(id, {message, received});
    faults_->set(kMeshInvalid, refusal());
  }
  on_fault_();
}

void WarningMonitor::meshAccepted(const std::string& id, SteadyTime received) {
  const Lock lock(mutex_);
  refused_meshes_->accept(id, received);
  refused_vertices_->accept(id, received);
  faults_->set(kMeshInvalid, refusal());
}

void WarningMonitor::verticesAccepted(const std::string& id, SteadyTime received) {
  const Lock lock(mutex_);
  refused_vertices_->accept(id, received);
  faults_->set(kMeshInvalid, refusal());
}

std::string WarningMonitor::refusal(const std::vector<std::string>& ids) const {
  const std::string of_mesh = refused_meshes_->message(ids);
  return of_mesh.empty() ? refused_vertices_->message(ids) : of_mesh;
}

void WarningMonitor::meshUnread(const std::string& message, SteadyTime now) {
  {
    const Lock lock(mutex_);
    inputs_.unread = WarningInputs::Event{message, now};
  }
  on_fault_();
}

void WarningMonitor::updateDropped(const std::string& id, SteadyTime received) {
  {
    const Lock lock(mutex_);
    if (!workpieces_->drop(id, received)) return;
  }
  on_fault_();
}

void WarningMonitor::detectorTested(const std::string& failure) {
  {
    const Lock lock(mutex_);
    const bool exchanged = failure.empty() && !faults_->get(kSelftest).empty();
    faults_->set(kSelftest, failure);
    if (exchanged) restartLocked();
  }
  on_fault_();
}

void WarningMonitor::detectorsDisagree(const std::string& message, const SampledQuery& query,
                                       const std::vector<std::uint32_t>& missed, SteadyTime now) {
  const Lock lock(mutex_);
  if (query.origin.epoch != epoch_) return;
  faults_->set(kCrosscheck, message);
  if (query.origin.measured && holds(workpieces_->newest(), *query.workpiece)) meets(*query.workpiece, missed, now);
}

void WarningMonitor::meets(const Workpiece& workpiece, const std::vector<std::uint32_t>& triangles, SteadyTime now) {
  if (triangles.empty() || inputs_.disabled_by) return;
  addToContact(workpiece, triangles, now, inputs_.contact);
  warnings_->endAcknowledgements();
}

void WarningMonitor::posesLost(const std::string& message, SteadyTime now) {
  {
    const Lock lock(mutex_);
    inputs_.pose_loss = WarningInputs::Event{message, now};
  }
  on_fault_();
}

void WarningMonitor::setWorkpieces(const Workpieces& workpieces, std::optional<SteadyTime> now) {
  const Lock lock(mutex_);
  workpieces_->set(workpieces, now);
  warnings_->endAcknowledgementsOfGone(workpieces);
}

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
    if (report.backlog > limits_.overload) inputs_.overload = WarningInputs::Backlog{report.backlog, now};
  }
  if (!report.failures.empty()) on_fault_();
}

// What its source names goes before the frames that it is seen from.
void WarningMonitor::noteJump(const SweepReport& report, SteadyTime now) {
  if (!report.jump.empty()) {
    inputs_.jump = WarningInputs::Event{report.jump, now};
  } else if (!report.jumps.empty()) {
    const auto slower = [](const FrameJump& a, const FrameJump& b) { return a.speed.speed < b.speed.speed; };
    const FrameJump& jump = *std::max_element(report.jumps.begin(), report.jumps.end(), slower);
    inputs_.jump = WarningInputs::Event{"the tool jumped against '" + jump.frame + "': " + inWords(jump.speed), now};
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

void WarningMonitor::timeJumped(const std::string& message) {
  {
    const Lock lock(mutex_);
    const std::uint64_t first_epoch = first_epoch_;
    restartLocked();
    first_epoch_ = first_epoch;
    if (inputs_.contact) inputs_.contact->lasting = false;
    faults_->add(kTimeJump, message);
  }
  on_fault_();
}

void WarningMonitor::placedAnew(const std::string& message) {
  {
    const Lock lock(mutex_);
    faults_->add(kTimeJump, message);
    placed_anew_ = faults_->count();
    coverage_.reset();
  }
  on_fault_();
}

void WarningMonitor::restartLocked() {
  first_epoch_ = ++epoch_;
  inputs_.pose.reset();
  inputs_.overload.reset();
  inputs_.pose_loss.reset();
  inputs_.jump.reset();
  inputs_.intended.clear();
  warnings_->restart();
  faults_->restart();
  workpieces_->restart();
  swept_until_ = {};
  coverage_.reset();
  for (WarningInputs::OtherTool& tool : inputs_.other_tools) tool.newest.reset();
}

void WarningMonitor::restart() {
  {
    const Lock lock(mutex_);
    faults_->set(kCrosscheck, {});
    restartLocked();
    inputs_.contact.reset();
    inputs_.failure.reset();
  }
  on_fault_();
}

void WarningMonitor::disable(const std::string& asked_by) {
  {
    const Lock lock(mutex_);
    disableLocked(asked_by);
  }
  on_fault_();
}

void WarningMonitor::disableLocked(const std::string& asked_by) {
  if (inputs_.disabled_by) return;
  restartLocked();
  inputs_.contact.reset();
  inputs_.disabled_by = asked_by;
}

std::string WarningMonitor::disableBelow(WarningLevel level, const Instant& now, const std::string& asked_by) {
  {
    const Progress progress = readProgress();
    const Lock lock(mutex_);
    Warning warning;
    computeLocked(now, progress, warning);
    if (warning.level >= level) return warning.text;
    disableLocked(asked_by);
  }
  on_fault_();
  return {};
}

void WarningMonitor::enable() {
  {
    const Lock lock(mutex_);
    if (!inputs_.disabled_by) return;
    restartLocked();
    inputs_.disabled_by.reset();
  }
  on_fault_();
}

void WarningMonitor::end() {
  {
    const Lock lock(mutex_);
    restartLocked();
    inputs_.ended = true;
  }
  on_fault_();
}

std::optional<std::string> WarningMonitor::disabledBy() const {
  const Lock lock(mutex_);
  return inputs_.disabled_by;
}

bool WarningMonitor::counts(const Checkpoint& checkpoint) const {
  const Lock lock(mutex_);
  return epoch_ == checkpoint.epoch && !inputs_.disabled_by && !inputs_.ended;
}

bool WarningMonitor::isToBeSwept(const Checkpoint& checkpoint) const {
  const Lock lock(mutex_);
  return isToBeSweptLocked(checkpoint);
}

bool WarningMonitor::isToBeSweptLocked(const Checkpoint& checkpoint) const {
  return checkpoint.epoch >= first_epoch_ && !inputs_.disabled_by && !inputs_.ended;
}

void WarningMonitor::setLimits(const WarningLimits& limits) {
  const Lock lock(mutex_);
  limits_ = limits;
}

void WarningMonitor::warning(const Instant& now, Warning& warning) const {
  const Progress progress = readProgress();
  const Lock lock(mutex_);
  computeLocked(now, progress, warning);
}

void WarningMonitor::computeLocked(const Instant& now, const Progress& progress, Warning& warning) const {
  inputs_.covered_until = coveredUntil(now);
  inputs_.waiting_since = progress.waiting_since;
  inputs_.hung = progress.hung;
  computeWarning(inputs_, now, limits_, warning);
}

std::string WarningMonitor::meshProblems(const Instant& now, const std::vector<std::string>& ids) const {
  const char* const hung = hung_();
  const Lock lock(mutex_);
  return sweep_guard_core::meshProblems(inputsAbout(ids, hung), now, limits_);
}

WarningInputs WarningMonitor::inputsAbout(const std::vector<std::string>& ids, const char* hung) const {
  const auto asked = [&](const std::string& id) {
    return ids.empty() || std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  const auto asked_object = [&](const WarningInputs::Object& object) { return asked(object.id); };
  WarningInputs about;
  std::copy_if(inputs_.objects.begin(), inputs_.objects.end(), std::back_inserter(about.objects), asked_object);
  std::copy_if(inputs_.required.begin(), inputs_.required.end(), std::back_inserter(about.required), asked);
  const auto asked_tool = [&](const WarningInputs::OtherTool& tool) {
    const auto is_link = [&](const std::string& id) {
      return id.compare(0, tool.name.size() + 1, tool.name + "/") == 0;
    };
    return ids.empty() || std::any_of(ids.begin(), ids.end(), is_link);
  };
  std::copy_if(inputs_.other_tools.begin(), inputs_.other_tools.end(), std::back_inserter(about.other_tools),
               asked_tool);
  const auto tell = [&](Reason reason, const std::string& message) {
    if (!message.empty()) about.faults[reason] = message;
  };
  tell(kMeshInvalid, refusal(ids));
  tell(kSelftest, faults_->get(kSelftest));
  tell(kCrosscheck, faults_->get(kCrosscheck));
  about.unread = inputs_.unread;
  if (inputs_.failure && inputs_.failure->lasting) about.failure = inputs_.failure;
  about.hung = hung;
  return about;
}

}  // namespace sweep_guard_core
