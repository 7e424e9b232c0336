// Every parameter is read, checked, and refused with one line that names key, value and range.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <set>

#include "refusal.h"
#include "ros/parameters/parameter_changes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {

using sweep_guard_core::deviationsAt;
using sweep_guard_core::fromPlaneProbability;
using sweep_guard_core::PredictionInterval;
using sweep_guard_core::WarningThresholds;

namespace {

class ParametersTest : public ::testing::Test {
 protected:
  void TearDown() override {
    for (const char* const set : {"/guarded", "/sweep_guard", "/robot_description"}) ros::param::del(set);
  }
  ros::NodeHandle node_{"/guarded"};
};

// Returns how far the tool's first piece extends in a direction [m].
double reach(const Parameters& parameters, const Eigen::Vector3d& direction_T) {
  return parameters.tool->pieces().front().shape_T.support(direction_T);
}

// Returns the number of vertices of the first piece's mesh.
size_t corners(const Parameters& parameters) {
  return parameters.tool->pieces().front().shape_T.mesh_T().vertexCount();
}

std::string refusal(const ros::NodeHandle& node) {
  return ::refusal([&] { loadParameters(node); });
}

const std::string kGripper =
    "<robot name='r'><link name='hand'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>"
    "<link name='finger'><collision><geometry><box size='0.02 0.02 0.02'/></geometry></collision></link>"
    "<joint name='opening' type='prismatic'><parent link='hand'/><child link='finger'/><axis xyz='1 0 0'/>"
    "<limit lower='0' upper='0.5' effort='1' velocity='1'/></joint></robot>";

TEST_F(ParametersTest, HaveTheDefaultsOfTheConfigurationFile) {
  const Parameters defaults = loadParameters(node_);
  const Parameters loaded = loadParameters(ros::NodeHandle("/from_file"));
  ASSERT_TRUE(ros::param::has("/from_file/fixed_frame"));
  EXPECT_EQ(loaded.fixed_frame, defaults.fixed_frame);
  EXPECT_EQ(loaded.tool_source, defaults.tool_source);
  EXPECT_EQ(loaded.tool_frame, defaults.tool_frame);
  ASSERT_EQ(loaded.tool->pieces().size(), defaults.tool->pieces().size());
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1)}) {
    EXPECT_EQ(reach(loaded, direction), reach(defaults, direction));
  }
  EXPECT_EQ(corners(loaded), corners(defaults));
  EXPECT_EQ(loaded.detector.name, defaults.detector.name);
  EXPECT_EQ(loaded.detector.options.cull, defaults.detector.options.cull);
  EXPECT_EQ(loaded.detector.options.gl_context, defaults.detector.options.gl_context);
  EXPECT_EQ(loaded.self_test, defaults.self_test);
  EXPECT_EQ(loaded.cross_check, defaults.cross_check);
  EXPECT_EQ(loaded.check_sweep_deadline, defaults.check_sweep_deadline);
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
  EXPECT_EQ(loaded.limits.thresholds.considered_on, defaults.limits.thresholds.considered_on);
  EXPECT_EQ(loaded.limits.thresholds.considered_off, defaults.limits.thresholds.considered_off);
  EXPECT_EQ(loaded.limits.thresholds.reflex, defaults.limits.thresholds.reflex);
  EXPECT_EQ(loaded.guard.cycle, defaults.guard.cycle);
  EXPECT_EQ(loaded.marker_rate, defaults.marker_rate);
  EXPECT_EQ(loaded.max_triangles, defaults.max_triangles);
  for (const ParameterInfo& info : loaded.described) EXPECT_EQ(info.value, info.fallback) << info.key;
}

// A Duration holds 292 years.
TEST_F(ParametersTest, ATimeoutLongerThanADurationNeverEnds) {
  for (const double seconds : {9.3e9, 1e10, 3.2e189}) {
    node_.setParam("timing/mesh_timeout", seconds);
    EXPECT_EQ(loadParameters(node_).limits.mesh_timeout, sweep_guard_core::Duration::max()) << seconds;
  }
  node_.setParam("timing/mesh_timeout", 1e9);
  EXPECT_EQ(loadParameters(node_).limits.mesh_timeout, std::chrono::seconds(1000000000));
}

TEST_F(ParametersTest, HaveTheValuesThatAreSet) {
  node_.setParam("tool/radius", 0.002);
  node_.setParam("tool/length", 1);  // an integer is a number too
  node_.setParam("detector", "reference");
  node_.setParam("volume", "obb");
  node_.setParam("timing/mesh_timeout", INFINITY);
  const Parameters parameters = loadParameters(node_);
  EXPECT_EQ(reach(parameters, Eigen::Vector3d::UnitX()), 0.002);
  EXPECT_EQ(reach(parameters, -Eigen::Vector3d::UnitZ()), 1.0);
  EXPECT_EQ(parameters.detector.name, "reference");
  EXPECT_EQ(parameters.guard.sweep.volume, sweep_guard_core::VolumeKind::kObb);
  EXPECT_EQ(parameters.limits.mesh_timeout, sweep_guard_core::Duration::max());
}

