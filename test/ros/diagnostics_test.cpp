// /diagnostics of a running guard. Part of node_test.
#include <sweep_guard/Interaction.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <cstdlib>
#include <set>
#include <string>

#include "connected_publisher.h"
#include "node_fixture.h"
#include "proximity_listener.h"
#include "refusal.h"
#include "ros/output/diagnostics.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using sweep_guard::Warning;
using sweep_guard_core::SweepStatistics;

class DiagnosticsTest : public NodeTest {
 protected:
  static bool any(const DiagnosticStatus& /*status*/) { return true; }

  static DiagnosticStatus awaitValue(const std::string& name, const std::string& key, const std::string& value) {
    return probe().awaitStatus(name, [&](const DiagnosticStatus& status) { return valueOf(status, key) == value; });
  }
};

DiagnosticStatus detectorOf(SweepStatistics& statistics) {
  Parameters parameters;
  parameters.detector.name = "halfspace";
  diagnostic_updater::DiagnosticStatusWrapper status;
  reportDetector(statistics.take(), parameters, status);
  return status;
}

TEST(ToolStatusTest, SaysWhatEachLinkIsMadeOf) {
  Parameters parameters;
  parameters.tool_description = "5 convex pieces";
  const auto reported = [&] {
    diagnostic_updater::DiagnosticStatusWrapper status;
    reportTool(parameters, status);
    return DiagnosticStatus(status);
  };
  EXPECT_EQ(reported().message, "5 convex pieces");
  parameters.link_shapes = {{"shaft", /*is_visual=*/false, 2}, {"jaw", /*is_visual=*/false, 1}};
  EXPECT_EQ(reported().message, "5 convex pieces");
  EXPECT_EQ(valueOf(reported(), "'shaft'"), "2 pieces from its collision geometry");
  parameters.link_shapes[1].is_visual = true;
  parameters.attached = {"payload"};
  EXPECT_EQ(reported().message, "5 convex pieces, 1 links of visual geometry");
  EXPECT_EQ(valueOf(reported(), "'jaw'"), "1 pieces from its visual geometry");
  EXPECT_EQ(valueOf(reported(), "'payload'"), "attached");
}

// A failing detector is fast enough.
TEST(DetectorStatusTest, IsAnErrorInThePeriodInWhichTheDetectorFails) {
  SweepStatistics statistics(std::chrono::milliseconds(66));
  statistics.swept(std::chrono::milliseconds(1), std::chrono::milliseconds(1));
  statistics.fault("'liver': no canary");
  const DiagnosticStatus failing = detectorOf(statistics);
  EXPECT_EQ(failing.level, DiagnosticStatus::ERROR);
  EXPECT_EQ(failing.message, "failed: 'liver': no canary");
  statistics.swept(std::chrono::milliseconds(1), std::chrono::milliseconds(1));
  const DiagnosticStatus cleared = detectorOf(statistics);
  EXPECT_EQ(cleared.level, DiagnosticStatus::OK);
  EXPECT_EQ(cleared.message, "halfspace keeps up");
  EXPECT_EQ(valueOf(cleared, "faults"), "1");
  EXPECT_EQ(valueOf(cleared, "last error"), "'liver': no canary");
}

TEST(DetectorStatusTest, AFailureOfEverySweepIsNoLackOfPoses) {
  SweepStatistics statistics(std::chrono::milliseconds(66));
  statistics.fault("sweep failed: no memory");
  EXPECT_EQ(detectorOf(statistics).message, "failed: sweep failed: no memory");
}

TEST_F(DiagnosticsTest, EachInputReportsTopicPublishersAndAge) {
  placeSquare("square", {0.0, 0.0, -1.0});
  probe().place(squareMovedTo("square", {0.0, 0.0, -1.0}, probe().time()));
  restAt({0.0, 0.0, 0.5});
  for (const auto& [name, topic] :
       {std::pair{"tool pose", "/tool_pose"}, {"mesh", "/mesh"}, {"mesh vertices", "/mesh_vertices"}}) {
    const DiagnosticStatus status = probe().awaitStatus(name, any);
    EXPECT_EQ(valueOf(status, "source"), topic);
    EXPECT_EQ(valueOf(status, "publishers"), "1");
    EXPECT_FALSE(valueOf(status, "rate [Hz]").empty());
    EXPECT_FALSE(valueOf(status, "age [s]").empty());
    EXPECT_FALSE(valueOf(status, "age by stamp [s]").empty());
    EXPECT_FALSE(valueOf(status, "last error").empty());
  }
  const DiagnosticStatus workpieces = probe().awaitStatus("workpieces", any);
  EXPECT_EQ(valueOf(workpieces, "'square'").find("revision 1, 2 triangles in 'world'"), 0U);
}

