#include "guard_probe.h"

#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "common/xyz.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kTimeout = std::chrono::seconds(20);
constexpr auto kGivenUp = std::chrono::milliseconds(400);  // the guard gives a change up after 500 ms at least
const ros::Duration kValid(0.2);                           // of a warning, from when it was sent

GuardProbe::Flag arrived(const std_msgs::Bool& flag) { return {flag.data != 0, std::chrono::steady_clock::now()}; }

template <typename Message>
Message firstRevision(const std::string& id, ros::Time stamp) {
  Message message;
  message.header.frame_id = "world";
  message.header.stamp = stamp;
  message.id = id;
  message.revision = 1;
  return message;
}

std::vector<Eigen::Vector3d> squareCorners(const Eigen::Vector3d& center, double half_side) {
  std::vector<Eigen::Vector3d> corners;
  for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
    corners.emplace_back(center + half_side * Eigen::Vector3d(x, y, 0.0));
  }
  return corners;
}

}  // namespace

GuardProbe::GuardProbe(bool drives_clock, ProbeSource pose_source) : time_(drives_clock ? 1000.0 : 0.0) {
  const auto wake = [this](const ros::SingleSubscriberPublisher&) { changed_.notify_all(); };
  pose_publisher_ = node_.advertise<geometry_msgs::PoseStamped>("tool_pose", 10000, wake);
  mesh_publisher_ = node_.advertise<sweep_guard::DeformableMesh>("mesh", 100, wake);
  vertices_publisher_ = node_.advertise<sweep_guard::MeshVertices>("mesh_vertices", 100, wake);
  tf_publisher_ = node_.advertise<tf2_msgs::TFMessage>("/tf", 100, wake);
  listen<sweep_guard::Warning>("warning", [this](const auto& warning) { warnings_.push_back(warning); });
  listen<sweep_guard::Contacts>("contacts", [this](const auto& contacts) { contacts_.push_back(contacts); });
  listen<sweep_guard::Prediction>("prediction", [this](const auto& next) { predictions_.push_back(next); });
  listen<std_msgs::Float64>("time_to_collision", [this](const auto& t) { times_to_collision_.push_back(t.data); });
  listen<std_msgs::Bool>("reflex_warning", [this](const auto& flag) { reflex_flags_.push_back(arrived(flag)); });
  listen<std_msgs::Bool>("considered_warning",
                         [this](const auto& flag) { considered_flags_.push_back(arrived(flag)); });
  listen<visualization_msgs::MarkerArray>("markers", [this](const auto& markers) { markers_.push_back(markers); });
  listen<dynamic_reconfigure::Config>("parameter_updates", [this](const auto& next) { configuration_ = next; });
  listen<diagnostic_msgs::DiagnosticArray>("/diagnostics", [this](const auto& diagnostics) {
    statuses_.insert(statuses_.end(), diagnostics.status.begin(), diagnostics.status.end());
  });
  if (drives_clock) clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10, /*latch=*/true);
  check_sweep_ = node_.serviceClient<sweep_guard::CheckSweep>("/sweep_guard/check_sweep");
  predict_ = node_.serviceClient<sweep_guard::Predict>("/sweep_guard/predict");
  acknowledge_ = node_.serviceClient<sweep_guard::Acknowledge>("/sweep_guard/acknowledge");
  enable_ = node_.serviceClient<std_srvs::SetBool>("/sweep_guard/enable");
  reset_ = node_.serviceClient<std_srvs::Trigger>("/sweep_guard/reset");
  configure_ = node_.serviceClient<dynamic_reconfigure::Reconfigure>("/sweep_guard/set_parameters");
  spinner_.start();
  const auto heard = [](const ros::Subscriber& subscriber) { return subscriber.getNumPublishers() > 0; };
  await("the guard's connections", [&] {
    return (pose_source == ProbeSource::kTf || pose_publisher_.getNumSubscribers() > 0) &&
           mesh_publisher_.getNumSubscribers() > 0 && vertices_publisher_.getNumSubscribers() > 0 &&
           tf_publisher_.getNumSubscribers() > 0 && std::all_of(subscribers_.begin(), subscribers_.end(), heard) &&
           !warnings_.empty() && !configuration_.doubles.empty() && check_sweep_.exists() && predict_.exists() &&
           acknowledge_.exists() && enable_.exists() && reset_.exists() && configure_.exists();
  });
  if (drives_clock) setClock(time_);  // latched: a guard that connects later sees it too
}

