// A tool is the complete collision geometry of its links, or it is refused.
#include "ros/tool/tool_model.h"
#include "data_path.h"
#include "refusal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <regex>
#include <set>

#include "ros/package_folder.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using sweep_guard_core::ConvexPiece;
using sweep_guard_core::ConvexShape;
using sweep_guard_core::InvalidInput;

std::string robot(const std::string& body) { return "<robot name='r'>" + body + "</robot>"; }

std::string link(const std::string& name, const std::string& collisions = "") {
  return "<link name='" + name + "'>" + collisions + "</link>";
}

std::string collision(const std::string& shape, const std::string& origin = "") {
  return "<collision>" + origin + "<geometry>" + shape + "</geometry></collision>";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& more = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child + "'/>" +
         more + "</joint>";
}

const std::string kBall = collision("<sphere radius='0.1'/>");

ToolModelOptions toolOf(const std::string& frame, const std::vector<std::string>& links) {
  ToolModelOptions options;
  options.frame = frame;
  options.links = links;
  return options;
}

double support(const std::vector<ConvexPiece>& pieces, const Vector3d& direction) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const ConvexPiece& piece : pieces) largest = std::max(largest, piece.shape_T.support(direction));
  return largest;
}

void expectBox(const std::vector<ConvexPiece>& pieces, const Vector3d& lowest, const Vector3d& highest,
               double tolerance = 1e-9) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(support(pieces, Vector3d::Unit(axis)), highest[axis], tolerance) << "axis " << axis;
    EXPECT_NEAR(-support(pieces, -Vector3d::Unit(axis)), lowest[axis], tolerance) << "axis " << axis;
  }
}

std::string refusal(const std::string& urdf, const ToolModelOptions& options) {
  return ::refusal([&] { loadToolModel(urdf, options); });
}

// Of a robot with one link.
std::vector<ConvexPiece> piecesOf(const std::string& collisions) {
  return loadToolModel(robot(link("a", collisions)), toolOf("a", {})).pieces;
}

TEST(ToolModelTest, PutsPrimitivesWhereTheirOriginsAre) {
  const auto pieces = piecesOf(
      collision("<cylinder radius='0.1' length='0.6'/>", "<origin xyz='1 2 3' rpy='0 1.5707963267948966 0'/>"));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].link, "a");
  expectBox(pieces, {0.7, 1.9, 2.9}, {1.3, 2.1, 3.1});
  expectBox(piecesOf(collision("<box size='0.2 0.4 0.6'/>")), {-0.1, -0.2, -0.3}, {0.1, 0.2, 0.3});
  expectBox(piecesOf(collision("<sphere radius='0.5'/>", "<origin xyz='0 0 1'/>")), {-0.5, -0.5, 0.5}, {0.5, 0.5, 1.5});
}

// A polygon with 32 sides would fall short of the circle by half a per cent.
TEST(ToolModelTest, KeepsCylindersRound) {
  const auto pieces = piecesOf(collision("<cylinder radius='1' length='1'/>"));
  for (double angle = 0.0; angle < 6.3; angle += 0.01) {
    EXPECT_NEAR(support(pieces, Vector3d(std::cos(angle), std::sin(angle), 0.0)), 1.0, 1e-12);
  }
}

TEST(ToolModelTest, TakesEveryCollisionOfEveryLinkListed) {
  const std::string urdf = robot(link("a", kBall + collision("<box size='1 1 1'/>")) + link("b", kBall) +
                                 link("c", kBall) + joint("ab", "fixed", "a", "b", "<origin xyz='0 0 2'/>") +
                                 joint("bc", "fixed", "b", "c", "<origin xyz='0 0 2'/>"));
  const auto pieces = loadToolModel(urdf, toolOf("b", {"a", "b"})).pieces;
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_EQ(pieces[1].link, "a");
  EXPECT_EQ(pieces[2].link, "b");
  expectBox(pieces, {-0.5, -0.5, -2.5}, {0.5, 0.5, 0.1});
}

TEST(ToolModelTest, TakesWhatHangsOnTheToolFrameWhereNoLinkIsListed) {
  const std::string urdf = robot(link("arm", kBall) + link("hand", kBall) + link("tip") + link("finger", kBall) +
                                 joint("wrist", "fixed", "arm", "hand") + joint("mount", "fixed", "hand", "tip") +
                                 joint("knuckle", "fixed", "hand", "finger"));
  std::set<std::string> links;
  for (const ConvexPiece& piece : loadToolModel(urdf, toolOf("hand", {})).pieces) links.insert(piece.link);
  EXPECT_EQ(links, (std::set<std::string>{"finger", "hand"}));
}

// Only the default frame is replaced by the first link.
TEST(ToolModelTest, TakesTheFirstLinkForAToolFrameThatNobodyNamed) {
  const std::string urdf =
      robot(link("a", kBall) + link("b", kBall) + joint("ab", "fixed", "a", "b", "<origin xyz='0 0 2'/>"));
  const ToolModel model = loadToolModel(urdf, toolOf("tool", {"b"}));
  EXPECT_EQ(model.frame, "b");
  expectBox(model.pieces, Vector3d::Constant(-0.1), Vector3d::Constant(0.1));
  EXPECT_TRUE(has(refusal(urdf, toolOf("tol", {"b"})), "tool_frame names 'tol'"));
}

