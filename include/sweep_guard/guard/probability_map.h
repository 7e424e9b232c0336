#pragma once

namespace sweep_guard_core {

/// An interval of HorizonOptions. Both begin now.
enum class PredictionInterval { kReflex, kConsidered };

/// Returns the probability that the tool meets a workpiece within an interval, anywhere and on any way, if the predicted
/// path comes as near to the workpiece within that interval as `deviations` (PredictedSweep). Falls with the deviations;
/// 0 beyond kMaxDeviations. These are the frequencies on recorded motion (doc/warnings.md).
double probabilityWithin(PredictionInterval interval, double deviations);

/// Returns the largest number of deviations that has at least this probability; -infinity if none has. The inverse of
/// probabilityWithin().
double deviationsAt(PredictionInterval interval, double probability);

/// Returns the probability within an interval at the deviations of which contactProbability() is `plane_probability`;
/// 1 if there are none.
double fromPlaneProbability(PredictionInterval interval, double plane_probability);

}  // namespace sweep_guard_core