TEST_F(ParametersTest, TakeListsOfAxes) {
  node_.setParam("prediction/degree", std::vector<int>{0, 1, 2, 3, 4, 5});
  node_.setParam("prediction/constrained", std::vector<std::string>{"rz", "x"});
  const Parameters parameters = loadParameters(node_);
  EXPECT_EQ(parameters.guard.predictor.degree, (std::array<int, 6>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(parameters.guard.predictor.constrained, (std::array<bool, 6>{true, false, false, false, false, true}));
}

TEST_F(ParametersTest, PadACylinder) {
  node_.setParam("tool/padding", 0.003);
  const Parameters parameters = loadParameters(node_);
  EXPECT_NEAR(reach(parameters, Eigen::Vector3d::UnitX()), 0.013, 1e-12);
  EXPECT_NEAR(reach(parameters, Eigen::Vector3d::UnitZ()), 0.003, 1e-12);
}

TEST_F(ParametersTest, MakeAToolOfARobot) {
  ros::param::set("/robot_description", kGripper);
  node_.setParam("tool/type", "urdf");
  node_.setParam("tool/links", std::vector<std::string>{"finger"});
  node_.setParam("tool/joints/opening", 0.25);
  node_.setParam("tool_frame", "hand");
  node_.setParam("tool/padding", 0.001);
  EXPECT_NEAR(reach(loadParameters(node_), Eigen::Vector3d::UnitX()), 0.261, 1e-12);
  node_.setParam("tool/joints/opening", 1);
  EXPECT_EQ(
      refusal(node_),
      "no tool from the parameter 'robot_description': tool/joints/opening is 1, beyond the joint's limits, 0 to 0.5");
}

// A command line has no lists.
TEST_F(ParametersTest, TakeAListOfLinksAsText) {
  ros::param::set("/robot_description", kGripper);
  node_.setParam("tool/type", "urdf");
  for (const char* const links : {"hand,finger", "[hand, finger]", "[]", ""}) {
    node_.setParam("tool/links", links);
    EXPECT_EQ(loadParameters(node_).tool->pieces().size(), 2U) << links;
  }
}

XmlRpc::XmlRpcValue pairOf(const std::string& link, const std::string& mesh_id) {
  XmlRpc::XmlRpcValue pair;
  pair["link"] = link;
  pair["mesh_id"] = mesh_id;
  return pair;
}

TEST_F(ParametersTest, TakePairsThatMayTouch) {
  ros::param::set("/robot_description", kGripper);
  node_.setParam("tool/type", "urdf");
  XmlRpc::XmlRpcValue pairs;
  pairs[0] = pairOf("finger", "payload");
  pairs[1] = pairOf("*", "*");
  node_.setParam("tool/allowed", pairs);
  EXPECT_EQ(loadParameters(node_).guard.allowed, (sweep_guard_core::AllowedPairs{{"finger", "payload"}, {"*", "*"}}));
  pairs[1] = pairOf("thumb", "payload");
  node_.setParam("tool/allowed", pairs);
  EXPECT_EQ(refusal(node_),
            "parameter tool/allowed: the tool has no link 'thumb': it has 'finger', 'hand'; '*' means each");
  node_.setParam("tool/type", "cylinder");
  EXPECT_EQ(
      refusal(node_),
      "parameter tool/allowed: the tool has no link 'finger': a cylinder has one link, without a name; '*' means each");
  XmlRpc::XmlRpcValue any;
  any[0] = pairOf("*", "payload");
  node_.setParam("tool/allowed", any);
  EXPECT_EQ(loadParameters(node_).guard.allowed.size(), 1U);
  any[0] = pairOf("*", std::string(129, 'x'));
  node_.setParam("tool/allowed", any);
  EXPECT_TRUE(has(refusal(node_), "is no name of a workpiece"));
}

TEST_F(ParametersTest, RefusePairsThatAreNone) {
  for (const char* const missing : {"link", "mesh_id"}) {
    XmlRpc::XmlRpcValue pairs;
    pairs[0] = pairOf("*", "payload");
    pairs[0][missing] = "";
    node_.setParam("tool/allowed", pairs);
    EXPECT_TRUE(has(refusal(node_), "none of the texts empty")) << missing;
    pairs[0][missing] = 3;
    node_.setParam("tool/allowed", pairs);
    EXPECT_TRUE(has(refusal(node_), "a list of groups {link: TEXT, mesh_id: TEXT}, or []")) << missing;
  }
  XmlRpc::XmlRpcValue pairs;
  pairs[0] = pairOf("*", "payload");
  pairs[0]["depth"] = "1";
  node_.setParam("tool/allowed", pairs);
  EXPECT_TRUE(has(refusal(node_), "a list of groups"));
}

TEST_F(ParametersTest, FindTheRobotUnderAnotherName) {
  node_.setParam("tool/type", "urdf");
  EXPECT_TRUE(has(refusal(node_), "no robot description in the parameter 'robot_description'"));
  node_.setParam("tool/robot_description", "gripper");
  EXPECT_TRUE(has(refusal(node_), "no robot description in the parameter 'gripper'"));
  node_.setParam("gripper", kGripper);
  EXPECT_EQ(loadParameters(node_).tool->pieces().size(), 2U);
  node_.setParam("gripper", 3);
  EXPECT_EQ(refusal(node_), "parameter /guarded/gripper must be a text");
  node_.setParam("tool/robot_description", "the gripper");
  EXPECT_TRUE(has(refusal(node_), "no robot description in the parameter 'the gripper'"));
}

TEST_F(ParametersTest, TakeNumbersAndAxesAsText) {
  node_.setParam("prediction/degree", "[0, 1, 2, 3, 4, 5]");
  node_.setParam("prediction/constrained", "['rz', 'x']");
  const Parameters parameters = loadParameters(node_);
  EXPECT_EQ(parameters.guard.predictor.degree, (std::array<int, 6>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(parameters.guard.predictor.constrained, (std::array<bool, 6>{true, false, false, false, false, true}));
}

TEST_F(ParametersTest, ChangeAsRequestedAndNoOthers) {
  node_.setParam("horizon/reflex", 0.2);
  node_.setParam("tool/radius", 0.02);
  const Parameters before = loadParameters(node_);
  node_.setParam("horizon/reflex", 0.3);  // as somebody else may
  node_.setParam("tool/radius", 0.03);
  const Parameters after =
      changeParameters(node_, before, {{"detector", std::string("reference")}, {"horizon/considered", 2}});
  EXPECT_EQ(after.detector.name, "reference");
  EXPECT_EQ(after.guard.horizon.considered, std::chrono::seconds(2));
  EXPECT_EQ(after.guard.horizon.reflex, std::chrono::milliseconds(200));
  EXPECT_EQ(after.tool, before.tool);
  const std::vector<ParameterChange> changes = differences(before, after);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].key, "detector");
  EXPECT_EQ(shown(changes[0].after), "reference");
  EXPECT_EQ(shown(changes[1].before), "1");
}

TEST_F(ParametersTest, ChangeThePaddingOfARobot) {
  ros::param::set("/robot_description", kGripper);
  node_.setParam("tool/type", "urdf");
  const Parameters before = loadParameters(node_);
  ros::param::del("/robot_description");
  const Parameters after = changeParameters(node_, before, {{"tool/padding", 0.01}});
  EXPECT_NEAR(reach(after, Eigen::Vector3d::UnitX()), reach(before, Eigen::Vector3d::UnitX()) + 0.01, 1e-12);
  EXPECT_EQ(after.tool->pieces().size(), before.tool->pieces().size());
}

TEST_F(ParametersTest, AreNotChangedToValuesThatTheStartRefuses) {
  const Parameters before = loadParameters(node_);
  const auto refused = [&](const std::string& key, const ParameterValue& value, const std::string& expected) {
    const std::string message = ::refusal([&] { changeParameters(node_, before, {{key, value}}); });
    EXPECT_TRUE(has(message, "/guarded/" + key));
    EXPECT_TRUE(has(message, expected));
  };
  refused("tool/padding", -0.1, "0 to 1");
  refused("warning/hold_time", static_cast<double>(NAN), "0 to 60");
  refused("horizon/reflex_step", 0.2, "0.001 to 0.1: at most horizon/reflex");
  refused("volume", std::string("sphere"), "obb, obb_planes, hull");
  refused("cull", 1, "true or false");
  refused("tool/radius", 0.02, "does not change while the guard runs");
  refused("gl_context", std::string("egl"), "does not change while the guard runs");
  refused("nonsense", 1.0, "there is no parameter");
}

// A hand of arm.urdf's kind: the opening moves the finger.
TEST_F(ParametersTest, AToolWhoseJointsMoveNeedsAFrameThatTheyDoNot) {
  ros::param::set("/robot_description", kGripper);
  node_.setParam("tool/type", "urdf");
  node_.setParam("tool/joint_states", true);
  const Parameters moving = loadParameters(node_);
  EXPECT_TRUE(moving.articulated);
  EXPECT_TRUE(has(moving.tool_description, "in the frame of 'hand', joints where joint_states says"));
  EXPECT_EQ(moving.bodies->size(), 2U);
  size_t pieces = 0;
  for (const auto& body : *moving.bodies) {
    for (const auto& piece : body.pieces()) EXPECT_EQ(moving.tool->pieces()[pieces++].link, piece.link);
  }
  EXPECT_EQ(moving.tool->pieces().size(), pieces);
  node_.setParam("tool_frame", "finger");
  EXPECT_TRUE(has(refusal(node_), "no joint moves the tool's links"));
  node_.setParam("tool/links", std::vector<std::string>{"hand", "finger"});
  EXPECT_TRUE(has(refusal(node_), "joints of the tool move its frame"));
}

TEST_F(ParametersTest, JointsOfACylinderDoNotMove) {
  node_.setParam("tool_source", "joint_states");
  EXPECT_TRUE(has(refusal(node_), "tool/type is cylinder: set it to urdf"));
}

TEST_F(ParametersTest, JointsHaveOtherNamesInMessagesIfTheyAreGiven) {
  ros::param::set("/robot_description", kGripper);
  node_.setParam("tool/type", "urdf");
  node_.setParam("tool/joint_states", true);
  node_.setParam("tool/joint_names/outer_opening", "opening");
  EXPECT_EQ(loadParameters(node_).joint_names, (std::map<std::string, std::string>{{"outer_opening", "opening"}}));
  node_.setParam("tool/joint_names/opened", "opening");
  EXPECT_TRUE(has(refusal(node_), "tool/joint_names: 'opened' and 'outer_opening' name one joint"));
  node_.setParam("tool/joint_names/opened", "closing");
  EXPECT_TRUE(has(refusal(node_), "tool/joint_names: no joint 'closing' moves the tool's links"));
}

std::string gripperWithJoint(const std::string& joint) {
  const std::string name = "'opening'";
  return std::string(kGripper).replace(kGripper.find(name), name.size(), "'" + joint + "'");
}

// The parameter server makes a group r1 of the key r1/opening, as of any other.
TEST_F(ParametersTest, NamesOfJointsMayHaveSlashes) {
  node_.setParam("tool/type", "urdf");
  node_.setParam("tool/joint_states", true);
  for (const std::string joint : {"opening", "r1/opening", "cell/r1/opening"}) {
    ros::param::set("/robot_description", gripperWithJoint(joint));
    node_.setParam("tool/joint_names/driver/" + joint, joint);
    node_.setParam("tool/joint_timeouts/" + joint, 0.3);
    const Parameters loaded = loadParameters(node_);
    EXPECT_EQ(loaded.joint_names, (std::map<std::string, std::string>{{"driver/" + joint, joint}}));
    EXPECT_EQ(loaded.joint_timeouts.count(joint), 1U) << joint;
    node_.setParam("tool/joint_names/driver/" + joint, 1);
    EXPECT_TRUE(has(refusal(node_), "tool/joint_names/driver/" + joint + " is 1, but must be a text"));
    node_.deleteParam("tool/joint_names");
    node_.deleteParam("tool/joint_timeouts");
  }
}

TEST_F(ParametersTest, JointsWithSlashesAreHeldWhereTheyAreSet) {
  node_.setParam("tool/type", "urdf");
  node_.setParam("tool/links", std::vector<std::string>{"hand", "finger"});
  for (const std::string joint : {"opening", "r1/opening", "cell/r1/opening"}) {
    ros::param::set("/robot_description", gripperWithJoint(joint));
    node_.setParam("tool/joints/" + joint, 0.3);
    EXPECT_EQ(loadParameters(node_).fixed_joints, (std::map<std::string, double>{{joint, 0.3}}));
    node_.setParam("tool/joints/" + joint, "wide");
    EXPECT_TRUE(has(refusal(node_), "tool/joints/" + joint + " is wide, but must be a finite number"));
    node_.deleteParam("tool/joints");
  }
}

TEST_F(ParametersTest, TheGeometryOfTheToolIsTheOneAskedFor) {
  const std::string ball = "<geometry><sphere radius='0.1'/></geometry>";
  ros::param::set("/robot_description", "<robot name='r'><link name='tool'><collision>" + ball +
                                            "</collision><visual>" + ball +
                                            "</visual></link><link name='tip'><visual>" + ball +
                                            "</visual></link><joint name='j' type='fixed'><parent link='tool'/>"
                                            "<child link='tip'/></joint></robot>");
  node_.setParam("tool/type", "urdf");
  const auto are_visual = [this](const std::string& geometry) {
    node_.setParam("tool/geometry", geometry);
    std::vector<bool> visual;
    for (const LinkShape& shape : loadParameters(node_).link_shapes) visual.push_back(shape.is_visual);
    return visual;
  };
  EXPECT_EQ(are_visual("either"), (std::vector<bool>{false, true}));
  EXPECT_EQ(are_visual("visual"), (std::vector<bool>{true, true}));
  node_.setParam("tool/geometry", "collision");
  EXPECT_TRUE(has(refusal(node_), "link 'tip': it has visual geometry, but no collision"));
}

// YAML's key /left/drill would be a parameter beside the node's.
TEST_F(ParametersTest, IdsMayHaveSlashesAndTheOneAtTheirFrontIsNotWritten) {
  for (const std::string id : {"drill", "left/drill", "left/sweep_guard/open"}) {
    node_.setParam("workpieces/" + id + "/open", true);
    node_.setParam("interaction/stiffness_of/" + id, 1e5);
    const Parameters loaded = loadParameters(node_);
    EXPECT_EQ(loaded.sheets.by_id, (std::map<std::string, bool>{{id, true}, {"/" + id, true}}));
    EXPECT_EQ(loaded.interaction.stiffness_of, (std::map<std::string, double>{{id, 1e5}, {"/" + id, 1e5}}));
    node_.setParam("workpieces/" + id + "/open", 1);
    EXPECT_TRUE(has(refusal(node_), "workpieces/" + id + "/open is 1, but must be true or false"));
    node_.deleteParam("workpieces");
    node_.deleteParam("interaction/stiffness_of");
  }
}

TEST_F(ParametersTest, AWorkpieceHasItsOwnRulesThenThoseOfAllOthersThenTheCommonOne) {
  node_.setParam("timing/mesh_timeout", 1.0);
  XmlRpc::XmlRpcValue rules;  // a name of ROS has no *
  rules["liver"]["timeout"] = 0.2;
  rules["*"]["timeout"] = 3;
  rules["*"]["padding"] = 0.001;
  rules["curtain"]["open"] = true;
  node_.setParam("workpieces", rules);
  const Parameters loaded = loadParameters(node_);
  EXPECT_EQ(loaded.limits.meshTimeout("liver"), std::chrono::milliseconds(200));
  EXPECT_EQ(loaded.limits.meshTimeout("curtain"), std::chrono::seconds(3));
  EXPECT_EQ(*loaded.paddings.of("liver"), 0.001) << "each kind of rule by itself";
  EXPECT_EQ(loaded.sheets.of("liver"), nullptr);
  EXPECT_EQ(loaded.ruled_ids, (std::set<std::string>{"curtain", "liver"}));
  node_.deleteParam("workpieces");
  EXPECT_EQ(loadParameters(node_).limits.meshTimeout("curtain"), std::chrono::seconds(1));
  node_.deleteParam("timing/mesh_timeout");
}

TEST_F(ParametersTest, ARuleOutOfRangeOrOfAnotherNameIsRefusedWithWhatIsWanted) {
  const auto refused = [&](const std::string& entry, const XmlRpc::XmlRpcValue& value, const std::string& wanted) {
    node_.setParam("workpieces/liver/" + entry, value);
    EXPECT_TRUE(has(refusal(node_), "workpieces/liver/" + entry + " is ")) << refusal(node_);
    EXPECT_TRUE(has(refusal(node_), wanted)) << refusal(node_);
    node_.deleteParam("workpieces");
  };
  refused("timeout", 0.0, "but must be [s] a number from 0.01 to inf");
  refused("timeout", "0.2", "'0.2' is a text: YAML wants 0.2, without quotes");
  refused("padding", -0.001, "but must be [m] a number from 0 to 1");
  refused("paddng", 0.001,
          "but must be a group of groups of {open: true or false, padding: [m] a number from 0 to 1, ");
}

TEST_F(ParametersTest, ACameraNeedsAnIdAndATopic) {
  XmlRpc::XmlRpcValue cameras;
  cameras[0]["id"] = "front";
  cameras[0]["depth"] = "/front/depth";
  cameras[0]["timeout"] = 1;
  node_.setParam("cameras", cameras);
  const Parameters loaded = loadParameters(node_);
  ASSERT_EQ(loaded.cameras.size(), 1U);
  EXPECT_EQ(loaded.cameras[0].depth, "/front/depth");
  EXPECT_EQ(loaded.cameras[0].options.farthest, 4.0) << "the default";
  EXPECT_EQ(loaded.limits.meshTimeout("front"), std::chrono::seconds(1));
  EXPECT_EQ(requiredIds(loaded), std::set<std::string>{"front"});
  node_.deleteParam("cameras");
}

TEST_F(ParametersTest, AnEntryOfACameraThatDoesNotFitIsRefusedWithWhatIsWanted) {
  const auto refused = [&](const std::string& entry, const XmlRpc::XmlRpcValue& value, const std::string& wanted) {
    XmlRpc::XmlRpcValue cameras;
    cameras[0]["id"] = "front";
    cameras[0]["depth"] = "/front/depth";
    cameras[0][entry] = value;
    node_.setParam("cameras", cameras);
    EXPECT_TRUE(has(refusal(node_), "/guarded/cameras is ")) << refusal(node_);
    EXPECT_TRUE(has(refusal(node_), wanted)) << refusal(node_);
  };
  XmlRpc::XmlRpcValue pair;
  pair[0] = 2.0;
  refused("range", pair, "must be with range: a list of two numbers");
  pair[1] = 1.0;
  refused("range", pair, "must be with range: [nearest, farthest]");
  refused("id", "", "must be a list of groups that each have id: TEXT, not empty");
  for (const char* const id : {"front left", "front-left", "front/left", "~front"})
    refused("id", id, "must be with ids of at most 128 letters, digits and _");
  refused("depth", 7, "must be a list of groups that each have depth: TEXT, not empty");
  refused("timeout", 0.0, "must be with timeout: [s] a number from 0.01 to 60");
  refused("surface_sped", 1.0, "must be without surface_sped, of which a camera has none");
  XmlRpc::XmlRpcValue twice;
  for (const int i : {0, 1}) {
    twice[i]["id"] = "front";
    twice[i]["depth"] = "/front/depth";
  }
  node_.setParam("cameras", twice);
  EXPECT_TRUE(has(refusal(node_), "must be with each id once")) << refusal(node_);
  node_.deleteParam("cameras");
}

TEST_F(ParametersTest, GroupsWithoutAValueAreRefused) {
  XmlRpc::XmlRpcValue empty;
  empty.begin();  // makes it a group
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"tool/joints", "r1"}, {"tool/joint_names", "cell/r1"}, {"workpieces", "curtain"}};
  for (const auto& [key, name] : cases) {
    node_.setParam(key + "/" + name, empty);
    EXPECT_TRUE(has(refusal(node_), "/guarded/" + key + "/" + name + " is "));
    node_.deleteParam(key);
  }
}

