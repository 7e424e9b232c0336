#include "rviz/panel_state.h"

#include <algorithm>
#include <cstdio>
#include <tuple>
#include <utility>

namespace sweep_guard_rviz {
namespace {

using sweep_guard::MotionStatus;
using sweep_guard::Warning;
using sweep_guard_core::toSeconds;

// Reasons that leave the level as it is.
constexpr std::uint32_t kDegraded = Warning::OVERLOAD | Warning::POSE_LOSS | Warning::INSIDE_UNTESTED | Warning::JUMP;

constexpr auto kFlashHalf = std::chrono::milliseconds(250);

constexpr std::pair<std::uint32_t, const char*> kReasons[] = {
    {Warning::NO_POSE, "no tool pose yet"},
    {Warning::POSE_STALE, "the tool pose is out of date"},
    {Warning::POSE_INVALID, "a tool pose was refused: not valid"},
    {Warning::OUT_OF_ORDER, "a tool pose was refused: older than the previous one"},
    {Warning::FUTURE_STAMP, "a tool pose was refused: its stamp lies in the future"},
    {Warning::NO_MESH, "no workpiece yet"},
    {Warning::MESH_STALE, "a workpiece is out of date"},
    {Warning::MESH_INVALID, "a workpiece was refused: not valid"},
    {Warning::TF_FAIL, "a transform is missing"},
    {Warning::TIME_JUMP, "time went back"},
    {Warning::DETECTOR_FAULT, "the detector failed"},
    {Warning::NOT_SWEPT, "a workpiece has not been swept yet"},
    {Warning::NOT_COVERED, "predicted path not tested"},
    {Warning::OVERLOAD, "overload: several poses swept at once"},
    {Warning::MULTI_PUBLISHER, "several nodes publish tool poses or a frame"},
    {Warning::POSE_LOSS, "tool poses were lost on the way"},
    {Warning::POSES_UNSWEPT, "tool poses wait to be swept"},
    {Warning::MESH_DROPPED, "vertices of a workpiece were dropped"},
    {Warning::WORKER_HUNG, "the guard hangs"},
    {Warning::SELFTEST, "the detector failed its test"},
    {Warning::CROSSCHECK, "two detectors disagree"},
    {Warning::INSIDE_UNTESTED, "a surface is open: inside is not tested"},
    {Warning::NOT_SEEN, "no camera sees where the tool is going"},
    {Warning::JUMP, "a jump: what was reported may come from it"},
    {Warning::DISABLED, "the guard is disabled: nothing is tested"},
};

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", value);
  return text;
}

const char* meaningOf(WarningLevel level, bool timed) {
  switch (level) {
    case WarningLevel::kContact:
      return "the tool touches";
    case WarningLevel::kReflex:
    case WarningLevel::kConsidered:
      return timed ? "to collision" : "collision is probable";
    case WarningLevel::kClear:
      return timed ? "to collision" : "no collision ahead";
    case WarningLevel::kUnknown:
      break;
  }
  return "nothing is guaranteed";
}

std::string ago(const Warning& warning, const Instant& now) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s ago", std::max(0.0, toSeconds(now.stamp - toTime(warning.held_since))));
  return text;
}

std::string meaningOf(const Warning& warning, WarningLevel level, bool timed, const Instant& now) {
  std::string meaning = meaningOf(level, timed);
  if (level == WarningLevel::kContact && warning.held) meaning = "touched " + ago(warning, now);
  if (level != WarningLevel::kContact && warning.held && !timed)
    meaning = "collision was expected, " + ago(warning, now);
  if (warning.intended && level == WarningLevel::kClear && !timed) meaning = "intended contact";
  return warning.acknowledged && level == WarningLevel::kConsidered ? "acknowledged: " + meaning : meaning;
}

// Returns whether target and time already show the sentence.
bool isRepeated(const std::string& sentence) {
  return sentence.rfind("tool meets '", 0) == 0 || sentence.rfind("tool touched '", 0) == 0 ||
         sentence.find("' expected in ") != std::string::npos || sentence == "acknowledged";
}

std::vector<std::string> sentences(std::string text) {
  const size_t level = text.find(": ");
  if (level != std::string::npos) text.erase(0, level + 2);
  std::vector<std::string> parts;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find("; ", begin), text.size());
    const std::string sentence = text.substr(begin, end - begin);
    if (!isRepeated(sentence)) parts.push_back(sentence);
    begin = end + 2;
  }
  return parts;
}

