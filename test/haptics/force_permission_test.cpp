#include "sweep_guard/haptics/force_renderer.h"

#include <gtest/gtest.h>

#include <functional>

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

const Instant kNow{Time(std::chrono::seconds(100)), SteadyTime(std::chrono::seconds(7))};

Timestamps ago(Duration age) { return {kNow.stamp - age, kNow.steady - age}; }

PermissionInputs fresh() {
  PermissionInputs inputs;
  inputs.warning = PermissionInputs::ReceivedWarning{WarningLevel::kClear, 0, kNow.steady};
  inputs.pose = ago({});
  inputs.planes = PermissionInputs::Planes{ago({}), kNow.stamp + milliseconds(100)};
  return inputs;
}

ForcePermission decide(const std::function<void(PermissionInputs&)>& change) {
  PermissionInputs inputs = fresh();
  change(inputs);
  return decideForce({inputs, {}}, kNow, {});
}

TEST(ForcePermissionTest, FreshInputsOfAnyKnownLevelLetTheWholeForceThrough) {
  for (const WarningLevel level :
       {WarningLevel::kClear, WarningLevel::kConsidered, WarningLevel::kReflex, WarningLevel::kContact}) {
    const ForcePermission permission = decide([&](auto& inputs) { inputs.warning->level = level; });
    EXPECT_EQ(permission.gain, 1.0);
    EXPECT_EQ(permission.cause, PermissionCause::kGuarded);
  }
}

TEST(ForcePermissionTest, ASilentPosePlanesOrDeviceFadeTheForceOutFrom50To70Milliseconds) {
  for (const auto& [silent, gain] : {std::pair{50, 1.0}, {55, 0.75}, {60, 0.5}, {69, 0.05}, {70, 0.0}, {90, 0.0}}) {
    const Timestamps silent_since = ago(milliseconds(silent));
    const ForcePermission pose = decide([&](auto& inputs) { inputs.pose = silent_since; });
    EXPECT_NEAR(pose.gain, gain, 1e-9) << silent;
    const ForcePermission planes = decide([&](auto& inputs) { inputs.planes->timestamps = silent_since; });
    EXPECT_NEAR(planes.gain, gain, 1e-9) << silent;
    const ForcePermission device = decideForce({fresh(), silent_since}, kNow, {});
    EXPECT_NEAR(device.gain, gain, 1e-9) << silent;
    if (silent == 50) continue;
    EXPECT_EQ(device.cause, PermissionCause::kDeviceSilent);
    EXPECT_EQ(pose.cause, PermissionCause::kPoseSilent);
    EXPECT_EQ(planes.cause, PermissionCause::kPlanesSilent);
  }
}

TEST(ForcePermissionTest, WhatIsNotKnownLetsNothingThrough) {
  const std::vector<std::pair<PermissionCause, std::function<void(PermissionInputs&)>>> cases = {
      {PermissionCause::kNoWarning, [](auto& inputs) { inputs.warning.reset(); }},
      {PermissionCause::kWarningSilent, [](auto& inputs) { inputs.warning->received -= milliseconds(151); }},
      {PermissionCause::kUnknown, [](auto& inputs) { inputs.warning->level = WarningLevel::kUnknown; }},
      {PermissionCause::kNoPose, [](auto& inputs) { inputs.pose.reset(); }},
      {PermissionCause::kOldPose, [](auto& inputs) { inputs.pose->stamp -= milliseconds(151); }},
      {PermissionCause::kNoPlanes, [](auto& inputs) { inputs.planes.reset(); }},
      {PermissionCause::kPlanesExpired, [](auto& inputs) { inputs.planes->valid_until -= milliseconds(101); }},
      {PermissionCause::kIncomplete, [](auto& inputs) { inputs.planes->complete = false; }},
      {PermissionCause::kNoTool, [](auto& inputs) { inputs.planes->tool_known = false; }}};
  for (const auto& [cause, change] : cases) {
    const ForcePermission permission = decide(change);
    EXPECT_EQ(permission.gain, 0.0) << textOf(cause);
    EXPECT_EQ(permission.cause, cause) << textOf(cause);
  }
  EXPECT_EQ(decide([](auto& inputs) { inputs.warning->received -= milliseconds(150); }).gain, 1.0);
}

}  // namespace
}  // namespace sweep_guard_core
