// Changes every changeable parameter of a running guard, and checks its effect.
#include <dynamic_reconfigure/ConfigDescription.h>
#include <gtest/gtest.h>
#include <sweep_guard/Interaction.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

#include "node_fixture.h"
#include "proximity_listener.h"
#include "refusal.h"
#include "ros/output/markers.h"

namespace sweep_guard_ros {
namespace {

using dynamic_reconfigure::Config;
using dynamic_reconfigure::ConfigDescription;
using sweep_guard::Contacts;
using sweep_guard::Prediction;
using sweep_guard::Warning;

constexpr double kPosePeriod = 0.01;  // [s]

template <typename Parameters, typename Value>
void append(Parameters& parameters, const std::string& key, Value value) {
  parameters.emplace_back();
  parameters.back().name = key;
  parameters.back().value = value;
}
void add(Config& config, const std::string& key, double value) { append(config.doubles, key, value); }
void add(Config& config, const std::string& key, bool value) { append(config.bools, key, value); }
void add(Config& config, const std::string& key, const char* value) { append(config.strs, key, value); }

template <typename Value>
Config one(const std::string& key, Value value) {
  Config config;
  add(config, key, value);
  return config;
}

template <typename Parameters>
auto valueIn(const Parameters& parameters, const std::string& key) {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(), [&](const auto& parameter) { return parameter.name == key; });
  if (found == parameters.end()) throw std::runtime_error("no parameter " + key);
  return found->value;
}

// The parameters are those of the start before and after each test.
class ReconfigureTest : public NodeTest {
 protected:
  static void SetUpTestSuite() { at_start_ = probe().configuration(); }
  void SetUp() override {
    probe().configure(one("warning/hold_time", 0.0));
    NodeTest::SetUp();
  }
  void TearDown() override {
    EXPECT_TRUE(probe().configure(at_start_));
    probe().enable(true);
    NodeTest::TearDown();
  }

  template <typename Value>
  void change(const std::string& key, Value value) {
    ASSERT_TRUE(probe().configure(one(key, value))) << key;
    changed_.insert(key);
  }

  void changeThresholds(double considered_on, double considered_off, double reflex) {
    Config config;
    add(config, "warning/considered_on", considered_on);
    add(config, "warning/considered_off", considered_off);
    add(config, "warning/reflex_probability", reflex);
    ASSERT_TRUE(probe().configure(config));
    for (const auto& number : config.doubles) changed_.insert(number.name);
  }

  // Makes one step of a motion, and returns the prediction after it.
  Prediction predictAt(const Eigen::Vector3d& tip) {
    moveTo(tip);
    return probe().awaitPrediction(probe().time());
  }

  // Rests for a while, then goes along x at a speed [m/s] for some steps.
  Prediction restAndGo(double speed, int steps) {
    probe().reset();
    placeSquare("far", {0.0, 0.0, -2.0});
    for (int i = 0; i < 20; ++i) moveTo({0.0, 0.0, 1.0});
    Prediction prediction;
    for (int i = 1; i <= steps; ++i) prediction = predictAt({speed * kPosePeriod * i, 0.0, 1.0});
    return prediction;
  }
  static double end(const Prediction& prediction) { return prediction.poses.back().pose.position.x; }
  static double lastStep(const Prediction& prediction) {  // [s]
    return (prediction.poses.back().from_now - prediction.poses.end()[-2].from_now).toSec();
  }
  static double firstStep(const Prediction& prediction) {  // [s]
    return (prediction.poses[1].from_now - prediction.poses[0].from_now).toSec();
  }
  static double lastSpeed(const Prediction& prediction) {  // [m/s]
    return (end(prediction) - prediction.poses.end()[-2].pose.position.x) / lastStep(prediction);
  }

  // Comes down towards the square at 0.25 m/s, so that it would be met after the time to go [s].
  Warning descendUntil(double to_go) {
    constexpr double kSpeed = 0.25;
    probe().reset();
    for (int i = 20; i >= 0; --i) {
      predictAt({0.0, 0.0, kSpeed * (to_go + i * kPosePeriod)});
      probe().place(squareMovedTo("square", {0.0, 0.0, 0.0}, probe().time()));
    }
    predictAt({0.0, 0.0, kSpeed * to_go - kSpeed * kPosePeriod});
    probe().skipWarnings();
    return probe().awaitWarning([](const Warning&) { return true; });
  }