template <typename Message, typename Take>
void GuardProbe::listen(const std::string& topic, Take take) {
  subscribers_.push_back(node_.subscribe<Message>(
      ros::names::resolve("/sweep_guard", topic), 10000,
      [this, take](const typename Message::ConstPtr& message) {
        const std::lock_guard lock(mutex_);
        take(*message);
        changed_.notify_all();
      },
      nullptr, ros::TransportHints().tcpNoDelay()));
}

template <typename Condition>
void GuardProbe::await(const std::string& what, Condition&& condition) const {
  std::unique_lock lock(mutex_);
  if (!changed_.wait_for(lock, kTimeout, condition)) throw std::runtime_error("timeout: waited for " + what);
}

void GuardProbe::setClock(ros::Time time) {
  const bool goes_back = time + ros::Duration(0.1) < time_;
  const std::uint32_t noticed = sweep_guard::Warning::TIME_JUMP | sweep_guard::Warning::DISABLED;
  publishClock(time);
  await("the guard to see the clock", [&] {
    const sweep_guard::Warning& newest = warnings_.back();
    return newest.valid_until == time + kValid && ros::Time::now() == time &&
           (!goes_back || (newest.reasons & noticed) != 0);
  });
}

void GuardProbe::tick(double seconds) {
  publishClock(time_ + ros::Duration(seconds));
  const ros::Time seen_by_now = time_ - ros::Duration(0.04);
  await("the guard to keep up with the clock", [&] { return warnings_.back().valid_until - kValid >= seen_by_now; });
}

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

template <typename Condition>
void GuardProbe::awaitAnswer(const std::string& what, const sweep_guard::CheckSweep::Request& request,
                             const Condition& fits) {
  const auto deadline = std::chrono::steady_clock::now() + kTimeout;
  while (!fits(check(request))) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("no answer shows " + what);
  }
}

void GuardProbe::awaitPlaced(const std::string& id, const Eigen::Vector3d& first_vertex,
                             const std_msgs::Header& header) {
  sweep_guard::CheckSweep::Request request;
  request.path = {poseAt(first_vertex, header.stamp)};
  request.path[0].header.frame_id = header.frame_id;
  request.mesh_ids = {id};
  awaitAnswer("workpiece " + id, request, [&](const auto& response) {
    return !response.objects.empty() && response.objects[0].mesh_stamp == header.stamp;
  });
}

void GuardProbe::remove(const std::string& mesh_id) {
  sweep_guard::DeformableMesh nothing;
  nothing.id = mesh_id;
  publish(nothing);
  sweep_guard::CheckSweep::Request request = requestAlong({Eigen::Vector3d::Zero()});
  request.mesh_ids = {mesh_id};
  awaitAnswer("the end of workpiece " + mesh_id, request, [](const auto& response) { return !response.success; });
}

sweep_guard::Contacts GuardProbe::move(const geometry_msgs::PoseStamped& pose) {
  forgetContacts();
  publish(pose);
  return awaitContacts(1).front();
}

template <typename Value>
Value GuardProbe::copyOf(const Value& value) const {
  const std::lock_guard lock(mutex_);
  return value;
}

template <typename Message, typename Condition>
Message GuardProbe::awaitNext(const std::string& what, const std::vector<Message>& messages, size_t& next,
                              const Condition& fits) const {
  Message found;
  await(what, [&] {
    while (next < messages.size()) {
      found = messages[next++];
      if (fits(found)) return true;
    }
    return false;
  });
  return found;
}