TEST_F(ParametersTest, TheSlowestJointDecidesHowOldAPoseMayBe) {
  ros::param::set("/robot_description", kGripper);
  node_.setParam("tool/type", "urdf");
  node_.setParam("tool/joint_states", true);
  node_.setParam("tool/joint_timeouts/opening", 0.3);
  const Parameters loaded = loadParameters(node_);
  EXPECT_EQ(loaded.limits.pose_timeout, std::chrono::milliseconds(300));
  EXPECT_EQ(loaded.guard.horizon.reserve, std::chrono::milliseconds(300));
  EXPECT_EQ(loaded.joint_timeout, std::chrono::milliseconds(100));
  node_.setParam("tool/joint_timeouts/opening", 3.0);
  EXPECT_TRUE(has(refusal(node_), "/guarded/tool/joint_timeouts/opening"));
  EXPECT_TRUE(has(refusal(node_), "a number from 0.01 to 2"));
  node_.setParam("tool/joint_timeouts/opening", 0.3);
  node_.setParam("tool/joint_timeouts/closing", 0.3);
  EXPECT_TRUE(has(refusal(node_), "no joint 'closing' moves the tool's links"));
}

TEST_F(ParametersTest, TheNameOfANodeIsResolvedInTheNamespaceOfTheNodeThatReadsIt) {
  const auto read = [](const std::string& reader, const std::string& set) {
    const ros::NodeHandle node("/guarded" + reader);
    if (!set.empty()) node.setParam("guard", set);
    return ParameterReader(node).node("guard", "sweep_guard");
  };
  EXPECT_EQ(read("/motion_guard", ""), "/guarded/sweep_guard");
  EXPECT_EQ(read("/arm/motion_guard", ""), "/guarded/arm/sweep_guard");
  EXPECT_EQ(read("/motion_guard", "left/guard"), "/guarded/left/guard");
  EXPECT_EQ(read("/motion_guard", "/sweep_guard"), "/sweep_guard");
  try {
    read("/motion_guard", "a guard");
    FAIL();
  } catch (const sweep_guard_core::InvalidInput& error) {
    EXPECT_TRUE(has(error.what(), "parameter guard has no name of a node")) << error.what();
  }
}