  // Moves from rest. The square is small, with its center at a point.
  Contacts sweep(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    moveTo(from);
    return moveTo(to);
  }

  // Rests above the square, where contact is only probable.
  Prediction rest() {
    Prediction prediction;
    for (int i = 0; i < 40; ++i) {
      prediction = predictAt({0.0005 * (i % 2), 0.0, 0.003});
      probe().place(squareMovedTo("square", {0.0, 0.0, 0.0}, probe().time()));
    }
    return prediction;
  }
  // On the parameter server, which is written before the answer to a change.
  static double numberOf(const std::string& key) {
    double number = 0.0;
    EXPECT_TRUE(ros::param::get("/sweep_guard/" + key, number)) << key;
    return number;
  }

  static inline Config at_start_;
  static inline std::set<std::string> changed_;
};

TEST_F(ReconfigureTest, PaddingGrowsTheTool) {
  placeSquare("square", {0.0, 0.0, 0.0});
  EXPECT_TRUE(sweep({0.115, 0.0, -0.05}, {0.115, 0.0, -0.05}).objects.empty());  // 5 mm beside it
  change("tool/padding", 0.006);
  EXPECT_EQ(sweep({0.115, 0.0, -0.05}, {0.115, 0.0, -0.05}).objects.size(), 1U);
  EXPECT_TRUE(probe().check(requestAlong({{0.115, 0.0, -0.05}})).collision);
}

TEST_F(ReconfigureTest, TheReachOfThePlanesChanges) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const TopicListener<sweep_guard::Proximity> planes("proximity");
  const auto newest = [&] {
    return planes.awaitNewest([](const auto& proximity) { return proximity.header.stamp == probe().time(); });
  };
  while (planes.all().empty()) moveTo({0.0, 0.0, 0.15});
  moveTo({0.0, 0.0, 0.15});
  EXPECT_TRUE(newest().planes.empty());
  change("proximity/reach", 0.2);
  moveTo({0.0, 0.0, 0.15});
  EXPECT_EQ(newest().planes.size(), 1U);
  change("proximity/reach", 0.0);
  const size_t before = planes.all().size();
  for (int i = 0; i < 5; ++i) moveTo({0.0, 0.0, 0.15});
  change("proximity/reach", 0.1);
  moveTo({0.0, 0.0, 0.15});
  newest();
  EXPECT_EQ(planes.all().size(), before + 1);
}

TEST_F(ReconfigureTest, TheLawOfTheForceChanges) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const TopicListener<sweep_guard::Interaction> forces("interaction");
  const auto force = [&](double from, double to) {
    moveTo({0.0, 0.0, from});
    moveTo({0.0, 0.0, to});
    const auto now = [](const auto& interaction) { return interaction.header.stamp == probe().time(); };
    return -forces.awaitNewest(now).wrench.force.z;  // the tip points down
  };
  while (forces.all().empty()) moveTo({0.0, 0.0, -0.01});
  const double before = force(-0.01, -0.01);
  EXPECT_GT(before, 0.1);
  change("interaction/stiffness", 2e6);
  EXPECT_NEAR(force(-0.01, -0.01), 2.0 * before, 1e-6);
  change("interaction/damping", 2.0);
  EXPECT_NEAR(force(-0.009, -0.01), 2.0 * before * (1.0 + 2.0 * 0.1), 1e-6);  // at 0.1 m/s
  change("interaction/damping", 0.0);
  change("interaction/min_area", 1.0);
  EXPECT_LT(force(-0.01, -0.01), 0.01 * before);
}

// In a corner of the box about a slanting motion, and outside of the hull.
TEST_F(ReconfigureTest, TheVolumeChanges) {
  placeSquare("corner", {0.2, 0.0, -0.1}, "world", /*half_side=*/0.005);
  change("volume", "obb");
  EXPECT_EQ(sweep({0.0, 0.0, 0.0}, {0.15, 0.0, -0.15}).objects.size(), 1U);
  change("volume", "hull");
  const Contacts contacts = sweep({0.0, 0.0, 0.0}, {0.15, 0.0, -0.15});
  EXPECT_TRUE(contacts.objects.empty());
  EXPECT_EQ(contacts.volume, "hull");
}

