#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "recording/motion_file.h"
#include "simulation/drilling.h"
#include "simulation/replay.h"
#include "simulation/run_node.h"
#include "simulation/tip.h"
#include "simulation/top_surface.h"
#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/Warning.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/ros/parameter_reader.h"
#include "sweep_guard/ros/parameters.h"

namespace sweep_guard_simulation {

namespace {

using sweep_guard::StampedPose;

constexpr int kQueue = 10000;
constexpr double kLongestSleep = 0.1;  // [s] so that a long gap in a recording does not delay the end of the node
constexpr double kLinger = 1.0;        // [s] for the last poses to leave
constexpr double kSlant = 0.45;        // more than the drill tilts: rise per width of the tool between two holes
constexpr double kDepth = 0.010;       // [m] below the surface, in both kinds of motion
constexpr double kHoleCircle = 0.06;   // [m] radius
constexpr int kHolesOnCircle = 5;
constexpr std::uint32_t kNotReady =
    sweep_guard::Warning::NO_MESH | sweep_guard::Warning::MESH_INVALID | sweep_guard::Warning::MESH_STALE;

/// The next pose, its stamp counted from the start of the motion; empty at the end.
using PoseStream = std::function<std::optional<StampedPose>()>;

PoseStream sampled(const Drilling& drilling, double rate, bool loop) {
  return [drilling, rate, loop, sample = 0L]() mutable -> std::optional<StampedPose> {
    const double t = static_cast<double>(sample++) / rate;
    if (!loop && t > drilling.duration()) return std::nullopt;
    return StampedPose{sweep_guard::Time(sweep_guard::fromSeconds(t)), drilling.pose(t)};
  };
}

PoseStream replayed(std::vector<StampedPose> poses, const Replay::Options& options) {
  return [replay = Replay(std::move(poses), options)]() mutable { return replay.next(); };
}

sweep_guard::TriangleMesh toMesh(const sweep_guard::DeformableMesh& message, const Eigen::Isometry3d& X_WM) {
  std::vector<Eigen::Vector3d> vertices_W;
  for (const geometry_msgs::Point& p : message.mesh.vertices)
    vertices_W.push_back(X_WM * Eigen::Vector3d(p.x, p.y, p.z));
  std::vector<sweep_guard::Triangle> triangles;
  for (const shape_msgs::MeshTriangle& triangle : message.mesh.triangles) {
    const auto& indices = triangle.vertex_indices;
    triangles.push_back({indices[0], indices[1], indices[2]});
  }
  return sweep_guard::TriangleMesh(vertices_W, std::move(triangles));
}

/// Leads the tool: waits for the workpiece and for the guard, then publishes one pose after the other when it is due.
class OperatorNode {
 public:
  explicit OperatorNode(sweep_guard_ros::ParameterReader& parameters)
      : frame_(parameters.name("frame", "world")),
        motion_file_(parameters.text("motion_file", "")),
        rate_(parameters.number("rate", 100.0, {1.0, 10000.0})),
        loop_(parameters.flag("loop", true)),
        wait_for_guard_(parameters.flag("wait_for_guard", true)),
        min_subscribers_(parameters.integer("min_subscribers", 1, 0, 100)),
        guard_(parameters.text("guard", "")),
        listener_(buffer_) {
    if (!motion_file_.empty()) recording_ = sweep_guard_recording::readMotionFile(motion_file_);
    publisher_ = node_.advertise<geometry_msgs::PoseStamped>("tool_pose", kQueue);
    mesh_subscriber_ = node_.subscribe("mesh", 1, &OperatorNode::onMesh, this);
    warning_subscriber_ = node_.subscribe("warning", 1, &OperatorNode::onWarning, this);
  }