// doc/interface.md and config/sweep_guard.yaml are generated from the descriptions.
TEST_F(ParametersTest, AreAllDescribedWithTheirEffect) {
  const Parameters loaded = loadParameters(node_);
  std::set<std::string> read;
  for (const auto& [key, setting] : loaded.settings) read.insert(key);
  for (const char* const apart : {"diagnostic_period", "robot_description"}) read.erase(apart);
  std::set<std::string> described;
  for (const ParameterInfo& info : loaded.described) {
    if (!info.effect.empty()) described.insert(info.key);
  }
  EXPECT_EQ(described, read);
}

class ThresholdsTest : public ParametersTest {
 protected:
  void expect(double considered_on, double considered_off, double reflex, const Parameters& parameters) {
    EXPECT_EQ(parameters.limits.thresholds.considered_on, considered_on);
    EXPECT_EQ(parameters.limits.thresholds.considered_off, considered_off);
    EXPECT_EQ(parameters.limits.thresholds.reflex, reflex);
  }
};

const double kOn = WarningThresholds{}.considered_on;
const double kOff = WarningThresholds{}.considered_off;
const double kReflex = WarningThresholds{}.reflex;
double considered(double plane) { return fromPlaneProbability(PredictionInterval::kConsidered, plane); }
double reflex(double plane) { return fromPlaneProbability(PredictionInterval::kReflex, plane); }

