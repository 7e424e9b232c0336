#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_core {

/// Keeps what is predicted for each workpiece, what was, and what the operator knows of: `warnings` and `removed` of
/// the inputs.
class WorkpieceWarnings {
 public:
  /// @param inputs  must outlive this, as the limits
  WorkpieceWarnings(WarningInputs& inputs, const WarningLimits& limits) : inputs_(inputs), limits_(limits) {}

  /// Takes over a prediction. The contact predicted with a workpiece that could not be tested again stands until its
  /// prediction ends.
  /// @param pose    where the prediction begins
  /// @param newest  snapshots of all workpieces. Of those that are gone only the newest alarms are kept, so that many
  ///     ids take no memory
  void update(const Prediction& prediction, const Timestamps& pose, const Workpieces& newest, const Instant& now);
  void restart();  ///< forgets everything

  bool isWarnedOf(const std::string& id, const Instant& now) const;
  void acknowledge(const Workpiece& workpiece, const Instant& now);  ///< it must be warned of (asserted)
  std::vector<std::string> acknowledged(SteadyTime now) const;       ///< ids
  void endAcknowledgement(const std::string& id);
  void endAcknowledgements();
  void endAcknowledgementsOfGone(const Workpieces& newest);  ///< also where another mesh has the name

 private:
  WarningInputs::WorkpieceWarning* find(const std::string& id);
  void updateOne(const Prediction& prediction, const PredictedObject& object, const Timestamps& pose,
                 const Instant& now);
  void findNext(const Prediction& prediction, const PredictedObject& object, const Timestamps& pose,
                const Instant& now);
  void endUntested(const Prediction& prediction, const Workpieces& newest, const Instant& now);
  void updateAlarms(WarningInputs::WorkpieceWarning& workpiece, const Instant& now);
  void keepAlarms(WarningInputs::WorkpieceWarning& gone);

  WarningInputs& inputs_;
  const WarningLimits& limits_;
  std::optional<PredictedContact> next_;  // while a prediction is taken over
};

}  // namespace sweep_guard_core