  void run() {
    if (!waitUntil([this] { return surface_.has_value(); }, "the workpiece and its frame")) return;
    if (wait_for_guard_ && !waitUntil([this] { return guard_ready_; }, "the guard to know the workpiece")) return;
    if (!guard_.empty()) takeHold(*sweep_guard_ros::loadParameters(ros::NodeHandle(guard_)).tool);
    const PoseStream motion = makePoses();
    const auto connected = [this] { return static_cast<int>(publisher_.getNumSubscribers()) >= min_subscribers_; };
    if (!waitUntil(connected, std::to_string(min_subscribers_) + " subscribers of the tool pose")) return;
    mesh_subscriber_.shutdown();
    warning_subscriber_.shutdown();
    ROS_INFO("the operator starts to move");
    if (perform(motion)) {
      ROS_INFO("the motion is over");
      ros::Duration(kLinger).sleep();
    }
  }

 private:
  void takeHold(const sweep_guard::Tool& tool) {
    p_TTip_ = tipOf(tool);
    girth_ = girthOf(tool);
  }

  void onMesh(const sweep_guard::DeformableMesh::ConstPtr& mesh) {
    if (!mesh->mesh.triangles.empty()) mesh_ = mesh;
  }

  void onWarning(const sweep_guard::Warning::ConstPtr& warning) { guard_ready_ = (warning->reasons & kNotReady) == 0; }

  void locateSurface() {
    if (surface_ || !mesh_) return;
    try {
      const Eigen::Isometry3d X_WM =
          tf2::transformToEigen(buffer_.lookupTransform(frame_, mesh_->header.frame_id, ros::Time(0)));
      surface_.emplace(toMesh(*mesh_, X_WM));
    } catch (const tf2::TransformException&) {
      return;
    }
  }

  bool waitUntil(const std::function<bool()>& condition, const std::string& what) {
    for (const ros::WallDuration pause(0.01); ros::ok(); pause.sleep()) {
      ros::spinOnce();
      locateSurface();
      if (condition()) return true;
      ROS_INFO_THROTTLE(5.0, "waiting for %s", what.c_str());
    }
    return false;
  }

  PoseStream makePoses() {
    if (recording_.empty()) {
      Drilling::Options options;
      options.depth = kDepth;
      options.clearance += kSlant * girth_;
      return sampled(Drilling(holesAround(*surface_, kHoleCircle, kHolesOnCircle), options), rate_, loop_);
    }
    Replay::Options options;
    options.loop = loop_;
    options.target_W = surface_->highestPoint() - kDepth * Eigen::Vector3d::UnitZ();
    return replayed(recording_, options);
  }

  bool perform(const PoseStream& motion) {
    const ros::Time start = ros::Time::now();
    for (std::optional<StampedPose> pose = motion(); pose; pose = motion()) {
      const ros::Time due = start + ros::Duration().fromNSec(pose->stamp.time_since_epoch().count());
      if (!sleepUntil(due)) return false;
      publish(pose->X_WT * Eigen::Translation3d(-p_TTip_), due);
    }
    return true;
  }

  static bool sleepUntil(const ros::Time& due) {
    while (ros::ok() && ros::Time::now() < due) {
      const ros::Duration rest = due - ros::Time::now();
      std::min(rest, ros::Duration(kLongestSleep)).sleep();
    }
    return ros::ok();
  }

  void publish(const Eigen::Isometry3d& X_WT, const ros::Time& stamp) {
    geometry_msgs::PoseStamped message;
    message.header.stamp = stamp;
    message.header.frame_id = frame_;
    message.pose = tf2::toMsg(X_WT);
    publisher_.publish(message);
  }

  std::string frame_;
  std::string motion_file_;
  double rate_;
  bool loop_;
  bool wait_for_guard_;
  int min_subscribers_;
  std::string guard_;  // whose tool it leads; empty: one with the tip in the origin
  std::vector<StampedPose> recording_;
  sweep_guard::DeformableMesh::ConstPtr mesh_;
  std::optional<TopSurface> surface_;
  bool guard_ready_ = false;
  Eigen::Vector3d p_TTip_ = Eigen::Vector3d::Zero();  // [m]; the motion is that of the tip
  double girth_ = 0.0;                                // [m]
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  ros::Subscriber mesh_subscriber_;
  ros::Subscriber warning_subscriber_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace

}  // namespace sweep_guard_simulation

int main(int argc, char** argv) {
  return sweep_guard_simulation::runNode<sweep_guard_simulation::OperatorNode>(argc, argv, "operator");
}