sweep_guard::Warning GuardProbe::awaitWarning(const Fits& fits) {
  return awaitNext("a warning", warnings_, next_warning_, fits);
}

void GuardProbe::skipWarnings() {
  const std::lock_guard lock(mutex_);
  next_warning_ = warnings_.size();
}

visualization_msgs::MarkerArray GuardProbe::awaitMarkers(const MarkersFit& fit) {
  return awaitNext("markers", markers_, next_markers_, fit);
}

std::vector<sweep_guard::Warning> GuardProbe::warnings() const { return copyOf(warnings_); }

std::vector<sweep_guard::Contacts> GuardProbe::awaitContacts(size_t count) {
  await("contacts", [&] { return contacts_.size() >= count; });
  return copyOf(contacts_);
}

std::vector<sweep_guard::Contacts> GuardProbe::awaitContactsUpTo(ros::Time stamp) {
  await("contacts up to a pose", [&] { return !contacts_.empty() && contacts_.back().header.stamp >= stamp; });
  return copyOf(contacts_);
}

void GuardProbe::forgetContacts() {
  const std::lock_guard lock(mutex_);
  contacts_.clear();
}

sweep_guard::Prediction GuardProbe::awaitPrediction(ros::Time stamp) const {
  sweep_guard::Prediction found;
  await("a prediction", [&] {
    if (predictions_.size() != times_to_collision_.size()) return false;
    const auto fits = [&](const sweep_guard::Prediction& prediction) { return prediction.header.stamp == stamp; };
    const auto newest = std::find_if(predictions_.rbegin(), predictions_.rend(), fits);
    if (newest == predictions_.rend()) return false;
    found = *newest;
    return true;
  });
  return found;
}

std::vector<double> GuardProbe::timesToCollision() const { return copyOf(times_to_collision_); }

std::vector<sweep_guard::Prediction> GuardProbe::predictions() const { return copyOf(predictions_); }

// A prediction and its time arrive one after the other. Forgetting half of a pair would leave lists of unequal lengths.
void GuardProbe::forgetPredictions() {
  await("the time to collision of each prediction", [&] {
    if (predictions_.size() != times_to_collision_.size()) return false;
    predictions_.clear();
    times_to_collision_.clear();
    return true;
  });
}

std::vector<GuardProbe::Flag> GuardProbe::awaitReflexFlags(size_t count) const {
  await("reflex flags", [&] { return reflex_flags_.size() >= count; });
  return copyOf(reflex_flags_);
}

std::vector<GuardProbe::Flag> GuardProbe::awaitConsideredFlags(size_t count) const {
  await("considered flags", [&] { return considered_flags_.size() >= count; });
  return copyOf(considered_flags_);
}

sweep_guard::Predict::Response GuardProbe::predict(double horizon) {
  sweep_guard::Predict::Request request;
  request.horizon = ros::Duration(horizon);
  sweep_guard::Predict::Response response;
  if (!predict_.call(request, response)) throw std::runtime_error("~predict does not answer");
  return response;
}

sweep_guard::CheckSweep::Response GuardProbe::check(sweep_guard::CheckSweep::Request request) {
  sweep_guard::CheckSweep::Response response;
  // roscpp drops an answer if the end of the connection is noticed first, which happens on a busy machine.
  for (int attempt = 0; attempt < 5; ++attempt) {
    if (check_sweep_.call(request, response)) return response;
  }
  throw std::runtime_error("~check_sweep does not answer");
}

sweep_guard::Acknowledge::Response GuardProbe::acknowledge(const std::string& mesh_id) {
  sweep_guard::Acknowledge service;
  service.request.mesh_id = mesh_id;
  if (!acknowledge_.call(service)) throw std::runtime_error("~acknowledge does not answer");
  return service.response;
}

std_srvs::SetBool::Response GuardProbe::enable(bool enabled) {
  std_srvs::SetBool service;
  service.request.data = enabled;
  if (!enable_.call(service)) throw std::runtime_error("~enable does not answer");
  return service.response;
}

