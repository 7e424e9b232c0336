#include "sweep_guard/haptics/force_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>

#include "allocations.h"
#include "haptics/planes.h"
#include "motion/random_scenes.h"
#include "refusal.h"
#include "sweep_guard/haptics/passive_device.h"

namespace sweep_guard_core {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;

constexpr double kRadius = 0.005;

// A ball above the plane z = 0, and a renderer that is called each millisecond.
class ForceRendererTest : public testing::Test {
 protected:
  ForceRendererTest() {
    options_.law.stiffness = 200.0;
    options_.device_damping = 100.0;
    options_.max_force_rate = 1e6;
  }

  void place(double depth) { pose_ = Translation3d(0.0, 0.0, kRadius - depth); }

  Instant now() const { return {Time(std::chrono::seconds(50) + now_), SteadyTime(std::chrono::seconds(9) + now_)}; }

  RenderedForce tick() {
    now_ += milliseconds(1);
    const Timestamps fresh{now().stamp, now().steady};
    if (poses_) inputs_.known.pose = MotionInputs::ToolPose{pose_, {fresh.stamp - pose_delay_, fresh.received}};
    if (warnings_) inputs_.known.warning = MotionInputs::GuardWarning{level_, 0, now().steady};
    if (planes_) {
      PlaneSet planes = planeSet({planeAt(Vector3d::UnitZ(), Vector3d::Zero())});
      planes.timestamps = fresh;
      planes.valid_until = fresh.stamp + milliseconds(100);
      inputs_.known.planes = std::make_shared<PlaneSet>(planes);
    }
    inputs_.known.tool = std::make_shared<ToolBalls>(tool_);
    if (!renderer_) renderer_.emplace(options_);
    RenderedForce rendered = renderer_->render(inputs_, sent_, now());
    sent_ = rendered.wrench;
    return rendered;
  }

  RenderedForce ticks(int count) {
    for (int i = 1; i < count; ++i) tick();
    return tick();
  }

