// The demo led by its interactive marker, with the feedback of rviz.
#include <gtest/gtest.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>
#include <visualization_msgs/InteractiveMarkerInit.h>

#include "demo_listener.h"

namespace sweep_guard_ros {
namespace {

using Eigen::Vector3d;
using visualization_msgs::InteractiveMarkerFeedback;
using Poses = DemoListener::Poses;

const ros::Duration kMarkerPeriod(0.004);
constexpr double kFullSpeed = 0.25;  // [m/s] of config/operator.yaml

// Latched: feedback before the connection is not lost.
class Mouse {
 public:
  Mouse() : publisher_(node_.advertise<InteractiveMarkerFeedback>("operator/marker/feedback", 1, /*latch=*/true)) {
    feedback_.marker_name = "tip";
    feedback_.header.frame_id = "world";
    feedback_.event_type = InteractiveMarkerFeedback::POSE_UPDATE;
    feedback_.pose.orientation.x = 1.0;
  }

  void dragTo(const Vector3d& position) {
    feedback_.pose.position.x = position.x();
    feedback_.pose.position.y = position.y();
    feedback_.pose.position.z = position.z();
    publisher_.publish(feedback_);
  }

 private:
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  InteractiveMarkerFeedback feedback_;
};

TEST(OperateMarkerTest, TheToolFollowsTheMarkerAsADeviceWould) {
  const DemoListener listener;
  Mouse mouse;
  const auto markers =
      ros::topic::waitForMessage<visualization_msgs::InteractiveMarkerInit>("operator/marker/update_full");
  ASSERT_EQ(markers->markers.size(), 1U);
  EXPECT_EQ(markers->markers[0].controls.size(), 6U);

  const Poses resting = listener.awaitRest(100);
  const Vector3d start = positionOf(resting.back());
  const auto& place = markers->markers[0].pose.position;
  EXPECT_TRUE(start.isApprox(Vector3d(place.x, place.y, place.z), 1e-9));

  const Vector3d goal = start + Vector3d(0.1, -0.05, 0.02);
  mouse.dragTo(goal);
  const Poses led =
      listener.awaitPoses([&goal](const Poses& poses) { return (positionOf(poses.back()) - goal).norm() < 1e-6; });
  const Poses after = listener.awaitRest(100);
  EXPECT_TRUE(positionOf(after.back()).isApprox(goal, 1e-5));

  const Poses all = listener.awaitPoses(0);
  EXPECT_TRUE(isEven(all, kMarkerPeriod));
  EXPECT_LE(longestStep(all), kFullSpeed * kMarkerPeriod.toSec() + 1e-9);
  EXPECT_FALSE(listener.inContact());
  mouse.dragTo(start - Vector3d(0, 0, 0.12));
  listener.awaitContact();
}

}  // namespace
}  // namespace sweep_guard_ros
