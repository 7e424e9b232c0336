// Every parameter is read, checked, and refused with one line that names key, value and range.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/parameters.h"

namespace sweep_guard_ros {
namespace {

class ParametersTest : public ::testing::Test {
 protected:
  void TearDown() override { ros::param::del("/guarded"); }
  ros::NodeHandle node_{"/guarded"};
};

TEST_F(ParametersTest, HaveTheDefaultsOfTheConfigurationFile) {
  const Parameters defaults = loadParameters(node_);
  const Parameters loaded = loadParameters(ros::NodeHandle("/from_file"));
  ASSERT_TRUE(ros::param::has("/from_file/fixed_frame"));
  EXPECT_EQ(loaded.fixed_frame, defaults.fixed_frame);
  EXPECT_EQ(loaded.tool_source, defaults.tool_source);
  EXPECT_EQ(loaded.tool_frame, defaults.tool_frame);
  EXPECT_EQ(loaded.tool_radius, defaults.tool_radius);
  EXPECT_EQ(loaded.tool_length, defaults.tool_length);
  EXPECT_EQ(loaded.tool_sides, defaults.tool_sides);
  EXPECT_EQ(loaded.detector, defaults.detector);
  EXPECT_EQ(loaded.cull, defaults.cull);
  EXPECT_EQ(loaded.guard.sweep.volume, defaults.guard.sweep.volume);
  EXPECT_EQ(loaded.guard.sweep.max_rotation, defaults.guard.sweep.max_rotation);
  EXPECT_EQ(loaded.limits.hold_time, defaults.limits.hold_time);
  EXPECT_EQ(loaded.limits.pose_timeout, defaults.limits.pose_timeout);
  EXPECT_EQ(loaded.limits.mesh_timeout, defaults.limits.mesh_timeout);
  EXPECT_EQ(loaded.guard.predictor.predictor, defaults.guard.predictor.predictor);
  EXPECT_EQ(loaded.guard.predictor.degree, defaults.guard.predictor.degree);
  EXPECT_EQ(loaded.guard.predictor.constrained, defaults.guard.predictor.constrained);
  EXPECT_EQ(loaded.guard.predictor.forgetting_factor, defaults.guard.predictor.forgetting_factor);
  EXPECT_EQ(loaded.guard.predictor.window, defaults.guard.predictor.window);
  EXPECT_EQ(loaded.guard.predictor.max_speed, defaults.guard.predictor.max_speed);
  EXPECT_EQ(loaded.guard.predictor.max_turn_rate, defaults.guard.predictor.max_turn_rate);
  EXPECT_EQ(loaded.guard.horizon.reflex, defaults.guard.horizon.reflex);
  EXPECT_EQ(loaded.guard.horizon.reflex_step, defaults.guard.horizon.reflex_step);
  EXPECT_EQ(loaded.guard.horizon.considered, defaults.guard.horizon.considered);
  EXPECT_EQ(loaded.guard.horizon.considered_step, defaults.guard.horizon.considered_step);
  EXPECT_EQ(loaded.limits.min_probability, defaults.limits.min_probability);
  EXPECT_EQ(loaded.guard.cycle, defaults.guard.cycle);
  EXPECT_EQ(loaded.marker_rate, defaults.marker_rate);
  EXPECT_EQ(loaded.max_triangles, defaults.max_triangles);
}

TEST_F(ParametersTest, TakeWhatIsSet) {
  node_.setParam("tool/radius", 0.002);
  node_.setParam("tool/length", 1);  // an integer is a number too
  node_.setParam("detector", "reference");
  node_.setParam("volume", "obb");
  node_.setParam("timing/mesh_timeout", INFINITY);
  const Parameters parameters = loadParameters(node_);
  EXPECT_EQ(parameters.tool_radius, 0.002);
  EXPECT_EQ(parameters.tool_length, 1.0);
  EXPECT_EQ(parameters.detector, "reference");
  EXPECT_EQ(parameters.guard.sweep.volume, sweep_guard::VolumeKind::kObb);
  EXPECT_EQ(parameters.limits.mesh_timeout, sweep_guard::Duration::max());
}

TEST_F(ParametersTest, TakeListsOfAxes) {
  node_.setParam("prediction/degree", std::vector<int>{0, 1, 2, 3, 4, 5});
  node_.setParam("prediction/constrained", std::vector<std::string>{"rz", "x"});
  const Parameters parameters = loadParameters(node_);
  EXPECT_EQ(parameters.guard.predictor.degree, (std::array<int, 6>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(parameters.guard.predictor.constrained, (std::array<bool, 6>{true, false, false, false, false, true}));
}

// A prediction has to serve until the next one comes, which is until the pose is stale.
TEST_F(ParametersTest, MakeThePredictionReachAsFarAsThePoseCounts) {
  node_.setParam("timing/pose_timeout", 0.25);
  EXPECT_EQ(loadParameters(node_).guard.horizon.reserve, std::chrono::milliseconds(250));
}

TEST_F(ParametersTest, AreRefusedByNameValueAndRange) {
  const auto refused = [&](const std::string& key, const auto& value, const std::string& expected) {
    node_.setParam(key, value);
    try {
      loadParameters(node_);
      ADD_FAILURE() << key << " is accepted";
    } catch (const sweep_guard::InvalidInput& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("/guarded/" + key), std::string::npos) << message;
      EXPECT_NE(message.find(expected), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
    node_.deleteParam(key);
  };
  refused("fixed_frame", 3, "frame");
  refused("fixed_frame", "", "frame");
  refused("tool_source", "topics", "topic, tf");
  refused("tool/type", "sphere", "cylinder");
  refused("tool/radius", 0.0, "1e-06 to 100");
  refused("tool/radius", -0.01, "-0.01");
  refused("tool/radius", NAN, "1e-06 to 100");
  refused("tool/radius", INFINITY, "1e-06 to 100");
  refused("tool/radius", "1e-2", "a number");  // what YAML makes of 1e-2
  refused("tool/length", true, "a number");
  refused("tool/sides", 2, "3 to 1000");
  refused("tool/sides", 3.5, "an integer");
  refused("volume", "hull", "obb, obb_planes");
  refused("detector", "halfspace", "select, reference");
  refused("cull", 1, "true or false");
  refused("max_rotation_per_sweep", 1.0, "0.01 to 0.5");
  refused("prediction/predictor", "oracle", "constant_velocity");
  refused("prediction/degree", 2, "6 integers from 0 to 5");
  refused("prediction/degree", std::vector<int>(5, 1), "6 integers from 0 to 5");
  refused("prediction/degree", std::vector<int>(6, 6), "6 integers from 0 to 5");
  refused("prediction/degree", std::vector<double>(6, 1.5), "6 integers from 0 to 5");
  refused("prediction/constrained", "rx", "some of x, y, z, rx, ry, rz");
  refused("prediction/constrained", std::vector<std::string>{"roll"}, "some of x, y, z, rx, ry, rz");
  refused("prediction/constrained", std::vector<int>{1}, "some of x, y, z, rx, ry, rz");
  refused("prediction/forgetting_factor", 0.0, "0.01 to 1");
  refused("prediction/forgetting_factor", 1.01, "0.01 to 1");
  refused("prediction/window", NAN, "0.02 to 10");
  refused("horizon/reflex", 0.0, "0.01 to 1");
  refused("horizon/reflex_step", 0.2, "0.001 to 0.1: at most horizon/reflex");
  refused("horizon/considered", 0.1, "0.101 to 5: later than horizon/reflex");
  refused("horizon/considered", INFINITY, "0.101 to 5");
  refused("horizon/considered_step", 0.95, "0.001 to 0.9: at most");
  refused("warning/min_probability", 0.0, "0.001 to 1");
  refused("warning/min_probability", 10, "0.001 to 1");
  refused("warning/hold_time", -0.1, "0 to 60");
  refused("timing/min_rate", 0, "1 to 1000");
  refused("limits/max_speed", -1, "0.001 to 1000");
  refused("limits/max_turn_rate", "fast", "a number");
  refused("timing/pose_timeout", 0.0, "0.01 to 2");
  refused("timing/pose_timeout", INFINITY, "0.01 to 2");
  refused("timing/mesh_timeout", NAN, "0.01 to inf");
  refused("timing/marker_rate", 0, "0.1 to 100");
  refused("limits/max_triangles", 0, "1 to 10000000");
  refused("timing", 3, "a group");
}

// A value can be fine by itself, and out of range for what another key is set to or falls back to.
TEST_F(ParametersTest, AreRefusedWhereTheyContradictEachOther) {
  node_.setParam("horizon/reflex", 1.0);
  try {
    loadParameters(node_);
    ADD_FAILURE() << "a reflex interval as long as the considered one is accepted";
  } catch (const sweep_guard::InvalidInput& error) {
    EXPECT_STREQ(error.what(),
                 "parameter /guarded/horizon/considered is 1, but must be a number from 1.001 to 5: later than "
                 "horizon/reflex");
  }
  node_.setParam("horizon/considered", 2.0);
  EXPECT_EQ(loadParameters(node_).guard.horizon.reflex, std::chrono::seconds(1));
}

TEST_F(ParametersTest, StopTheNodeWithOneLineAndStatusTwo) {
  const std::string node = std::filesystem::read_symlink("/proc/self/exe").replace_filename("sweep_guard_node");
  FILE* run = popen((node + " _tool/radius:=-1 2>&1").c_str(), "r");
  ASSERT_NE(run, nullptr);
  std::string output;
  std::array<char, 256> part{};
  while (std::fgets(part.data(), part.size(), run) != nullptr) output += part.data();
  EXPECT_EQ(WEXITSTATUS(pclose(run)), 2);
  EXPECT_NE(output.find("/sweep_guard/tool/radius is -1"), std::string::npos) << output;
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1) << output;
}

}  // namespace
}  // namespace sweep_guard_ros

int main(int argc, char** argv) {
  ros::init(argc, argv, "parameters_test");
  ros::start();
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