  ForceOptions options_;
  ToolBalls tool_ = ballTool(kRadius);
  ForceInputs inputs_;
  std::optional<ForceRenderer> renderer_;
  DeviceWrench sent_;
  Isometry3d pose_ = Isometry3d::Identity();
  Duration now_{};
  Duration pose_delay_{};
  WarningLevel level_ = WarningLevel::kContact;
  bool poses_ = true;
  bool planes_ = true;
  bool warnings_ = true;
};

TEST_F(ForceRendererTest, ScalesAndTurnsTheForceToTheDevice) {
  options_.force_scale = 0.5;
  options_.position_scale = 0.25;
  inputs_.R_WD = AngleAxisd(M_PI / 2, Vector3d::UnitX());
  place(0.01);
  const Vector3d force_D = ticks(3).wrench.force_D;
  EXPECT_TRUE(force_D.isApprox(Vector3d(0.0, 1.0, 0.0), 1e-6)) << force_D.transpose();
}

TEST_F(ForceRendererTest, ClampsForceAndRate) {
  options_.max_force = 2.5;
  options_.max_force_rate = 100.0;
  place(0.03);
  double before = 0.0;
  for (int i = 1; i <= 40; ++i) {
    const double force = tick().wrench.force_D.norm();
    EXPECT_LE(force - before, 0.1 + 1e-9);
    before = force;
  }
  EXPECT_NEAR(before, 2.5, 1e-9);
  place(-0.1);
  EXPECT_NEAR(tick().wrench.force_D.norm(), 2.4, 1e-9);
}

TEST_F(ForceRendererTest, TorqueIsByChoice) {
  inputs_.known.tool.reset();
  pose_ = Translation3d(0.0, 0.0, kRadius - 0.005) * AngleAxisd(0.3, Vector3d::UnitX());
  EXPECT_TRUE(ticks(3).wrench.torque_D.isZero(0.0));
  EXPECT_GT(sent_.force_D.norm(), 0.5);
}

TEST_F(ForceRendererTest, ADelayOfThePoseScalesTheStiffnessDown) {
  options_.device_damping = 2.0;
  place(0.005);
  EXPECT_EQ(ticks(3).stiffness_gain, 1.0);
  pose_delay_ = milliseconds(37);
  const RenderedForce rendered = tick();
  EXPECT_NEAR(toSeconds(rendered.delay), 0.039, 1e-9) << "with the 2 ms of the output";
  EXPECT_NEAR(rendered.stiffness_gain, 2.0 / (0.0005 + 0.039) / 200.0, 1e-9);
  EXPECT_NEAR(rendered.wrench.force_D.z(), 200.0 * rendered.stiffness_gain * 0.005, 1e-9);
  pose_delay_ = {};
  EXPECT_LT(tick().stiffness_gain, 0.3) << "a delay is remembered";
  EXPECT_EQ(ticks(5000).stiffness_gain, 1.0);
}

TEST_F(ForceRendererTest, ALeverScalesTheStiffnessDownWhereThereIsTorque) {
  options_.device_turn_damping = 1e-3;
  tool_.pieces[0][0].center_T = Vector3d(0.1, 0.0, 0.0);
  place(0.005);
  EXPECT_EQ(ticks(3).stiffness_gain, 1.0);
  options_.max_torque = 1.0;
  renderer_.reset();
  const RenderedForce rendered = ticks(3);
  EXPECT_NEAR(rendered.stiffness_gain, dampingWithLever(100.0, 1e-3, 0.1) / (200.0 * 0.0025), 1e-9);
  EXPECT_NEAR(rendered.wrench.torque_D.norm(), 0.1 * rendered.wrench.force_D.norm(), 1e-9);
}

TEST_F(ForceRendererTest, SilenceOfPoseOrPlanesIsZeroWithinSeventyMilliseconds) {
  for (bool* const source : {&poses_, &planes_}) {
    place(0.01);
    EXPECT_NEAR(ticks(100).wrench.force_D.z(), 2.0, 1e-6);
    *source = false;
    EXPECT_NEAR(ticks(50).wrench.force_D.z(), 2.0, 1e-6);
    EXPECT_NEAR(ticks(10).wrench.force_D.z(), 1.0, 1e-6);
    EXPECT_GT(ticks(9).wrench.force_D.z(), 0.0);
    EXPECT_EQ(tick().wrench.force_D.z(), 0.0);
    *source = true;
  }
}

TEST_F(ForceRendererTest, AfterASilenceTheForceComesBackAtItsRate) {
  options_.max_force_rate = 100.0;
  place(0.01);
  ticks(100);
  poses_ = false;
  ticks(60);
  poses_ = true;
  const double before = sent_.force_D.z();
  EXPECT_NEAR(before, 1.0, 1e-6);
  EXPECT_NEAR(tick().wrench.force_D.z(), before + 0.1, 1e-6);
}

TEST_F(ForceRendererTest, UnknownAndASilentGuardAreZeroAtOnce) {
  place(0.01);
  EXPECT_GT(ticks(50).wrench.force_D.z(), 1.0);
  level_ = WarningLevel::kUnknown;
  EXPECT_TRUE(tick().wrench.force_D.isZero(0.0));
  level_ = WarningLevel::kContact;
  EXPECT_GT(ticks(50).wrench.force_D.z(), 1.0);
  warnings_ = false;
  EXPECT_GT(ticks(150).wrench.force_D.z(), 1.0);
  EXPECT_TRUE(tick().wrench.force_D.isZero(0.0));
}

TEST_F(ForceRendererTest, AllocatesNothing) {
  place(0.01);
  ticks(5);
  PassiveDevice device(options_, {});
  const ForceInputs inputs = inputs_;
  now_ += milliseconds(1);
  const Instant at = now();
  const Allocations allocations;
  renderer_->render(inputs, sent_, at);
  device.observe({inputs.known.pose->X_WT, inputs.R_WD, 1.0, inputs.known.pose->timestamps}, at);
  device.limit(sent_, at.steady);
  EXPECT_EQ(allocations.count(), 0U) << allocations.stacks();
}

TEST_F(ForceRendererTest, OptionsThatNoDeviceCanCarryAreRefused) {
  options_.law.damping = 100.0;
  EXPECT_TRUE(has(refusal([&] { ForceRenderer{options_}; }), "device_damping"));
  options_ = {};
  options_.max_force = 0.0;
  EXPECT_TRUE(has(refusal([&] { ForceRenderer{options_}; }), "max_force"));
  EXPECT_TRUE(has(refusal([&] { PassiveDevice({}, {/*max_speed=*/0.0}); }), "max_speed"));
}

using Complex = std::complex<double>;

// The damping that a device needs beside a simulated wall H(z) = z^-m (K + B (z - 1) / (T z)), at the frequency angle / T:
// T/2 / (1 - cos(angle)) Re{(1 - e^(-j angle)) H(e^(j angle))} [Colgate and Schenkel 1997].
double neededDamping(double stiffness, const SampledDevice& device, int delay_periods, double angle) {
  const Complex z = std::polar(1.0, angle);
  const Complex wall =
      std::pow(z, -delay_periods) * (stiffness + device.virtual_damping * (z - 1.0) / (device.period * z));
  return device.period / 2 / (1.0 - std::cos(angle)) * std::real((1.0 - 1.0 / z) * wall);
}

TEST(StiffnessBoundTest, ADeviceWithTheBoundHasTheDampingOfColgateAndSchenkelAtEachFrequency) {
  RandomScenes random(3);
  for (int i = 0; i < 200; ++i) {
    const SampledDevice device{random.uniform(0.5, 5.0), random.uniform(0.0, 0.4), random.logUniform(5e-4, 5e-3)};
    const int periods = static_cast<int>(random.count(50));
    const double stiffness = maxStiffness(device, periods * device.period);
    for (int j = 1; j <= 500; ++j) {
      ASSERT_LE(neededDamping(stiffness, device, periods, M_PI * j / 500.0), device.damping + 1e-9);
    }
  }
}

// At low frequencies, without virtual damping, nothing is left of it: a stiffer wall is active.
TEST(StiffnessBoundTest, WithoutVirtualDampingTheBoundIsTheBest) {
  const SampledDevice device{2.0, 0.0, 0.001};
  for (const int periods : {0, 1, 10, 50}) {
    const double stiffness = maxStiffness(device, periods * device.period);
    EXPECT_GT(neededDamping(1.001 * stiffness, device, periods, 1e-4), device.damping);
  }
}

TEST(StiffnessBoundTest, IsZeroIfTheSimulatedDamperIsStronger) {
  EXPECT_EQ(maxStiffness({1.0, 1.5, 0.001}, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(maxStiffness({2.0, 0.0, 0.001}, 0.0), 4000.0);
  EXPECT_DOUBLE_EQ(maxStiffness({2.5, 0.5, 0.001}, 0.0195), 100.0);
}

// The matrix diag(b, c) less what a spring and a damper at the point take, (1, lever) (1, lever)', loses its determinant.
TEST(StiffnessBoundTest, WithALeverForceAndTorqueTogetherUseUpTheDamping) {
  const double b = 2.0, c = 0.01, lever = 0.08;
  const double damping = dampingWithLever(b, c, lever);
  EXPECT_NEAR((b - damping) * (c - damping * lever * lever), std::pow(damping * lever, 2), 1e-12);
  EXPECT_EQ(dampingWithLever(b, c, 0.0), b);
}

const Instant kNow{Time(std::chrono::seconds(100)), SteadyTime(std::chrono::seconds(7))};

Timestamps ago(Duration age) { return {kNow.stamp - age, kNow.steady - age}; }

std::shared_ptr<PlaneSet> freshPlanes() {
  auto planes = std::make_shared<PlaneSet>();
  planes->timestamps = ago({});
  planes->valid_until = kNow.stamp + milliseconds(100);
  planes->complete = true;
  return planes;
}

MotionInputs fresh(const std::shared_ptr<PlaneSet>& planes) {
  return {planes, std::make_shared<ToolBalls>(), MotionInputs::ToolPose{Isometry3d::Identity(), ago({})},
          MotionInputs::GuardWarning{WarningLevel::kClear, 0, kNow.steady}};
}

using Change = std::function<void(MotionInputs&, PlaneSet&)>;

ForcePermission decide(const Change& change) {
  const std::shared_ptr<PlaneSet> planes = freshPlanes();
  MotionInputs inputs = fresh(planes);
  change(inputs, *planes);
  return decideForce({{}, inputs}, kNow, {});
}

TEST(ForcePermissionTest, FreshInputsOfAnyKnownLevelLetTheWholeForceThrough) {
  for (const WarningLevel level :
       {WarningLevel::kClear, WarningLevel::kConsidered, WarningLevel::kReflex, WarningLevel::kContact}) {
    const ForcePermission permission = decide([&](auto& inputs, auto& /*planes*/) { inputs.warning->level = level; });
    EXPECT_EQ(permission.gain, 1.0);
    EXPECT_EQ(permission.cause, PermissionCause::kGuarded);
  }
}

TEST(ForcePermissionTest, ASilentPosePlanesOrDeviceFadeTheForceOutFrom50To70Milliseconds) {
  for (const auto& [silent, gain] : {std::pair{50, 1.0}, {55, 0.75}, {60, 0.5}, {69, 0.05}, {70, 0.0}, {90, 0.0}}) {
    const Timestamps silent_since = ago(milliseconds(silent));
    const ForcePermission pose =
        decide([&](auto& inputs, auto& /*planes*/) { inputs.pose->timestamps = silent_since; });
    EXPECT_NEAR(pose.gain, gain, 1e-9) << silent;
    const ForcePermission planes = decide([&](auto& /*inputs*/, auto& set) { set.timestamps = silent_since; });
    EXPECT_NEAR(planes.gain, gain, 1e-9) << silent;
    const ForcePermission device = decideForce({silent_since, fresh(freshPlanes())}, kNow, {});
    EXPECT_NEAR(device.gain, gain, 1e-9) << silent;
    if (silent == 50) continue;
    EXPECT_EQ(device.cause, PermissionCause::kDeviceSilent);
    EXPECT_EQ(pose.cause, PermissionCause::kPoseSilent);
    EXPECT_EQ(planes.cause, PermissionCause::kPlanesSilent);
  }
}

TEST(ForcePermissionTest, AToolThatJointsMoveHasAForceOnlyWhileTheyTellWhereItIs) {
  const std::shared_ptr<PlaneSet> planes = freshPlanes();
  planes->joints = {"elbow"};
  planes->positions = {0.0};
  ForceInputs inputs{{}, fresh(planes)};
  EXPECT_EQ(decideForce(inputs, kNow, {}).gain, 0.0);
  EXPECT_EQ(decideForce(inputs, kNow, {}).cause, PermissionCause::kMovingJoints);
  inputs.placed = PlacedByJoints{nullptr, ago({})};
  EXPECT_EQ(decideForce(inputs, kNow, {}).gain, 1.0);
  inputs.placed->timestamps.stamp = ago(milliseconds(151)).stamp;
  EXPECT_EQ(decideForce(inputs, kNow, {}).cause, PermissionCause::kOldJoints);
  inputs.placed->timestamps = ago(milliseconds(60));
  EXPECT_NEAR(decideForce(inputs, kNow, {}).gain, 0.5, 1e-9);
  EXPECT_EQ(decideForce(inputs, kNow, {}).cause, PermissionCause::kJointsSilent);
}

TEST(ForcePermissionTest, WhatNoCameraSeesTakesNothingFromTheForceOfWhatIsKnown) {
  const ForcePermission permission = decide([](auto& inputs, auto& /*planes*/) {
    inputs.warning->level = WarningLevel::kUnknown;
    inputs.warning->reasons = kNotSeen;
  });
  EXPECT_EQ(permission.gain, 1.0);
}

TEST(ForcePermissionTest, WhatIsNotKnownLetsNothingThrough) {
  const std::vector<std::pair<PermissionCause, Change>> cases = {
      {PermissionCause::kNoWarning, [](auto& inputs, auto& /*planes*/) { inputs.warning.reset(); }},
      {PermissionCause::kWarningSilent,
       [](auto& inputs, auto& /*planes*/) { inputs.warning->received -= milliseconds(151); }},
      {PermissionCause::kUnknown,
       [](auto& inputs, auto& /*planes*/) { inputs.warning->level = WarningLevel::kUnknown; }},
      {PermissionCause::kNoPose, [](auto& inputs, auto& /*planes*/) { inputs.pose.reset(); }},
      {PermissionCause::kOldPose,
       [](auto& inputs, auto& /*planes*/) { inputs.pose->timestamps.stamp -= milliseconds(151); }},
      {PermissionCause::kNoPlanes, [](auto& inputs, auto& /*planes*/) { inputs.planes.reset(); }},
      {PermissionCause::kPlanesExpired,
       [](auto& /*inputs*/, auto& planes) { planes.valid_until -= milliseconds(101); }},
      {PermissionCause::kIncomplete, [](auto& /*inputs*/, auto& planes) { planes.complete = false; }},
      {PermissionCause::kNoTool, [](auto& inputs, auto& /*planes*/) { inputs.tool.reset(); }}};
  for (const auto& [cause, change] : cases) {
    const ForcePermission permission = decide(change);
    EXPECT_EQ(permission.gain, 0.0) << textOf(cause);
    EXPECT_EQ(permission.cause, cause) << textOf(cause);
  }
  EXPECT_EQ(decide([](auto& inputs, auto& /*planes*/) { inputs.warning->received -= milliseconds(150); }).gain, 1.0);
}

}  // namespace
}  // namespace sweep_guard_core
