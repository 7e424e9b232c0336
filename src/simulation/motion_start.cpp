#include "simulation/motion_start.h"

#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_simulation {
namespace {

constexpr double kMaxSleep = 0.1;  // [s] of one sleep, so that the node ends soon during a long gap
constexpr double kLongGap = 5.0;   // [s] reported in the log
constexpr std::uint32_t kNotReady =
    sweep_guard::Warning::NO_MESH | sweep_guard::Warning::MESH_INVALID | sweep_guard::Warning::MESH_STALE;

sweep_guard_core::TriangleMesh toMesh(const sweep_guard::DeformableMesh& message, const Eigen::Isometry3d& X_WM) {
  std::vector<Eigen::Vector3d> vertices_W;
  for (const geometry_msgs::Point& p : message.mesh.vertices)
    vertices_W.push_back(X_WM * Eigen::Vector3d(p.x, p.y, p.z));
  std::vector<sweep_guard_core::Triangle> triangles;
  for (const shape_msgs::MeshTriangle& triangle : message.mesh.triangles) {
    const auto& indices = triangle.vertex_indices;
    triangles.push_back({indices[0], indices[1], indices[2]});
  }
  return sweep_guard_core::TriangleMesh(vertices_W, std::move(triangles));
}

bool sleepUntil(const ros::Time& due) {
  while (ros::ok() && ros::Time::now() < due) {
    const ros::Duration left = due - ros::Time::now();
    std::min(left, ros::Duration(kMaxSleep)).sleep();
  }
  return ros::ok();
}

}  // namespace

bool waitUntil(const std::function<bool()>& condition, const std::string& what) {
  for (const ros::WallDuration pause(0.01); ros::ok(); pause.sleep()) {
    ros::spinOnce();
    if (condition()) return true;
    ROS_INFO_THROTTLE(5.0, "waiting for %s", what.c_str());
  }
  return false;
}

sweep_guard_core::Time rosNow() { return sweep_guard_ros::fromMsg(ros::Time::now()); }

bool awaitDue(const PoseScheduler& scheduler, sweep_guard_core::Time stamp) {
  const double gap = sweep_guard_core::toSeconds(scheduler.due(stamp) - rosNow());
  if (gap > kLongGap) ROS_INFO("the motion has a gap: waiting for %.0f s", gap);
  return sleepUntil(sweep_guard_ros::toMsg(scheduler.due(stamp)));
}

MotionStart::MotionStart(sweep_guard_ros::ParameterReader& parameters)
    : frame_(parameters.name("frame", "world")), min_subscribers_(parameters.integer("min_subscribers", 1, 0, 100)) {
  const auto on_mesh = [this](const sweep_guard::DeformableMesh::ConstPtr& mesh) {
    if (!mesh->mesh.triangles.empty()) mesh_ = mesh;
  };
  const auto on_warning = [this](const sweep_guard::Warning::ConstPtr& warning) {
    guard_ready_ = (warning->reasons & kNotReady) == 0;
  };
  mesh_subscriber_ = node_.subscribe<sweep_guard::DeformableMesh>("mesh", 1, on_mesh);
  warning_subscriber_ = node_.subscribe<sweep_guard::Warning>("warning", 1, on_warning);
}

bool MotionStart::awaitWorkpiece() {
  return waitUntil([this] { return mesh_ && locate(); }, "the workpiece and its frame");
}

bool MotionStart::awaitGuard() {
  return waitUntil([this] { return guard_ready_; }, "the guard to know the workpiece");
}

bool MotionStart::awaitSubscribers(const ros::Publisher& publisher) const {
  return waitUntil([&] { return static_cast<int>(publisher.getNumSubscribers()) >= min_subscribers_; },
                   std::to_string(min_subscribers_) + " subscribers of " + publisher.getTopic());
}

void MotionStart::stopListening() {
  mesh_subscriber_.shutdown();
  warning_subscriber_.shutdown();
}

bool MotionStart::locate() {
  try {
    const Eigen::Isometry3d X_WM =
        tf2::transformToEigen(buffer_.lookupTransform(frame_, mesh_->header.frame_id, ros::Time(0)));
    mesh_W_.emplace(toMesh(*mesh_, X_WM));
    center_W_ = X_WM.translation();
    return true;
  } catch (const tf2::TransformException&) {
    return false;
  }
}

}  // namespace sweep_guard_simulation
