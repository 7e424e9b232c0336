#include "sweep_guard/monitor/warning.h"

#include <algorithm>
#include <cmath>

#include "common/number_text.h"
#include "monitor/warning_reasons.h"
#include "monitor/workpiece_level.h"

namespace sweep_guard_core {
namespace {

std::string inPercent(double probability) {
  const long percent = std::lround(100.0 * probability);
  return percent == 0 ? "< 1" : std::to_string(percent);
}

void prepend(Warning& warning, TextPieces message) {
  if (!warning.text.empty()) warning.text.insert(0, "; ");
  insertText(warning.text, 0, message);
}

// A time beyond the interval does not explain the level: what is less probable, or was predicted before, does.
void describePrediction(const WorkpieceLevel& level, const Instant& now, const WarningLimits& limits,
                        Warning& warning) {
  const Duration interval = level.level == WarningLevel::kReflex ? limits.reflex : limits.considered;
  const std::optional<Duration>& time = warning.time_to_collision;
  const bool beyond = time && *time > interval + limits.tick;
  const bool held = beyond && level.ended;
  const bool probable = !held && (time ? beyond : warning.probability > 0.0);
  const std::string percent = probable ? inPercent(warning.probability) : "";
  const std::string within = probable ? inSeconds(warning.probability_interval) : "";
  const std::string ago = held ? inSeconds(now.steady - *level.ended) : "";
  const std::string when = time ? inSeconds(*time) : "";
  const std::string_view expected = time ? "expected in " : "was expected";
  prepend(warning, {"collision with '", warning.mesh_id, "' ", percent, probable ? " % probable within " : "", within,
                    held ? "was near " : "", ago, held ? " ago" : "", beyond ? ", " : "",
                    probable && !time ? std::string_view() : expected, when});
}

std::string_view linkOf(const WarningInputs& inputs, const std::optional<size_t>& piece) {
  return piece && *piece < inputs.links.size() ? std::string_view(inputs.links[*piece]) : std::string_view();
}

void describeContact(Warning& warning, bool inside, std::string_view link, Duration since) {
  const size_t count = warning.triangles.size();
  const std::string number = count == 0 ? "" : std::to_string(count);
  const std::string_view comma = count == 0 ? "" : ", ";
  const std::string_view noun = count == 0 ? "" : count == 1 ? " triangle" : " triangles";
  const std::string_view by = link.empty() ? "" : ", by link '";
  const std::string_view end = link.empty() ? "" : "'";
  if (warning.held_since) {
    const std::string_view how = inside ? "tool was inside '" : "tool touched '";
    return prepend(warning, {how, warning.mesh_id, "' ", inSeconds(since), " ago", comma, number, noun, by, link, end});
  }
  prepend(warning,
          {inside ? "tool is inside '" : "tool meets '", warning.mesh_id, "'", comma, number, noun, by, link, end});
}

void setPrediction(const PredictedContact& predicted, const Instant& now, const WarningLimits& limits,
                   Warning& warning) {
  if (predicted.contact) {
    warning.time_to_collision = std::max(Duration::zero(), timeTo(*predicted.contact, predicted.pose, now));
  }
  const bool reflex = warningLevel(predicted, now, limits) == WarningLevel::kReflex;
  warning.probability = reflex ? predicted.reflex_probability : predicted.considered_probability;
  warning.probability_interval = reflex ? limits.reflex : limits.considered;
}

void warn(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits, Warning& warning) {
  const WorkpieceLevel strongest = strongestWarning(inputs, now, limits);
  const PredictedContact* const current = currentPrediction(inputs, now, strongest);
  if (current != nullptr) setPrediction(*current, now, limits, warning);
  if (strongest.contact == nullptr) return;
  warning.level = strongest.level;
  warning.acknowledged = strongest.acknowledged;
  if (strongest.ended) warning.held_since = now.stamp - (now.steady - *strongest.ended);
  warning.mesh_id = strongest.contact->mesh_id;
  warning.tool_piece = strongest.contact->tool_piece;
  warning.triangles = strongest.contact->triangles;
  if (warning.acknowledged) prepend(warning, {"acknowledged"});
  describePrediction(strongest, now, limits, warning);
}

void setContact(const WarningInputs& inputs, const Instant& now, Warning& warning) {
  const WarningInputs::Contact& contact = *inputs.contact;
  const Duration since = now.steady - contact.found;
  warning.level = WarningLevel::kContact;
  warning.acknowledged = false;
  warning.held_since = contact.lasting ? std::nullopt : std::optional(now.stamp - since);
  warning.mesh_id = contact.id;
  warning.triangles = contact.triangles;
  warning.tool_piece = contact.tool_piece;
  describeContact(warning, contact.inside, linkOf(inputs, contact.tool_piece), since);
}

void describeIntended(const WarningInputs& inputs, Warning& warning) {
  warning.intended = !inputs.intended.empty() && (warning.reasons & (kNoPose | kPoseStale)) == 0;
  if (warning.intended) addReason(warning, Reason{}, {"intended contact with '", inputs.intended.front(), "'"});
}

void reportDisabled(const std::string& disabled_by, Warning& warning) {
  addReason(warning, kDisabled, {styleOf(warning.level).name, ": disabled by ", disabled_by, ": nothing is tested"});
}

void reportEnd(Warning& warning) {
  addReason(warning, kDisabled, {styleOf(warning.level).name, ": the guard is shutting down"});
}

}  // namespace

WarningThresholds WarningThresholds::ofMinProbability(double min_probability) {
  const double reflex = fromPlaneProbability(PredictionInterval::kReflex, min_probability);
  const double considered = fromPlaneProbability(PredictionInterval::kConsidered, min_probability);
  return {reflex, considered, considered};
}

void Warning::clear() {
  level = WarningLevel::kUnknown;
  reasons = 0;
  text.clear();
  mesh_id.clear();
  tool_piece.reset();
  triangles.clear();
  time_to_collision.reset();
  probability = 0.0;
  probability_interval = {};
  held_since.reset();
  acknowledged = false;
  intended = false;
  seen.reset();
  pose_stamp = {};
  covered_until = {};
}

void computeWarning(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits, Warning& warning) {
  warning.clear();
  if (inputs.ended) return reportEnd(warning);
  if (inputs.disabled_by) return reportDisabled(*inputs.disabled_by, warning);
  addReasons(inputs, now, limits, warning);
  warning.level = (warning.reasons & ~kDegraded) == 0 ? WarningLevel::kClear : WarningLevel::kUnknown;
  if (inputs.pose) warning.pose_stamp = inputs.pose->stamp;
  warning.covered_until = inputs.covered_until;
  warning.seen = inputs.seen;
  const size_t length = warning.text.size();
  warn(inputs, now, limits, warning);
  if (inputs.contact && (inputs.contact->lasting || limits.hold(now.steady - inputs.contact->found))) {
    warning.text.erase(0, warning.text.size() - length);
    setContact(inputs, now, warning);
  }
  describeIntended(inputs, warning);
  insertText(warning.text, 0, {styleOf(warning.level).name, warning.text.empty() ? "" : ": "});
}

}  // namespace sweep_guard_core