// The margin for rounding identifies the detector. The cull decides on a triangle with a corner in the volume.
TEST_F(ReconfigureTest, TheDetectorAndItsCullChange) {
  placeSquare("small", {0.0, 0.0, 0.0}, "world", /*half_side=*/0.002);
  const auto margin = [&] { return sweep({0.0, 0.0, 0.05}, {0.0, 0.0, -0.05}).margin; };
  const double culled = margin();
  change("cull", false);
  const double drawn = margin();
  EXPECT_GT(drawn, culled);
  change("detector", "reference");
  EXPECT_LT(margin(), drawn);
  predictAt({0.0, 0.0, 0.5});
  predictAt({0.0, 0.0, 0.5});
  EXPECT_TRUE(probe().predict(1.0).success);
}

TEST_F(ReconfigureTest, TheNarrowPhaseIsLeftOut) {
  placeSquare("square", {0.0, 0.0, 0.0});
  EXPECT_TRUE(sweep({0.0, 0.0, 0.05}, {0.0, 0.0, -0.05}).objects.at(0).fine);
  change("fine", false);
  EXPECT_FALSE(sweep({0.0, 0.0, 0.05}, {0.0, 0.0, -0.05}).objects.at(0).fine);
}

// The margin covers the deviation bound, which falls with the square of the angle.
TEST_F(ReconfigureTest, TurnsAreSplitIntoSmallerSteps) {
  placeSquare("square", {0.0, 0.0, 0.0});
  const auto margin = [&] {
    moveTo({0.0, 0.0, 1.0});
    probe().tick(kPosePeriod);
    return probe()
        .move(poseAt({0.0, 0.0, 1.0}, probe().time(),
                     Eigen::Quaterniond(Eigen::AngleAxisd(M_PI - 0.15, Eigen::Vector3d::UnitX()))))
        .margin;
  };
  const double whole = margin();
  change("max_rotation_per_sweep", 0.05);
  EXPECT_LT(margin(), 0.2 * whole);
}

TEST_F(ReconfigureTest, ThePredictorIsExchanged) {
  change("prediction/predictor", "constant_velocity");
  const Prediction steady = restAndGo(0.2, 10);
  EXPECT_NEAR(lastSpeed(steady), 0.2, 0.01);
  EXPECT_GE(end(steady), 0.02 + 0.2 * steady.poses.back().from_now.toSec() - 1e-3);  // load lengthens the path
  change("prediction/predictor", "hold");
  EXPECT_NEAR(end(restAndGo(0.2, 10)), 0.02, 1e-9);
}

TEST_F(ReconfigureTest, ThePolynomialHasAnotherDegree) {
  change("prediction/predictor", "polynomial");
  const double line = end(restAndGo(0.2, 10));
  change("prediction/degree", "[0, 1, 1, 1, 1, 1]");
  EXPECT_LT(end(restAndGo(0.2, 10)), line - 0.05);
}

TEST_F(ReconfigureTest, AnAxisIsHeldStill) {
  change("prediction/predictor", "constant_velocity");
  EXPECT_GT(end(restAndGo(0.2, 10)), 0.1);
  change("prediction/constrained", "[x]");
  EXPECT_NEAR(end(restAndGo(0.2, 10)), 0.02, 1e-9);
}

TEST_F(ReconfigureTest, ThePolynomialForgetsSooner) {
  change("prediction/predictor", "polynomial");
  const double slowly = end(restAndGo(0.2, 5));
  change("prediction/forgetting_factor", 0.1);
  EXPECT_GT(end(restAndGo(0.2, 5)), slowly + 0.05);
}

TEST_F(ReconfigureTest, ThePolynomialHasAShorterWindow) {
  change("prediction/predictor", "polynomial");
  const double long_back = end(restAndGo(0.2, 5));
  change("prediction/window", 0.04);
  EXPECT_GT(end(restAndGo(0.2, 5)), long_back + 0.05);
}

// A faster motion is a jump, after which the motion is unknown.
TEST_F(ReconfigureTest, TheSpeedLimitDetectsAJump) {
  EXPECT_FALSE(restAndGo(0.2, 3).poses.empty());
  change("limits/max_speed", 0.1);
  EXPECT_TRUE(restAndGo(0.2, 3).poses.empty());
}