std_srvs::Trigger::Response GuardProbe::reset() {
  std_srvs::Trigger service;
  if (!reset_.call(service)) throw std::runtime_error("~reset does not answer");
  return service.response;
}

// A call that a busy machine gave up is repeated: a refusal takes less.
bool GuardProbe::configure(const dynamic_reconfigure::Config& changes) {
  dynamic_reconfigure::Reconfigure service;
  service.request.config = changes;
  const auto give_up = std::chrono::steady_clock::now() + kTimeout;
  while (true) {
    const auto begin = std::chrono::steady_clock::now();
    if (configure_.call(service)) return true;
    const auto end = std::chrono::steady_clock::now();
    if (end - begin < kGivenUp || end > give_up) return false;
  }
}

dynamic_reconfigure::Config GuardProbe::configuration() const { return copyOf(configuration_); }

GuardProbe::Status GuardProbe::awaitStatus(const std::string& name, const std::function<bool(const Status&)>& fits) {
  size_t next = copyOf(statuses_).size();
  return awaitNext("a status of " + name, statuses_, next, [&](const Status& status) {
    return status.name.substr(status.name.find(": ") + 2) == name && fits(status);
  });
}

size_t GuardProbe::markersReceived() const { return copyOf(markers_).size(); }

bool endToEnd(const std::vector<sweep_guard::Contacts>& contacts) {
  const auto apart = [](const auto& one, const auto& next) { return next.interval_start != one.header.stamp; };
  return std::adjacent_find(contacts.begin(), contacts.end(), apart) == contacts.end();
}

size_t contactCount(const std::vector<sweep_guard::Contacts>& contacts) {
  size_t count = 0;
  for (const sweep_guard::Contacts& one : contacts) count += one.objects.size();
  return count;
}

std::string valueOf(const diagnostic_msgs::DiagnosticStatus& status, const std::string& key) {
  for (const auto& value : status.values) {
    if (value.key == key) return value.value;
  }
  return "";
}

geometry_msgs::PoseStamped poseAt(const Eigen::Vector3d& tip_W, ros::Time stamp, const Eigen::Quaterniond& rotation) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "world";
  pose.header.stamp = stamp;
  pose.pose.position = tf2::toMsg(tip_W);
  pose.pose.orientation = tf2::toMsg(rotation);
  return pose;
}

sweep_guard::CheckSweep::Request requestAlong(const std::vector<Eigen::Vector3d>& tips_W) {
  sweep_guard::CheckSweep::Request request;
  for (const Eigen::Vector3d& tip_W : tips_W) request.path.push_back(poseAt(tip_W, ros::Time()));
  return request;
}

sweep_guard::DeformableMesh squareAt(const std::string& id, const Eigen::Vector3d& center, ros::Time stamp,
                                     double half_side) {
  auto mesh = firstRevision<sweep_guard::DeformableMesh>(id, stamp);
  mesh.open = 1;
  for (const Eigen::Vector3d& corner : squareCorners(center, half_side)) {
    mesh.mesh.vertices.push_back(tf2::toMsg(corner));
  }
  mesh.mesh.triangles.resize(2);
  mesh.mesh.triangles[0].vertex_indices = {0, 1, 2};
  mesh.mesh.triangles[1].vertex_indices = {0, 2, 3};
  return mesh;
}

sweep_guard::MeshVertices squareMovedTo(const std::string& id, const Eigen::Vector3d& center, ros::Time stamp,
                                        double half_side) {
  auto vertices = firstRevision<sweep_guard::MeshVertices>(id, stamp);
  for (const Eigen::Vector3d& corner : squareCorners(center, half_side)) {
    for (const double coordinate : sweep_guard_core::xyz(corner))
      vertices.positions.push_back(static_cast<float>(coordinate));
  }
  return vertices;
}

}  // namespace sweep_guard_ros
