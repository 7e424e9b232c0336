#include "sweep_guard/monitor/warning_monitor.h"

#include <algorithm>
#include <cstring>

#include "guard/cross_check.h"
#include "guard/triangle_set.h"

namespace sweep_guard_core {
namespace {

constexpr auto kFailureShown = std::chrono::milliseconds(100);
constexpr size_t kRefusalsKept = 64;  // bounds the memory that invalid ids can take

bool sameTriangles(const Workpiece& a, const Workpiece& b) {
  return a.id == b.id && a.frame == b.frame && &a.mesh_M.triangles() == &b.mesh_M.triangles();
}

bool holds(const Workpieces& workpieces, const Workpiece& workpiece) {
  return std::any_of(workpieces.begin(), workpieces.end(),
                     [&](const auto& one) { return sameTriangles(*one, workpiece); });
}

std::optional<size_t> firstPiece(const SweepResult& result) {
  const auto sooner = [](const TriangleContact& a, const TriangleContact& b) {
    return a.impact.time_of_impact < b.impact.time_of_impact;
  };
  const auto first = std::min_element(result.in_contact.begin(), result.in_contact.end(), sooner);
  return first == result.in_contact.end() ? std::nullopt : std::optional(first->piece);
}

void setAlarm(std::optional<WarningInputs::Alarm>& alarm, const PredictedContact& contact, SteadyTime ended) {
  if (!alarm) alarm.emplace();
  alarm->contact = contact;
  alarm->ended = ended;
}

void keepNewer(std::optional<WarningInputs::Alarm>& kept, std::optional<WarningInputs::Alarm>& alarm) {
  if (alarm && (!kept || kept->ended < alarm->ended)) std::swap(kept, alarm);
}

bool notSwept(const SweepReport& report, const std::string& id) {
  const auto unplaced = [&](const auto& workpiece) { return workpiece->id == id; };
  const auto failed = [&](const SweepFailure& failure) { return failure.workpiece->id == id; };
  return std::any_of(report.unplaced.begin(), report.unplaced.end(), unplaced) ||
         std::any_of(report.failures.begin(), report.failures.end(), failed);
}

}  // namespace

WarningMonitor::WarningMonitor(const WarningLimits& limits, std::function<void()> on_fault,
                               std::function<std::optional<SteadyTime>()> waiting_since,
                               std::function<const char*()> hung)
    : on_fault_(std::move(on_fault)),
      waiting_since_(std::move(waiting_since)),
      hung_(std::move(hung)),
      limits_(limits) {}

void WarningMonitor::require(const std::set<std::string>& ids) {
  const std::lock_guard lock(mutex_);
  inputs_.required.assign(ids.begin(), ids.end());
}

WarningMonitor::Checkpoint WarningMonitor::checkpoint() const {
  const std::lock_guard lock(mutex_);
  return checkpoint_;
}

void WarningMonitor::fault(Reason reason, const std::string& message) {
  {
    const std::lock_guard lock(mutex_);
    addFault(reason, message);
  }
  on_fault_();
}

void WarningMonitor::failed(Reason reason, const char* message, SteadyTime now, bool lasting) noexcept {
  const std::lock_guard lock(mutex_);
  auto& failure = inputs_.failure;
  lasting = lasting || (failure && failure->lasting);
  failure = WarningInputs::Failure{reason, {}, now, lasting};
  std::strncpy(failure->message.data(), message, failure->message.size() - 1);
  failure_number_ = ++checkpoint_.faults;
}

void WarningMonitor::addFault(Reason reason, const std::string& message) {
  inputs_.faults[reason] = message;
  fault_numbers_[reason] = ++checkpoint_.faults;
}

void WarningMonitor::meshRefused(const std::string& id, const std::string& message, SteadyTime received) {
  refuse(refused_meshes_, id, {message, received});
}

void WarningMonitor::verticesRefused(const std::string& id, const std::string& message, SteadyTime received) {
  refuse(refused_vertices_, id, {message, received});
}

void WarningMonitor::refuse(Refusals& refusals, const std::string& id, const WarningInputs::Event& refusal) {
  {
    const std::lock_guard lock(mutex_);
    const bool room = refusals.size() < kRefusalsKept || refusals.count(id) != 0;
    refusals[room ? id : refusals.rbegin()->first] = refusal;
    updateRefusals();
  }
  on_fault_();
}

void WarningMonitor::accept(Refusals& refusals, const std::string& id, SteadyTime received) {
  const auto refused = refusals.find(id);
  if (refused == refusals.end() || refused->second.found > received) return;
  refusals.erase(refused);
  updateRefusals();
}

void WarningMonitor::meshAccepted(const std::string& id, SteadyTime received) {
  const std::lock_guard lock(mutex_);
  accept(refused_meshes_, id, received);
  accept(refused_vertices_, id, received);
}

void WarningMonitor::verticesAccepted(const std::string& id, SteadyTime received) {
  const std::lock_guard lock(mutex_);
  accept(refused_vertices_, id, received);
}

void WarningMonitor::meshUnread(const std::string& message, SteadyTime now) {
  {
    const std::lock_guard lock(mutex_);
    inputs_.unread = WarningInputs::Event{message, now};
  }
  on_fault_();
}

void WarningMonitor::updateDropped(const std::string& id, SteadyTime received) {
  {
    const std::lock_guard lock(mutex_);
    const auto same = [&](const auto& workpiece) { return workpiece->id == id; };
    if (std::none_of(workpieces_.begin(), workpieces_.end(), same)) return;
    SteadyTime& newest = dropped_[id];
    newest = std::max(newest, received);
    updateObjects();
  }
  on_fault_();
}

void WarningMonitor::detectorTested(const std::string& failure) {
  {
    const std::lock_guard lock(mutex_);
    const bool exchanged = failure.empty() && !test_failure_.empty();
    test_failure_ = failure;
    updateDetectorFaults();
    if (exchanged) restartLocked();
  }
  on_fault_();
}

void WarningMonitor::detectorsDisagree(const std::string& message, const SampledQuery& query,
                                       const std::vector<std::uint32_t>& missed, SteadyTime now) {
  const std::lock_guard lock(mutex_);
  if (query.origin.epoch != checkpoint_.epoch) return;
  disagreement_ = message;
  updateDetectorFaults();
  if (query.origin.measured && holds(workpieces_, *query.workpiece)) addContact(*query.workpiece, missed, now);
}

void WarningMonitor::describeDisagreement(const std::string& message, const SampledQuery& query) {
  const std::lock_guard lock(mutex_);
  if (disagreement_.empty() || query.origin.epoch != checkpoint_.epoch) return;
  disagreement_ = message;
  updateDetectorFaults();
}

void WarningMonitor::updateDetectorFaults() {
  const auto set = [&](Reason reason, const std::string& message) {
    inputs_.faults.erase(reason);
    if (!message.empty()) inputs_.faults[reason] = message;
  };
  set(kSelftest, test_failure_);
  set(kCrosscheck, disagreement_);
}

// A contact that lasts stays; triangles that are added to it are told until its next sweep.
void WarningMonitor::addContact(const Workpiece& workpiece, const std::vector<std::uint32_t>& triangles,
                                SteadyTime now) {
  if (triangles.empty() || inputs_.disabled_by) return;
  auto& contact = inputs_.contact;
  if (!contact || (contact->id != workpiece.id && !contact->lasting)) {
    contact = WarningInputs::Contact{workpiece.id, {}, now};
  }
  contact->found = now;
  endAcknowledgements();
  if (contact->id == workpiece.id) unite(contact->triangles, triangles);
}

void WarningMonitor::posesLost(const std::string& message, SteadyTime now) {
  {
    const std::lock_guard lock(mutex_);
    inputs_.pose_loss = WarningInputs::Event{message, now};
  }
  on_fault_();
}

void WarningMonitor::updateRefusals() {
  const Refusals& refusals = refused_meshes_.empty() ? refused_vertices_ : refused_meshes_;
  inputs_.faults.erase(kMeshInvalid);
  if (!refusals.empty()) inputs_.faults[kMeshInvalid] = refusals.rbegin()->second.message;
}

void WarningMonitor::setWorkpieces(const Workpieces& workpieces) {
  const std::lock_guard lock(mutex_);
  workpieces_ = workpieces;
  endAcknowledgementsOfGoneMeshes();
  updateObjects();
}

void WarningMonitor::updateObjects() {
  for (auto dropped = dropped_.begin(); dropped != dropped_.end();) {
    const auto same = [&](const auto& workpiece) { return workpiece->id == dropped->first; };
    const bool known = std::any_of(workpieces_.begin(), workpieces_.end(), same);
    dropped = known ? std::next(dropped) : dropped_.erase(dropped);
  }
  inputs_.objects.resize(workpieces_.size());
  for (size_t i = 0; i < workpieces_.size(); ++i) {
    const Workpiece& workpiece = *workpieces_[i];
    WarningInputs::Object& object = inputs_.objects[i];
    if (object.id != workpiece.id) object.behind = {};
    object.id = workpiece.id;
    object.timestamps = {workpiece.stamp, workpiece.received};
    object.swept = holds(swept_, workpiece);
    object.dropped = dropped_.count(workpiece.id) != 0;
  }
}

void WarningMonitor::swept(const SweepReport& report, const Timestamps& pose, const Checkpoint& checkpoint,
                           SteadyTime now) {
  {
    const std::lock_guard lock(mutex_);
    if (!checkpoint_.continues(checkpoint)) return;
    for (auto fault = fault_numbers_.begin(); fault != fault_numbers_.end();) {
      const auto& [reason, number] = *fault;
      const bool cleared = number <= checkpoint.faults;
      if (cleared) inputs_.faults.erase(reason);
      fault = cleared ? fault_numbers_.erase(fault) : std::next(fault);
    }
    if (failure_number_ <= checkpoint.faults) endFailure(now);
    for (const SweepFailure& failure : report.failures) {
      addFault(kDetectorFault, "detection on '" + failure.workpiece->id + "' failed: " + failure.reason);
    }
    inputs_.pose = pose;
    swept_.clear();
    for (const SweptObject& object : report.objects) {
      if (object.behind == Duration::zero()) swept_.push_back(object.workpiece);
      const auto dropped = dropped_.find(object.workpiece->id);
      if (dropped != dropped_.end() && object.workpiece->received > dropped->second) dropped_.erase(dropped);
    }
    updateObjects();
    updateBehind(report);
    if (report.complete()) swept_until_ = report.end;
    updateContact(report, now);
    if (report.backlog > limits_.overload) inputs_.overload = WarningInputs::Backlog{report.backlog, now};
  }
  if (!report.failures.empty()) on_fault_();
}

void WarningMonitor::endFailure(SteadyTime now) {
  const auto& failure = inputs_.failure;
  if (failure && !failure->lasting && now - failure->found >= kFailureShown) inputs_.failure.reset();
}

void WarningMonitor::updateBehind(const SweepReport& report) {
  for (WarningInputs::Object& object : inputs_.objects) {
    const auto same = [&](const SweptObject& swept) { return swept.workpiece->id == object.id; };
    const auto swept = std::find_if(report.objects.begin(), report.objects.end(), same);
    object.behind = swept == report.objects.end() ? Duration::zero() : swept->behind;
  }
}

void WarningMonitor::updateContact(const SweepReport& report, SteadyTime now) {
  auto& contact = inputs_.contact;
  if (contact) contact->lasting = contact->lasting && notSwept(report, contact->id);
  for (const SweptObject& object : report.objects) {
    if (!object.result.contact()) continue;
    endAcknowledgements();
    const SweepResult& found = object.result;
    if (!contact) contact = WarningInputs::Contact{};
    contact->id = object.workpiece->id;
    contact->triangles = found.not_ruled_out;
    contact->found = now;
    contact->lasting = true;
    contact->inside = found.inside;
    contact->tool_piece = firstPiece(found);
    return;
  }
}

void WarningMonitor::predicted(const Prediction& prediction, const Timestamps& pose, const Checkpoint& checkpoint,
                               const Instant& now, Duration took) {
  {
    const std::lock_guard lock(mutex_);
    if (!checkpoint_.continues(checkpoint)) return;
    inputs_.look_ahead = took;
    for (const SweepFailure& failure : prediction.failures) {
      addFault(kDetectorFault, "predicting contact with '" + failure.workpiece->id + "' failed: " + failure.reason);
    }
    if (!coverage_) coverage_.emplace();
    coverage_->covered_until = {};  // until the contact is known: there may be no memory for it
    coverage_->tested.clear();
    for (const PredictedObject& object : prediction.objects) coverage_->tested.push_back(object.workpiece);
    for (const PredictedObject& object : prediction.objects) updatePredicted(prediction, object, pose, now);
    endUntested(now);
    coverage_->pose = pose;
    coverage_->covered_until = prediction.coveredUntil();
  }
  if (!prediction.failures.empty()) on_fault_();
}

WarningInputs::WorkpieceWarning* WarningMonitor::findWarning(const std::string& id) {
  const auto same = [&](const WarningInputs::WorkpieceWarning& workpiece) { return workpiece.id == id; };
  const auto found = std::find_if(inputs_.warnings.begin(), inputs_.warnings.end(), same);
  return found == inputs_.warnings.end() ? nullptr : &*found;
}

void WarningMonitor::updatePredicted(const Prediction& prediction, const PredictedObject& object,
                                     const Timestamps& pose, const Instant& now) {
  WarningInputs::WorkpieceWarning* workpiece = findWarning(object.workpiece->id);
  const auto& [reflex, considered_on, considered_off] = limits_.thresholds;
  const bool is_on = workpiece != nullptr && workpiece->predicted && isConsidered(*workpiece->predicted, now, limits_);
  findPredictedContact(prediction, object, pose, {reflex, is_on ? considered_off : considered_on}, next_);
  if (is_on && next_ && !isConsidered(*next_, now, limits_)) {
    findPredictedContact(prediction, object, pose, {reflex, considered_on}, next_);
  }
  if (workpiece == nullptr && !next_) return;
  if (workpiece == nullptr) workpiece = &inputs_.warnings.emplace_back();
  workpiece->id = object.workpiece->id;
  updateAlarms(*workpiece, now);
  std::swap(workpiece->predicted, next_);
  const auto& predicted = workpiece->predicted;
  if (predicted && warningLevel(*predicted, now, limits_) == WarningLevel::kReflex) endAcknowledgements();
}

// The contact predicted with a workpiece that could not be tested again stands until its prediction ends. Of workpieces
// that are gone only the newest alarms are kept, so that many ids take no memory.
void WarningMonitor::endUntested(const Instant& now) {
  const auto isIn = [](const Workpieces& workpieces, const std::string& id) {
    return std::any_of(workpieces.begin(), workpieces.end(), [&](const auto& one) { return one->id == id; });
  };
  for (auto workpiece = inputs_.warnings.begin(); workpiece != inputs_.warnings.end();) {
    const bool known = isIn(workpieces_, workpiece->id);
    if (isIn(coverage_->tested, workpiece->id) ||
        (known && workpiece->predicted && timeSinceEnd(*workpiece->predicted, now) == Duration::zero())) {
      ++workpiece;
      continue;
    }
    updateAlarms(*workpiece, now);
    workpiece->predicted.reset();
    if (!known) {
      keepNewer(inputs_.removed.reflex, workpiece->reflex);
      keepNewer(inputs_.removed.considered, workpiece->considered);
    }
    workpiece = known ? std::next(workpiece) : inputs_.warnings.erase(workpiece);
  }
}

void WarningMonitor::updateAlarms(WarningInputs::WorkpieceWarning& workpiece, const Instant& now) {
  if (!workpiece.predicted) return;
  const PredictedContact& predicted = *workpiece.predicted;
  const SteadyTime ended = now.steady - timeSinceEnd(predicted, now);
  const WarningLevel level = warningLevel(predicted, now, limits_);
  if (level >= WarningLevel::kConsidered) setAlarm(workpiece.considered, predicted, ended);
  if (level < WarningLevel::kReflex) return;
  setAlarm(workpiece.reflex, predicted, ended);
  endAcknowledgements();
}

std::string WarningMonitor::acknowledge(const std::string& id, const Instant& now) {
  const std::lock_guard lock(mutex_);
  Warning warning;
  computeLocked(now, warning);
  if (warning.level != WarningLevel::kConsidered) return "only CONSIDERED can be acknowledged, not " + warning.text;
  const auto same = [&](const auto& one) { return one->id == id; };
  const auto known = std::find_if(workpieces_.begin(), workpieces_.end(), same);
  WarningInputs::WorkpieceWarning* const workpiece = findWarning(id);
  if (known == workpieces_.end() || workpiece == nullptr || !isWarnedOf(*workpiece, now, limits_)) {
    return "there is no warning of '" + id + "': " + warning.text;
  }
  workpiece->acknowledged_until = now.steady + limits_.acknowledge_time;
  workpiece->acknowledged_revision = (*known)->revision;
  return {};
}

void WarningMonitor::endAcknowledgement(const std::string& id) {
  const std::lock_guard lock(mutex_);
  if (WarningInputs::WorkpieceWarning* const workpiece = findWarning(id)) workpiece->acknowledged_until.reset();
}

std::vector<std::string> WarningMonitor::acknowledged(SteadyTime now) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> ids;
  for (const WarningInputs::WorkpieceWarning& workpiece : inputs_.warnings) {
    if (workpiece.acknowledged_until && now <= *workpiece.acknowledged_until) ids.push_back(workpiece.id);
  }
  return ids;
}