TEST_F(ReconfigureTest, TheTurnRateLimitDetectsAJump) {
  placeSquare("far", {0.0, 0.0, -2.0});
  const auto turn = [&] {
    probe().reset();
    moveTo({0.0, 0.0, 1.0});
    moveTo({0.0, 0.0, 1.0});
    probe().tick(kPosePeriod);
    probe().move(poseAt({0.0, 0.0, 1.0}, probe().time(),
                        Eigen::Quaterniond(Eigen::AngleAxisd(M_PI - 0.05, Eigen::Vector3d::UnitX()))));
    return probe().awaitPrediction(probe().time());
  };
  EXPECT_FALSE(turn().poses.empty());
  change("limits/max_turn_rate", 1.0);
  EXPECT_TRUE(turn().poses.empty());
}

TEST_F(ReconfigureTest, TheReflexIntervalIsLonger) {
  placeSquare("square", {0.0, 0.0, 0.0});
  EXPECT_EQ(descendUntil(0.4).level, Warning::CONSIDERED);
  change("horizon/reflex", 0.8);
  EXPECT_EQ(descendUntil(0.4).level, Warning::REFLEX);
}

TEST_F(ReconfigureTest, TheConsideredIntervalIsLonger) {
  placeSquare("square", {0.0, 0.0, 0.0});
  changeThresholds(1.0, 1.0, 1.0);
  EXPECT_EQ(descendUntil(1.5).level, Warning::CLEAR);
  change("horizon/considered", 2.0);
  EXPECT_EQ(descendUntil(1.5).level, Warning::CONSIDERED);
}

TEST_F(ReconfigureTest, ThePredictedStepsAreLonger) {
  const Prediction before = restAndGo(0.0, 2);
  EXPECT_LT(firstStep(before), 0.011);
  EXPECT_NEAR(lastStep(before), 0.1, 0.01);
  change("horizon/reflex_step", 0.05);
  change("horizon/considered_step", 0.5);
  const Prediction after = restAndGo(0.0, 2);
  EXPECT_GT(firstStep(after), 0.03);
  EXPECT_NEAR(lastStep(after), 0.5, 0.06);
}

TEST_F(ReconfigureTest, AContactLessProbableThanTheThresholdsIsNotShown) {
  placeSquare("square", {0.0, 0.0, 0.0});
  changeThresholds(1.0, 1.0, 1.0);
  const Prediction before = rest();
  EXPECT_EQ(before.interval, Prediction::NONE);
  EXPECT_EQ(before.probability, 0.0);  // too small for the thresholds
  changeThresholds(0.001, 0.001, 0.001);
  const Prediction after = rest();
  EXPECT_NE(after.interval, Prediction::NONE);
  EXPECT_GT(after.probability, 0.0);
}

TEST_F(ReconfigureTest, EachLevelHasAThresholdOfItsOwn) {
  placeSquare("square", {0.0, 0.0, 0.0});
  changeThresholds(0.001, 0.001, 1.0);
  EXPECT_EQ(rest().interval, Prediction::CONSIDERED);
  EXPECT_FALSE(probe().configure(one("warning/considered_off", 0.002)));
  change("warning/considered_on", 1.0);
  change("warning/considered_off", 0.5);
  EXPECT_EQ(rest().interval, Prediction::NONE);
  change("warning/reflex_probability", 0.5);
  EXPECT_EQ(numberOf("warning/considered_on"), 1.0);
}

TEST_F(ReconfigureTest, TheDistanceAndTheTimeOfAnAcknowledgementChange) {
  placeSquare("square", {0.0, 0.0, 0.0});
  EXPECT_TRUE(has(probe().acknowledge("square").message, "only CONSIDERED can be acknowledged"));
  changeThresholds(0.001, 0.001, 1.0);
  ASSERT_EQ(rest().interval, Prediction::CONSIDERED);
  change("warning/acknowledge_distance", 0.0);
  EXPECT_TRUE(has(probe().acknowledge("square").message, "warning/acknowledge_distance"));
  change("warning/acknowledge_distance", 0.6);
  EXPECT_TRUE(probe().acknowledge("square").success);
  change("warning/acknowledge_time", 1.0);
  EXPECT_EQ(numberOf("warning/acknowledge_time"), 1.0);
}

