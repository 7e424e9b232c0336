#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/guard/prediction.h"

namespace sweep_guard_core {

/// The contact that the operator is warned of, and the prediction that it comes from.
struct PredictedContact {
  Time earliest;                ///< start of the first sweep that warns: with contact, or probable enough
  std::optional<Time> contact;  ///< start of the first sweep with contact, >= `earliest`; empty: merely probable
  double probability = 0.0;     ///< largest probability of this workpiece's sweeps from `earliest` on, in [0, 1]
  std::string mesh_id = {};
  std::vector<std::uint32_t> triangles = {};  ///< of this workpiece, met by the predicted path: ascending, each once
  /// Index of the convex piece of the tool that is most likely to meet the workpiece: in the first sweep with contact,
  /// or in the first that warns if none has contact. Empty only if the prediction names no piece there.
  std::optional<size_t> tool_piece = {};
  Timestamps pose = {};    ///< newest measured pose, where the prediction begins
  Duration duration = {};  ///< length of the prediction, from the stamp of that pose
};

/// Finds the earliest sweep that meets a workpiece, or does so with at least this probability.
/// @param pose             times of the pose where the prediction begins
/// @param min_probability  in (0, 1] (asserted)
/// @param[out] contact     overwritten; empty if there is none
void findPredictedContact(const Prediction& prediction, const Timestamps& pose, double min_probability,
                          std::optional<PredictedContact>& contact);

}  // namespace sweep_guard_core