TEST(ToolModelTest, TakesTheRootForAToolFrameThatNobodyNamedIfItIsTold) {
  const std::string urdf =
      robot(link("a") + link("b", kBall) + joint("ab", "fixed", "a", "b", "<origin xyz='0 0 2'/>"));
  ToolModelOptions options = toolOf("tool", {"b"});
  options.of_root = true;
  const ToolModel model = loadToolModel(urdf, options);
  EXPECT_EQ(model.frame, "a");
  expectBox(model.pieces, Vector3d(-0.1, -0.1, 1.9), Vector3d(0.1, 0.1, 2.1));
}

TEST(ToolModelTest, AToolFrameMayHaveThePrefixThatItHasInTf) {
  const std::string urdf = robot(link("a", kBall) + link("b", kBall) + joint("ab", "fixed", "a", "b"));
  EXPECT_EQ(loadToolModel(urdf, toolOf("robot1/a", {"b"})).frame, "a");
  EXPECT_EQ(loadToolModel(urdf, toolOf("/cell/robot1/b", {"b"})).frame, "b");
  EXPECT_EQ(loadToolModel(urdf, toolOf("robot1/tool", {"b"})).frame, "b");
  EXPECT_TRUE(has(refusal(urdf, toolOf("robot1/c", {"b"})),
                  "tool_frame names 'robot1/c', which is not a link of the robot, nor is 'c'; its links are a, b"));
}

TEST(ToolModelTest, HoldsJointsWhereTheyAreSet) {
  const std::string urdf = robot(link("a", kBall) + link("b") + link("c", kBall) +
                                 joint("turn", "revolute", "a", "b",
                                       "<origin xyz='1 0 0'/><axis xyz='0 0 2'/>"
                                       "<limit lower='-2' upper='2' effort='1' velocity='1'/>") +
                                 joint("slide", "prismatic", "b", "c",
                                       "<axis xyz='1 0 0'/><limit lower='0.5' upper='3' effort='1' velocity='1'/>"));
  ToolModelOptions options = toolOf("a", {"c"});
  expectBox(loadToolModel(urdf, options).pieces, {1.4, -0.1, -0.1}, {1.6, 0.1, 0.1});  // 0 is below the slide's limits
  options.joints = {{"turn", M_PI / 2}, {"slide", 2.0}};
  const ToolModel model = loadToolModel(urdf, options);
  expectBox(model.pieces, {0.9, 1.9, -0.1}, {1.1, 2.1, 0.1});
  EXPECT_EQ(model.joints, options.joints);
  options.joints = {{"slide", 3.5}};
  EXPECT_TRUE(has(refusal(urdf, options), "tool/joints/slide is 3.5, beyond the joint's limits, 0.5 to 3"));
  options.joints = {{"slid", 1.0}};
  EXPECT_TRUE(has(refusal(urdf, options), "names 'slid', which is not a joint"));
}

TEST(ToolModelTest, ClosesBothFingersOfAGripper) {
  const std::string limit = "<limit lower='0' upper='0.04' effort='1' velocity='1'/>";
  const std::string urdf =
      robot(link("hand", kBall) + link("left", kBall) + link("right", kBall) +
            joint("l", "prismatic", "hand", "left", "<axis xyz='0 1 0'/>" + limit) +
            joint("r", "prismatic", "hand", "right",
                  "<axis xyz='0 -1 0'/>" + limit + "<mimic joint='l' multiplier='2' offset='0.01'/>"));
  ToolModelOptions options = toolOf("hand", {"left", "right"});
  options.joints = {{"l", 0.04}};
  expectBox(loadToolModel(urdf, options).pieces, {-0.1, -0.19, -0.1}, {0.1, 0.14, 0.1});
  options.joints = {{"r", 0.01}};
  EXPECT_TRUE(has(refusal(urdf, options), "mimics 'l'"));
}

TEST(ToolModelTest, JointsThatMimicEachOtherAreRefusedByTheirNames) {
  const std::string limit = "<limit lower='0' upper='0.05' velocity='1' effort='1'/>";
  const auto refusalOf = [&](const std::vector<std::pair<std::string, std::string>>& mimics) {
    std::string elements = link("hand", kBall);
    for (const auto& [name, leader] : mimics) {
      elements += link(name + "_link", kBall) +
                  joint(name, "prismatic", "hand", name + "_link", limit + "<mimic joint='" + leader + "'/>");
    }
    return refusal(robot(elements), toolOf("hand", {mimics.front().first + "_link"}));
  };
  EXPECT_TRUE(has(refusalOf({{"knuckle", "tip"}, {"tip", "knuckle"}}), "joints 'knuckle' and 'tip' mimic each other"));
  EXPECT_TRUE(has(refusalOf({{"a", "b"}, {"b", "c"}, {"c", "b"}}), "joints 'b' and 'c' mimic each other"));
  EXPECT_TRUE(has(refusalOf({{"a", "b"}, {"b", "c"}, {"c", "a"}}), "joints 'a', 'b' and 'c' mimic each other"));
  EXPECT_TRUE(has(refusalOf({{"a", "a"}}), "joint 'a' mimics itself"));
  EXPECT_TRUE(has(refusalOf({{"a", "none"}}), "joint 'a' mimics 'none', which does not exist"));
}