void WarningMonitor::endAcknowledgements() {
  for (WarningInputs::WorkpieceWarning& workpiece : inputs_.warnings) workpiece.acknowledged_until.reset();
}

// The mesh that was acknowledged may be gone, or another one may have its name.
void WarningMonitor::endAcknowledgementsOfGoneMeshes() {
  for (WarningInputs::WorkpieceWarning& workpiece : inputs_.warnings) {
    if (!workpiece.acknowledged_until) continue;
    const auto same = [&](const auto& one) {
      return one->id == workpiece.id && one->revision == workpiece.acknowledged_revision;
    };
    if (std::none_of(workpieces_.begin(), workpieces_.end(), same)) workpiece.acknowledged_until.reset();
  }
}

void WarningMonitor::timeJumped(const std::string& message) {
  {
    const std::lock_guard lock(mutex_);
    restartLocked();
    if (inputs_.contact) inputs_.contact->lasting = false;
    addFault(kTimeJump, message);
  }
  on_fault_();
}

void WarningMonitor::restartLocked() {
  ++checkpoint_.epoch;
  inputs_.pose.reset();
  inputs_.warnings.clear();
  inputs_.removed = {};
  inputs_.overload.reset();
  inputs_.pose_loss.reset();
  inputs_.faults.clear();
  if (inputs_.failure && !inputs_.failure->lasting) inputs_.failure.reset();
  swept_until_ = {};
  coverage_.reset();
  swept_.clear();
  fault_numbers_.clear();
  updateObjects();
  updateRefusals();
  updateDetectorFaults();
}

