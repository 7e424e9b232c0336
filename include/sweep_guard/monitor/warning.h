#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/common/rules.h"
#include "sweep_guard/common/warning_level.h"
#include "sweep_guard/monitor/warning_inputs.h"

namespace sweep_guard_core {

/// Smallest probabilities of a contact off the predicted path within an interval (probabilityWithin()) that are warned
/// of, each in (0, 1].
struct WarningThresholds {
  double reflex = 0.0085;          ///< raises REFLEX
  double considered_on = 0.065;    ///< raises CONSIDERED
  double considered_off = 0.0029;  ///< keeps CONSIDERED up; <= considered_on

  /// Returns the thresholds of all contacts at least this probable on the scale of one plane, see fromPlaneProbability().
  static WarningThresholds ofMinProbability(double min_probability);
};

/// How long a warning is valid that a guard publishes.
constexpr Duration kWarningValid = std::chrono::milliseconds(200);

/// Limits of computeWarning(), which does not check them. The first three have no default.
struct WarningLimits {
  Duration pose_timeout;  ///< a pose older than this is stale; > 0
  Duration mesh_timeout;  ///< a workpiece older than this is stale; > 0; Duration::max(): never
  Duration
      hold_time;  ///< how long a contact, a warning, an overload, a loss, a jump or kNotSeen is shown after its end; >= 0
  Duration reflex = std::chrono::milliseconds(100);       ///< end of the reflex interval, counted from now, > 0
  Duration considered = std::chrono::milliseconds(1000);  ///< end of the considered interval, > reflex
  Duration tick = std::chrono::milliseconds(15);          ///< longest time until the next computeWarning(); >= 0
  /// Longest wait of poses that are swept at once, and of a pose that is not swept yet, without a reason; >= 0. The latter may
  /// wait for as long as the newest prediction took, if that is longer.
  Duration overload = std::chrono::milliseconds(20);
  WarningThresholds thresholds = {};
  Duration acknowledge_time = std::chrono::seconds(10);  ///< longest time that a warning stays acknowledged; >= 0
  Rules<Duration> mesh_timeouts = {};                    ///< of some workpieces, in place of `mesh_timeout`
  double min_seen = 0.09;  ///< cameras see too little of a path if Prediction::seen is less; in (0, 1]

  /// Returns the age above which a workpiece is stale.
  Duration meshTimeout(const std::string& id) const {
    const Duration* const rule = mesh_timeouts.of(id);
    return rule == nullptr ? mesh_timeout : *rule;
  }

  /// Returns whether something is still shown that has ended so long ago.
  bool hold(Duration since_end) const { return since_end <= hold_time; }
};

/// The level and the reasons for it.
struct Warning {
  WarningLevel level = WarningLevel::kUnknown;
  std::uint32_t reasons = 0;  ///< bits of Reason
  std::string text;           ///< level and reasons in words
  std::string mesh_id;        ///< workpiece of the contact, or of the predicted contact; empty: neither
  /// Convex piece of the tool that touched first, if the narrow phase knows; before contact, the piece that is
  /// predicted to touch, or most likely to.
  std::optional<size_t> tool_piece;
  /// Of `mesh_id`, ascending, each once: in contact or not ruled out; before contact, met by the predicted path.
  std::vector<std::uint32_t> triangles;
  /// Time from now until the predicted path meets the workpiece of the predicted contact, >= 0; empty: it does not, the
  /// prediction has ended, or a stronger warning about another workpiece is held. At kContact, this may be another
  /// workpiece than `mesh_id`; at kClear and kUnknown, it is the one that is met first.
  std::optional<Duration> time_to_collision;
  /// Probability that the tool meets the workpiece of the predicted contact within `probability_interval` from now, in
  /// [0, 1]; 0 once its prediction has ended, or while a stronger warning about another workpiece is held.
  double probability = 0.0;
  Duration probability_interval{};  ///< the reflex interval if the predicted contact lies in it, or the considered one
  /// When the contact or the predicted contact ended that the level still reports, for the hold time. Empty: it lasts,
  /// or there is none.
  std::optional<Time> held_since;
  bool acknowledged = false;   ///< the operator knows of this workpiece; only at kConsidered
  bool intended = false;       ///< the newest sweep, if not stale, met a workpiece as intended; at any level
  std::optional<double> seen;  ///< of the newest prediction, see Prediction::seen
  Time pose_stamp;             ///< newest pose that has been swept; epoch: none
  Time covered_until;          ///< every workpiece is tested up to here; epoch: never

  void clear();  ///< resets all fields and keeps the buffers
};

/// Computes the warning. The first level that applies wins, in this order:
/// - CONTACT: the tool meets a workpiece other than intended, or did so within the hold time. A contact that is not ruled
///   out counts.
/// - REFLEX, CONSIDERED: the predicted contact with a workpiece lies within this interval now or by the next call, or
///   did so within the hold time. Of several workpieces, the one with the highest level is named, then one that is not
///   acknowledged, then one that is predicted to be met now, then the one that is met first.
/// - UNKNOWN: a reason other than kDegraded applies.
/// - CLEAR: there is a workpiece, and each required one; pose and workpieces are fresh; no pose has waited too long
///   (`overload`); every workpiece was swept at that pose and tested to the end of the considered interval; there is no
///   fault.
/// Reasons are reported whatever the level. A guard that is disabled or shuts down is always UNKNOWN, even during a
/// contact, and kDisabled is its only reason; the fields after `text` are then empty. The text names a workpiece that is
/// met as intended.
/// @param[out] warning  overwritten; its buffers are used again
void computeWarning(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits, Warning& warning);

/// Returns why the workpieces are not as good as CLEAR needs them, in words; empty if they are. Names `faults`,
/// `failure`, `hung` and an `unread` of the last second, too. Without a pose in `inputs`, does not ask whether the
/// workpieces were swept.
std::string meshProblems(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits);

/// Appends to a text that it cannot be told whether the tool is inside a workpiece.
/// @param edges  TriangleMesh::openEdges(), > 0
void appendOpenSurface(const std::string& id, size_t edges, std::string& text);

/// Returns the level of a predicted contact now, or at the end of its prediction if that is over, as it counts until
/// the next call: kReflex if its `reflex` is at most the reflex interval and `tick` away, kConsidered if its
/// `considered` is at most the considered interval and `tick` away, otherwise kClear.
WarningLevel warningLevel(const PredictedContact& predicted, const Instant& now, const WarningLimits& limits);

/// Returns whether the `considered` of a predicted contact is at most the considered interval and `tick` away, whatever
/// its `reflex` calls for; false once its prediction has ended.
bool isConsidered(const PredictedContact& predicted, const Instant& now, const WarningLimits& limits);

/// Returns whether a workpiece is warned of: its contact is predicted within an interval, or was within the hold time.
bool isWarnedOf(const WarningInputs::WorkpieceWarning& workpiece, const Instant& now, const WarningLimits& limits);

/// Returns the time since the prediction of a contact ended (`duration` after its pose); 0 if it has not.
Duration timeSinceEnd(const PredictedContact& predicted, const Instant& now);

}  // namespace sweep_guard_core