// A crank leads a rod, which leads a finger; a sensor mimics the crank, and nothing that is right.
TEST(ToolModelTest, KnowsTheJointsBetweenAFollowerAndWhatItFollows) {
  const std::string limits = "<axis xyz='0 0 1'/><limit lower='0' upper='1' effort='1' velocity='1'/>";
  const auto mimic = [&](const std::string& leader, const std::string& how) {
    return limits + "<mimic joint='" + leader + "' " + how + "/>";
  };
  const std::string urdf =
      robot(link("hand") + link("crank_link") + link("rod_link") + link("finger_link", kBall) + link("sensor_link") +
            link("loop_link") + link("lost_link") + joint("crank", "prismatic", "hand", "crank_link", limits) +
            joint("rod", "prismatic", "hand", "rod_link", mimic("crank", "multiplier='2' offset='0.125'")) +
            joint("finger", "prismatic", "hand", "finger_link", mimic("rod", "multiplier='-3'")) +
            joint("sensor", "revolute", "hand", "sensor_link", mimic("crank", "offset='1'")) +
            joint("loop", "revolute", "hand", "loop_link", mimic("loop", "")) +
            joint("lost", "revolute", "hand", "lost_link", mimic("none", "")));
  ToolModelOptions options = toolOf("hand", {"finger_link"});
  const auto model = loadToolModel(urdf, options).robot;
  std::map<std::string, double> positions;
  for (const auto& [name, joint] : model->robot.tree.mimics()) positions[name] = joint.at({0.5});
  EXPECT_EQ(positions, (std::map<std::string, double>{{"rod", 1.125}, {"finger", -3.375}, {"sensor", 1.5}}));
  EXPECT_EQ(model->beside.elsewhere, (std::set<std::string>{"loop", "lost"}));
  for (const std::string name : {"rod", "finger", "sensor"}) {
    options.joints = {{name, 0.1}};
    EXPECT_EQ(refusal(urdf, options), "joint '" + name + "' mimics 'crank': set that joint in tool/joints");
  }
}

// A joint above the tool moves the whole tool.
// A lift carries a torso, which carries a head, a crank that the lift mimics, and a hand, the tool.
TEST(ToolModelTest, KnowsWhatTheOtherJointsOfTheRobotMove) {
  const std::string limits = "<axis xyz='0 0 1'/><limit lower='0' upper='1' effort='1' velocity='1'/>";
  const std::string urdf =
      robot(link("base") + link("torso") + link("head") + link("crank") + link("hand", kBall) + link("finger", kBall) +
            joint("lift", "prismatic", "base", "torso", limits + "<mimic joint='turn'/>") +
            joint("pan", "revolute", "torso", "head", limits) + joint("turn", "revolute", "base", "crank", limits) +
            joint("wrist", "revolute", "torso", "hand", limits) + joint("grip", "prismatic", "hand", "finger", limits));
  const auto beside = [&](const std::string& frame, const std::vector<std::string>& links) {
    return loadToolModel(urdf, toolOf(frame, links)).robot->beside;
  };
  using Names = std::set<std::string>;
  EXPECT_EQ(beside("torso", {"hand", "finger"}).of_frame, (Names{"lift", "turn"}));
  EXPECT_EQ(beside("torso", {"hand", "finger"}).elsewhere, Names{"pan"});
  EXPECT_EQ(beside("hand", {"hand", "finger"}).of_frame, (Names{"lift", "turn", "wrist"}));
  EXPECT_EQ(beside("base", {"hand"}).of_frame, Names{});
  EXPECT_EQ(beside("base", {"hand"}).elsewhere, (Names{"grip", "pan"}));
}

TEST(ToolModelTest, LeavesOutJointsThatMoveTheToolAsAWhole) {
  const std::string urdf = robot(link("base", kBall) + link("hand", kBall) + link("tip") +
                                 joint("float", "floating", "base", "hand") + joint("mount", "fixed", "hand", "tip"));
  EXPECT_TRUE(loadToolModel(urdf, toolOf("tip", {"hand"})).joints.empty());
  EXPECT_TRUE(has(refusal(urdf, toolOf("tip", {"base"})), "joint 'float'"));
}

