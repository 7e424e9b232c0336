#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/guard/prediction.h"

namespace sweep_guard_core {

/// Smallest probabilities that a sweep off the predicted path is warned of at a level, each in (0, 1].
struct ContactThresholds {
  double reflex;
  double considered;
};

/// A contact with one workpiece that the operator may be warned of, and the prediction that it comes from.
struct PredictedContact {
  /// Start of the first sweep that calls for the level: with contact, or probable enough. At least one is set.
  std::optional<Time> reflex;
  std::optional<Time> considered;
  std::optional<Time> contact;  ///< start of the first sweep with contact; empty: merely probable
  double probability = 0.0;     ///< largest probability of the sweeps from earliest() on, in [0, 1]
  std::string mesh_id = {};
  std::vector<std::uint32_t> triangles = {};  ///< of the workpiece, met by the predicted path: ascending, each once
  /// Index of the convex piece of the tool that is most likely to meet the workpiece: in the first sweep with contact,
  /// or in the first that warns if none has contact. Empty only if the prediction names no piece there.
  std::optional<size_t> tool_piece = {};
  Timestamps pose = {};    ///< newest measured pose, where the prediction begins
  Duration duration = {};  ///< length of the prediction, from the stamp of that pose

  Time earliest() const;  ///< the earlier of `reflex` and `considered`
};

/// Finds the first sweeps that meet a workpiece, or do so with at least these probabilities.
/// @param object        one of the prediction's
/// @param pose          times of the pose where the prediction begins
/// @param[out] contact  overwritten; empty if there is none
void findPredictedContact(const Prediction& prediction, const PredictedObject& object, const Timestamps& pose,
                          const ContactThresholds& thresholds, std::optional<PredictedContact>& contact);

}  // namespace sweep_guard_core