// Takes the guard's own text, which has figures, where there is one.
std::vector<std::string> reasonsOf(const Warning& warning) {
  if (warning.level == Warning::CLEAR && warning.reasons == 0 && !warning.intended) return {};
  if (warning.text.find(": ") != std::string::npos) return sentences(warning.text);
  std::vector<std::string> reasons;
  for (const auto& [bit, words] : kReasons) {
    if ((warning.reasons & bit) != 0) reasons.emplace_back(words);
  }
  return reasons;
}

std::string targetOf(const Warning& warning) {
  if (warning.mesh_id.empty()) return "";
  const char* const how = warning.level != Warning::CONTACT ? "ahead: " : warning.held ? "touched " : "touches ";
  std::string target = how + warning.mesh_id;
  const size_t count = warning.triangles.size();
  if (count > 0) target += ", " + std::to_string(count) + (count == 1 ? " triangle" : " triangles");
  if (!warning.tool_link.empty()) target += ", by " + warning.tool_link;
  return target;
}

PanelState unknown(std::vector<std::string> reasons) {
  PanelState state;
  state.title = styleOf(WarningLevel::kUnknown).name;
  state.time = "-";
  state.meaning = meaningOf(WarningLevel::kUnknown, false);
  state.reasons = std::move(reasons);
  return state;
}

PanelState silent(const std::string& why) {
  PanelState state = unknown({why});
  state.silent = true;
  return state;
}

// All panels of a machine share the steady clock: they flash together.
bool brightAt(SteadyTime now) { return now.time_since_epoch() / kFlashHalf % 2 == 0; }

}  // namespace

bool PanelState::operator==(const PanelState& other) const {
  const auto all = [](const PanelState& s) {
    return std::tie(s.level, s.bright, s.disabled, s.acknowledged, s.silent, s.title, s.time, s.meaning, s.target,
                    s.reasons);
  };
  return all(*this) == all(other);
}

Instant currentInstant() { return {toTime(ros::Time::now()), std::chrono::steady_clock::now()}; }

WarningLevel levelOf(const Warning& warning) {
  const bool says_clear = warning.level == Warning::CLEAR;
  const bool is_clear = warning.clear && (warning.reasons & ~kDegraded) == 0;
  if (warning.level > Warning::CONTACT || says_clear != is_clear) return WarningLevel::kUnknown;
  return static_cast<WarningLevel>(warning.level);
}

std::optional<double> timeToCollision(const Warning& warning) {
  if (levelOf(warning) == WarningLevel::kUnknown || warning.time_to_collision < ros::Duration(0)) return std::nullopt;
  return warning.time_to_collision.toSec();
}

PanelState panelState(const std::optional<ReceivedWarning>& newest, const Instant& now, const std::string& topic) {
  if (!newest) return silent("no warning from " + topic);
  const Warning& warning = newest->warning;
  const std::chrono::duration<double> age = now.steady - newest->received.steady;
  if (age > kSilence) return silent("the guard has been silent for " + seconds(age.count()));
  if (toTime(warning.valid_until) < now.stamp) {
    return silent("the warning expired " + seconds(toSeconds(now.stamp - toTime(warning.valid_until))) + " ago");
  }

  PanelState state;
  state.level = levelOf(warning);
  if (state.level == WarningLevel::kUnknown) {
    state = unknown(reasonsOf(warning));
    if (warning.level != Warning::UNKNOWN) state.reasons.emplace_back("the warning contradicts itself");
    state.disabled = (warning.reasons & Warning::DISABLED) != 0;
    if (state.disabled) state.title = "DISABLED";
    return state;
  }
  const std::optional<double> left = timeToCollision(warning);
  const bool touches = state.level == WarningLevel::kContact && !warning.held;
  state.bright = !touches || brightAt(now.steady);
  state.acknowledged = warning.acknowledged && state.level == WarningLevel::kConsidered;
  state.title = styleOf(state.level).name;
  if (state.level == WarningLevel::kContact) {
    state.time = touches && left ? "now" : "-";
  } else {
    state.time = left ? seconds(*left) : "-";
  }
  state.meaning = meaningOf(warning, state.level, left.has_value(), now);
  state.target = targetOf(warning);
  state.reasons = reasonsOf(warning);
  return state;
}

HeldState heldState(const MotionStatus& status) {
  if (status.code == MotionStatus::NO_WARNING) return {};
  if (status.code != MotionStatus::DECELERATE_FOR_COLLISION) return {true, status.text};
  char share[32];
  std::snprintf(share, sizeof share, " (%.0f %% of the speed)", 100.0 * status.scale);
  return {false, status.text + share};
}

}  // namespace sweep_guard_rviz
