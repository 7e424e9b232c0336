#pragma once

#include <optional>

#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_core {

/// The level of one workpiece, and the predicted contact that it comes from.
struct WorkpieceLevel {
  WarningLevel level = WarningLevel::kClear;
  const PredictedContact* contact = nullptr;
  std::optional<SteadyTime> ended = {};  ///< empty: it is predicted now
  bool acknowledged = false;

  void raise(WarningLevel to, const PredictedContact& about, const std::optional<SteadyTime>& since) {
    if (to > level) *this = {to, &about, since, false};
  }
  bool goesBefore(const WorkpieceLevel& other) const {
    if (level != other.level || level == WarningLevel::kClear) return level > other.level;
    if (acknowledged != other.acknowledged) return other.acknowledged;
    if (!ended != !other.ended) return !ended;
    return ended ? *ended > *other.ended : contact->earliest() < other.contact->earliest();
  }
};

/// Returns the level of the workpiece that is warned of; without `contact` there is none.
WorkpieceLevel strongestWarning(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits);

/// Returns the predicted contact of the workpiece that is warned of, or if there is none the earliest of all; null: none.
const PredictedContact* currentPrediction(const WarningInputs& inputs, const Instant& now,
                                          const WorkpieceLevel& warned);

/// Returns the time from now to a moment of the path that was predicted from a pose; negative: it is over.
Duration timeTo(Time moment, const Timestamps& pose, const Instant& now);

}  // namespace sweep_guard_core