TEST_F(DiagnosticsTest, SayWhichShareOfThePosesRepeatsTheOneBefore) {
  placeSquare("square", {0.0, 0.0, -1.0});
  std::string share;
  for (int i = 0; i < 10 && (share.empty() || share == "0"); ++i) {
    restAt({0.0, 0.0, 0.5});
    share = valueOf(probe().awaitStatus("tool pose", any), "repeated positions [%]");
  }
  ASSERT_FALSE(share.empty());
  EXPECT_GT(std::stod(share), 0.0);
  EXPECT_LE(std::stod(share), 100.0);
}

TEST_F(DiagnosticsTest, SayWhichWorkpieceHasCoordinatesThatAreRounded) {
  placeSquare("square", {0.0, 0.0, -1.0});
  probe().place(squareMovedTo("square", {0.0, 0.0, -1.0}, probe().time()));
  const auto coarse = [](const DiagnosticStatus& status) { return has(status.message, "for float32 rounds"); };
  EXPECT_FALSE(coarse(probe().awaitStatus("workpieces", any)));
  probe().place(squareMovedTo("square", {30e3, 30e3, -1.0}, probe().time()));
  EXPECT_TRUE(has(probe().awaitStatus("workpieces", coarse).message, "'square' is known to 1.4 mm only"));
}

TEST_F(DiagnosticsTest, SayHowLargeWorkpiecesAreAndHowFarTheToolIs) {
  const auto doubts = [](const std::string& what) {
    return [what](const DiagnosticStatus& status) {
      return status.level != DiagnosticStatus::OK && has(status.message, what);
    };
  };
  placeSquare("square", {0.0, 0.0, -1.0});
  moveTo({0.0, 0.0, 0.5});
  awaitValue("workpieces", "size of 'square'", "0.2 x 0.2 x 0 m, at least 1.5 m from the tool, nearest so far 1.5 m");
  placeSquare("mesh in mm", {0.0, 0.0, -1.0}, "world", 100.0);
  moveTo({0.0, 0.0, 0.5});
  probe().awaitStatus("workpieces", doubts("'mesh in mm' is 200 m long: is its mesh in millimeters?"));
  probe().remove("mesh in mm");
  placeSquare("transform in mm", {0.0, 0.0, -299.75});
  moveTo({0.0, 0.0, 0.5});
  probe().awaitStatus("workpieces", doubts("the tool was never nearer to 'transform in mm' than 300 m"));
}

// In the frame of the tool poses, or of a workpiece.
tf2_msgs::TFMessage transformOfLength(const std::string& child, double length) {
  tf2_msgs::TFMessage message;
  geometry_msgs::TransformStamped& transform = message.transforms.emplace_back();
  transform.header.frame_id = "world";
  transform.header.stamp = probe().time();
  transform.child_frame_id = child;
  transform.transform.rotation.w = length;
  return message;
}

TEST_F(DiagnosticsTest, SayWhichTransformOfAWorkpieceIsRefused) {
  placeSquare("square", {0.0, 0.0, -1.0}, "bench");
  ConnectedPublisher<tf2_msgs::TFMessage> publisher("/tf");
  for (const auto& [length, value] : {std::pair{0.5, "0.5) is 0.5"}, {0.0, "0) is 0"}, {1.3, "1.3) is 1.3"}}) {
    probe().tick(0.01);
    probe().publish(poseAt(kAway, probe().time()));  // from then on, the frame counts
    probe().awaitWarning(hasReason(Warning::TF_FAIL));
    (*publisher).publish(transformOfLength("bench", length));
    probe().awaitWarning([&, refused = value](const Warning& warning) {
      return hasReason(Warning::TF_FAIL)(warning) && has(warning.text, "transform to 'bench' from node '") &&
             has(warning.text, refused);
    });
  }
  probe().awaitStatus("workpieces", [](const DiagnosticStatus& status) {
    return status.level == DiagnosticStatus::ERROR && has(status.message, "(0, 0, 0, 1.3) is 1.3");
  });
}

