#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>
#include <tf2_eigen/tf2_eigen.h>

#include <optional>
#include <string>

#include "recording/run_node.h"
#include "simulation/guided_tip.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {
namespace {

constexpr double kMaxStep = 0.1;  // [s]; after a longer pause the arm goes on from rest

/// Moves the tool as a robot does: towards the newest command, as fast as its limits allow, and says where it is.
class SimulatedArm {
 public:
  explicit SimulatedArm(sweep_guard_ros::ParameterReader& parameters)
      : frame_(parameters.name("frame", "world")),
        rate_(parameters.number("rate", 100.0, {1.0, 10000.0})),
        tip_(pointingDown(parameters.position("home", {0.0, 0.0, 0.7})),
             readLimits(parameters, "", {0.5, 2.0, 3.0, 12.0})) {
    publisher_ = node_.advertise<geometry_msgs::PoseStamped>("tool_pose", 100);
    subscriber_ = node_.subscribe("command", 1, &SimulatedArm::onCommand, this, ros::TransportHints().tcpNoDelay());
  }

  void run() {
    ros::Time::waitForValid();
    ros::Time before = ros::Time::now();
    for (ros::Rate rate(rate_); ros::ok(); rate.sleep()) {
      ros::spinOnce();
      const ros::Time now = ros::Time::now();
      move((now - before).toSec());
      publish(now);
      before = now;
    }
  }

 private:
  void onCommand(const geometry_msgs::PoseStamped::ConstPtr& command) {
    Eigen::Isometry3d goal_W;
    tf2::fromMsg(command->pose, goal_W);
    goal_W_ = goal_W;
  }

  void move(double dt) {
    if (dt > kMaxStep) tip_.stop();
    if (goal_W_ && dt > 0.0 && dt <= kMaxStep) tip_.moveTowards(*goal_W_, dt);
  }

  void publish(const ros::Time& stamp) {
    geometry_msgs::PoseStamped message;
    message.header.stamp = stamp;
    message.header.frame_id = frame_;
    message.pose = tf2::toMsg(tip_.pose());
    publisher_.publish(message);
  }

  std::string frame_;
  double rate_;
  GuidedTip tip_;
  std::optional<Eigen::Isometry3d> goal_W_;
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
};

}  // namespace
}  // namespace sweep_guard_simulation

int main(int argc, char** argv) {
  return sweep_guard_recording::runNode<sweep_guard_simulation::SimulatedArm>(argc, argv, "simulated_arm");
}