TEST(ToolModelTest, MakesHullsOfMeshesToScale) {
  const PackageFolder folder;
  folder.write("robot/t.obj", tetrahedronObj());
  const auto tool = [](const std::string& scale) {
    return piecesOf(collision("<mesh filename='package://robot/t.obj' scale='" + scale + "'/>"));
  };
  expectBox(tool("1 1 1"), {0, 0, 0}, {1, 1, 1});
  expectBox(tool("0.1 2 -3"), {0, 0, -3}, {0.1, 2, 0});
  EXPECT_NEAR(support(tool("1 1 1"), Vector3d(1, 1, 1).normalized()), 1.0 / std::sqrt(3.0), 1e-9);
}

std::string visual(const std::string& shape, const std::string& origin = "") {
  return "<visual>" + origin + "<geometry>" + shape + "</geometry></visual>";
}

// A base with both kinds of geometry, a tip with collision geometry only, a shaft with visual geometry only.
class VisualGeometryTest : public testing::Test {
 protected:
  static std::vector<std::string> shapesOf(const std::vector<std::string>& links, LinkGeometry geometry) {
    ToolModelOptions options = toolOf("base", links);
    options.geometry = geometry;
    std::vector<std::string> shapes;
    for (const auto& [link, is_visual, pieces] : loadToolModel(kUrdf, options).shapes)
      shapes.push_back(link + (is_visual ? ": visual " : ": collision ") + std::to_string(pieces));
    return shapes;
  }
  static std::string refusalOf(const std::vector<std::string>& links, LinkGeometry geometry) {
    return ::refusal([&] { shapesOf(links, geometry); });
  }

  static const std::string kUrdf;
};

const std::string VisualGeometryTest::kUrdf =
    robot(link("base", kBall + visual("<box size='1 1 1'/>") + visual("<sphere radius='1'/>")) +
          link("shaft", visual("<cylinder radius='0.1' length='0.6'/>", "<origin xyz='0 0 1'/>")) + link("tip", kBall) +
          joint("mount", "fixed", "base", "shaft") + joint("end", "fixed", "shaft", "tip"));

using Shapes = std::vector<std::string>;

TEST_F(VisualGeometryTest, StandsInWhereALinkHasNoCollisionGeometry) {
  EXPECT_EQ(shapesOf({"base", "shaft", "tip"}, LinkGeometry::kEither),
            (Shapes{"base: collision 1", "shaft: visual 1", "tip: collision 1"}));
  EXPECT_EQ(shapesOf({"base", "shaft"}, LinkGeometry::kVisual), (Shapes{"base: visual 2", "shaft: visual 1"}));
  EXPECT_EQ(shapesOf({"base", "tip"}, LinkGeometry::kCollision), (Shapes{"base: collision 1", "tip: collision 1"}));
}

TEST_F(VisualGeometryTest, IsWhereItsOriginIs) {
  ToolModelOptions options = toolOf("base", {"shaft"});
  options.geometry = LinkGeometry::kEither;
  options.padding = 0.01;
  expectBox(loadToolModel(kUrdf, options).pieces, {-0.11, -0.11, 0.69}, {0.11, 0.11, 1.31});
}

TEST_F(VisualGeometryTest, ALinkWithoutTheGeometryAskedForIsRefusedWithTheWayOut) {
  EXPECT_EQ(
      refusalOf({"base", "shaft"}, LinkGeometry::kCollision),
      "link 'shaft': it has visual geometry, but no collision; set tool/geometry to either, add a <collision>, or list "
      "only links with one in tool/links");
  EXPECT_TRUE(has(refusalOf({"base", "tip"}, LinkGeometry::kVisual),
                  "link 'tip': it has collision geometry, but no visual; set tool/geometry to either, add a <visual>"));
  ToolModelOptions options = toolOf("a", {"a"});
  options.geometry = LinkGeometry::kEither;
  EXPECT_TRUE(has(refusal(robot(link("a")), options), "link 'a': it has no geometry; add a <"));
}

TEST_F(VisualGeometryTest, ALinkThatIsAPointIsLeftOutUnlessItIsListed) {
  const std::string urdf =
      robot(link("a", kBall) + link("b", visual("<box size='0 0 0'/>")) + link("c", visual("<sphere radius='1'/>")) +
            joint("ab", "fixed", "a", "b") + joint("bc", "fixed", "b", "c"));
  ToolModelOptions options = toolOf("a", {});
  options.geometry = LinkGeometry::kEither;
  const auto shapes = loadToolModel(urdf, options).shapes;
  ASSERT_EQ(shapes.size(), 2U);
  EXPECT_EQ(shapes[0].link, "a");
  EXPECT_EQ(shapes[1].link, "c");
  options.links = {"a", "b"};
  EXPECT_TRUE(has(refusal(urdf, options), "link 'b': its box's size in x is 0 m"));
}

// The first two are read by urdfdom as far as they go, the others not at all.
const std::vector<std::string> kBadShapes = {"<sphere radius='0.1'/><sphere radius='2'/>",
                                             "<sphere radius='0.1'/></geometry><geometry><box size='1 1 1'/>",
                                             "<capsule radius='1' length='1'/>",
                                             "<sphere radius='wide'/>",
                                             "<mesh scale='1 1 1'/>",
                                             ""};

