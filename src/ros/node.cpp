#include "sweep_guard/ros/node.h"

#include <ros/console.h>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kPosesQueued = 4096;            // 4 s at 1 kHz; by then the poses are stale, and the warning says so
constexpr std::uint32_t kContactsQueued = 1000;  // of 1 s at 1 kHz
constexpr auto kWatchPeriod = std::chrono::milliseconds(10);    // how late a silent input may be noticed
constexpr auto kWarningPeriod = std::chrono::milliseconds(45);  // with the watch's: 20 Hz at least
constexpr auto kWarningValid = std::chrono::milliseconds(200);
constexpr auto kClockJump = std::chrono::milliseconds(100);

ros::WallDuration wall(sweep_guard::Duration duration) { return ros::WallDuration(sweep_guard::toSeconds(duration)); }

sweep_guard::GuardOptions guardOptions(const Parameters& parameters) {
  sweep_guard::GuardOptions options;
  options.sweep = parameters.sweep;
  options.horizon.reserve = parameters.limits.pose_timeout;
  return options;
}

}  // namespace

SweepGuardNode::SweepGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : parameters_(loadParameters(private_node)),
      contacts_publisher_(ros::NodeHandle(private_node).advertise<sweep_guard::Contacts>("contacts", kContactsQueued)),
      warning_publisher_(ros::NodeHandle(private_node).advertise<sweep_guard::Warning>("warning", 10)),
      marker_publisher_(ros::NodeHandle(private_node).advertise<visualization_msgs::MarkerArray>("markers", 1)),
      ledger_(parameters_.limits, [this] { warn(/*only_on_change=*/true); }),
      guard_(parameters_.tool(), sweep_guard::makeDetector(parameters_.detector, parameters_.cull),
             guardOptions(parameters_)),
      workpieces_(parameters_.max_triangles, ledger_),
      poses_(node, parameters_, frames_, workpieces_, ledger_, [this](PlacedPose pose) { enqueue(std::move(pose)); }),
      meshes_(node, workpieces_),
      check_sweep_(private_node, parameters_, frames_, workpieces_),
      diagnostics_(node, private_node, parameters_, {poses_, meshes_, workpieces_, ledger_, workload_}),
      markers_(parameters_.fixed_frame, guard_.tool()) {
  warning_timer_ =
      warning_thread_.on(node).createSteadyTimer(wall(kWatchPeriod), [this](const ros::SteadyTimerEvent&) { watch(); });
  marker_timer_ = report_thread_.on(node).createSteadyTimer(ros::WallDuration(1.0 / parameters_.marker_rate),
                                                            [this](const ros::SteadyTimerEvent&) { publishMarkers(); });
  diagnostics_timer_ = report_thread_.on(node).createSteadyTimer(
      ros::WallDuration(1.0), [this](const ros::SteadyTimerEvent&) { diagnostics_.publish(); });

  sweeping_thread_ = std::thread([this] { sweepPoses(); });
  warning_thread_.start();
  meshes_.start();
  poses_.start();
  check_sweep_.start();
  report_thread_.start();
  ROS_INFO("guarding '%s' in '%s' by %s, %s; poses from %s, meshes from %s and %s", parameters_.tool_frame.c_str(),
           parameters_.fixed_frame.c_str(), parameters_.detector.c_str(),
           sweep_guard::nameOf(parameters_.sweep.volume).c_str(), poses_.source().c_str(), meshes_.meshTopic().c_str(),
           meshes_.verticesTopic().c_str());
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
    const bool newest = queue_.empty();
    lock.unlock();
    queue_changed_.notify_all();
    try {
      sweep(pose);
      const sweep_guard::Duration waited = std::chrono::steady_clock::now() - predicted_;
      if (newest || waited >= sweep_guard::GuardOptions().cycle) lookAhead(pose);
    } catch (const std::exception& error) {  // no memory for the report or its messages
      ledger_.fault(sweep_guard::kDetectorFault, std::string("sweeping failed: ") + error.what());
    }
  }
}

void SweepGuardNode::sweep(const PlacedPose& placed) {
  const sweep_guard::ToolPose& pose = placed.pose;
  if (placed.came.epoch != ledger_.mark().epoch) return;  // time has gone back since it came
  if (placed.came.epoch != guard_epoch_) guard_.forget();
  guard_epoch_ = placed.came.epoch;

  const sweep_guard::SteadyTime begin = std::chrono::steady_clock::now();
  auto report = std::make_shared<const sweep_guard::SweepReport>(guard_.sweep(pose, workpieces_.snapshot()));
  const sweep_guard::SteadyTime swept = std::chrono::steady_clock::now();
  if (!report->objects.empty()) publishContacts(*report);
  ledger_.swept(*report, {pose.stamp, pose.received}, placed.came, swept);
  warn(/*only_on_change=*/true);

  workload_.swept(std::chrono::steady_clock::now() - pose.received, swept - begin, report->failures.size());
  for (const auto& failure : report->failures) log_.error(failure.workpiece->id, "detection failed: " + failure.reason);
  const std::lock_guard lock(scene_mutex_);
  scene_.X_WT = pose.X_WT;
  scene_.newest = report;
  if (report->contact()) scene_.contact = report;
}

void SweepGuardNode::lookAhead(const PlacedPose& placed) {
  if (placed.came.epoch != guard_epoch_) return;
  const sweep_guard::Seen seen{placed.pose.stamp, placed.pose.received};
  ledger_.predicted(guard_.lookAhead(age(seen, now()), workpieces_.snapshot()), seen, placed.came, now());
  predicted_ = std::chrono::steady_clock::now();
  warn(/*only_on_change=*/true);
}

void SweepGuardNode::publishContacts(const sweep_guard::SweepReport& report) {
  sweep_guard::Contacts contacts = toMsg(report);
  contacts.header.frame_id = parameters_.fixed_frame;
  contacts.tool = parameters_.tool_frame;
  contacts.volume = sweep_guard::nameOf(parameters_.sweep.volume);
  contacts_publisher_.publish(contacts);
}

void SweepGuardNode::watch() {
  watchClock();
  const bool due = std::chrono::steady_clock::now() - warned_.load() >= kWarningPeriod;
  warn(/*only_on_change=*/!due);
}

// Clocks that go back (a bag that loops, a simulation that starts again) make every stamp of before meaningless.
void SweepGuardNode::watchClock() {
  const sweep_guard::Time stamp = now().stamp;
  if (stamp + kClockJump < clock_seen_) {
    ROS_WARN("ROS time went back by %.2f s: poses are forgotten, workpieces that may go stale are",
             sweep_guard::toSeconds(clock_seen_ - stamp));
    ledger_.timeJumped("time went back");
    workpieces_.timeJumped();
  }
  clock_seen_ = stamp;
}

void SweepGuardNode::warn(bool only_on_change) {
  const std::lock_guard lock(warning_mutex_);
  const sweep_guard::Instant at = now();
  sweep_guard::Warning next = toMsg(ledger_.verdict(at));
  const bool new_level = next.level != warning_.level;
  if (only_on_change && !new_level && next.reasons == warning_.reasons) return;
  next.header.frame_id = parameters_.fixed_frame;
  next.tool = parameters_.tool_frame;
  next.sequence = warning_.sequence + (new_level ? 1 : 0);
  next.level_counts = warning_.level_counts;
  if (new_level) ++next.level_counts[next.level];
  next.valid_until = toMsg(at.stamp + kWarningValid);
  warning_ = next;
  warned_ = at.steady;
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
