#include "guard_probe.h"

#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <chrono>
#include <stdexcept>

namespace sweep_guard_ros {
namespace {

constexpr auto kPatience = std::chrono::seconds(20);

std::vector<Eigen::Vector3d> sheetCorners(const Eigen::Vector3d& center, double half_side) {
  std::vector<Eigen::Vector3d> corners;
  for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
    corners.push_back(center + half_side * Eigen::Vector3d(x, y, 0.0));
  }
  return corners;
}

}  // namespace

GuardProbe::GuardProbe(bool drives_clock, PoseSource pose_source) : time_(drives_clock ? 1000.0 : 0.0) {
  const auto wake = [this](const ros::SingleSubscriberPublisher&) { changed_.notify_all(); };
  pose_publisher_ = node_.advertise<geometry_msgs::PoseStamped>("tool_pose", 10000, wake);
  mesh_publisher_ = node_.advertise<sweep_guard::DeformableMesh>("mesh", 100, wake);
  vertices_publisher_ = node_.advertise<sweep_guard::MeshVertices>("mesh_vertices", 100, wake);
  tf_publisher_ = node_.advertise<tf2_msgs::TFMessage>("/tf", 100, wake);
  const auto hints = ros::TransportHints().tcpNoDelay();
  warning_subscriber_ = node_.subscribe<sweep_guard::Warning>(
      "/sweep_guard/warning", 10000,
      [this](const sweep_guard::Warning::ConstPtr& warning) {
        const std::lock_guard lock(mutex_);
        warnings_.push_back(*warning);
        changed_.notify_all();
      },
      nullptr, hints);
  contacts_subscriber_ = node_.subscribe<sweep_guard::Contacts>(
      "/sweep_guard/contacts", 10000,
      [this](const sweep_guard::Contacts::ConstPtr& contacts) {
        const std::lock_guard lock(mutex_);
        contacts_.push_back(*contacts);
        changed_.notify_all();
      },
      nullptr, hints);
  markers_subscriber_ = node_.subscribe<visualization_msgs::MarkerArray>(
      "/sweep_guard/markers", 10, [this](const visualization_msgs::MarkerArray::ConstPtr& markers) {
        const std::lock_guard lock(mutex_);
        markers_ = *markers;
        changed_.notify_all();
      });
  if (drives_clock) clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10, wake);
  check_sweep_ = node_.serviceClient<sweep_guard::CheckSweep>("/sweep_guard/check_sweep");
  spinner_.start();
  await("the guard's connections", [&] {
    return (pose_source == PoseSource::kTf || pose_publisher_.getNumSubscribers() > 0) &&
           mesh_publisher_.getNumSubscribers() > 0 && vertices_publisher_.getNumSubscribers() > 0 &&
           tf_publisher_.getNumSubscribers() > 0 && contacts_subscriber_.getNumPublishers() > 0 && !warnings_.empty() &&
           check_sweep_.exists();
  });
  if (drives_clock) {
    // The guard, and this process itself.
    await("the subscribers of the clock", [this] { return clock_publisher_.getNumSubscribers() > 1; });
    setClock(time_);
  }
}

template <typename Condition>
void GuardProbe::await(const std::string& what, Condition&& condition) const {
  std::unique_lock lock(mutex_);
  if (!changed_.wait_for(lock, kPatience, condition)) throw std::runtime_error("waited in vain for " + what);
}

void GuardProbe::setClock(ros::Time time) {
  publishClock(time);
  const ros::Duration valid(0.2);
  await("the guard to see the clock",
        [&] { return !warnings_.empty() && warnings_.back().valid_until == time + valid && ros::Time::now() == time; });
}

void GuardProbe::tick(double seconds) { publishClock(time_ + ros::Duration(seconds)); }

void GuardProbe::publishClock(ros::Time time) {
  time_ = time;
  rosgraph_msgs::Clock clock;
  clock.clock = time;
  clock_publisher_.publish(clock);
}

void GuardProbe::placeFrame(const std::string& frame, const Eigen::Isometry3d& X_WF) {
  tf2_msgs::TFMessage message;
  message.transforms.push_back(tf2::eigenToTransform(X_WF));
  message.transforms[0].header.frame_id = "world";
  message.transforms[0].header.stamp = time_;
  message.transforms[0].child_frame_id = frame;
  tf_publisher_.publish(message);
}

void GuardProbe::place(const sweep_guard::DeformableMesh& mesh) {
  publish(mesh);
  const geometry_msgs::Point& first = mesh.mesh.vertices.front();
  awaitPlaced(mesh.id, {first.x, first.y, first.z}, mesh.header);
}

void GuardProbe::place(const sweep_guard::MeshVertices& vertices) {
  publish(vertices);
  awaitPlaced(vertices.id, {vertices.positions[0], vertices.positions[1], vertices.positions[2]}, vertices.header);
}

