#pragma once

#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// The predicted motion of the tool after a pose, not yet tested for contacts.
struct PredictedMotion {
  PoseWithFrames from;
  PredictedPath path;        ///< empty if the motion is not known yet
  size_t reflex_sweeps = 0;  ///< number of sweeps, counted from the first, that end within the reflex interval
};

}  // namespace sweep_guard_core
