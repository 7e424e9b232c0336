#include "monitor_model.h"

#include <algorithm>

namespace sweep_guard_fuzz {
namespace {

constexpr MonitorModel::Level kUnknown = 0;
constexpr MonitorModel::Level kClear = 1;
constexpr MonitorModel::Level kConsidered = 2;
constexpr MonitorModel::Level kReflex = 3;
constexpr MonitorModel::Level kContact = 4;

constexpr std::int64_t kPoseTimeout = 100;
constexpr std::int64_t kMeshTimeout = 500;
constexpr std::int64_t kHoldTime = 500;
constexpr std::int64_t kReflexEnd = 100 + 15;  // the next warning may be a tick away
constexpr std::int64_t kConsideredEnd = 1000;
constexpr std::int64_t kTick = 15;
constexpr std::int64_t kOverload = 20;
constexpr std::int64_t kUnreadTime = 1000;
constexpr std::int64_t kFailureShown = 100;
constexpr std::int64_t kStandsIn = 50;

std::int64_t age(const MonitorModel::Clock& input, const MonitorModel::Clock& now) {
  return std::max(now.stamp - input.stamp, now.steady - input.steady);
}

}  // namespace

void MonitorModel::place(int id, int mesh, const Clock& times) {
  auto& workpiece = workpieces_[at(id)];
  if (!workpiece) workpiece = Workpiece{mesh, times, {}, {}};
  if (workpiece->mesh != mesh) workpiece->replaced[workpiece->mesh] = times.steady;
  workpiece->mesh = mesh;
  workpiece->times = times;
}

void MonitorModel::remove(int id) { workpieces_[at(id)].reset(); }

void MonitorModel::fail(std::int64_t now, bool lasting) {
  failure_ = Failure{event(), now, lasting || (failure_ && failure_->lasts)};
}

void MonitorModel::acceptMesh(int id, std::int64_t received) {
  auto& refused = refused_meshes_[at(id)];
  if (refused && *refused <= received) refused.reset();
  acceptVertices(id, received);
}

void MonitorModel::acceptVertices(int id, std::int64_t received) {
  auto& refused = refused_vertices_[at(id)];
  if (refused && *refused <= received) refused.reset();
}

void MonitorModel::drop(int id, std::int64_t received) {
  auto& workpiece = workpieces_[at(id)];
  if (workpiece) workpiece->dropped = std::max(workpiece->dropped.value_or(received), received);
}

void MonitorModel::selfTest(bool passed) {
  const bool exchanged = self_test_failed_ && passed;
  self_test_failed_ = !passed;
  if (exchanged) newEpoch();
}

void MonitorModel::disagree(int id, int mesh, bool missed, const Checkpoint& asked, std::int64_t now) {
  if (asked.epoch != epoch_) return;
  disagreed_ = true;
  const auto& workpiece = workpieces_[at(id)];
  if (!missed || disabled_ || !workpiece || workpiece->mesh != mesh) return;
  if (!contact_ || (contact_->id != id && !contact_->lasts)) contact_ = Contact{id, now, false};
  contact_->found = now;
}

void MonitorModel::newEpoch() {
  first_epoch_ = ++epoch_;
  pose_.reset();
  expected_ = {};
  alarms_ = {};
  fault_ = 0;
  if (failure_ && !failure_->lasts) failure_.reset();
  for (auto& workpiece : workpieces_) {
    if (workpiece) workpiece->swept.reset();
  }
  swept_until_ = 0;
  coverage_.reset();
}

void MonitorModel::jump() {
  const int first_epoch = first_epoch_;
  newEpoch();
  first_epoch_ = first_epoch;
  if (contact_) contact_->lasts = false;
  fault();
}

void MonitorModel::restart() {
  newEpoch();
  contact_.reset();
  failure_.reset();
  disagreed_ = false;
}

void MonitorModel::disable() {
  if (disabled_) return;
  newEpoch();
  contact_.reset();
  disabled_ = true;
}

void MonitorModel::enable() {
  if (!disabled_) return;
  newEpoch();
  disabled_ = false;
}

void MonitorModel::end() {
  newEpoch();
  ended_ = true;
}

// Only what it met counts.
void MonitorModel::sweepBeforeJump(const Report& report, std::int64_t now) {
  if (report.checkpoint.epoch < first_epoch_ || disabled_ || ended_) return;
  for (int id = 0; id < kIds; ++id) {
    const Tested& tested = report.tested[at(id)];
    if (!tested.present || !tested.contact) continue;
    contact_ = Contact{id, now, false};
    return;
  }
}

void MonitorModel::sweep(const Report& report, std::int64_t now) {
  if (report.checkpoint.epoch != epoch_) return sweepBeforeJump(report, now);
  if (fault_ <= report.checkpoint.event) fault_ = 0;
  const bool over = failure_ && failure_->event <= report.checkpoint.event && !failure_->lasts;
  if (over && now - failure_->found >= kFailureShown) failure_.reset();
  if (report.failed) fault();
  pose_ = report.pose;
  bool any = false;
  bool complete = true;
  std::optional<int> met;
  for (int id = 0; id < kIds; ++id) {
    const Tested& tested = report.tested[at(id)];
    auto& workpiece = workpieces_[at(id)];
    any = any || tested.present;
    complete = complete && !report.missing[at(id)] && !(tested.present && tested.behind);
    if (tested.present && tested.contact && !met) met = id;
    if (!workpiece) continue;
    workpiece->swept.reset();
    if (tested.present && !tested.behind) workpiece->swept = tested.mesh;
    if (tested.present && workpiece->dropped && tested.received > *workpiece->dropped) workpiece->dropped.reset();
  }
  if (any && complete) swept_until_ = report.pose.stamp;
  if (contact_) contact_->lasts = contact_->lasts && report.missing[at(contact_->id)];
  if (met) contact_ = Contact{*met, now, true};
}

bool MonitorModel::counts(const std::optional<int>& tested, const Workpiece& workpiece, const Clock& now) {
  if (!tested) return false;
  const auto replaced = workpiece.replaced.find(*tested);
  return *tested == workpiece.mesh ||
         (replaced != workpiece.replaced.end() && now.steady - replaced->second <= kStandsIn);
}

void MonitorModel::keepAlarm(std::optional<Alarm>& kept, const Alarm& alarm) {
  if (!kept || kept->ended < alarm.ended) kept = alarm;
}

void MonitorModel::endExpected(int id, const Clock& now) {
  const auto& expected = expected_[at(id)];
  if (!expected) return;
  const std::int64_t old = age(expected->pose, now);
  const std::int64_t since_end = std::max<std::int64_t>(0, old - expected->length);
  const std::int64_t left = expected->from - old + since_end;
  const std::int64_t ended = now.steady - since_end;
  if (left <= kConsideredEnd + kTick) keepAlarm(alarms_[at(id)][0], {kConsidered, ended});
  if (left <= kReflexEnd) keepAlarm(alarms_[at(id)][1], {kReflex, ended});
}

void MonitorModel::predict(const Report& report, const Clock& now) {
  if (report.checkpoint.epoch != epoch_) return;
  took_ = report.took;
  if (report.failed) fault();
  const bool whole = report.length > 0 &&
                     std::none_of(report.missing.begin(), report.missing.end(), [](bool missing) { return missing; });
  coverage_ = Coverage{report, report.pose.stamp + (whole ? report.length : 0)};
  for (int id = 0; id < kIds; ++id) {
    const Tested& tested = report.tested[at(id)];
    auto& expected = expected_[at(id)];
    const bool stands = known(id) && expected && age(expected->pose, now) <= expected->length;
    if (!tested.present && stands) continue;
    endExpected(id, now);
    expected.reset();
    if (tested.present && tested.contact) expected = Expected{report.pose, tested.from, report.length};
  }
}

std::string MonitorModel::whyNotSwept(const Clock& now) const {
  bool any = false;
  for (int id = 0; id < kIds; ++id) {
    const auto& workpiece = workpieces_[at(id)];
    any = any || workpiece;
    if (required_[at(id)] && !workpiece) return "a required workpiece is missing";
    if (refused_meshes_[at(id)]) return "a mesh was refused";
    if (refused_vertices_[at(id)]) return "vertices were refused";
    if (!workpiece) continue;
    if (age(workpiece->times, now) > kMeshTimeout) return "a workpiece is stale";
    if (workpiece->dropped) return "an update was dropped";
    if (!counts(workpiece->swept, *workpiece, now)) return "a workpiece was not swept";
  }
  return any ? "" : "no workpiece";
}

std::string MonitorModel::whyNotCovered(const Clock& now) const {
  if (!pose_) return "no pose was swept";
  if (age(*pose_, now) > kPoseTimeout) return "the pose is stale";
  std::int64_t until = swept_until_;
  if (coverage_ && coverage_->report.pose.stamp <= swept_until_ && age(coverage_->report.pose, now) <= kPoseTimeout) {
    bool all = true;
    for (int id = 0; id < kIds; ++id) {
      const auto& workpiece = workpieces_[at(id)];
      const Tested& tested = coverage_->report.tested[at(id)];
      all = all && (!workpiece || (tested.present && counts(tested.mesh, *workpiece, now)));
    }
    if (all) until = std::max(until, coverage_->until);
  }
  return until - pose_->stamp - age(*pose_, now) < kConsideredEnd ? "the path ahead was not tested" : "";
}

std::string MonitorModel::whyNotClear(const Clock& now) const {
  if (ended_ || disabled_) return "nothing is tested";
  if (hung_) return "a thread hangs";
  if (self_test_failed_) return "the detector failed its test";
  if (disagreed_) return "detectors disagreed";
  if (fault_ != 0) return "a fault came later than the pose";
  if (failure_) return "work failed";
  if (unread_ && now.steady - *unread_ <= kUnreadTime) return "a message was not read";
  if (waiting_ && now.steady - *waiting_ > std::max(kOverload, took_)) return "a pose waits";
  const std::string not_swept = whyNotSwept(now);
  return not_swept.empty() ? whyNotCovered(now) : not_swept;
}

MonitorModel::Level MonitorModel::warned(const Clock& now) const {
  Level highest = kUnknown;
  for (const auto& expected : expected_) {
    if (!expected) continue;
    const std::int64_t old = age(expected->pose, now);
    const std::int64_t since_end = std::max<std::int64_t>(0, old - expected->length);
    const std::int64_t left = expected->from - old + since_end;
    if (since_end > kHoldTime || left > kConsideredEnd + kTick) continue;
    highest = std::max(highest, left <= kReflexEnd ? kReflex : kConsidered);
  }
  for (const auto& alarms : alarms_) {
    for (const auto& alarm : alarms) {
      if (alarm && now.steady - alarm->ended <= kHoldTime) highest = std::max(highest, alarm->level);
    }
  }
  return highest;
}

MonitorModel::Level MonitorModel::level(const Clock& now) const {
  if (ended_ || disabled_) return kUnknown;
  if (contact_ && (contact_->lasts || now.steady - contact_->found <= kHoldTime)) return kContact;
  const Level warning = warned(now);
  if (warning != kUnknown) return warning;
  return whyNotClear(now).empty() ? kClear : kUnknown;
}

}  // namespace sweep_guard_fuzz