// The numbers after the keys, in the order of the message.
std::vector<double> valuesIn(const std::string& message) {
  std::vector<double> values;
  for (const char* const key : {"considered_on: ", "considered_off: ", "reflex_probability: "}) {
    const size_t begin = message.find(key);
    EXPECT_NE(begin, std::string::npos) << message;
    if (begin != std::string::npos) values.push_back(std::stod(message.substr(begin + std::strlen(key))));
  }
  return values;
}

TEST_F(ThresholdsTest, TheOldThresholdIsRefusedWithTheThreeThatMeanTheSame) {
  using Values = std::vector<double>;
  expect(kOn, kOff, kReflex, loadParameters(node_));
  for (const double old : {0.3, 0.1, 1.0}) {
    node_.setParam("warning/min_probability", old);
    const std::string message = refusal(node_);
    EXPECT_TRUE(has(message, "warning/min_probability has been replaced by three")) << message;
    EXPECT_EQ(valuesIn(message), (Values{considered(old), considered(old), reflex(old)})) << message;
  }
  node_.setParam("warning/min_probability", 0.1);
  node_.setParam("warning/reflex_probability", 0.2);
  EXPECT_EQ(valuesIn(refusal(node_)), (Values{considered(0.1), considered(0.1), 0.2}));
  node_.setParam("warning/considered_on", 0.005);
  EXPECT_EQ(valuesIn(refusal(node_)), (Values{0.005, 0.005, 0.2}));
  node_.setParam("warning/considered_off", 0.002);
  EXPECT_EQ(valuesIn(refusal(node_)), (Values{0.005, 0.002, 0.2}));
  node_.deleteParam("warning/min_probability");
  expect(0.005, 0.002, 0.2, loadParameters(node_));
}

