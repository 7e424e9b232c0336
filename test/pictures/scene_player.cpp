// Plays a scene to a guard and to rviz, always in the same way, and holds its last moment for a picture.
//
// It publishes the clock, and takes a step only after the guard has answered the previous one: neither a slow machine
// nor a slow display changes the picture. It relays the messages of the guard until the scene holds. Then it repeats
// the last messages, so that they do not expire.
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pictures/tip_script.h"
#include "recording/run_node.h"
#include "simulation/workpiece.h"
#include "simulation/workpiece_messages.h"
#include "sweep_guard/Acknowledge.h"
#include "sweep_guard/Interaction.h"
#include "sweep_guard/Prediction.h"
#include "sweep_guard/ToolShape.h"
#include "sweep_guard/Touches.h"
#include "sweep_guard/View.h"
#include "sweep_guard/Warning.h"
#include "sweep_guard/common/warning_level.h"

namespace sweep_guard_simulation {
namespace {

constexpr double kStart = 1000.0;       // [s]; start of the scene on its clock
constexpr double kTimeout = 30.0;       // [s]; for guard and rviz to connect, and for an answer
constexpr double kRepeatPeriod = 0.05;  // [s]
constexpr double kFirstDelay = 1.0;     // [s]; drawing takes longer at first
constexpr int kViewsToSettle = 3;       // the first view may be older than the prediction from its pose
constexpr std::uint32_t kNotReady =
    sweep_guard::Warning::NO_MESH | sweep_guard::Warning::MESH_INVALID | sweep_guard::Warning::MESH_STALE;
// Instead of a level:
const std::string kEnd = "END";
const std::string kHeld = "HELD";                  // a contact that has been over for a while
const std::string kAcknowledged = "ACKNOWLEDGED";  // a warning, which the player acknowledges
constexpr double kHeldFor = 0.2;                   // [s]
const std::string kWorkpiece = "workpiece";

const char* nameOf(std::uint8_t level) {
  return sweep_guard_core::styleOf(static_cast<sweep_guard_core::WarningLevel>(level)).name;
}

std::vector<std::string> endConditions() {
  std::vector<std::string> names = {kEnd, kHeld, kAcknowledged};
  for (const sweep_guard_core::LevelStyle& style : sweep_guard_core::kLevelStyles) names.emplace_back(style.name);
  return names;
}

/// Relays what the guard says on a topic, and repeats the newest of it.
template <typename Message>
class Relay {
 public:
  explicit Relay(const std::string& topic)
      : publisher_(node_.advertise<Message>("shown/" + topic, 10)),
        subscriber_(node_.subscribe<Message>("guard/" + topic, 10, [this](const typename Message::ConstPtr& message) {
          newest_ = message;
          repeat();
        })) {}

  void repeat() const {
    if (newest_) publisher_.publish(newest_);
  }

 private:
  ros::NodeHandle node_;
  typename Message::ConstPtr newest_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
};

class ScenePlayer {
 public:
  explicit ScenePlayer(sweep_guard_ros::ParameterReader& parameters)
      : frame_(parameters.name("frame", "world")),
        workpiece_(makeWorkpiece(parameters)),
        script_(parameters.texts("poses")),
        step_(1.0 / parameters.number("rate", 50.0, {1.0, 1000.0})),
        slowdown_(parameters.number("slowdown", 1.0, {0.01, 100.0})),
        level_(parameters.choice("until", kEnd, endConditions())),
        from_(parameters.number("from", 0.0, {0.0, 1000.0})),
        silent_from_(parameters.number("silent_from", 1000.0, {0.0, 1000.0})),
        X_WM_(placeOf(parameters)),
        elastic_(makeElasticWorkpiece(parameters, workpiece_, step_,
                                      X_WM_.linear().transpose() * Eigen::Vector3d::UnitZ())) {
    if (elastic_) setToolOf("guard", kWorkpiece, *elastic_);
    node_.setParam("/use_sim_time", true);
    broadcastFrame();
    clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10);
    mesh_publisher_ = node_.advertise<sweep_guard::DeformableMesh>("mesh", 1, /*latch=*/true);
    vertices_publisher_ = node_.advertise<sweep_guard::MeshVertices>("mesh_vertices", 10);
    pose_publisher_ = node_.advertise<geometry_msgs::PoseStamped>("tool_pose", 10);
    view_publisher_ = node_.advertise<sweep_guard::View>("shown/view", 10);
    warning_publisher_ = node_.advertise<sweep_guard::Warning>("shown/warning", 10);
    tool_publisher_ = node_.advertise<sweep_guard::ToolShape>("shown/tool", 1, /*latch=*/true);
    view_subscriber_ = node_.subscribe("guard/view", 10, &ScenePlayer::onView, this);
    warning_subscriber_ = node_.subscribe("guard/warning", 10, &ScenePlayer::onWarning, this);
    prediction_subscriber_ = node_.subscribe<sweep_guard::Prediction>(
        "guard/prediction", 10,
        [this](const sweep_guard::Prediction::ConstPtr& message) { predicted_ = message->header.stamp; });
    if (elastic_) {
      force_publisher_ = node_.advertise<visualization_msgs::MarkerArray>("shown/force", 1);
      interaction_subscriber_ = node_.subscribe("guard/interaction", 10, &ScenePlayer::onInteraction, this);
      interaction_.emplace("interaction");
      touches_.emplace("touches");
    }
    tool_subscriber_ = node_.subscribe<sweep_guard::ToolShape>(
        "guard/tool", 1, [this](const sweep_guard::ToolShape::ConstPtr& shape) { tool_publisher_.publish(shape); });
  }

