#include "sweep_guard/ros/node.h"

#include <ros/console.h>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kPosesQueued = 4096;  // 4 s at 1 kHz; by then the poses are stale, and the warning says so
constexpr auto kWatchPeriod = std::chrono::milliseconds(10);  // how late a silent input may be noticed
constexpr int kWatchesPerWarning = 5;
constexpr auto kWarningValid = std::chrono::milliseconds(200);
constexpr auto kClockJump = std::chrono::milliseconds(100);
constexpr std::uint32_t kMendedByASweep = sweep_guard::kPoseInvalid | sweep_guard::kOutOfOrder |
                                          sweep_guard::kFutureStamp | sweep_guard::kTfFail | sweep_guard::kTimeJump |
                                          sweep_guard::kDetectorFault;

ros::WallDuration wall(sweep_guard::Duration duration) { return ros::WallDuration(sweep_guard::toSeconds(duration)); }

}  // namespace

SweepGuardNode::SweepGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : parameters_(loadParameters(private_node)),
      contacts_publisher_(ros::NodeHandle(private_node).advertise<sweep_guard::Contacts>("contacts", 1000)),
      warning_publisher_(ros::NodeHandle(private_node).advertise<sweep_guard::Warning>("warning", 10)),
      marker_publisher_(ros::NodeHandle(private_node).advertise<visualization_msgs::MarkerArray>("markers", 1)),
      ledger_(parameters_.limits),
      guard_(parameters_.tool(), sweep_guard::makeDetector(parameters_.detector, parameters_.cull), parameters_.sweep),
      workpieces_(parameters_.max_triangles, ledger_),
      poses_(node, parameters_, frames_, workpieces_, ledger_, [this](PlacedPose pose) { enqueue(std::move(pose)); }),
      check_sweep_(private_node, parameters_, frames_, workpieces_),
      diagnostics_(node, private_node, parameters_, poses_, workpieces_, ledger_, workload_),
      markers_(parameters_.fixed_frame, guard_.tool()) {
  warning_.tool = parameters_.tool_frame;
  warning_.header.frame_id = parameters_.fixed_frame;

  const auto hints = ros::TransportHints().tcpNoDelay();
  ros::NodeHandle mesh_node = mesh_thread_.on(node);
  mesh_subscriber_ = mesh_node.subscribe<sweep_guard::DeformableMesh>(
      "mesh", 10, [this](const sweep_guard::DeformableMesh::ConstPtr& msg) { workpieces_.accept(*msg); }, nullptr,
      hints);
  vertices_subscriber_ = mesh_node.subscribe<sweep_guard::MeshVertices>(
      "mesh_vertices", 10, [this](const sweep_guard::MeshVertices::ConstPtr& msg) { workpieces_.accept(*msg); },
      nullptr, hints);

  warning_timer_ =
      warning_thread_.on(node).createSteadyTimer(wall(kWatchPeriod), [this](const ros::SteadyTimerEvent&) { watch(); });
  marker_timer_ = report_thread_.on(node).createSteadyTimer(ros::WallDuration(1.0 / parameters_.marker_rate),
                                                            [this](const ros::SteadyTimerEvent&) { publishMarkers(); });
  diagnostics_timer_ = report_thread_.on(node).createSteadyTimer(
      ros::WallDuration(1.0), [this](const ros::SteadyTimerEvent&) { diagnostics_.publish(); });

  sweeping_thread_ = std::thread([this] { sweepPoses(); });
  warning_thread_.start();
  mesh_thread_.start();
  poses_.start();
  check_sweep_.start();
  report_thread_.start();
  ROS_INFO("guarding '%s' in '%s' by %s, %s; poses from %s, meshes from %s and %s", parameters_.tool_frame.c_str(),
           parameters_.fixed_frame.c_str(), parameters_.detector.c_str(),
           sweep_guard::nameOf(parameters_.sweep.volume).c_str(), poses_.source().c_str(),
           mesh_subscriber_.getTopic().c_str(), vertices_subscriber_.getTopic().c_str());
}

SweepGuardNode::~SweepGuardNode() {
  {
    const std::lock_guard lock(queue_mutex_);
    stopping_ = true;
  }
  queue_changed_.notify_all();
  sweeping_thread_.join();
}