ToolModelOptions optionsOf(const std::vector<std::string>& links, LinkGeometry geometry) {
  ToolModelOptions options = toolOf("a", links);
  options.geometry = geometry;
  return options;
}

TEST_F(VisualGeometryTest, GeometryThatIsNotUsedStopsNothing) {
  const std::string good_visual = visual("<sphere radius='0.1'/>");
  const std::string bad_color =
      "<visual><geometry><sphere radius='1'/></geometry><material name='grey'><color rgba='1 1'/></material></visual>";
  for (const std::string& shape : kBadShapes) {
    SCOPED_TRACE(shape);
    const std::string of_visual = robot(link("a", kBall + visual(shape) + bad_color));
    EXPECT_EQ(refusal(of_visual, optionsOf({}, LinkGeometry::kCollision)), "");
    EXPECT_EQ(refusal(of_visual, optionsOf({}, LinkGeometry::kEither)), "");
    const std::string of_collision = robot(link("a", collision(shape) + good_visual));
    EXPECT_EQ(refusal(of_collision, optionsOf({}, LinkGeometry::kVisual)), "");
  }
}

TEST_F(VisualGeometryTest, GeometryThatIsUsedIsChecked) {
  for (const std::string& shape : kBadShapes) {
    SCOPED_TRACE(shape);
    const std::string of_visual = robot(link("a", visual(shape)));
    EXPECT_NE(refusal(of_visual, optionsOf({}, LinkGeometry::kVisual)), "");
    EXPECT_NE(refusal(of_visual, optionsOf({}, LinkGeometry::kEither)), "");
    const std::string of_collision = robot(link("a", collision(shape) + visual("<sphere radius='0.1'/>")));
    EXPECT_NE(refusal(of_collision, optionsOf({}, LinkGeometry::kCollision)), "");
    EXPECT_NE(refusal(of_collision, optionsOf({}, LinkGeometry::kEither)), "");
  }
}

TEST_F(VisualGeometryTest, SeveralGeometriesStopOnlyWhereTheLinkIsOfTheTool) {
  for (const std::string& shape : {kBadShapes[0], kBadShapes[1]}) {
    for (const LinkGeometry geometry : {LinkGeometry::kCollision, LinkGeometry::kEither, LinkGeometry::kVisual}) {
      const bool visible = geometry == LinkGeometry::kVisual;
      const std::string urdf =
          robot(link("a", kBall + visual("<sphere radius='1'/>")) +
                link("b", visible ? visual(shape) : collision(shape)) + joint("ab", "fixed", "a", "b"));
      EXPECT_EQ(refusal(urdf, optionsOf({"a"}, geometry)), "");
      EXPECT_EQ(refusal(urdf, optionsOf({"a", "b"}, geometry)),
                std::string("link 'b': a ") + (visible ? "visual" : "collision") +
                    " must have one geometry of one shape; give each shape its own");
    }
  }
}

// Where the first visual is left out with its material, urdfdom would not know the color of the second one.
TEST_F(VisualGeometryTest, ColorsDoNotMatter) {
  const auto colored = [](const std::string& material) {
    return "<visual><geometry><sphere radius='0.1'/></geometry><material " + material + "</visual>";
  };
  const std::string defined = "name='grey'><color rgba='1 1 1 1'/></material>";
  for (const std::string material :
       {"name='grey'/>", "name='nowhere'/>", "name='red'><color rgba='1 0'/></material>"}) {
    const std::string urdf =
        robot(link("a", kBall + colored(defined)) + link("b", colored(material)) + joint("ab", "fixed", "a", "b"));
    EXPECT_EQ(refusal(urdf, optionsOf({}, LinkGeometry::kEither)), "") << material;
  }
}

// urdfdom would take the box of size 0 alone.
TEST_F(VisualGeometryTest, ALinkIsNotTakenForAPointByTheFirstOfItsShapes) {
  for (const std::string shape : {"<box size='0 0 0'/><sphere radius='1'/>", "<box size='0 0 0.1'/>", "<box/>"}) {
    const std::string urdf = robot(link("a", kBall) + link("b", visual(shape)) + joint("ab", "fixed", "a", "b"));
    EXPECT_TRUE(has(refusal(urdf, optionsOf({}, LinkGeometry::kCollision)),
                    "link 'b': it has visual geometry, but no collision"));
    EXPECT_NE(refusal(urdf, optionsOf({}, LinkGeometry::kEither)), "");
  }
}

TEST(ToolModelTest, GrowsEveryPieceByThePadding) {
  ToolModelOptions options = toolOf("a", {});
  options.padding = 0.05;
  const std::string urdf = robot(link("a", kBall + collision("<box size='1 1 1'/>", "<origin xyz='2 0 0'/>")));
  expectBox(loadToolModel(urdf, options).pieces, {-0.15, -0.55, -0.55}, {2.55, 0.55, 0.55});
}

struct Bad {
  std::string urdf;
  std::string expected;
};