TEST_F(ReconfigureTest, TheHoldTimeOfAContactChanges) {
  placeSquare("square", {0.0, 0.0, 0.0});
  change("warning/hold_time", 60.0);
  sweep({0.0, 0.0, 0.05}, {0.0, 0.0, -0.05});
  for (int i = 0; i < 5; ++i) moveTo({0.0, 0.0, 0.5});
  EXPECT_EQ(probe().warnings().back().level, Warning::CONTACT);
  probe().skipWarnings();
  change("warning/hold_time", 0.0);
  moveTo({0.0, 0.0, 0.5});
  probe().awaitWarning([](const Warning& warning) { return !warning.contact; });
}

// A thousand times less time for more than two thousand sweeps. On a busy machine there is enough time now and then.
// camera_test.cpp shows what it does.
TEST_F(ReconfigureTest, WhatCamerasMustSeeChanges) { change("min_seen", 0.5); }

TEST_F(ReconfigureTest, TheRateDecidesHowManySweepsThereIsTimeFor) {
  Config fine;
  add(fine, "horizon/considered", 5.0);
  add(fine, "horizon/considered_step", 0.002);
  ASSERT_TRUE(probe().configure(fine));
  const auto nearly_all = [](const Prediction& made) { return 10 * made.sweeps_made >= 9 * made.sweeps_asked; };
  Prediction slow = restAndGo(0.1, 3);
  for (int tries_left = 20; tries_left > 0 && !nearly_all(slow); --tries_left) slow = restAndGo(0.1, 3);
  EXPECT_TRUE(nearly_all(slow)) << slow.sweeps_made << " of " << slow.sweeps_asked;
  change("timing/min_rate", 1000.0);
  const Prediction fast = restAndGo(0.1, 3);
  EXPECT_LT(fast.sweeps_made, fast.sweeps_asked);
  EXPECT_LT(fast.sweeps_made, slow.sweeps_made);
}

TEST_F(ReconfigureTest, PathsAreGivenUpSoonerOrLater) {
  for (int i = 0; i < 50; ++i) placeSquare("square" + std::to_string(i), {0.0, 0.0, 0.0});
  sweep_guard::CheckSweep::Request request = requestAlong(std::vector<Eigen::Vector3d>(1024, {0.0, 0.0, -0.05}));
  change("check_sweep/deadline", 60.0);
  EXPECT_TRUE(probe().check(request).success);
  change("check_sweep/deadline", 0.01);
  EXPECT_TRUE(has(probe().check(request).message, "check_sweep/deadline"));
}

TEST_F(ReconfigureTest, PosesBecomeStaleSoonerOrLater) {
  placeSquare("square", {0.0, 0.0, -1.0});
  change("timing/pose_timeout", 0.1);
  restAt({0.0, 0.0, 0.5});
  probe().advance(0.101);
  EXPECT_EQ(probe().warnings().back().reasons, Warning::POSE_STALE) << probe().warnings().back().text;
  change("timing/pose_timeout", 2.0);
  probe().skipWarnings();
  const Warning later = probe().awaitWarning([](const Warning&) { return true; });
  EXPECT_EQ(later.reasons & Warning::POSE_STALE, 0U) << later.text;
}

TEST_F(ReconfigureTest, MeshesNeverBecomeStale) {
  placeSquare("square", {0.0, 0.0, -1.0});
  probe().advance(10.1);
  probe().awaitWarning(hasReason(Warning::MESH_STALE));
  change("timing/mesh_timeout", std::numeric_limits<double>::infinity());
  probe().skipWarnings();
  const Warning later = probe().awaitWarning([](const Warning&) { return true; });
  EXPECT_EQ(later.reasons & Warning::MESH_STALE, 0U) << later.text;
}

// Compared to the warnings, which keep their 20 Hz.
TEST_F(ReconfigureTest, TheMarkerRateChanges) {
  const auto count = [] {
    const size_t before = probe().markersReceived();
    probe().skipWarnings();
    probe().awaitWarning([left = 20](const Warning&) mutable { return --left == 0; });
    return probe().markersReceived() - before;
  };
  change("timing/marker_rate", 0.1);
  EXPECT_LE(count(), 1U);
  change("timing/marker_rate", 100.0);
  EXPECT_GE(count(), 20U);
}

