#include "monitor/warning_reasons.h"

#include <algorithm>

#include "common/number_text.h"
#include "monitor/late_frames.h"

namespace sweep_guard_core {
namespace {

constexpr Duration kUnreadTime = std::chrono::seconds(1);
constexpr size_t kMaxText = 1000;  // longer texts name no further workpieces [bytes]

void addPoseReasons(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits, Warning& warning) {
  if (!inputs.pose) {
    addReason(warning, kNoPose, {"no tool pose yet"});
  } else if (stale(*inputs.pose, now, limits.pose_timeout)) {
    const bool arrives = now.steady - inputs.pose->received <= limits.pose_timeout;
    addReason(warning, kPoseStale,
              {"newest tool pose is ", inSeconds(age(*inputs.pose, now)), " old",
               arrives ? " by its stamp: clocks differ" : ""});
  }
  if (!inputs.waiting_since) return;
  const Duration waited = now.steady - *inputs.waiting_since;
  if (waited > std::max(limits.overload, inputs.look_ahead)) {
    addReason(warning, kPosesUnswept, {"a tool pose has waited for ", inSeconds(waited)});
  }
}

void addCoverageReasons(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits,
                        Warning& warning) {
  if (inputs.objects.empty() || !inputs.pose || stale(*inputs.pose, now, limits.pose_timeout)) return;
  const Duration ahead = inputs.covered_until - inputs.pose->stamp - age(*inputs.pose, now);
  if (ahead >= limits.considered) return;
  if (ahead <= Duration::zero()) return addReason(warning, kNotCovered, {"predicted path not tested"});
  addReason(warning, kNotCovered, {"predicted path tested for ", inSeconds(ahead), " only"});
}

void addSight(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits, Warning& warning) {
  if (!inputs.seen || !inputs.unseen || !limits.hold(now.steady - inputs.unseen->found)) return;
  const std::string percent = std::to_string(static_cast<int>(100.0 * inputs.unseen->share));
  addReason(warning, kNotSeen, {"cameras see only ", percent, " % of a part of the predicted path"});
}

void addObject(Warning& warning, Reason reason, TextPieces message) {
  if (warning.text.size() < kMaxText) return addReason(warning, reason, message);
  warning.reasons |= reason;
}

void addMissing(const WarningInputs& inputs, Warning& warning) {
  if (inputs.objects.empty() && inputs.required.empty()) addReason(warning, kNoMesh, {"no workpiece yet"});
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
    if (object.ages && stale(object.timestamps, now, limits.meshTimeout(object.id))) {
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
    addReason(warning, kMeshInvalid, {inputs.unread->message});
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
  const auto held = [&](const std::optional<WarningInputs::Event>& event) {
    return event && limits.hold(now.steady - event->found);
  };
  if (inputs.overload && limits.hold(now.steady - *inputs.overload)) {
    addReason(warning, kOverload, {"overload: poses that waited for ", inSeconds(inputs.backlog), " swept at once"});
  }
  if (held(inputs.pose_loss)) addReason(warning, kPoseLoss, {inputs.pose_loss->message});
  if (held(inputs.jump)) addReason(warning, kJump, {inputs.jump->message, ": what was reported may come from that"});
}

void addThreadReasons(const WarningInputs& inputs, Warning& warning) {
  if (inputs.failure) addReason(warning, inputs.failure->reason, {inputs.failure->message.data()});
  if (inputs.hung != nullptr) addReason(warning, kWorkerHung, {"thread '", inputs.hung, "' makes no progress"});
}

}  // namespace

void addReasons(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits, Warning& warning) {
  addPoseReasons(inputs, now, limits, warning);
  addObjectReasons(inputs, now, limits, warning);
  addCoverageReasons(inputs, now, limits, warning);
  addSight(inputs, now, limits, warning);
  addOtherToolReasons(inputs, now, limits, warning);
  addFrameReasons(inputs, now, limits, warning);
  addLoadReasons(inputs, now, limits, warning);
  for (const auto& [reason, message] : inputs.faults) addReason(warning, reason, {message});
  addThreadReasons(inputs, warning);
  addOpen(inputs, warning);
}

std::string meshProblems(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits) {
  Warning warning;
  addObjectReasons(inputs, now, limits, warning);
  addOtherToolReasons(inputs, now, limits, warning);
  for (const auto& [reason, message] : inputs.faults) addReason(warning, reason, {message});
  addThreadReasons(inputs, warning);
  return warning.text;
}

void appendOpenSurface(const std::string& id, size_t edges, std::string& text) {
  if (!text.empty()) text += "; ";
  insertText(text, text.size(),
             {"the surface of '", id, "' is open at ", std::to_string(edges), edges == 1 ? " edge" : " edges",
              ": the guard cannot tell whether the tool is inside"});
}

}  // namespace sweep_guard_core