void SweepGuardNode::enqueue(PlacedPose pose) {
  std::unique_lock lock(queue_mutex_);
  queue_changed_.wait(lock, [this] { return stopping_ || queue_.size() < kPosesQueued; });
  queue_.push_back(std::move(pose));
  lock.unlock();
  queue_changed_.notify_all();
}

void SweepGuardNode::sweepPoses() {
  while (true) {
    std::unique_lock lock(queue_mutex_);
    queue_changed_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
    if (stopping_) return;
    const PlacedPose pose = std::move(queue_.front());
    queue_.pop_front();
    lock.unlock();
    queue_changed_.notify_all();
    sweep(pose);
    warn(/*only_on_change=*/true);
  }
}

void SweepGuardNode::sweep(const PlacedPose& pose) {
  if (pose.epoch != epoch_) return;  // time has gone back since it came
  if (pose.epoch != guard_epoch_) guard_.forget();
  guard_epoch_ = pose.epoch;
  try {
    const sweep_guard::SteadyTime begin = std::chrono::steady_clock::now();
    sweep_guard::SweepReport report = guard_.sweep(pose.tool, workpieces_.snapshot());
    const sweep_guard::SteadyTime end = std::chrono::steady_clock::now();
    this->report(pose, std::move(report));
    workload_.swept(end - pose.tool.received, end - begin);
  } catch (
      const std::exception& error) {  // a detector that failed, or no memory: the next pose sweeps this interval too
    workload_.failed();
    ledger_.fault(sweep_guard::kDetectorFault, std::string("detector failed: ") + error.what());
    ROS_ERROR_THROTTLE(1.0, "detector failed: %s", error.what());
  }
}

void SweepGuardNode::report(const PlacedPose& pose, sweep_guard::SweepReport report) {
  if (!report.objects.empty()) {
    sweep_guard::Contacts contacts = toMsg(report);
    contacts.header.frame_id = parameters_.fixed_frame;
    contacts.tool = parameters_.tool_frame;
    contacts.volume = sweep_guard::nameOf(parameters_.sweep.volume);
    contacts_publisher_.publish(contacts);
  }
  ledger_.swept(report, {pose.tool.stamp, pose.tool.received}, std::chrono::steady_clock::now());
  ledger_.mend(kMendedByASweep, pose.faults_before);

  auto shared = std::make_shared<const sweep_guard::SweepReport>(std::move(report));
  const std::lock_guard lock(scene_mutex_);
  scene_.X_WT = pose.X_WT;
  scene_.newest = shared;
  if (shared->contact()) scene_.contact = shared;
}

// Clocks that go back (a bag that loops, a simulation that starts again) make every stamp of before meaningless.
void SweepGuardNode::watchClock() {
  const sweep_guard::Time stamp = now().stamp;
  if (stamp + kClockJump < clock_seen_) {
    ROS_WARN("ROS time went back by %.2f s: poses are forgotten, workpieces are stale",
             sweep_guard::toSeconds(clock_seen_ - stamp));
    ledger_.timeJumped("time went back");
    workpieces_.timeJumped();
    poses_.timeJumped();
    ++epoch_;
  }
  clock_seen_ = stamp;
}

void SweepGuardNode::watch() {
  watchClock();
  warn(/*only_on_change=*/watches_++ % kWatchesPerWarning != 0);
}

void SweepGuardNode::warn(bool only_on_change) {
  const std::lock_guard lock(warning_mutex_);
  const sweep_guard::Instant at = now();
  sweep_guard::Warning next = toMsg(ledger_.verdict(at));
  const bool new_level = next.level != warning_.level;
  if (only_on_change && !new_level && next.reasons == warning_.reasons) return;
  next.header = warning_.header;
  next.header.stamp = next.covered_until;
  next.tool = warning_.tool;
  next.sequence = warning_.sequence + (new_level ? 1 : 0);
  next.level_counts = warning_.level_counts;
  if (new_level) ++next.level_counts[next.level];
  next.valid_until = toMsg(at.stamp + kWarningValid);
  warning_ = next;
  warning_publisher_.publish(next);
}

void SweepGuardNode::publishMarkers() {
  if (marker_publisher_.getNumSubscribers() == 0) return;
  MarkerScene scene;
  {
    const std::lock_guard lock(scene_mutex_);
    scene = scene_;
  }
  scene.verdict = ledger_.verdict(now());
  marker_publisher_.publish(markers_.draw(scene));
}

}  // namespace sweep_guard_ros