  void run() {
    await("the guard and for subscribers of the workpiece, of the tool and of the guard's view", [this] {
      return warned_ && pose_publisher_.getNumSubscribers() > 0 && view_subscriber_.getNumPublishers() > 0 &&
             mesh_publisher_.getNumSubscribers() > 1 && vertices_publisher_.getNumSubscribers() > 1 &&
             view_publisher_.getNumSubscribers() > 0 && tool_publisher_.getNumSubscribers() > 0;
    });
    publishMesh();
    await("the guard to know the workpiece", [this] { return (warning_.reasons & kNotReady) == 0; });
    play();
    hold();
  }

 private:
  void broadcastFrame() {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(X_WM_);
    transform.header.frame_id = frame_;
    transform.child_frame_id = "workpiece";
    broadcaster_.sendTransform(transform);
  }

  ros::Time now() const { return ros::Time(kStart + t_); }

  template <typename Message>
  void send(const ros::Publisher& publisher, Message message, const std::string& frame) const {
    message.header.stamp = now();
    message.header.frame_id = frame;
    publisher.publish(message);
  }

  void publishClock() const {
    rosgraph_msgs::Clock clock;
    clock.clock = now();
    clock_publisher_.publish(clock);
  }

  std::vector<float> positions() const { return elastic_ ? elastic_->positions() : workpiece_.positions(t_); }

  void publishMesh() const {
    sweep_guard::DeformableMesh mesh = meshMessage(positions(), workpiece_.triangles());
    mesh.id = kWorkpiece;
    send(mesh_publisher_, mesh, "workpiece");
  }

  void publishVertices() const {
    sweep_guard::MeshVertices vertices = verticesMessage(positions());
    vertices.id = kWorkpiece;
    send(vertices_publisher_, vertices, "workpiece");
  }

  void publishPose() const {
    geometry_msgs::PoseStamped pose;
    pose.pose = tf2::toMsg(script_.pose(t_));
    send(pose_publisher_, pose, frame_);
  }

  void onView(const sweep_guard::View::ConstPtr& view) {
    if (holding_) return;
    views_ = predicted_ == now() && view->header.stamp == predicted_ ? views_ + 1 : 0;
    view_ = *view;
    view_publisher_.publish(view_);
  }

  void onWarning(const sweep_guard::Warning::ConstPtr& warning) {
    if (holding_) return;
    warning_ = *warning;
    warned_ = true;
    warning_publisher_.publish(warning_);
  }

  // The force as the guard measures it.
  void onInteraction(const sweep_guard::Interaction::ConstPtr& interaction) {
    if (holding_ || interaction->header.stamp != now()) return;
    const auto vectorOf = [](const auto& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
    const Eigen::Isometry3d X_WT = script_.pose(t_);
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    if (!interaction->objects.empty()) point = X_WT * vectorOf(interaction->objects[0].centroid);
    std_msgs::Header header = interaction->header;
    header.frame_id = frame_;
    force_ = forceMarkers(header, point, X_WT.linear() * vectorOf(interaction->wrench.force), elastic_->dent());
    force_publisher_.publish(force_);
  }

  void await(const std::string& what, const std::function<bool()>& condition) const {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kTimeout);
    for (; !condition(); ros::WallDuration(0.005).sleep()) {
      if (!ros::ok() || ros::WallTime::now() > end)
        throw sweep_guard_core::InvalidInput("timeout while waiting for " + what);
      publishClock();
      ros::spinOnce();
    }
  }

