#include "prediction/tool_jumps.h"

#include <cmath>

#include "sweep_guard/common/printable.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kMaxStates = 64;  // as there are at 1 kHz, thrice
constexpr double kFaster = 2.0;    // than the robot description says
constexpr int kStepsOfRun = 3;
constexpr Duration kTimeOfRun = std::chrono::milliseconds(50);

}  // namespace

std::string ToolJumps::add(const ToolState& state, const SpeedLimits& limits) {
  states_.add(state);
  forgetOld();
  const auto jump = jumpOfTool(limits);
  noteRun(jump && !jump->turns);
  for (size_t i = 0; i < joints_.size(); ++i) {
    if (const auto of_joint = jumpOfJoint(i, limits))
      return "joint '" + printable(joints_[i].name) + "' jumped: " + inWords(*of_joint);
  }
  if (!jump) return {};
  if (goesOn()) {
    const double speed = run_->length / toSeconds(states_.newest().stamp - run_->from.stamp);
    return "the tool '" + printable(tool_frame_) + "' moves at " + inWords({speed, /*turns=*/false}) + " against '" +
           printable(fixed_frame_) + "', as a pose in millimeters does";
  }
  return "the tool '" + printable(tool_frame_) + "' jumped against '" + printable(fixed_frame_) +
         "': " + inWords(*jump);
}

void ToolJumps::noteRun(bool jumped) {
  if (!jumped) return run_.reset();
  const ToolState& before = states_[states_.size() - 2];
  if (!run_) run_ = Run{before};
  run_->length += movedBetween(before.X_WT, states_.newest().X_WT).distance;
  ++run_->steps;
}

// Places that alternate are no motion.
bool ToolJumps::goesOn() const {
  if (!run_ || run_->steps < kStepsOfRun || states_.newest().stamp - run_->from.stamp < kTimeOfRun) return false;
  return movedBetween(run_->from.X_WT, states_.newest().X_WT).distance > 0.5 * run_->length;
}

void ToolJumps::reset() {
  states_.clear();
  run_.reset();
}

std::string ToolJumps::faster() const {
  for (size_t i = 0; i < joints_.size(); ++i) {
    const double limit = joints_[i].velocity;
    if (!(limit > 0.0)) continue;
    const auto fast = jumpOfJoint(i, {kFaster * limit, kFaster * limit});
    if (!fast) continue;
    return "joint '" + printable(joints_[i].name) + "' moved at " + inWords(*fast) + ": the robot description says " +
           inWords({limit, fast->turns});
  }
  return {};
}

template <typename MovedTo>
std::optional<JumpSpeed> ToolJumps::jumpOf(const MovedTo& moved, const SpeedLimits& limits) const {
  if (states_.size() < 2) return std::nullopt;
  const ToolState& newest = states_.newest();
  const auto since = [&](const ToolState& from) { return std::pair(moved(from, newest), newest.stamp - from.stamp); };
  const auto [step, within] = since(states_[states_.size() - 2]);
  return jumpOfStep(step, within, limits, [&] { return since(states_[0]); });
}

std::optional<JumpSpeed> ToolJumps::jumpOfJoint(size_t joint, const SpeedLimits& limits) const {
  const auto moved = [&](const ToolState& from, const ToolState& to) {
    const double by = std::abs(to.positions[joint] - from.positions[joint]);
    return joints_[joint].turns ? Moved{0.0, by} : Moved{by, 0.0};
  };
  return jumpOf(moved, limits);
}

std::optional<JumpSpeed> ToolJumps::jumpOfTool(const SpeedLimits& limits) const {
  return jumpOf([](const ToolState& from, const ToolState& to) { return movedBetween(from.X_WT, to.X_WT); }, limits);
}

void ToolJumps::forgetOld() {
  const Time old = states_.newest().stamp - kJumpTime;
  while (states_.size() > kMaxStates || (states_.size() > 1 && states_[1].stamp <= old)) states_.forgetFirst();
}

}  // namespace sweep_guard_core
