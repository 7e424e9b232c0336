#pragma once

#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// Returns the options.
/// @throws InvalidInput if one is out of range; not if the name of the predictor is unknown
const PredictorOptions& checked(const PredictorOptions& options);

}  // namespace sweep_guard_core