void WarningMonitor::restart() {
  {
    const std::lock_guard lock(mutex_);
    disagreement_.clear();
    restartLocked();
    inputs_.contact.reset();
    inputs_.failure.reset();
  }
  on_fault_();
}

void WarningMonitor::disable(const std::string& asked_by) {
  {
    const std::lock_guard lock(mutex_);
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
    const std::lock_guard lock(mutex_);
    Warning warning;
    computeLocked(now, warning);
    if (warning.level >= level) return warning.text;
    disableLocked(asked_by);
  }
  on_fault_();
  return {};
}

void WarningMonitor::enable() {
  {
    const std::lock_guard lock(mutex_);
    if (!inputs_.disabled_by) return;
    restartLocked();
    inputs_.disabled_by.reset();
  }
  on_fault_();
}

void WarningMonitor::end() {
  {
    const std::lock_guard lock(mutex_);
    restartLocked();
    inputs_.ended = true;
  }
  on_fault_();
}

std::optional<std::string> WarningMonitor::disabledBy() const {
  const std::lock_guard lock(mutex_);
  return inputs_.disabled_by;
}

bool WarningMonitor::counts(const Checkpoint& checkpoint) const {
  const std::lock_guard lock(mutex_);
  return checkpoint_.continues(checkpoint) && !inputs_.disabled_by && !inputs_.ended;
}

