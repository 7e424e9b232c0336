// What goes to the robot, on the topic servo_cp.
#include <limits>

#include "connected_publisher.h"
#include "node_fixture.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using geometry_msgs::PoseStamped;

class CommandTest : public NodeTest {
 protected:
  static PoseStamped commandAt(double x) { return poseAt({x, 0.0, 5.0}, probe().time()); }

  // Moves along x, 10 ms after the command.
  void drive(int poses, const std::function<PoseStamped(double)>& command = commandAt) {
    for (int i = 0; i < poses; ++i) {
      probe().tick(0.01);
      (*commands()).publish(command(x_ + 0.002));
      probe().publish(poseAt({x_ += 0.001, 0.0, 5.0}, probe().time()));
      probe().awaitPrediction(probe().time());
    }
  }

  // Which of two topics is read first is not known: a few poses later it is.
  std::string source() {
    drive(1);
    return probe().awaitPrediction(probe().time()).prediction_source;
  }
  // Where a busy processor reads commands three poses late they count anew, after a second of them.
  void driveUntil(const std::string& wanted) {
    for (int i = 0; i < 1500; ++i) {
      if (source() == wanted) return;
    }
    ADD_FAILURE() << "never " << wanted;
  }

  static DiagnosticStatus awaitCommandStatus(const std::string& text) {
    return probe().awaitStatus("command", [&](const DiagnosticStatus& status) {
      return status.level == DiagnosticStatus::ERROR && status.message.find(text) != std::string::npos;
    });
  }

  static ConnectedPublisher<PoseStamped>& commands() {
    static ConnectedPublisher<PoseStamped> publisher("servo_cp");
    return publisher;
  }

  double x_ = 0.0;
};

TEST_F(CommandTest, ThePredictionSaysThatItIsMadeFromACommandAndNoLongerOnceThatIsSilent) {
  driveUntil("command");
  probe().awaitStatus("prediction", [](const auto& status) { return valueOf(status, "source") == "command"; });
  for (int i = 0; i < 10; ++i) {
    probe().tick(0.01);
    probe().publish(poseAt({x_ += 0.001, 0.0, 5.0}, probe().time()));
    probe().awaitPrediction(probe().time());
  }
  EXPECT_EQ(probe().awaitPrediction(probe().time()).prediction_source, "measured");
}

TEST_F(CommandTest, WhatIsNoCommandIsRefusedAndTheMotionIsMeasured) {
  driveUntil("command");
  drive(10, [](double x) {
    PoseStamped command = commandAt(x);
    command.pose.position.x = std::numeric_limits<double>::quiet_NaN();
    return command;
  });
  EXPECT_EQ(probe().awaitPrediction(probe().time()).prediction_source, "measured");
  awaitCommandStatus("refused");
  drive(1, [](double x) {
    PoseStamped command = commandAt(x);
    command.header.frame_id = "nowhere";
    return command;
  });
  awaitCommandStatus("nowhere");
  drive(1, [](double x) {
    PoseStamped command = commandAt(x);
    command.header.stamp += ros::Duration(10.0);
    return command;
  });
  awaitCommandStatus("future");
  drive(1, [](double x) {
    PoseStamped command = commandAt(x);
    command.header.frame_id.clear();
    return command;
  });
  awaitCommandStatus("names no frame");
  driveUntil("command");
}

}  // namespace
}  // namespace sweep_guard_ros
