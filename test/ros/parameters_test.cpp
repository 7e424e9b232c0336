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
  EXPECT_EQ(loaded.sweep.volume, defaults.sweep.volume);
  EXPECT_EQ(loaded.sweep.max_rotation, defaults.sweep.max_rotation);
  EXPECT_EQ(loaded.limits.hold_time, defaults.limits.hold_time);
  EXPECT_EQ(loaded.limits.pose_timeout, defaults.limits.pose_timeout);
  EXPECT_EQ(loaded.limits.mesh_timeout, defaults.limits.mesh_timeout);
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
  EXPECT_EQ(parameters.sweep.volume, sweep_guard::VolumeKind::kObb);
  EXPECT_EQ(parameters.limits.mesh_timeout, sweep_guard::Duration::max());
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
  refused("warning/hold_time", -0.1, "0 to 60");
  refused("timing/pose_timeout", 0.0, "0.01 to 2");
  refused("timing/pose_timeout", INFINITY, "0.01 to 2");
  refused("timing/mesh_timeout", NAN, "0.01 to inf");
  refused("timing/marker_rate", 0, "0.1 to 100");
  refused("limits/max_triangles", 0, "1 to 10000000");
  refused("timing", 3, "a group");
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