TEST(ToolModelTest, RefusesBadDescriptionsInOneLine) {
  const PackageFolder folder;
  folder.write("robot/flat.obj", "v 0 0 0\n");
  const auto mesh = [](const std::string& attributes) {
    return robot(link("a", collision("<mesh " + attributes + "/>")));
  };
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<e>";
  const std::vector<Bad> cases = {
      {"", "not XML"},
      {"<robot name='r'><link name='a'>", "not XML"},
      {deep, "not XML"},
      {"<sdf/>", "no element <robot>"},
      {std::string(size_t{9} << 20U, ' '), "larger than 8 MiB"},
      {robot(""), "not a URDF"},
      {"<robot>" + link("a", kBall) + "</robot>", "name"},
      {robot(link("a", kBall) + link("a", kBall)), "'a' is not unique"},
      {robot(link("a", kBall) + link("b", kBall)), "wo root links"},
      {robot(link("a", kBall) + joint("j", "fixed", "a", "b")), "[b]"},
      {robot(link("a", kBall) + link("b") + joint("j", "bent", "a", "b")), "bent"},
      {robot(link("a", kBall) + link("b") + link("c") + joint("j", "fixed", "a", "b") + joint("k", "fixed", "c", "b")),
       "root"},
      {robot(link("a", kBall) + link("b") + joint("j", "fixed", "a", "b") + joint("k", "fixed", "a", "b")),
       "child of two joints"},
      {robot(link("a")), "link 'a' and the links below it have no shape"},
      {robot(link("a", "<visual><geometry><sphere radius='1'/></geometry></visual>")),
       "link 'a': it has visual geometry, but no collision"},
      {robot(link("a", "<collision/>")), "link 'a'"},
      {robot(link("a", "<collision><geometry><sphere radius='1'/><sphere radius='2'/></geometry></collision>")),
       "link 'a': a collision must have one geometry"},
      {robot(link("a", collision("<capsule radius='1' length='1'/>"))), "capsule"},
      {robot(link("a", collision("<sphere radius='-1'/>"))), "link 'a': its sphere's radius is -1"},
      {robot(link("a", collision("<sphere radius='wide'/>"))), "Link [a]"},
      {robot(link("a", collision("<sphere radius='nan'/>"))), "nan"},
      {robot(link("a", collision("<sphere radius='%n%s%s%s%s%s%s'/>"))), "radius"},  // a format of printf()
      {robot(link("a", collision("<&#37;n&#37;s/>"))), "not XML"},
      {robot(link("&#37;n%s%s%s%s%s%s", collision("<sphere radius='wide'/>"))), "wide"},
      {robot(link("a", collision("<box size='1 0 1'/>"))), "link 'a': its box's size in y is 0"},
      {robot(link("a", collision("<box size='1 1'/>"))), "3 expected"},
      {robot(link("a", collision("<cylinder radius='1' length='1e9'/>"))), "link 'a': its cylinder's length is 1e+09"},
      {robot(link("a", collision("<sphere radius='1'/>", "<origin xyz='1e300 0 0'/>"))), "link 'a': it reaches"},
      {mesh("filename='package://robot/missing.stl'"), "link 'a': package://robot/missing.stl: no such file"},
      {mesh("filename='package://missing/a.stl'"), "link 'a': package://missing/a.stl: no package"},
      {mesh("filename='package://robot/../../../../etc/passwd'"), "leads out of the package"},
      {mesh("filename='http://example.org/a.stl'"), "only package:// and file://"},
      {mesh("filename='package://robot/flat.obj'"), "robot/flat.obj: cannot be read: OBJ-file is too small"},
      {mesh("filename='package://robot/flat.obj' scale='0 1 1'"), "scale must not be 0"},
      {mesh("scale='1 1 1'"), "filename"},
  };
  for (const Bad& bad : cases) {
    const std::string message = refusal(bad.urdf, toolOf("tool", {}));
    EXPECT_NE(message, "") << bad.urdf << " is accepted";
    EXPECT_TRUE(has(message, bad.expected)) << bad.urdf.substr(0, 200) << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(message.size(), 500U) << message;
  }
}

// urdfdom passes over <xacro:gripper>, and the gripper would be missing from the tool.
TEST(ToolModelTest, RefusesAFileForXacroByWhatXacroWouldReplace) {
  const std::string flange = link("flange", kBall);
  const std::vector<Bad> cases = {
      {robot(flange + "<xacro:gripper parent='flange'/>"), "<xacro:gripper>"},
      {robot("<xacro:include filename='$(find gripper)/gripper.xacro'/>" + flange), "<xacro:include>"},
      {robot(link("flange", kBall + "<visual><xacro:insert_block name='shape'/></visual>")), "<xacro:insert_block>"},
      {robot(flange + "<gazebo><xacro:if value='1'/></gazebo>"), "<xacro:if>"},
      {robot("<link name='flange' xacro:if='1'>" + kBall + "</link>"), "xacro:if=\"1\" in <link>"},
      {robot(link("flange", collision("<box size='${width} 1 1'/>"))), "size=\"${width} 1 1\" in <box>"},
      {robot(link("${prefix}flange", kBall)), "name=\"${prefix}flange\" in <link>"},
      {"<robot name='$(arg name)'>" + flange + "</robot>", "name=\"$(arg name)\" in <robot>"},
      {robot(link("flange", collision("<mesh filename='$(find drill)/drill.stl'/>"))),
       "filename=\"$(find drill)/drill.stl\" in <mesh>"},
  };
  for (const Bad& bad : cases) {
    const std::string message = refusal(bad.urdf, toolOf("flange", {}));
    EXPECT_TRUE(has(message, "it is a xacro file, with " + bad.expected));
    EXPECT_TRUE(has(message, "run `xacro FILE > robot.urdf` first"));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(message.size(), 500U) << message;
  }
}