TEST_F(ThresholdsTest, TheOldThresholdIsUnknownWhileTheGuardRuns) {
  const Parameters before = loadParameters(node_);
  const auto change = [&] { changeParameters(node_, before, {{"warning/min_probability", 0.3}}); };
  EXPECT_TRUE(has(::refusal(change), "there is no parameter"));
}

TEST_F(ThresholdsTest, TheLowerOneFollowsAnUpperOneBelowIt) {
  node_.setParam("warning/considered_on", 0.002);
  const Parameters before = loadParameters(node_);
  expect(0.002, 0.002, kReflex, before);
  expect(0.001, 0.001, kReflex, changeParameters(node_, before, {{"warning/considered_on", 0.001}}));
  node_.setParam("warning/considered_off", 0.06);
  EXPECT_TRUE(has(refusal(node_), "at most warning/considered_on"));
}

TEST_F(ThresholdsTest, ThePredictionFindsWhateverIsWarnedOf) {
  const auto most = [&] { return loadParameters(node_).guard.max_deviations; };
  const double reflex_shown = deviationsAt(PredictionInterval::kReflex, 0.01);
  const double considered_shown = deviationsAt(PredictionInterval::kConsidered, 0.01);
  ASSERT_LT(reflex_shown, considered_shown);
  node_.setParam("warning/considered_off", 0.003);
  EXPECT_EQ(most(), deviationsAt(PredictionInterval::kConsidered, 0.003));
  node_.setParam("warning/considered_off", 0.03);
  EXPECT_EQ(most(), considered_shown);
  node_.setParam("warning/reflex_probability", 0.001);
  EXPECT_EQ(most(), deviationsAt(PredictionInterval::kReflex, 0.001));
}

