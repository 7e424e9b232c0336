#pragma once

#include <array>
#include <string>

#include "prediction/delayed_targets.h"
#include "prediction/displacement_regression.h"
#include "prediction/error_model.h"
#include "prediction/motion_regressors.h"

namespace sweep_guard_core {

/// What `direct` has learned of an operator. A predictor may begin with it instead of with constant velocity; it then
/// goes on to learn and to forget as ever.
struct Profile {
  using Regressions = std::array<DisplacementRegression<PoseSpace::kAxes>::Learned, kLearnedHorizons.size()>;

  Regressions translation;
  Regressions rotation;
  MotionRegressors<PoseSpace>::Speeds speeds;
  ErrorModel<PoseSpace>::Shares errors;
};

constexpr size_t kMaxProfileSize = 1U << 18U;  ///< of its text [bytes]

/// Returns the profile as text with a version and all digits, whatever the locale is.
std::string toText(const Profile& profile);

/// Reads what toText() returned.
/// @throws InvalidInput if it is of another version or predictor, of other horizons or regressors, not complete, too
///     long, or has numbers that no predictor has learned
Profile profileFromText(const std::string& text);

}  // namespace sweep_guard_core
