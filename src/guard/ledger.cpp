#include "sweep_guard/guard/ledger.h"

#include <algorithm>

namespace sweep_guard {
namespace {

constexpr size_t kRefusalsKept = 64;  // a flood of made-up ids must not grow the ledger

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

void note(std::optional<Evidence::Alarm>& alarm, const ExpectedContact& contact, SteadyTime ended) {
  if (!alarm) alarm.emplace();
  alarm->contact = contact;
  alarm->ended = ended;
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

void Ledger::note(Reason reason, const std::string& story) {
  evidence_.faults[reason] = story;
  fault_numbers_[reason] = ++mark_.faults;
}

void Ledger::meshRefused(const std::string& id, const std::string& story) { refused(refused_meshes_, id, story); }

void Ledger::verticesRefused(const std::string& id, const std::string& story) { refused(refused_vertices_, id, story); }

void Ledger::refused(Stories& refusals, const std::string& id, const std::string& story) {
  {
    const std::lock_guard lock(mutex_);
    const bool room = refusals.size() < kRefusalsKept || refusals.count(id) != 0;
    refusals[room ? id : refusals.rbegin()->first] = story;
    noteRefusals();
  }
  on_fault_();
}

void Ledger::meshAccepted(const std::string& id) {
  const std::lock_guard lock(mutex_);
  if (refused_meshes_.erase(id) + refused_vertices_.erase(id) > 0) noteRefusals();
}

void Ledger::verticesAccepted(const std::string& id) {
  const std::lock_guard lock(mutex_);
  if (refused_vertices_.erase(id) > 0) noteRefusals();
}

void Ledger::noteRefusals() {
  const Stories& told = refused_meshes_.empty() ? refused_vertices_ : refused_meshes_;
  evidence_.faults.erase(kMeshInvalid);
  if (!told.empty()) evidence_.faults[kMeshInvalid] = told.rbegin()->second;
}

void Ledger::setWorkpieces(const Workpieces& workpieces) {
  const std::lock_guard lock(mutex_);
  workpieces_ = workpieces;
  noteObjects();
}

void Ledger::noteObjects() {
  evidence_.objects.resize(workpieces_.size());
  for (size_t i = 0; i < workpieces_.size(); ++i) {
    const Workpiece& workpiece = *workpieces_[i];
    Evidence::Object& object = evidence_.objects[i];
    object.id = workpiece.id;
    object.seen = {workpiece.stamp, workpiece.received};
    object.swept = holds(swept_, workpiece);
  }
}

void Ledger::swept(const SweepReport& report, const Seen& pose, const Mark& pose_came, SteadyTime now) {
  {
    const std::lock_guard lock(mutex_);
    if (pose_came.epoch != mark_.epoch) return;
    for (auto fault = fault_numbers_.begin(); fault != fault_numbers_.end();) {
      const auto& [reason, number] = *fault;
      const bool mended = number <= pose_came.faults;
      if (mended) evidence_.faults.erase(reason);
      fault = mended ? fault_numbers_.erase(fault) : std::next(fault);
    }
    for (const SweepFailure& failure : report.failures) {
      note(kDetectorFault, "detection on '" + failure.workpiece->id + "' failed: " + failure.reason);
    }
    evidence_.pose = pose;
    swept_.clear();
    for (const SweptObject& object : report.objects) swept_.push_back(object.workpiece);
    noteObjects();
    if (report.complete()) swept_until_ = report.end;
    noteContact(report, now);
    if (report.backlog > limits_.overload) evidence_.overload = Evidence::Backlog{report.backlog, now};
  }
  if (!report.failures.empty()) on_fault_();
}

void Ledger::noteContact(const SweepReport& report, SteadyTime now) {
  auto& contact = evidence_.contact;
  if (contact) contact->lasting = contact->lasting && notSwept(report, contact->id);
  for (const SweptObject& object : report.objects) {
    if (!object.findings.contact()) continue;
    const SweepFindings& found = object.findings;
    if (!contact) contact.emplace();
    contact->id = object.workpiece->id;
    contact->triangles = found.met;
    contact->found = now;
    contact->lasting = true;
    contact->inside = found.inside;
    contact->tool_part = firstPart(found);
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
    if (!prediction_) prediction_.emplace();
    prediction_->pose = pose;
    prediction_->covered_until = outlook.coveredUntil();
    prediction_->tested.clear();
    for (const PredictedObject& object : outlook.objects) prediction_->tested.push_back(object.workpiece);
    noteExpected(outlook, pose, now);
  }
  if (!outlook.failures.empty()) on_fault_();
}

// What was expected of a workpiece that could not be tested again still stands, to the end of its prediction.
void Ledger::noteExpected(const Outlook& outlook, const Seen& pose, const Instant& now) {
  expectedContact(outlook, limits_.min_probability, next_);
  auto& expected = evidence_.expected;
  if (expected) {
    const ExpectedContact& before = expected->contact;
    const auto same = [&](const auto& workpiece) { return workpiece->id == before.mesh_id; };
    const bool there = std::any_of(workpieces_.begin(), workpieces_.end(), same);
    const bool tested = std::any_of(prediction_->tested.begin(), prediction_->tested.end(), same);
    const bool stands = there && !tested && overSince(*expected, now) == Duration::zero();
    if (stands && (!next_ || before.from <= next_->from)) return;
    noteAlarm(now);
  }
  if (!next_) return expected.reset();
  if (!expected) expected.emplace();
  std::swap(expected->contact, *next_);
  expected->pose = pose;
  expected->reach = outlook.path.back().ahead;
}

void Ledger::noteAlarm(const Instant& now) {
  const Evidence::Expectation& expected = *evidence_.expected;
  const SteadyTime ended = now.steady - overSince(expected, now);
  const Level level = warningOf(expected, now, limits_);
  if (level >= Level::kConsidered) sweep_guard::note(evidence_.considered, expected.contact, ended);
  if (level >= Level::kReflex) sweep_guard::note(evidence_.reflex, expected.contact, ended);
}

void Ledger::timeJumped(const std::string& story) {
  {
    const std::lock_guard lock(mutex_);
    beginAnew();
    if (evidence_.contact) evidence_.contact->lasting = false;
    note(kTimeJump, story);
  }
  on_fault_();
}

void Ledger::beginAnew() {
  ++mark_.epoch;
  evidence_.pose.reset();
  evidence_.expected.reset();
  evidence_.reflex.reset();
  evidence_.considered.reset();
  evidence_.overload.reset();
  evidence_.faults.clear();
  swept_until_ = {};
  prediction_.reset();
  swept_.clear();
  fault_numbers_.clear();
  noteObjects();
  noteRefusals();
}

void Ledger::restart() {
  {
    const std::lock_guard lock(mutex_);
    beginAnew();
    evidence_.contact.reset();
  }
  on_fault_();
}

void Ledger::disable(const std::string& asked_by) {
  {
    const std::lock_guard lock(mutex_);
    if (evidence_.disabled) return;
    beginAnew();
    evidence_.contact.reset();
    evidence_.disabled = asked_by;
  }
  on_fault_();
}

void Ledger::enable() {
  {
    const std::lock_guard lock(mutex_);
    if (!evidence_.disabled) return;
    beginAnew();
    evidence_.disabled.reset();
  }
  on_fault_();
}

std::optional<std::string> Ledger::disabledBy() const {
  const std::lock_guard lock(mutex_);
  return evidence_.disabled;
}

bool Ledger::counts(const Mark& came) const {
  const std::lock_guard lock(mutex_);
  return came.epoch == mark_.epoch && !evidence_.disabled;
}

void Ledger::setLimits(const VerdictLimits& limits) {
  const std::lock_guard lock(mutex_);
  limits_ = limits;
}

Verdict Ledger::verdict(const Instant& now) const {
  Verdict verdict;
  this->verdict(now, verdict);
  return verdict;
}

void Ledger::verdict(const Instant& now, Verdict& verdict) const {
  const std::lock_guard lock(mutex_);
  evidence_.covered_until = coveredUntil(now);
  assess(evidence_, now, limits_, verdict);
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
