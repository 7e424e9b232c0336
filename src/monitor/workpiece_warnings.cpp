#include "monitor/workpiece_warnings.h"

#include <algorithm>
#include <cassert>

#include "monitor/swept_workpieces.h"

namespace sweep_guard_core {
namespace {

void setAlarm(std::optional<WarningInputs::Alarm>& alarm, const PredictedContact& contact, SteadyTime ended) {
  if (alarm && ended < alarm->ended) return;
  if (!alarm) alarm.emplace();
  alarm->contact = contact;
  alarm->ended = ended;
}

void keepNewer(std::optional<WarningInputs::Alarm>& kept, std::optional<WarningInputs::Alarm>& alarm) {
  if (alarm && (!kept || kept->ended < alarm->ended)) std::swap(kept, alarm);
}

bool isTested(const Prediction& prediction, const std::string& id) {
  return std::any_of(prediction.objects.begin(), prediction.objects.end(),
                     [&](const PredictedObject& object) { return object.workpiece->id == id; });
}

}  // namespace

void WorkpieceWarnings::update(const Prediction& prediction, const Timestamps& pose, const Workpieces& newest,
                               const Instant& now) {
  for (const PredictedObject& object : prediction.objects) updateOne(prediction, object, pose, now);
  endUntested(prediction, newest, now);
}

void WorkpieceWarnings::updateOne(const Prediction& prediction, const PredictedObject& object, const Timestamps& pose,
                                  const Instant& now) {
  findNext(prediction, object, pose, now);
  WarningInputs::WorkpieceWarning* workpiece = find(object.workpiece->id);
  if (workpiece == nullptr && !next_) return;
  if (workpiece == nullptr) workpiece = &inputs_.warnings.emplace_back();
  workpiece->id = object.workpiece->id;
  updateAlarms(*workpiece, now);
  std::swap(workpiece->predicted, next_);
  const auto& predicted = workpiece->predicted;
  if (predicted && warningLevel(*predicted, now, limits_) == WarningLevel::kReflex) endAcknowledgements();
}

void WorkpieceWarnings::findNext(const Prediction& prediction, const PredictedObject& object, const Timestamps& pose,
                                 const Instant& now) {
  const WarningInputs::WorkpieceWarning* const workpiece = find(object.workpiece->id);
  const auto& [reflex, considered_on, considered_off] = limits_.thresholds;
  const bool is_on = workpiece != nullptr && workpiece->predicted && isConsidered(*workpiece->predicted, now, limits_);
  ContactThresholds thresholds = {reflex, is_on ? considered_off : considered_on, age(pose, now) + limits_.reflex,
                                  age(pose, now) + limits_.considered};
  findPredictedContact(prediction, object, pose, thresholds, next_);
  if (is_on && next_ && !isConsidered(*next_, now, limits_)) {
    thresholds.considered = considered_on;
    findPredictedContact(prediction, object, pose, thresholds, next_);
  }
}

void WorkpieceWarnings::endUntested(const Prediction& prediction, const Workpieces& newest, const Instant& now) {
  for (auto workpiece = inputs_.warnings.begin(); workpiece != inputs_.warnings.end();) {
    const bool known = findWorkpiece(newest, workpiece->id) != nullptr;
    const bool stands = known && workpiece->predicted && timeSinceEnd(*workpiece->predicted, now) == Duration::zero();
    const bool ends = !stands && !isTested(prediction, workpiece->id);
    if (ends) updateAlarms(*workpiece, now);
    if (ends) workpiece->predicted.reset();
    if (ends && !known) keepAlarms(*workpiece);
    workpiece = ends && !known ? inputs_.warnings.erase(workpiece) : std::next(workpiece);
  }
}

void WorkpieceWarnings::updateAlarms(WarningInputs::WorkpieceWarning& workpiece, const Instant& now) {
  if (!workpiece.predicted) return;
  const PredictedContact& predicted = *workpiece.predicted;
  const SteadyTime ended = now.steady - timeSinceEnd(predicted, now);
  const WarningLevel level = warningLevel(predicted, now, limits_);
  if (level >= WarningLevel::kConsidered) setAlarm(workpiece.considered, predicted, ended);
  if (level < WarningLevel::kReflex) return;
  setAlarm(workpiece.reflex, predicted, ended);
  endAcknowledgements();
}

void WorkpieceWarnings::keepAlarms(WarningInputs::WorkpieceWarning& gone) {
  keepNewer(inputs_.removed.reflex, gone.reflex);
  keepNewer(inputs_.removed.considered, gone.considered);
}

void WorkpieceWarnings::restart() {
  inputs_.warnings.clear();
  inputs_.removed = {};
}

bool WorkpieceWarnings::isWarnedOf(const std::string& id, const Instant& now) const {
  return std::any_of(inputs_.warnings.begin(), inputs_.warnings.end(), [&](const auto& warning) {
    return warning.id == id && sweep_guard_core::isWarnedOf(warning, now, limits_);
  });
}

void WorkpieceWarnings::acknowledge(const Workpiece& workpiece, const Instant& now) {
  assert(isWarnedOf(workpiece.id, now));
  WarningInputs::WorkpieceWarning& warning = *find(workpiece.id);
  warning.acknowledged_until = now.steady + limits_.acknowledge_time;
  warning.acknowledged_revision = workpiece.revision;
}

std::vector<std::string> WorkpieceWarnings::acknowledged(SteadyTime now) const {
  std::vector<std::string> ids;
  for (const WarningInputs::WorkpieceWarning& workpiece : inputs_.warnings) {
    if (workpiece.acknowledged_until && now <= *workpiece.acknowledged_until) ids.push_back(workpiece.id);
  }
  return ids;
}

void WorkpieceWarnings::endAcknowledgement(const std::string& id) {
  if (WarningInputs::WorkpieceWarning* const workpiece = find(id)) workpiece->acknowledged_until.reset();
}

void WorkpieceWarnings::endAcknowledgements() {
  for (WarningInputs::WorkpieceWarning& workpiece : inputs_.warnings) workpiece.acknowledged_until.reset();
}

void WorkpieceWarnings::endAcknowledgementsOfGone(const Workpieces& newest) {
  for (WarningInputs::WorkpieceWarning& workpiece : inputs_.warnings) {
    const Workpiece* const one = findWorkpiece(newest, workpiece.id);
    const bool same = one != nullptr && one->revision == workpiece.acknowledged_revision;
    if (!same) workpiece.acknowledged_until.reset();
  }
}

WarningInputs::WorkpieceWarning* WorkpieceWarnings::find(const std::string& id) {
  const auto same = [&](const WarningInputs::WorkpieceWarning& workpiece) { return workpiece.id == id; };
  const auto found = std::find_if(inputs_.warnings.begin(), inputs_.warnings.end(), same);
  return found == inputs_.warnings.end() ? nullptr : &*found;
}

}  // namespace sweep_guard_core