// A prediction is used until the next one, at most until its pose is stale.
TEST_F(ParametersTest, MakeThePredictionCoverThePoseTimeout) {
  node_.setParam("timing/pose_timeout", 0.25);
  EXPECT_EQ(loadParameters(node_).guard.horizon.reserve, std::chrono::milliseconds(250));
}

TEST_F(ParametersTest, AreRefusedByNameValueAndRange) {
  const auto refused = [&](const std::string& key, const auto& value, const std::string& expected) {
    node_.setParam(key, value);
    std::string message = refusal(node_);
    EXPECT_TRUE(has(message, "/guarded/" + key));
    EXPECT_TRUE(has(message, expected));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    node_.deleteParam(key);
  };
  refused("fixed_frame", 3, "frame");
  refused("fixed_frame", "", "frame");
  refused("tool_source", "topics", "topic, tf");
  refused("tool/type", "sphere", "cylinder, urdf");
  refused("tool/robot_description", "", "a name, not empty");
  refused("tool/links", "hand,,finger", "none of them empty");
  refused("tool/links", true, "a list of texts");
  refused("tool/links", std::vector<int>{1}, "a list of texts");
  refused("tool/links", std::vector<std::string>{""}, "none of them empty");
  refused("tool/allowed", "payload", "a list of groups");
  refused("tool/allowed", true, "a list of groups");
  refused("tool/mesh_roots", 1, "a list of texts");
  refused("tool/mesh_depth", 17, "0 to 16");
  refused("tool/padding", -0.001, "0 to 1");
  refused("tool/padding", NAN, "0 to 1");
  refused("tool/joints", 0.5, "a group of numbers");
  refused("tool/joints/opening", "wide", "a finite number");
  refused("tool/joints/opening", NAN, "a finite number");
  XmlRpc::XmlRpcValue no_ros_name;
  no_ros_name["finger-1"] = "wide";
  refused("tool/joints", no_ros_name, "tool/joints/finger-1");
  refused("tool/joint_states", "joint_states", "true or false");
  refused("tool/joint_timeouts", 0.5, "a group of numbers");
  refused("tool/joint_names", "opening", "a group of texts");
  refused("tool/joint_names/outer", 1, "a text");
  refused("tool/joint_names/outer", "", "not empty");
  refused("tool/geometry", "mesh", "collision, visual, either");
  refused("tool/radius", 0.0, "1e-06 to 100");
  refused("tool/radius", -0.01, "-0.01");
  refused("tool/radius", NAN, "1e-06 to 100");
  refused("tool/radius", INFINITY, "1e-06 to 100");
  refused("tool/radius", "1e-2", "a number");  // what YAML makes of 1e-2
  refused("tool/length", true, "a number");
  refused("tool/sides", 2, "3 to 1000");
  refused("tool/sides", 3.5, "an integer");
  refused("volume", "sphere", "obb, obb_planes, hull");
  refused("detector", "plane", "select, halfspace, reference");
  refused("cull", 1, "true or false");
  refused("gl_context", "glx", "auto, osmesa, egl");
  refused("self_test", false, "a text");  // what YAML makes of off
  refused("self_test", "warn", "unknown, exit, none");
  refused("cross_check", -1, "0 to 1000000");
  refused("check_sweep/deadline", 0.0, "0.01 to 60");
  refused("max_rotation_per_sweep", 1.0, "0.01 to 0.5");
  refused("prediction/predictor", "oracle", "constant_velocity");
  refused("prediction/degree", 2, "6 integers from 0 to 5");
  refused("prediction/degree", std::vector<int>(5, 1), "6 integers from 0 to 5");
  refused("prediction/degree", std::vector<int>(6, 6), "6 integers from 0 to 5");
  refused("prediction/degree", std::vector<double>(6, 1.5), "6 integers from 0 to 5");
  refused("prediction/constrained", "rx, roll", "some of x, y, z, rx, ry, rz");
  refused("prediction/degree", "1, 1, 1, 1, 1, 1.5", "6 integers from 0 to 5");
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
  refused("warning/considered_on", 0.0, "0.001 to 1");
  refused("warning/considered_off", 0.3, "0.001 to 0.065");
  refused("warning/reflex_probability", 1.1, "0.001 to 1");
  refused("warning/hold_time", -0.1, "0 to 60");
  refused("timing/min_rate", 0, "1 to 1000");
  refused("timing/realtime_priority", 100, "0 to 99");
  refused("limits/max_speed", -1, "0.001 to 1000");
  refused("limits/max_turn_rate", "fast", "a number");
  refused("timing/pose_timeout", 0.0, "0.01 to 2");
  refused("timing/pose_timeout", INFINITY, "0.01 to 2");
  refused("timing/mesh_timeout", NAN, "0.01 to inf");
  refused("timing/marker_rate", 0, "0.1 to 100");
  refused("limits/max_triangles", 0, "1 to 10000000");
  refused("timing", 3, "a group");
}