TEST(ToolModelTest, TakesWhatXacroHasWritten) {
  const std::string start = "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>";
  const std::string comment =
      "<!-- autogenerated by xacro from flange.xacro --><!-- <xacro:gripper width='${width}'/> -->";
  for (const std::string& more :
       {std::string(), comment, std::string("<gazebo reference='flange'><plugin path='$(HOME)/${name}'/></gazebo>"),
        link("xacro_cup") + joint("xacro", "fixed", "flange", "xacro_cup"),
        link("cup$") + joint("j", "fixed", "flange", "cup$")}) {
    const std::string urdf = start + link("flange", kBall) + more + "</robot>";
    EXPECT_EQ(loadToolModel(urdf, toolOf("flange", {})).pieces.size(), 1U) << urdf;
  }
}

// Each of them grows by three bytes. To move the rest for each took 31 s for a mebibyte of them.
TEST(ToolModelTest, ReadsADescriptionFullOfPercentSigns) {
  const std::string note = "<note text='" + std::string(size_t{7} << 20U, '%') + "'/>";
  EXPECT_EQ(loadToolModel(robot(link("a", kBall) + note), toolOf("a", {})).pieces.size(), 1U);
}

// urdfdom takes them for the formats of printf().
TEST(ToolModelTest, KeepsPercentSignsInNames) {
  const PackageFolder folder;
  const std::string wide = "\xEF\xBC\x85";         // another sign, of full width
  const std::string private_use = "\xEE\x80\x80";  // U+E000
  for (const std::string& sign : std::vector<std::string>{"%", "%25", "%s", wide, private_use, private_use + "0%"}) {
    SCOPED_TRACE(sign);
    const std::string file = "robot/100" + sign + ".obj";
    const std::string urdf =
        robot(link("a" + sign) + link("b", collision("<mesh filename='package://" + file + "'/>")) +
              joint("j" + sign, "revolute", "a" + sign, "b",
                    "<axis xyz='0 0 1'/><limit lower='-4' upper='4' effort='1' velocity='1'/>"));
    ToolModelOptions options = toolOf("a" + sign, {"b"});
    EXPECT_TRUE(has(refusal(urdf, options), "package://" + file + ": no such file"));
    folder.write(file == "robot/100%25.obj" ? "robot/100%.obj" : file, tetrahedronObj());
    options.joints = {{"j" + sign, M_PI}};
    const ToolModel model = loadToolModel(urdf, options);
    expectBox(model.pieces, {-1, -1, 0}, {0, 0, 1});
    EXPECT_EQ(model.frame, "a" + sign);
    EXPECT_EQ(model.joints, options.joints);
    fs::remove(folder.path() / "robot/100%.obj");
  }
}

// They would be below no link, and so left out of every tool.
TEST(ToolModelTest, RefusesLinksInALoopOfJoints) {
  const std::string itself = robot(link("a", kBall) + link("b", kBall) + joint("bb", "fixed", "b", "b"));
  EXPECT_TRUE(has(refusal(itself, toolOf("a", {})), "link 'b' is not connected to the root link 'a'"));
  const std::string each_other = robot(link("a", kBall) + link("b", kBall) + link("c", kBall) +
                                       joint("bc", "fixed", "b", "c") + joint("cb", "fixed", "c", "b"));
  EXPECT_TRUE(has(refusal(each_other, toolOf("a", {})), "is not connected to the root link 'a'"));
}

TEST(ToolModelTest, RefusesLinksThatAreNone) {
  const std::string urdf = robot(link("a", kBall) + link("b") + joint("ab", "fixed", "a", "b"));
  EXPECT_TRUE(has(refusal(urdf, toolOf("tool", {"c"})), "'c', which is not a link of the robot; its links are a, b"));
  EXPECT_TRUE(has(refusal(urdf, toolOf("tool", {"a", "a"})), "twice"));
  EXPECT_TRUE(has(refusal(urdf, toolOf("tool", {"b"})), "link 'b': it has no geometry"));
}

