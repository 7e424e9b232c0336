#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/guard/prediction.h"

namespace sweep_guard_core {

/// Smallest probabilities of a contact off the predicted path that is warned of at a level, and the intervals of both.
struct ContactThresholds {
  double reflex;            ///< in (0, 1]
  double considered;        ///< in (0, 1]
  Duration reflex_end;      ///< of the reflex interval, after the stamp of the prediction
  Duration considered_end;  ///< of the considered interval, after the stamp of the prediction
};

/// A contact with one workpiece that the operator may be warned of, and the prediction that it comes from.
struct PredictedContact {
  /// Start of the first sweep that calls for the level: with contact, or probable enough. At least one is set.
  std::optional<Time> reflex;
  std::optional<Time> considered;
  std::optional<Time> contact;  ///< start of the first sweep with contact; empty: merely probable
  /// Probability that the tool meets the workpiece within each interval, or until the start of the sweep above if that
  /// is later, in [0, 1].
  double reflex_probability = 0.0;
  double considered_probability = 0.0;
  std::string mesh_id = {};
  std::vector<std::uint32_t> triangles = {};  ///< of the workpiece, met by the predicted path: ascending, each once
  /// Index of the convex piece of the tool that is most likely to meet the workpiece: in the first sweep with contact,
  /// or in the first that warns if none has contact. Empty only if the prediction names no piece there.
  std::optional<size_t> tool_piece = {};
  Timestamps pose = {};    ///< newest measured pose, where the prediction begins
  Duration duration = {};  ///< length of the prediction, from the stamp of that pose

  Time earliest() const;  ///< the earlier of `reflex` and `considered`
};

/// Finds the first sweeps that meet a workpiece, or come so near to it that one of these probabilities is reached.
/// @param object        one of the prediction's
/// @param pose          times of the pose where the prediction begins
/// @param[out] contact  overwritten; empty if there is none
void findPredictedContact(const Prediction& prediction, const PredictedObject& object, const Timestamps& pose,
                          const ContactThresholds& thresholds, std::optional<PredictedContact>& contact);

}  // namespace sweep_guard_core