TEST_F(ReconfigureTest, EachNamespaceOfTheMarkersCanBeHidden) {
  placed_.insert("allowed");
  probe().publish(squareAt("allowed", {0.0, 0.0, 0.0}, probe().time(), 0.1));  // no answer shows it: it may be touched
  placeSquare("square", {0.0, 0.0, 0.0});
  placeSquare("below", {0.0, 0.0, -0.1});
  change("warning/hold_time", 60.0);
  moveTo({0.0, 0.0, 0.02});
  moveTo({0.0, 0.0, 0.0});
  moveTo({0.0, 0.0, -0.02});
  const auto drawn = [](const visualization_msgs::MarkerArray& array) {
    std::set<std::string> namespaces;
    for (const auto& marker : array.markers) {
      if (marker.action == visualization_msgs::Marker::ADD) namespaces.insert(marker.ns);
    }
    return namespaces;
  };
  const std::set<std::string> all(markerNamespaces().begin(), markerNamespaces().end());
  probe().awaitMarkers([&](const auto& array) { return drawn(array) == all; });
  for (const std::string& name : markerNamespaces()) {
    std::set<std::string> others = all;
    others.erase(name);
    change("markers/" + name, false);
    probe().awaitMarkers([&](const auto& array) { return drawn(array) == others; });
    change("markers/" + name, true);
    probe().awaitMarkers([&](const auto& array) { return drawn(array) == all; });
  }
}

// The path through the square begins before the change and ends after it.
TEST_F(ReconfigureTest, TheMotionDuringAChangeIsSwept) {
  placeSquare("square", {0.0, 0.0, 0.0});
  moveTo({0.0, 0.0, 0.05});
  const ros::Time before = probe().time();
  Config config;
  add(config, "detector", "halfspace");
  add(config, "volume", "hull");
  add(config, "tool/padding", 0.001);
  add(config, "prediction/predictor", "constant_velocity");
  ASSERT_TRUE(probe().configure(config));
  const Contacts contacts = moveTo({0.0, 0.0, -0.5});
  EXPECT_EQ(contacts.interval_start, before);
  EXPECT_EQ(contacts.objects.size(), 1U);
}

// Whatever the order of poses and changes.
TEST_F(ReconfigureTest, ManyChangesLeaveNoGap) {
  placeSquare("square", {0.0, 0.0, 0.0});
  moveTo({0.0, 0.0, 0.5});
  probe().forgetContacts();
  for (int i = 0; i < 60; ++i) {
    probe().tick(0.001);
    probe().publish(poseAt({0.0, 0.0, i == 30 ? -0.5 : 0.5}, probe().time()));
    Config config = one("detector", i % 2 == 0 ? "halfspace" : "reference");
    add(config, "tool/padding", 0.001 * (i % 3));
    ASSERT_TRUE(probe().configure(config));
  }
  const std::vector<Contacts> contacts = probe().awaitContactsUpTo(probe().time());
  EXPECT_TRUE(endToEnd(contacts));
  EXPECT_GE(contactCount(contacts), 1U);
  EXPECT_LE(contactCount(contacts), 2U);
}

TEST_F(ReconfigureTest, AChangeAloneMakesNothingUnknown) {
  change("timing/pose_timeout", 2.0);  // a busy machine may take longer
  placeSquare("square", {0.0, 0.0, -1.0});
  restAt({0.0, 0.0, 0.5});
  const size_t since = probe().warnings().size();
  for (const char* const detector : {"halfspace", "reference", "select"}) {
    change("detector", detector);
    moveTo({0.0, 0.0, 0.5});
    probe().awaitPrediction(probe().time());
  }
  const auto warnings = probe().warnings();
  for (size_t i = since; i < warnings.size(); ++i) {
    EXPECT_EQ(warnings[i].reasons & ~std::uint32_t{Warning::POSE_STALE}, 0U) << warnings[i].text;
    EXPECT_TRUE(warnings[i].clear || warnings[i].reasons != 0) << warnings[i].text;
  }
}

TEST_F(ReconfigureTest, BadValuesAreRefusedAndChangeNothing) {
  placeSquare("square", {0.0, 0.0, -1.0});
  const Config before = probe().configuration();
  for (const Config& bad :
       {one("tool/padding", -0.001), one("horizon/reflex", std::nan("")), one("horizon/reflex", 5.0),
        one("horizon/considered", 0.05), one("horizon/reflex_step", 0.5), one("timing/pose_timeout", 100.0),
        one("warning/considered_on", 0.0), one("warning/min_probability", 0.1), one("detector", "oracle"),
        one("volume", "sphere"), one("prediction/degree", "[1, 1]"), one("prediction/degree", "[1, 1, 1, 1, 1, 9]"),
        one("prediction/constrained", "[roll]"), one("cull", "yes"), one("fine", 1.0), one("gl_context", "egl"),
        one("limits/max_triangles", 5.0), one("tool/radius", 0.02), one("nonsense", 1.0)}) {
    EXPECT_FALSE(probe().configure(bad)) << bad;
    const Config after = probe().configuration();
    EXPECT_EQ(after.doubles, before.doubles) << bad;
    EXPECT_EQ(after.strs, before.strs) << bad;
    EXPECT_EQ(after.bools, before.bools) << bad;
  }
  restAt({0.0, 0.0, 0.5});
}

