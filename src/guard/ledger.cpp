#include "sweep_guard/guard/ledger.h"

#include <algorithm>

namespace sweep_guard {
namespace {

constexpr size_t kRefusedMeshesKept = 64;  // a flood of made-up ids must not grow the ledger

bool sameTriangles(const Workpiece& a, const Workpiece& b) {
  return a.id == b.id && a.frame == b.frame && &a.mesh_M.triangles() == &b.mesh_M.triangles();
}

bool holds(const Workpieces& workpieces, const Workpiece& workpiece) {
  return std::any_of(workpieces.begin(), workpieces.end(),
                     [&](const auto& one) { return sameTriangles(*one, workpiece); });
}

std::optional<size_t> firstPart(const SweepFindings& findings) {
  const auto sooner = [](const TouchedTriangle& a, const TouchedTriangle& b) {
    return a.impact.time_of_impact < b.impact.time_of_impact;
  };
  const auto first = std::min_element(findings.touched.begin(), findings.touched.end(), sooner);
  return first == findings.touched.end() ? std::nullopt : std::optional(first->part);
}

// A workpiece that is there, and whose sweep had no answer.
bool notSwept(const SweepReport& report, const std::string& id) {
  const auto unplaced = [&](const auto& workpiece) { return workpiece->id == id; };
  const auto failed = [&](const SweepFailure& failure) { return failure.workpiece->id == id; };
  return std::any_of(report.unplaced.begin(), report.unplaced.end(), unplaced) ||
         std::any_of(report.failures.begin(), report.failures.end(), failed);
}

}  // namespace

Ledger::Ledger(const VerdictLimits& limits, std::function<void()> on_fault)
    : on_fault_(std::move(on_fault)), limits_(limits) {}

Ledger::Mark Ledger::mark() const {
  const std::lock_guard lock(mutex_);
  return mark_;
}

void Ledger::fault(Reason reason, const std::string& story) {
  {
    const std::lock_guard lock(mutex_);
    note(reason, story);
  }
  on_fault_();
}

void Ledger::note(Reason reason, const std::string& story) { faults_[reason] = {story, ++mark_.faults}; }

void Ledger::meshRefused(const std::string& id, const std::string& story) {
  {
    const std::lock_guard lock(mutex_);
    const bool room = refused_meshes_.size() < kRefusedMeshesKept || refused_meshes_.count(id) != 0;
    refused_meshes_[room ? id : refused_meshes_.rbegin()->first] = story;
  }
  on_fault_();
}

void Ledger::meshAccepted(const std::string& id) {
  const std::lock_guard lock(mutex_);
  refused_meshes_.erase(id);
}

void Ledger::setWorkpieces(const Workpieces& workpieces) {
  const std::lock_guard lock(mutex_);
  workpieces_ = workpieces;
}

void Ledger::swept(const SweepReport& report, const Seen& pose, const Mark& pose_came, SteadyTime now) {
  {
    const std::lock_guard lock(mutex_);
    if (pose_came.epoch != mark_.epoch) return;
    for (auto fault = faults_.begin(); fault != faults_.end();) {
      fault = fault->second.number <= pose_came.faults ? faults_.erase(fault) : std::next(fault);
    }
    for (const SweepFailure& failure : report.failures) {
      note(kDetectorFault, "detection on '" + failure.workpiece->id + "' failed: " + failure.reason);
    }
    pose_ = pose;
    swept_.clear();
    for (const SweptObject& object : report.objects) swept_.push_back(object.workpiece);
    if (report.complete()) swept_until_ = report.end;
    noteContact(report, now);
    if (report.backlog > limits_.overload) overload_ = Evidence::Backlog{report.backlog, now};
  }
  if (!report.failures.empty()) on_fault_();
}

void Ledger::noteContact(const SweepReport& report, SteadyTime now) {
  if (contact_) contact_->lasting = contact_->lasting && notSwept(report, contact_->id);
  for (const SweptObject& object : report.objects) {
    if (!object.findings.contact()) continue;
    const SweepFindings& found = object.findings;
    if (!contact_) contact_.emplace();
    contact_->id = object.workpiece->id;
    contact_->triangles = found.met;
    contact_->found = now;
    contact_->lasting = true;
    contact_->inside = found.inside;
    contact_->tool_part = firstPart(found);
    return;
  }
}

void Ledger::predicted(const Outlook& outlook, const Seen& pose, const Mark& pose_came, const Instant& now) {
  {
    const std::lock_guard lock(mutex_);
    if (pose_came.epoch != mark_.epoch) return;
    for (const SweepFailure& failure : outlook.failures) {
      note(kDetectorFault, "predicting contact with '" + failure.workpiece->id + "' failed: " + failure.reason);
    }
    prediction_ = Prediction{pose, outlook.coveredUntil(), {}};
    for (const PredictedObject& object : outlook.objects) prediction_->tested.push_back(object.workpiece);
    noteExpected(outlook, pose, now);
  }
  if (!outlook.failures.empty()) on_fault_();
}

// What was expected of a workpiece that could not be tested again still stands, to the end of its prediction.
void Ledger::noteExpected(const Outlook& outlook, const Seen& pose, const Instant& now) {
  const auto next = expectedContact(outlook, limits_.min_probability);
  if (expected_) {
    const ExpectedContact& before = expected_->contact;
    const auto same = [&](const auto& workpiece) { return workpiece->id == before.mesh_id; };
    const bool there = std::any_of(workpieces_.begin(), workpieces_.end(), same);
    const bool tested = std::any_of(prediction_->tested.begin(), prediction_->tested.end(), same);
    const bool stands = there && !tested && overSince(*expected_, now) == Duration::zero();
    if (stands && (!next || before.from <= next->from)) return;
    noteAlarm(now);
    expected_.reset();
  }
  if (next) expected_ = Evidence::Expectation{*next, pose, outlook.path.back().ahead};
}

void Ledger::noteAlarm(const Instant& now) {
  const Evidence::Alarm alarm{expected_->contact, now.steady - overSince(*expected_, now)};
  const Level level = warningOf(*expected_, now, limits_);
  if (level >= Level::kConsidered) considered_ = alarm;
  if (level >= Level::kReflex) reflex_ = alarm;
}

void Ledger::timeJumped(const std::string& story) {
  {
    const std::lock_guard lock(mutex_);
    beginAnew();
    if (contact_) contact_->lasting = false;
    note(kTimeJump, story);
  }
  on_fault_();
}

void Ledger::beginAnew() {
  ++mark_.epoch;
  pose_.reset();
  swept_until_ = {};
  prediction_.reset();
  expected_.reset();
  reflex_.reset();
  considered_.reset();
  overload_.reset();
  swept_.clear();
  faults_.clear();
}

void Ledger::restart() {
  {
    const std::lock_guard lock(mutex_);
    beginAnew();
    contact_.reset();
  }
  on_fault_();
}

void Ledger::disable(const std::string& asked_by) {
  {
    const std::lock_guard lock(mutex_);
    if (disabled_by_) return;
    beginAnew();
    contact_.reset();
    disabled_by_ = asked_by;
  }
  on_fault_();
}

void Ledger::enable() {
  {
    const std::lock_guard lock(mutex_);
    if (!disabled_by_) return;
    beginAnew();
    disabled_by_.reset();
  }
  on_fault_();
}

std::optional<std::string> Ledger::disabledBy() const {
  const std::lock_guard lock(mutex_);
  return disabled_by_;
}

bool Ledger::counts(const Mark& came) const {
  const std::lock_guard lock(mutex_);
  return came.epoch == mark_.epoch && !disabled_by_;
}

void Ledger::setLimits(const VerdictLimits& limits) {
  const std::lock_guard lock(mutex_);
  limits_ = limits;
}

Verdict Ledger::verdict(const Instant& now) const {
  const std::lock_guard lock(mutex_);
  Evidence evidence;
  evidence.disabled = disabled_by_;
  evidence.pose = pose_;
  evidence.covered_until = coveredUntil(now);
  evidence.expected = expected_;
  evidence.reflex = reflex_;
  evidence.considered = considered_;
  evidence.contact = contact_;
  evidence.overload = overload_;
  for (const auto& workpiece : workpieces_) {
    evidence.objects.push_back({workpiece->id, {workpiece->stamp, workpiece->received}, holds(swept_, *workpiece)});
  }
  for (const auto& [reason, fault] : faults_) evidence.faults[reason] = fault.story;
  for (const auto& [id, story] : refused_meshes_) evidence.faults[kMeshInvalid] = story;
  return assess(evidence, now, limits_);
}

// A prediction counts where it follows on what has been swept, for as long as its pose is not stale: a newer pose
// outdates it, but poses may come faster than predictions.
Time Ledger::coveredUntil(const Instant& now) const {
  if (!prediction_ || prediction_->pose.stamp > swept_until_ || stale(prediction_->pose, now, limits_.pose_timeout)) {
    return swept_until_;
  }
  const auto tested = [&](const auto& workpiece) { return holds(prediction_->tested, *workpiece); };
  const bool all = std::all_of(workpieces_.begin(), workpieces_.end(), tested);
  return all ? std::max(swept_until_, prediction_->covered_until) : swept_until_;
}

}  // namespace sweep_guard