// YAML 1.1 wants a point, and a sign of the exponent.
TEST_F(ParametersTest, ATextThatIsANumberIsRefusedWithTheNumberThatYamlWants) {
  const auto refusalOf = [&](const std::string& key, const auto& value) {
    node_.setParam(key, value);
    std::string message = refusal(node_);
    EXPECT_TRUE(has(message, "/guarded/" + key + " is "));
    node_.deleteParam(key);
    return message;
  };
  EXPECT_TRUE(
      has(refusalOf("tool/radius", "5e-3"), "1e-06 to 100; '5e-3' is a text: YAML wants 5.0e-3, without quotes"));
  EXPECT_TRUE(has(refusalOf("limits/max_speed", "1E3"), "'1E3' is a text: YAML wants 1.0E+3,"));
  EXPECT_TRUE(has(refusalOf("limits/max_speed", "1.5e3"), "'1.5e3' is a text: YAML wants 1.5e+3,"));
  EXPECT_TRUE(has(refusalOf("tool/length", "0.3"), "'0.3' is a text: YAML wants 0.3,"));
  EXPECT_TRUE(has(refusalOf("tool/length", "+.3"), "'+.3' is a text: YAML wants 0.3,"));
  EXPECT_TRUE(has(refusalOf("tool/joints/opening", "-.5e-1"), "'-.5e-1' is a text: YAML wants -0.5e-1,"));
  EXPECT_TRUE(has(refusalOf("timing/mesh_timeout", "inf"), "'inf' is a text: YAML wants .inf,"));
  EXPECT_TRUE(has(refusalOf("tool/mesh_depth", "3"), "0 to 16; '3' is a text: YAML wants 3,"));
  EXPECT_FALSE(has(refusalOf("tool/mesh_depth", "3e0"), "is a text"));
  EXPECT_FALSE(has(refusalOf("tool/radius", "wide"), "is a text"));
  EXPECT_FALSE(has(refusalOf("tool/radius", -1.0), "is a text"));
  EXPECT_FALSE(has(refusalOf("tool/radius", "nan"), "is a text"));
}

// A valid value may be out of range for the value of another key.
TEST_F(ParametersTest, AreRefusedIfTheyContradictEachOther) {
  node_.setParam("horizon/reflex", 1.0);
  EXPECT_EQ(
      refusal(node_),
      "parameter /guarded/horizon/considered is 1, but must be a number from 1.001 to 5: later than horizon/reflex");
  node_.setParam("horizon/considered", 2.0);
  EXPECT_EQ(loadParameters(node_).guard.horizon.reflex, std::chrono::seconds(1));
}

/// Output and exit status of the node.
std::pair<std::string, int> runNode(const std::string& arguments) {
  const std::string node = std::filesystem::read_symlink("/proc/self/exe").replace_filename("sweep_guard_node");
  FILE* run = popen((node + " " + arguments + " 2>&1").c_str(), "r");
  if (run == nullptr) return {"it does not run", -1};
  std::string output;
  std::array<char, 256> part{};
  while (std::fgets(part.data(), part.size(), run) != nullptr) output += part.data();
  return {output, WEXITSTATUS(pclose(run))};
}

TEST_F(ParametersTest, StopTheNodeWithOneLineAndStatusTwo) {
  const auto [output, status] = runNode("_tool/radius:=-1");
  EXPECT_EQ(status, 2);
  EXPECT_TRUE(has(output, "/sweep_guard/tool/radius is -1"));
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1) << output;
}

// The node takes no locale from its environment.
TEST_F(ParametersTest, HaveDecimalPointsInEveryLocale) {
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  const auto [output, status] = runNode("_tool/radius:=-0.5");
  unsetenv("LC_ALL");
  EXPECT_EQ(status, 2);
  EXPECT_TRUE(has(output, "/sweep_guard/tool/radius is -0.5"));
}

// urdfdom and rospack would add lines. log4cxx would show question marks in place of an umlaut.
TEST_F(ParametersTest, StopTheNodeWithOneLineForARobotThatMakesNoTool) {
  const auto robot = [](const std::string& shape) {
    return "<robot name='r'><link name='a'><collision><geometry>" + shape + "</geometry></collision></link></robot>";
  };
  for (const auto& [shape, expected] :
       {std::pair{"<capsule/>", "capsule"},
        {"<mesh filename='package://nowhere/a.stl'/>", "package 'nowhere'"},
        {"<mesh filename='package://nowhere/\xC3\x84rmel.stl'/>", "package://nowhere/\xC3\x84rmel.stl: no package"},
        {"<mesh filename='./100%.stl'/>", "./100%.stl: only package:// and file://"},
        {"<sphere radius='-1'/>", "link 'a': its sphere's radius is -1"}}) {
    ros::param::set("/robot_description", robot(shape));
    const auto [output, status] = runNode("_tool/type:=urdf");
    EXPECT_EQ(status, 2);
    EXPECT_TRUE(has(output, expected));
    EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1) << output;
  }
}

}  // namespace
}  // namespace sweep_guard_ros