  void play() {
    t_ = script_.begin();
    ros::WallTime due = ros::WallTime::now() + ros::WallDuration(kFirstDelay);
    while (true) {
      publishClock();
      if (elastic_) elastic_->advance(X_WM_.inverse() * script_.pose(t_));
      publishVertices();
      const bool silent = t_ >= silent_from_;
      if (!silent) {
        publishPose();
        await("the guard's answer", [this] { return view_.header.stamp == now(); });
      }
      if (level_ == kAcknowledged && warning_.level == sweep_guard::Warning::CONSIDERED) acknowledge();
      if (isOver()) return;
      due += ros::WallDuration(slowdown_ * step_);
      await("the next step", [&] { return ros::WallTime::now() >= due; });
      t_ += step_;
    }
  }

  static void acknowledge() {
    sweep_guard::Acknowledge acknowledge;
    ros::service::call("guard/acknowledge", acknowledge);
  }

  bool isReached() const {
    if (level_ == kHeld)
      return warning_.contact && warning_.held && now() - warning_.held_since > ros::Duration(kHeldFor);
    if (level_ == kAcknowledged) return warning_.acknowledged;
    return level_ == nameOf(warning_.level);
  }

  bool isOver() const {
    if (t_ >= from_ && isReached()) return true;
    const bool ended = t_ + 0.5 * step_ > script_.end();
    if (ended && level_ != kEnd) {
      throw sweep_guard_core::InvalidInput("the scene ended without " + level_ + "; last warning: " + warning_.text);
    }
    return ended;
  }

  void hold() {
    if (t_ < silent_from_) {
      await("the guard's view of the end", [this] { return views_ >= kViewsToSettle; });
    }
    holding_ = true;
    std::printf("holding at %.3f s: %s\n", t_, warning_.text.c_str());
    std::fflush(stdout);
    for (; ros::ok(); ros::WallDuration(kRepeatPeriod).sleep()) {
      publishClock();
      view_publisher_.publish(view_);
      warning_publisher_.publish(warning_);
      if (elastic_) {
        force_publisher_.publish(force_);
        interaction_->repeat();
      }
      ros::spinOnce();
    }
  }

  std::string frame_;
  Workpiece workpiece_;
  TipScript script_;
  double step_;         // [s]
  double slowdown_;     // duration of the playback relative to the scene
  std::string level_;   // that ends the scene
  double from_;         // [s] when it may end
  double silent_from_;  // [s] end of the poses
  Eigen::Isometry3d X_WM_;
  std::optional<ElasticWorkpiece> elastic_;
  double t_ = 0.0;  // [s]
  bool warned_ = false;
  bool holding_ = false;
  int views_ = 0;  // of the newest pose and its prediction
  ros::Time predicted_;
  sweep_guard::View view_;
  sweep_guard::Warning warning_;
  ros::NodeHandle node_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  ros::Publisher clock_publisher_;
  ros::Publisher mesh_publisher_;
  ros::Publisher vertices_publisher_;
  ros::Publisher pose_publisher_;
  ros::Publisher view_publisher_;
  ros::Publisher warning_publisher_;
  ros::Publisher tool_publisher_;
  ros::Publisher force_publisher_;
  visualization_msgs::MarkerArray force_;
  ros::Subscriber interaction_subscriber_;
  std::optional<Relay<sweep_guard::Interaction>> interaction_;
  std::optional<Relay<sweep_guard::Touches>> touches_;
  ros::Subscriber view_subscriber_;
  ros::Subscriber warning_subscriber_;
  ros::Subscriber prediction_subscriber_;
  ros::Subscriber tool_subscriber_;
};

}  // namespace
}  // namespace sweep_guard_simulation

int main(int argc, char** argv) {
  return sweep_guard_recording::runNode<sweep_guard_simulation::ScenePlayer>(argc, argv, "scene_player");
}