// Also in the periods in which nothing more is refused.
TEST_F(DiagnosticsTest, SayWhichTransformOfTheToolIsRefusedUntilAGoodOneComes) {
  ConnectedPublisher<tf2_msgs::TFMessage> publisher("/tf");
  probe().tick(0.01);
  auto pose = poseAt(kAway, probe().time());
  pose.header.frame_id = "cart";
  probe().publish(pose);  // from then on, the frame counts
  probe().awaitWarning(hasReason(Warning::TF_FAIL));
  for (const auto& [length, value] : {std::pair{0.5, "0.5) is 0.5"}, {0.0, "0) is 0"}, {1.3, "1.3) is 1.3"}}) {
    const auto is_told = [told = value](const DiagnosticStatus& status) {
      return status.level == DiagnosticStatus::ERROR && has(status.message, "transform to 'cart' from node '") &&
             has(status.message, told);
    };
    (*publisher).publish(transformOfLength("cart", length));
    const std::string refused = valueOf(probe().awaitStatus("tool pose", is_told), "refused");
    probe().awaitStatus("tool pose", [&](const DiagnosticStatus& status) {
      return is_told(status) && valueOf(status, "refused") == refused;
    });
  }
  (*publisher).publish(transformOfLength("cart", 1.0));
  probe().awaitStatus("tool pose",
                      [](const DiagnosticStatus& status) { return !has(status.message, "transform to 'cart'"); });
}

TEST_F(DiagnosticsTest, APoseThatWasRefusedIsTheLastErrorOfItsInputAlone) {
  auto bad = poseAt({0.0, 0.0, 0.5}, probe().time());
  bad.pose.position.y = NAN;
  probe().publish(bad);
  const DiagnosticStatus status = probe().awaitStatus("tool pose", [](const DiagnosticStatus& next) {
    return next.level == DiagnosticStatus::ERROR && next.message.find("refused") == 0;
  });
  EXPECT_TRUE(has(valueOf(status, "last error"), "position"));
  EXPECT_FALSE(has(valueOf(probe().awaitStatus("mesh vertices", any), "last error"), "position"));
}

TEST_F(DiagnosticsTest, PosesThatHaveStoppedAreAnErrorAndVerticesAreNot) {
  placeSquare("square", {0.0, 0.0, -1.0});
  restAt({0.0, 0.0, 0.5});
  probe().awaitStatus("tool pose", [](const DiagnosticStatus& status) {
    return status.level == DiagnosticStatus::ERROR && status.message == "has stopped";
  });
  EXPECT_EQ(probe().awaitStatus("mesh vertices", any).level, DiagnosticStatus::OK);
}

TEST_F(DiagnosticsTest, ReportDetectorPredictorAndDeadlines) {
  const DiagnosticStatus detector = probe().awaitStatus("detector", any);
  EXPECT_EQ(valueOf(detector, "detector"), "select");
  const bool slow = ros::param::param("/sweep_guard/timing/min_rate", 15.0) == 1.0;
  EXPECT_EQ(valueOf(detector, "deadline [ms]"), slow ? "1000.0" : "66.7");
  EXPECT_EQ(valueOf(detector, "last error"), "none");
  const DiagnosticStatus prediction = probe().awaitStatus("prediction", any);
  EXPECT_EQ(valueOf(prediction, "predictor"), "direct");
  EXPECT_EQ(valueOf(prediction, "horizon [s]"), "reflex 0.1, considered 1");
  EXPECT_EQ(valueOf(probe().awaitStatus("parameters", any), "last refusal"), "none");
}

TEST_F(DiagnosticsTest, EachStageFromAMessageToAWarningTakesTime) {
  const std::set<std::string> all = {"receive [%]",    "sweep [%]",       "narrow phase [%]",
                                     "prediction [%]", "probability [%]", "monitor [%]",
                                     "proximity [%]",  "interaction [%]", "publish [%]"};
  const TopicListener<sweep_guard::Proximity> planes("proximity");
  const TopicListener<sweep_guard::Interaction> forces("interaction");
  touchASquare();
  std::set<std::string> seen;
  for (int tries_left = 20; tries_left > 0 && seen != all; --tries_left) {
    for (int i = 0; i < 25; ++i) {
      moveTo({0.0, 0.0, 0.01});
      moveTo({0.0, 0.0, -0.01});
    }
    for (const auto& [stage, share] : probe().awaitStatus("stages", any).values) {
      if (std::strtod(share.c_str(), nullptr) > 0.0) seen.insert(stage);
    }
  }
  EXPECT_EQ(seen, all);
}

TEST_F(DiagnosticsTest, ReportThatTheGuardIsDisabledAndByWhom) {
  ASSERT_TRUE(probe().enable(false).success);
  awaitValue("warning", "enabled", "no: disabled by " + ros::this_node::getName());
  EXPECT_EQ(probe().awaitStatus("detector", any).message, "disabled: nothing is swept");
  ASSERT_TRUE(probe().enable(true).success);
  awaitValue("warning", "enabled", "yes");
}

}  // namespace
}  // namespace sweep_guard_ros
