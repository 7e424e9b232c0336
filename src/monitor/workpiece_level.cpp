#include "monitor/workpiece_level.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

WorkpieceLevel levelOf(const WarningInputs::WorkpieceWarning& workpiece, const Instant& now,
                       const WarningLimits& limits) {
  WorkpieceLevel warned;
  if (workpiece.predicted) {
    const Duration since_end = timeSinceEnd(*workpiece.predicted, now);
    const bool current = since_end == Duration::zero();
    if (limits.hold(since_end)) {
      warned.raise(warningLevel(*workpiece.predicted, now, limits), *workpiece.predicted,
                   current ? std::nullopt : std::optional(now.steady - since_end));
    }
  }
  const auto raiseIfHeld = [&](WarningLevel level, const std::optional<WarningInputs::Alarm>& alarm) {
    if (alarm && limits.hold(now.steady - alarm->ended)) warned.raise(level, alarm->contact, alarm->ended);
  };
  raiseIfHeld(WarningLevel::kReflex, workpiece.reflex);
  raiseIfHeld(WarningLevel::kConsidered, workpiece.considered);
  warned.acknowledged = warned.level == WarningLevel::kConsidered && workpiece.acknowledged_until &&
                        now.steady <= *workpiece.acknowledged_until;
  return warned;
}

}  // namespace

WorkpieceLevel strongestWarning(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits) {
  WorkpieceLevel strongest = levelOf(inputs.removed, now, limits);
  for (const WarningInputs::WorkpieceWarning& workpiece : inputs.warnings) {
    const WorkpieceLevel warned = levelOf(workpiece, now, limits);
    if (warned.goesBefore(strongest)) strongest = warned;
  }
  return strongest;
}

const PredictedContact* currentPrediction(const WarningInputs& inputs, const Instant& now,
                                          const WorkpieceLevel& warned) {
  const PredictedContact* current = nullptr;
  for (const WarningInputs::WorkpieceWarning& workpiece : inputs.warnings) {
    if (!workpiece.predicted || timeSinceEnd(*workpiece.predicted, now) > Duration::zero()) continue;
    if (warned.contact != nullptr && warned.contact->mesh_id != workpiece.id) continue;
    if (current == nullptr || workpiece.predicted->earliest() < current->earliest()) current = &*workpiece.predicted;
  }
  return current;
}

Duration timeTo(Time moment, const Timestamps& pose, const Instant& now) {
  return moment - pose.stamp - age(pose, now);
}

WarningLevel warningLevel(const PredictedContact& predicted, const Instant& now, const WarningLimits& limits) {
  const auto isWithin = [&](const std::optional<Time>& start, Duration interval) {
    return start && timeTo(*start, predicted.pose, now) + timeSinceEnd(predicted, now) <= interval + limits.tick;
  };
  if (isWithin(predicted.reflex, limits.reflex)) return WarningLevel::kReflex;
  return isWithin(predicted.considered, limits.considered) ? WarningLevel::kConsidered : WarningLevel::kClear;
}

bool isConsidered(const PredictedContact& predicted, const Instant& now, const WarningLimits& limits) {
  return predicted.considered && timeSinceEnd(predicted, now) == Duration::zero() &&
         timeTo(*predicted.considered, predicted.pose, now) <= limits.considered + limits.tick;
}

bool isWarnedOf(const WarningInputs::WorkpieceWarning& workpiece, const Instant& now, const WarningLimits& limits) {
  return levelOf(workpiece, now, limits).level != WarningLevel::kClear;
}

Duration timeSinceEnd(const PredictedContact& predicted, const Instant& now) {
  return std::max(Duration::zero(), age(predicted.pose, now) - predicted.duration);
}

}  // namespace sweep_guard_core