void GuardProbe::awaitPlaced(const std::string& id, const Eigen::Vector3d& first_vertex,
                             const std_msgs::Header& header) {
  sweep_guard::CheckSweep::Request request;
  request.path = {poseAt(first_vertex, header.stamp)};
  request.path[0].header.frame_id = header.frame_id;
  request.mesh_ids = {id};
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < deadline) {
    const auto response = check(request);
    if (!response.objects.empty() && response.objects[0].mesh_stamp == header.stamp) return;
  }
  throw std::runtime_error("waited in vain for workpiece " + id);
}

void GuardProbe::remove(const std::string& mesh_id) {
  sweep_guard::DeformableMesh nothing;
  nothing.id = mesh_id;
  publish(nothing);
  sweep_guard::CheckSweep::Request request;
  request.path = {poseAt({0.0, 0.0, 0.0}, ros::Time())};
  request.mesh_ids = {mesh_id};
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (check(request).success) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("workpiece " + mesh_id + " stays");
  }
}

sweep_guard::Contacts GuardProbe::move(const geometry_msgs::PoseStamped& pose) {
  forgetContacts();
  publish(pose);
  return awaitContacts(1).front();
}

sweep_guard::Warning GuardProbe::awaitWarning(const Fits& fits) {
  sweep_guard::Warning found;
  await("a warning", [&] {
    while (next_warning_ < warnings_.size()) {
      found = warnings_[next_warning_++];
      if (fits(found)) return true;
    }
    return false;
  });
  return found;
}

void GuardProbe::skipWarnings() {
  const std::lock_guard lock(mutex_);
  next_warning_ = warnings_.size();
}

visualization_msgs::MarkerArray GuardProbe::awaitMarkers(const MarkersFit& fit) {
  await("markers", [&] { return fit(markers_); });
  const std::lock_guard lock(mutex_);
  return markers_;
}

std::vector<sweep_guard::Warning> GuardProbe::warnings() const {
  const std::lock_guard lock(mutex_);
  return warnings_;
}

std::vector<sweep_guard::Contacts> GuardProbe::awaitContacts(size_t count) {
  await("contacts", [&] { return contacts_.size() >= count; });
  const std::lock_guard lock(mutex_);
  return contacts_;
}

void GuardProbe::forgetContacts() {
  const std::lock_guard lock(mutex_);
  contacts_.clear();
}

sweep_guard::CheckSweep::Response GuardProbe::check(sweep_guard::CheckSweep::Request request) {
  sweep_guard::CheckSweep::Response response;
  if (!check_sweep_.call(request, response)) throw std::runtime_error("~check_sweep does not answer");
  return response;
}

geometry_msgs::PoseStamped poseAt(const Eigen::Vector3d& tip_W, ros::Time stamp, const Eigen::Quaterniond& rotation) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "world";
  pose.header.stamp = stamp;
  pose.pose.position.x = tip_W.x();
  pose.pose.position.y = tip_W.y();
  pose.pose.position.z = tip_W.z();
  pose.pose.orientation.w = rotation.w();
  pose.pose.orientation.x = rotation.x();
  pose.pose.orientation.y = rotation.y();
  pose.pose.orientation.z = rotation.z();
  return pose;
}

sweep_guard::DeformableMesh sheetAt(const std::string& id, const Eigen::Vector3d& center, ros::Time stamp,
                                    double half_side) {
  sweep_guard::DeformableMesh mesh;
  mesh.header.frame_id = "world";
  mesh.header.stamp = stamp;
  mesh.id = id;
  mesh.revision = 1;
  for (const Eigen::Vector3d& corner : sheetCorners(center, half_side)) {
    geometry_msgs::Point point;
    point.x = corner.x();
    point.y = corner.y();
    point.z = corner.z();
    mesh.mesh.vertices.push_back(point);
  }
  mesh.mesh.triangles.resize(2);
  mesh.mesh.triangles[0].vertex_indices = {0, 1, 2};
  mesh.mesh.triangles[1].vertex_indices = {0, 2, 3};
  return mesh;
}

sweep_guard::MeshVertices sheetMovedTo(const std::string& id, const Eigen::Vector3d& center, ros::Time stamp,
                                       double half_side) {
  sweep_guard::MeshVertices vertices;
  vertices.header.frame_id = "world";
  vertices.header.stamp = stamp;
  vertices.id = id;
  vertices.revision = 1;
  for (const Eigen::Vector3d& corner : sheetCorners(center, half_side)) {
    for (const double coordinate : corner) vertices.positions.push_back(static_cast<float>(coordinate));
  }
  return vertices;
}

}  // namespace sweep_guard_ros
