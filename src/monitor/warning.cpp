#include "sweep_guard/monitor/warning.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "common/number_text.h"
#include "monitor/late_frames.h"

namespace sweep_guard_core {
namespace {

constexpr Duration kUnreadTime = std::chrono::seconds(1);
constexpr size_t kMaxText = 1000;  // longer texts name no further workpieces [bytes]

std::string inPercent(double probability) {
  const long percent = std::lround(100.0 * probability);
  return percent == 0 ? "< 1" : std::to_string(percent);
}

// Assembled where the text is kept: a repeated warning allocates nothing.
using TextPieces = std::initializer_list<std::string_view>;

void insert(std::string& text, size_t place, TextPieces pieces) {
  for (const std::string_view piece : pieces) {
    text.insert(place, piece);
    place += piece.size();
  }
}

void add(Warning& warning, Reason reason, TextPieces message) {
  warning.reasons |= reason;
  if (!warning.text.empty()) warning.text += "; ";
  insert(warning.text, warning.text.size(), message);
}

void addPoseReasons(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits, Warning& warning) {
  if (!inputs.pose) {
    add(warning, kNoPose, {"no tool pose yet"});
  } else if (stale(*inputs.pose, now, limits.pose_timeout)) {
    const bool arrives = now.steady - inputs.pose->received <= limits.pose_timeout;
    add(warning, kPoseStale,
        {"newest tool pose is ", inSeconds(age(*inputs.pose, now)), " old",
         arrives ? " by its stamp: clocks differ" : ""});
  }
  if (!inputs.waiting_since) return;
  const Duration waited = now.steady - *inputs.waiting_since;
  if (waited > std::max(limits.overload, inputs.look_ahead)) {
    add(warning, kPosesUnswept, {"a tool pose has waited for ", inSeconds(waited)});
  }
}

void addCoverageReasons(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits,
                        Warning& warning) {
  if (inputs.objects.empty() || !inputs.pose || stale(*inputs.pose, now, limits.pose_timeout)) return;
  const Duration ahead = inputs.covered_until - inputs.pose->stamp - age(*inputs.pose, now);
  if (ahead >= limits.considered) return;
  if (ahead <= Duration::zero()) return add(warning, kNotCovered, {"predicted path not tested"});
  add(warning, kNotCovered, {"predicted path tested for ", inSeconds(ahead), " only"});
}

void addObject(Warning& warning, Reason reason, TextPieces message) {
  if (warning.text.size() < kMaxText) return add(warning, reason, message);
  warning.reasons |= reason;
}

void addMissing(const WarningInputs& inputs, Warning& warning) {
  if (inputs.objects.empty() && inputs.required.empty()) add(warning, kNoMesh, {"no workpiece yet"});
  auto object = inputs.objects.begin();
  for (const std::string& id : inputs.required) {
    while (object != inputs.objects.end() && object->id < id) ++object;
    if (object != inputs.objects.end() && object->id == id) continue;
    addObject(warning, kNoMesh, {"workpiece '", id, "' has not arrived"});
  }
}

void addObjectReasons(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits, Warning& warning) {
  addMissing(inputs, warning);
  for (const WarningInputs::Object& object : inputs.objects) {
    if (object.ages && stale(object.timestamps, now, limits.mesh_timeout)) {
      addObject(warning, kMeshStale,
                {"workpiece '", object.id, "' is ", inSeconds(age(object.timestamps, now)), " old"});
    }
    if (object.dropped) addObject(warning, kMeshDropped, {"vertices of workpiece '", object.id, "' were dropped"});
    if (!inputs.pose || object.swept || now.steady <= object.stands_in_until.value_or(SteadyTime::min())) continue;
    if (object.behind > Duration::zero()) {
      addObject(warning, kNotSwept,
                {"tool poses are ", inSeconds(object.behind), " behind workpiece '", object.id, "'"});
    } else {
      addObject(warning, kNotSwept, {"workpiece '", object.id, "' not swept yet"});
    }
  }
  if (inputs.unread && now.steady - inputs.unread->found <= kUnreadTime) {
    add(warning, kMeshInvalid, {inputs.unread->message});
  }
}

// Neither its motion nor its surface is known.
constexpr auto kOtherToolUnknown = static_cast<Reason>(kNotCovered | kNotSwept);

void addOtherToolReasons(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits,
                         Warning& warning) {
  for (const WarningInputs::OtherTool& tool : inputs.other_tools) {
    if (!tool.problem.empty()) {
      addObject(warning, kOtherToolUnknown, {"tool of '", tool.name, "': ", tool.problem});
    } else if (!tool.newest) {
      addObject(warning, kOtherToolUnknown, {"tool of '", tool.name, "' has not been heard of"});
    } else if (stale(*tool.newest, now, limits.pose_timeout)) {
      addObject(warning, kOtherToolUnknown,
                {"newest pose of the tool of '", tool.name, "' is ", inSeconds(age(*tool.newest, now)), " old"});
    }
  }
}

void addFrameReasons(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits, Warning& warning) {
  for (const WarningInputs::Frame& frame : inputs.frames) {
    const auto late = lateAge(frame, now, limits.pose_timeout);
    if (!late) continue;
    addObject(warning, kTfFail,
              {"transforms of '", frame.name, "' are up to ", inSeconds(*late),
               " old: send them sooner or more often, or raise timing/pose_timeout"});
  }
}

void addOpen(const WarningInputs& inputs, Warning& warning) {
  for (const WarningInputs::Object& object : inputs.objects) {
    if (object.open_edges == 0) continue;
    warning.reasons |= kInsideUntested;
    if (warning.text.size() < kMaxText) appendOpenSurface(object.id, object.open_edges, warning.text);
  }
}

void addLoadReasons(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits, Warning& warning) {
  const auto held = [&](const auto& event) { return event && now.steady - event->found <= limits.hold_time; };
  if (held(inputs.overload)) {
    add(warning, kOverload, {"overload: poses that waited for ", inSeconds(inputs.overload->waited), " swept at once"});
  }
  if (held(inputs.pose_loss)) add(warning, kPoseLoss, {inputs.pose_loss->message});
  if (held(inputs.jump)) add(warning, kJump, {inputs.jump->message, ": what was reported may come from that"});
}

void addThreadReasons(const WarningInputs& inputs, Warning& warning) {
  if (inputs.failure) add(warning, inputs.failure->reason, {inputs.failure->message.data()});
  if (inputs.hung != nullptr) add(warning, kWorkerHung, {"thread '", inputs.hung, "' makes no progress"});
}

// The warning of one workpiece.
struct WorkpieceLevel {
  WarningLevel level = WarningLevel::kClear;
  const PredictedContact* contact = nullptr;
  std::optional<SteadyTime> ended = {};  // empty: it is predicted now
  bool acknowledged = false;