void WarningMonitor::setLimits(const WarningLimits& limits) {
  const std::lock_guard lock(mutex_);
  limits_ = limits;
}

void WarningMonitor::warning(const Instant& now, Warning& warning) const {
  const std::lock_guard lock(mutex_);
  computeLocked(now, warning);
}

void WarningMonitor::computeLocked(const Instant& now, Warning& warning) const {
  inputs_.covered_until = coveredUntil(now);
  inputs_.waiting_since = waiting_since_();
  inputs_.hung = hung_();
  computeWarning(inputs_, now, limits_, warning);
}

std::string WarningMonitor::meshProblems(const Instant& now, const std::vector<std::string>& ids) const {
  const std::lock_guard lock(mutex_);
  const auto asked = [&](const std::string& id) {
    return ids.empty() || std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  WarningInputs meshes;
  for (const WarningInputs::Object& object : inputs_.objects) {
    if (asked(object.id)) meshes.objects.push_back(object);
  }
  for (const std::string& id : inputs_.required) {
    if (asked(id)) meshes.required.push_back(id);
  }
  for (const Refusals* refusals : {&refused_vertices_, &refused_meshes_}) {
    for (const auto& [id, refusal] : *refusals) {
      const bool may_hide_others = refusals->size() >= kRefusalsKept;
      if (asked(id) || may_hide_others) meshes.faults[kMeshInvalid] = refusal.message;
    }
  }
  if (!test_failure_.empty()) meshes.faults[kSelftest] = test_failure_;
  if (!disagreement_.empty()) meshes.faults[kCrosscheck] = disagreement_;
  meshes.unread = inputs_.unread;
  if (inputs_.failure && inputs_.failure->lasting) meshes.failure = inputs_.failure;
  meshes.hung = hung_();
  return sweep_guard_core::meshProblems(meshes, now, limits_);
}

// Poses may come faster than predictions: an older prediction counts while its pose is not stale.
Time WarningMonitor::coveredUntil(const Instant& now) const {
  if (!coverage_ || coverage_->pose.stamp > swept_until_ || stale(coverage_->pose, now, limits_.pose_timeout)) {
    return swept_until_;
  }
  const auto tested = [&](const auto& workpiece) { return holds(coverage_->tested, *workpiece); };
  const bool all = std::all_of(workpieces_.begin(), workpieces_.end(), tested);
  return all ? std::max(swept_until_, coverage_->covered_until) : swept_until_;
}

}  // namespace sweep_guard_core