// Robots made by others.
class RealRobotTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = dataPath("urdf");
    if (!fs::exists(folder_)) GTEST_SKIP() << missing(folder_);
    PackageFolder::setPackagePath(folder_.string());
  }

  std::string read(const std::string& name) const {
    std::ifstream file(folder_ / "expanded" / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  PackageFolder restored_;
  fs::path folder_;
};

TEST_F(RealRobotTest, FrankaHandIsAMeshAndTwoFingersOfFourBoxes) {
  ToolModelOptions options = toolOf("panda_hand_tcp", {"panda_hand", "panda_leftfinger", "panda_rightfinger"});
  const ToolModel closed = loadToolModel(read("franka_hand.urdf"), options);
  EXPECT_EQ(closed.pieces.size(), 9U);
  EXPECT_EQ(closed.joints.at("panda_finger_joint1"), 0.0);
  EXPECT_NEAR(support(closed.pieces, Vector3d::UnitZ()), 0.0584 + 0.04525 + 0.00925 - 0.1034, 1e-9);
  options.joints["panda_finger_joint1"] = 0.04;
  const ToolModel open = loadToolModel(read("franka_hand.urdf"), options);
  const auto fingers = [](const ToolModel& model) {
    return std::vector<ConvexPiece>(model.pieces.begin() + 1, model.pieces.end());
  };
  for (const Vector3d& side : {Vector3d(Vector3d::UnitY()), Vector3d(-Vector3d::UnitY())}) {
    EXPECT_NEAR(support(fingers(open), side), support(fingers(closed), side) + 0.04, 1e-9);
  }
}

TEST_F(RealRobotTest, EveryCompleteRobotLoads) {
  const struct {
    std::string file;
    std::string frame;
    std::vector<std::string> links;
    size_t pieces;
    double extent;  // [m], roughly
  } cases[] = {
      {"franka_hand.urdf", "panda_hand", {}, 15, 0.2},
      {"panda_with_hand.urdf", "panda_link8", {"panda_link5", "panda_link6", "panda_link7", "panda_hand"}, 4, 0.5},
      {"ur5.urdf", "tool0", {"forearm_link", "wrist_1_link", "wrist_2_link", "wrist_3_link"}, 4, 0.6},
      {"ur5.urdf", "base_link", {}, 7, 1.2},
      {"costar_drill.urdf", "drill", {"drill"}, 1, 0.3},
  };
  for (const auto& one : cases) {
    ToolModelOptions options = toolOf(one.frame, one.links);
    options.mesh_depth = 0;
    const ToolModel model = loadToolModel(read(one.file), options);
    EXPECT_EQ(model.pieces.size(), one.pieces) << one.file;
    double extent = 0.0;
    for (const ConvexPiece& part : model.pieces) extent = std::max(extent, part.shape_T.boundingRadius());
    EXPECT_GT(extent, 0.3 * one.extent) << one.file;
    EXPECT_LT(extent, 2.0 * one.extent) << one.file;
  }
}

TEST_F(RealRobotTest, DrillIsCutWhereItIsHollow) {
  ToolModelOptions options = toolOf("drill", {"drill"});
  const auto whole = loadToolModel(read("costar_drill.urdf"), options).pieces;
  options.mesh_depth = 0;
  const auto hull = loadToolModel(read("costar_drill.urdf"), options).pieces;
  EXPECT_EQ(hull.size(), 1U);
  EXPECT_GT(whole.size(), 2U);
  for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0, -1, 0), Vector3d(0.6, 0, 0.8)}) {
    EXPECT_NEAR(support(whole, direction), support(hull, direction), 1e-7);
  }
}

// Only its shaft has collision geometry. Its meshes are missing: boxes stand in.
TEST_F(RealRobotTest, DvrkInstrumentIsMadeOfItsVisualGeometryBeyondTheShaft) {
  const std::string urdf =
      std::regex_replace(read("dvrk_psm1.urdf"), std::regex("<mesh [^>]*/>"), "<box size='0.01 0.01 0.01'/>");
  ToolModelOptions options = toolOf("PSM1_roll_link", {});
  EXPECT_TRUE(has(refusal(urdf, options), "it has visual geometry, but no collision; set tool/geometry to either"));
  options.geometry = LinkGeometry::kEither;
  std::map<std::string, bool> visuals;
  for (const LinkShape& shape : loadToolModel(urdf, options).shapes) visuals[shape.link] = shape.is_visual;
  EXPECT_EQ(visuals, (std::map<std::string, bool>{{"PSM1_roll_link", false},
                                                  {"PSM1_wrist_pitch_link", true},
                                                  {"PSM1_wrist_yaw_link", true},
                                                  {"PSM1_jaw_1_link", true},
                                                  {"PSM1_jaw_2_link", true}}));
}

TEST_F(RealRobotTest, DvrkInstrumentIsRefusedByTheNameOfTheMissingMesh) {
  for (const std::vector<std::string>& links :
       {std::vector<std::string>{}, {"PSM1_roll_link"}, {"PSM1_roll_link", "PSM1_wrist_pitch_link"}}) {
    EXPECT_TRUE(has(refusal(read("dvrk_psm1.urdf"), toolOf("tool", links)),
                    "link 'PSM1_roll_link': package://dvrk_model/meshes/instruments/roll/4670/roll_4670.obj: "
                    "no such file"));
  }
}

}  // namespace
}  // namespace sweep_guard_ros