  void raise(WarningLevel to, const PredictedContact& about, const std::optional<SteadyTime>& since) {
    if (to > level) *this = {to, &about, since, false};
  }
  bool goesBefore(const WorkpieceLevel& other) const {
    if (level != other.level || level == WarningLevel::kClear) return level > other.level;
    if (acknowledged != other.acknowledged) return other.acknowledged;
    if (!ended != !other.ended) return !ended;
    return ended ? *ended > *other.ended : contact->earliest() < other.contact->earliest();
  }
};

WorkpieceLevel levelOf(const WarningInputs::WorkpieceWarning& workpiece, const Instant& now,
                       const WarningLimits& limits) {
  WorkpieceLevel warned;
  if (workpiece.predicted) {
    const Duration since_end = timeSinceEnd(*workpiece.predicted, now);
    const bool current = since_end == Duration::zero();
    if (since_end <= limits.hold_time) {
      warned.raise(warningLevel(*workpiece.predicted, now, limits), *workpiece.predicted,
                   current ? std::nullopt : std::optional(now.steady - since_end));
    }
  }
  const auto raiseIfHeld = [&](WarningLevel level, const std::optional<WarningInputs::Alarm>& alarm) {
    if (alarm && now.steady - alarm->ended <= limits.hold_time) warned.raise(level, alarm->contact, alarm->ended);
  };
  raiseIfHeld(WarningLevel::kReflex, workpiece.reflex);
  raiseIfHeld(WarningLevel::kConsidered, workpiece.considered);
  warned.acknowledged = warned.level == WarningLevel::kConsidered && workpiece.acknowledged_until &&
                        now.steady <= *workpiece.acknowledged_until;
  return warned;
}

WorkpieceLevel strongestWarning(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits) {
  WorkpieceLevel strongest = levelOf(inputs.removed, now, limits);
  for (const WarningInputs::WorkpieceWarning& workpiece : inputs.warnings) {
    const WorkpieceLevel warned = levelOf(workpiece, now, limits);
    if (warned.goesBefore(strongest)) strongest = warned;
  }
  return strongest;
}

// Of the workpiece that is warned of, or without one, the earliest.
const PredictedContact* currentPrediction(const WarningInputs& inputs, const Instant& now,
                                          const WorkpieceLevel& warned) {
  const PredictedContact* current = nullptr;
  for (const WarningInputs::WorkpieceWarning& workpiece : inputs.warnings) {
    if (!workpiece.predicted || timeSinceEnd(*workpiece.predicted, now) > Duration::zero()) continue;
    if (warned.contact != nullptr && warned.contact->mesh_id != workpiece.id) continue;
    if (current == nullptr || workpiece.predicted->earliest() < current->earliest()) current = &*workpiece.predicted;
  }
  return current;
}

void prepend(Warning& warning, TextPieces message) {
  if (!warning.text.empty()) warning.text.insert(0, "; ");
  insert(warning.text, 0, message);
}

Duration timeTo(Time moment, const Timestamps& pose, const Instant& now) {
  return moment - pose.stamp - age(pose, now);
}

void describePrediction(Warning& warning) {
  const auto describe = [&](std::string_view how, const std::string& much, std::string_view within = {},
                            const std::string& interval = {}) {
    prepend(warning, {"collision with '", warning.mesh_id, "' ", how, much, within, interval});
  };
  if (warning.time_to_collision) return describe("expected in ", inSeconds(*warning.time_to_collision));
  if (warning.probability == 0.0) return describe("was expected", "");
  describe("", inPercent(warning.probability), " % probable within ", inSeconds(warning.probability_interval));
}

void describeContact(Warning& warning, bool inside, Duration since) {
  const size_t count = warning.triangles.size();
  const std::string number = count == 0 ? "" : std::to_string(count);
  const std::string_view comma = count == 0 ? "" : ", ";
  const std::string_view noun = count == 0 ? "" : count == 1 ? " triangle" : " triangles";
  if (warning.held_since) {
    const std::string_view how = inside ? "tool was inside '" : "tool touched '";
    return prepend(warning, {how, warning.mesh_id, "' ", inSeconds(since), " ago", comma, number, noun});
  }
  prepend(warning, {inside ? "tool is inside '" : "tool meets '", warning.mesh_id, "'", comma, number, noun});
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
  describePrediction(warning);
}

void setContact(const WarningInputs::Contact& contact, const Instant& now, Warning& warning) {
  const Duration since = now.steady - contact.found;
  warning.level = WarningLevel::kContact;
  warning.acknowledged = false;
  warning.held_since = contact.lasting ? std::nullopt : std::optional(now.stamp - since);
  warning.mesh_id = contact.id;
  warning.triangles = contact.triangles;
  warning.tool_piece = contact.tool_piece;
  describeContact(warning, contact.inside, since);
}

void describeIntended(const WarningInputs& inputs, Warning& warning) {
  warning.intended = !inputs.intended.empty() && (warning.reasons & (kNoPose | kPoseStale)) == 0;
  if (warning.intended) add(warning, Reason{}, {"intended contact with '", inputs.intended.front(), "'"});
}

void reportDisabled(const std::string& disabled_by, Warning& warning) {
  add(warning, kDisabled, {styleOf(warning.level).name, ": disabled by ", disabled_by, ": nothing is tested"});
}

void reportEnd(Warning& warning) {
  add(warning, kDisabled, {styleOf(warning.level).name, ": the guard is shutting down"});
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
  pose_stamp = {};
  covered_until = {};
}

void computeWarning(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits, Warning& warning) {
  warning.clear();
  if (inputs.ended) return reportEnd(warning);
  if (inputs.disabled_by) return reportDisabled(*inputs.disabled_by, warning);
  addPoseReasons(inputs, now, limits, warning);
  addObjectReasons(inputs, now, limits, warning);
  addCoverageReasons(inputs, now, limits, warning);
  addOtherToolReasons(inputs, now, limits, warning);
  addFrameReasons(inputs, now, limits, warning);
  addLoadReasons(inputs, now, limits, warning);
  for (const auto& [reason, message] : inputs.faults) add(warning, reason, {message});
  addThreadReasons(inputs, warning);
  addOpen(inputs, warning);

  warning.level = (warning.reasons & ~kDegraded) == 0 ? WarningLevel::kClear : WarningLevel::kUnknown;
  if (inputs.pose) warning.pose_stamp = inputs.pose->stamp;
  warning.covered_until = inputs.covered_until;
  const size_t length = warning.text.size();
  warn(inputs, now, limits, warning);
  if (inputs.contact && (inputs.contact->lasting || now.steady - inputs.contact->found <= limits.hold_time)) {
    warning.text.erase(0, warning.text.size() - length);
    setContact(*inputs.contact, now, warning);
  }
  describeIntended(inputs, warning);
  insert(warning.text, 0, {styleOf(warning.level).name, warning.text.empty() ? "" : ": "});
}

std::string meshProblems(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits) {
  Warning warning;
  addObjectReasons(inputs, now, limits, warning);
  addOtherToolReasons(inputs, now, limits, warning);
  for (const auto& [reason, message] : inputs.faults) add(warning, reason, {message});
  addThreadReasons(inputs, warning);
  return warning.text;
}

void appendOpenSurface(const std::string& id, size_t edges, std::string& text) {
  if (!text.empty()) text += "; ";
  insert(text, text.size(),
         {"the surface of '", id, "' is open at ", std::to_string(edges), edges == 1 ? " edge" : " edges",
          ": the guard cannot tell whether the tool is inside"});
}

WarningLevel warningLevel(const PredictedContact& predicted, const Instant& now, const WarningLimits& limits) {
  const auto isWithin = [&](const std::optional<Time>& start, Duration interval) {
    return start && timeTo(*start, predicted.pose, now) + timeSinceEnd(predicted, now) <= interval + limits.tick;
  };
  if (isWithin(predicted.reflex, limits.reflex)) return WarningLevel::kReflex;
  return isWithin(predicted.considered, limits.considered) ? WarningLevel::kConsidered : WarningLevel::kClear;
}

bool isConsidered(const PredictedContact& predicted, const Instant& now, const WarningLimits& limits) {
  return predicted.considered && timeSinceEnd(predicted, now) == Duration::zero() &&
         timeTo(*predicted.considered, predicted.pose, now) <= limits.considered + limits.tick;
}

bool isWarnedOf(const WarningInputs::WorkpieceWarning& workpiece, const Instant& now, const WarningLimits& limits) {
  return levelOf(workpiece, now, limits).level != WarningLevel::kClear;
}

Duration timeSinceEnd(const PredictedContact& predicted, const Instant& now) {
  return std::max(Duration::zero(), age(predicted.pose, now) - predicted.duration);
}

}  // namespace sweep_guard_core
