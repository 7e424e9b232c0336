#include "evaluation/delayed_guard.h"

#include <algorithm>

#include "evaluation/simulated_node.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::Twist;

namespace {

constexpr std::uint32_t kRevision = 1;
constexpr Duration kValid = std::chrono::milliseconds(100);

std::shared_ptr<const sweep_guard_core::ToolBalls> ballsOf(const sweep_guard_core::Tool& tool) {
  auto balls = std::make_shared<sweep_guard_core::ToolBalls>();
  balls->revision = kRevision;
  for (const auto& piece : tool.pieces()) balls->pieces.push_back(enclosingBalls(piece.shape_T));
  return balls;
}

}  // namespace

DelayedGuard::DelayedGuard(const sweep_guard_core::Tool& tool, const DelayedGuardOptions& options)
    : options_(options), tool_(ballsOf(tool)), guard_(options.motion) {}

void DelayedGuard::measure(const Eigen::Isometry3d& X_WT, const sweep_guard_core::Proximity& proximity, Time now) {
  auto planes = std::make_shared<sweep_guard_core::PlaneSet>();
  planes->timestamps = {now, instantOf(now + options_.plane_delay).steady};
  planes->valid_until = now + options_.plane_delay + kValid;
  planes->complete = proximity.unplaced.empty();
  planes->tool_revision = kRevision;
  planes->uncovered = proximity.uncovered;
  planes->X_WT = X_WT;
  for (const auto& found : proximity.planes) planes->planes.push_back(found.plane);
  measured_.push_back(std::move(planes));
  while (measured_[0]->timestamps.stamp + options_.plane_delay + kValid < now) measured_.pop_front();
}

DelayedGuard::Planes DelayedGuard::newest(Time now, Duration delay) const {
  const auto found = std::find_if(measured_.rbegin(), measured_.rend(),
                                  [&](const Planes& planes) { return planes->timestamps.stamp + delay <= now; });
  return found == measured_.rend() ? nullptr : *found;
}

Twist DelayedGuard::guard(const Twist& command_W, Duration period, Time now) {
  const auto at = instantOf(now);
  sweep_guard_core::MotionInputs inputs;
  inputs.tool = tool_;
  inputs.warning = {sweep_guard_core::WarningLevel::kClear, 0, at.steady};
  inputs.planes = newest(now, options_.plane_delay);
  if (const Planes planes = newest(now, options_.pose_delay)) {
    const Time stamp = planes->timestamps.stamp;
    inputs.pose = {planes->X_WT, {stamp, instantOf(stamp + options_.pose_delay).steady}};
  }
  sweep_guard_core::MotionCommand command;
  command.twist_W = command_W;
  command.timestamps = {at.stamp, at.steady};
  command.period = period;
  return guard_.guard(inputs, command, at).twist_W;
}

}  // namespace sweep_guard_evaluation