// One of the two is valid alone.
TEST_F(ReconfigureTest, ARequestIsAppliedAsAWholeOrNotAtAll) {
  Config config;
  add(config, "horizon/considered_step", 0.2);
  add(config, "horizon/considered", 0.05);
  EXPECT_FALSE(probe().configure(config));
  EXPECT_EQ(valueIn(probe().configuration().doubles, "horizon/considered_step"), 0.1);
  config.doubles.back().value = 2.0;
  EXPECT_TRUE(probe().configure(config));
}

TEST_F(ReconfigureTest, DiagnosticsAndParameterServerReportChangesAndRefusals) {
  change("horizon/reflex", 0.2);
  EXPECT_FALSE(probe().configure(one("horizon/reflex", 3.0)));
  const auto status = probe().awaitStatus("parameters", [](const auto& next) {
    return valueOf(next, "last refusal").find("horizon/reflex is 3, but must be a number from 0.01 to 1") !=
           std::string::npos;
  });
  EXPECT_EQ(valueOf(status, "horizon/reflex"), "0.2, at the start 0.1");
  EXPECT_TRUE(has(valueOf(status, "last change"), "horizon/reflex from 0.1 to 0.2"));
  EXPECT_TRUE(has(valueOf(status, "last change"), ros::this_node::getName()));
  double set = 0.0;
  EXPECT_TRUE(ros::param::get("/sweep_guard/horizon/reflex", set));
  EXPECT_EQ(set, 0.2);
}

// dynparam reads the description and sends each value in its type.
TEST_F(ReconfigureTest, TheCommandLineToolChangesThem) {
  const auto set = [](const std::string& what) {
    return std::system(("rosrun dynamic_reconfigure dynparam set /sweep_guard " + what).c_str());
  };
  EXPECT_EQ(set("\"{detector: halfspace, fine: false, horizon/considered: 2, prediction/constrained: [x, rz]}\""), 0);
  const Config after = probe().configuration();
  EXPECT_EQ(valueIn(after.strs, "detector"), "halfspace");
  EXPECT_FALSE(valueIn(after.bools, "fine"));
  EXPECT_EQ(valueIn(after.doubles, "horizon/considered"), 2.0);
  EXPECT_EQ(valueIn(after.strs, "prediction/constrained"), "[x, rz]");
  EXPECT_NE(set("horizon/considered 0.01"), 0);
}

// Clients build their sliders and choices from it.
TEST_F(ReconfigureTest, TheDescriptionHasEachParameterInAGroupWithRangeAndDefault) {
  const auto description =
      ros::topic::waitForMessage<ConfigDescription>("/sweep_guard/parameter_descriptions", ros::Duration(1e6));
  ASSERT_TRUE(description);
  std::set<std::string> offered;
  for (const auto& group : description->groups) {
    for (const auto& parameter : group.parameters) {
      offered.insert(parameter.name);
      EXPECT_EQ(parameter.name.find(group.name + "/") == 0, group.id != 0) << parameter.name;
      EXPECT_FALSE(parameter.description.empty()) << parameter.name;
    }
  }
  EXPECT_EQ(valueIn(description->min.doubles, "timing/pose_timeout"), 0.01);
  EXPECT_EQ(valueIn(description->max.doubles, "timing/pose_timeout"), 2.0);
  EXPECT_EQ(valueIn(description->dflt.strs, "detector"), "select");
  const testing::TestSuite& suite = *testing::UnitTest::GetInstance()->current_test_suite();
  if (suite.test_to_run_count() == suite.total_test_count()) {
    EXPECT_EQ(offered, changed_) << "the tests above change all that may change";
  }
}

}  // namespace
}  // namespace sweep_guard_ros
