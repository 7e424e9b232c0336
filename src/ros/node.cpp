#include "sweep_guard/ros/node.h"

#include <ros/console.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>

#include <algorithm>
#include <boost/make_shared.hpp>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"
#include "sweep_guard/ros/real_time.h"

namespace sweep_guard_ros {
namespace {

constexpr size_t kPosesQueued = 4096;            // 4 s at 1 kHz; by then the poses are stale, and the warning says so
constexpr std::uint32_t kContactsQueued = 1000;  // of 1 s at 1 kHz
constexpr std::uint32_t kPredictionsQueued = 100;
constexpr size_t kTasksQueued = 16;
constexpr auto kWatchPeriod = std::chrono::milliseconds(10);    // how late a silent input may be noticed
constexpr auto kWarningPeriod = std::chrono::milliseconds(45);  // with the watch's: 20 Hz at least
constexpr auto kWarningValid = std::chrono::milliseconds(200);
constexpr auto kReflexPeriod = std::chrono::milliseconds(100);
constexpr auto kConsideredPeriod = std::chrono::seconds(1);
constexpr auto kViewPeriod = std::chrono::microseconds(16667);
constexpr auto kClockJump = std::chrono::milliseconds(100);

template <typename Message>
ros::Publisher advertise(ros::NodeHandle private_node, const std::string& topic, std::uint32_t queued) {
  return private_node.advertise<Message>(topic, queued);
}

std_msgs::Bool flagMessage(bool raised) {
  std_msgs::Bool msg;
  msg.data = raised;
  return msg;
}

// A pose that is passed is swept where the next one is.
bool knowsAllFramesOf(const PlacedPose& placed, const PlacedPose& next) {
  const auto& frames = placed.pose.X_WM;
  return std::all_of(frames.begin(), frames.end(),
                     [&](const auto& frame) { return next.pose.X_WM.count(frame.first) != 0; });
}

ros::WallDuration wall(sweep_guard::Duration duration) { return ros::WallDuration(sweep_guard::toSeconds(duration)); }

}  // namespace

SweepGuardNode::SweepGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : parameters_(loadParameters(private_node)),
      contacts_publisher_(advertise<sweep_guard::Contacts>(private_node, "contacts", kContactsQueued)),
      prediction_publisher_(advertise<sweep_guard::Prediction>(private_node, "prediction", kPredictionsQueued)),
      time_to_collision_publisher_(advertise<std_msgs::Float64>(private_node, "time_to_collision", kPredictionsQueued)),
      warning_publisher_(advertise<sweep_guard::Warning>(private_node, "warning", 10)),
      reflex_publisher_(advertise<std_msgs::Bool>(private_node, "reflex_warning", 10)),
      considered_publisher_(advertise<std_msgs::Bool>(private_node, "considered_warning", 10)),
      marker_publisher_(advertise<visualization_msgs::MarkerArray>(private_node, "markers", 1)),
      ledger_(parameters_.initial().limits, [this] { warn(/*only_on_change=*/true); }),
      guard_(*parameters_.initial().tool,
             sweep_guard::makeDetector(parameters_.initial().detector, parameters_.initial().detector_options),
             parameters_.initial().guard),
      workpieces_(parameters_.initial().max_triangles, ledger_),
      poses_(node, parameters_.initial(), frames_, workpieces_, ledger_,
             [this](PlacedPose pose) { enqueue(std::move(pose)); }),
      meshes_(node, workpieces_),
      check_sweep_(private_node, parameters_, frames_, workpieces_),
      predict_(private_node, parameters_, workpieces_,
               [this](sweep_guard::Duration horizon) {
                 return betweenSweeps<PredictService::Answer>([this, horizon] { return forecast(horizon); });
               }),
      workload_(parameters_.initial().guard.cycle),
      markers_(parameters_.initial().fixed_frame),
      view_(private_node, parameters_.initial().fixed_frame, parameters_.initial().tool_frame,
            *parameters_.initial().tool),
      controls_(private_node, ledger_, workpieces_, [this] { reset(); }),
      tuning_(private_node, parameters_, [this](const auto& next) { adopt(next); }),
      diagnostics_(node, private_node, {parameters_, poses_, meshes_, workpieces_, ledger_, workload_, tuning_}) {
  warning_timer_ =
      warning_thread_.on(node).createSteadyTimer(wall(kWatchPeriod), [this](const ros::SteadyTimerEvent&) { watch(); });
  reflex_timer_ = warning_thread_.on(node).createSteadyTimer(wall(kReflexPeriod), [this](const ros::SteadyTimerEvent&) {
    repeat(reflex_publisher_, &sweep_guard::Warning::reflex);
  });
  considered_timer_ = warning_thread_.on(node).createSteadyTimer(
      wall(kConsideredPeriod),
      [this](const ros::SteadyTimerEvent&) { repeat(considered_publisher_, &sweep_guard::Warning::considered); });
  marker_timer_ = report_thread_.on(node).createSteadyTimer(ros::WallDuration(1.0 / parameters_.initial().marker_rate),
                                                            [this](const ros::SteadyTimerEvent&) { publishMarkers(); });
  view_timer_ = report_thread_.on(node).createSteadyTimer(wall(kViewPeriod), [this](const ros::SteadyTimerEvent&) {
    if (view_.wanted()) view_.publish(sceneNow());
  });
  diagnostics_timer_ = report_thread_.on(node).createSteadyTimer(
      ros::WallDuration(1.0), [this](const ros::SteadyTimerEvent&) { diagnostics_.publish(); });

  sweeping_thread_ = std::thread([this] { work(); });
  warning_thread_.start();
  meshes_.start();
  poses_.start();
  check_sweep_.start();
  predict_.start();
  controls_.start();
  tuning_.start();
  report_thread_.start();
  ROS_INFO("guarding '%s' (%s) in '%s' by %s, %s; poses from %s, meshes from %s and %s",
           parameters_.initial().tool_frame.c_str(), parameters_.initial().tool_story.c_str(),
           parameters_.initial().fixed_frame.c_str(), parameters_.initial().detector_story.c_str(),
           sweep_guard::nameOf(parameters_.initial().guard.sweep.volume).c_str(), poses_.source().c_str(),
           meshes_.meshTopic().c_str(), meshes_.verticesTopic().c_str());
}

SweepGuardNode::~SweepGuardNode() {
  {
    const std::lock_guard lock(queue_mutex_);
    stopping_ = true;
  }
  queue_changed_.notify_all();
  sweeping_thread_.join();
  tasks_.clear();  // whoever waits for one hears that it is not done
}

void SweepGuardNode::enqueue(PlacedPose pose) {
  if (!ledger_.counts(pose.came)) return;
  std::unique_lock lock(queue_mutex_);
  queue_changed_.wait(lock, [this] { return stopping_ || queue_.size() < kPosesQueued; });
  queue_.push_back(std::move(pose));
  lock.unlock();
  queue_changed_.notify_all();
}

// Done by the sweeping thread, which alone touches the guard.
template <typename Result>
std::future<Result> SweepGuardNode::betweenSweeps(std::function<Result()> task) {
  const auto packaged = std::make_shared<std::packaged_task<Result()>>(std::move(task));
  {
    const std::lock_guard lock(queue_mutex_);
    if (stopping_) throw sweep_guard::Error("the guard is shutting down");
    if (tasks_.size() >= kTasksQueued) throw sweep_guard::Error("the guard is busy: ask again");
    tasks_.push_back([packaged] { (*packaged)(); });
  }
  queue_changed_.notify_all();
  return packaged->get_future();
}

// What takes time is made here, and what it replaces is destroyed here: the sweeping thread only exchanges them.
void SweepGuardNode::adopt(const std::shared_ptr<const Parameters>& next) {
  const std::lock_guard alone(adopting_mutex_);
  sweep_guard::GuardChange change;
  change.options = next->guard;
  const auto before = parameters_.get();
  if (detectorsDiffer(*before, *next)) {
    change.detector = sweep_guard::makeDetector(next->detector, next->detector_options);
  }
  if (differ(*before, *next, "prediction/") || differ(*before, *next, "limits/")) {
    change.predictor.emplace(next->guard.predictor);
  }
  if (differ(*before, *next, "tool/")) change.tool = *next->tool;
  betweenSweeps<void>([&] {
    guard_.adopt(change);
    ledger_.setLimits(next->limits);
    workload_.setCycle(next->guard.cycle);
    parameters_.set(next);
  }).get();
  marker_timer_.setPeriod(ros::WallDuration(1.0 / next->marker_rate));
  warn(/*only_on_change=*/true);
}

void SweepGuardNode::reset() {
  const std::lock_guard alone(adopting_mutex_);
  sweep_guard::GuardChange change;
  change.options = parameters_.get()->guard;
  change.predictor.emplace(change.options.predictor);
  ledger_.restart();
  betweenSweeps<void>([&] {
    guard_.forget();
    guard_.adopt(change);
    passed_.clear();
    swept_.reset();
    const std::lock_guard lock(scene_mutex_);
    scene_ = {};
  }).get();
  workload_.restart();
}

void SweepGuardNode::work() {
  if (parameters_.initial().realtime_priority > 0) {
    const std::string refusal = askForRealTime(parameters_.initial().realtime_priority);
    if (!refusal.empty()) ROS_WARN("%s", refusal.c_str());
  }
  while (true) {
    std::unique_lock lock(queue_mutex_);
    queue_changed_.wait(lock, [this] { return stopping_ || !queue_.empty() || !tasks_.empty(); });
    if (stopping_) return;
    const std::deque<std::function<void()>> tasks = std::move(tasks_);
    tasks_.clear();
    const std::deque<PlacedPose> poses = std::move(queue_);
    queue_.clear();
    lock.unlock();
    queue_changed_.notify_all();
    for (const auto& task : tasks) task();
    process(poses);
  }
}

void SweepGuardNode::process(const std::deque<PlacedPose>& poses) {
  for (size_t i = 0; i < poses.size(); ++i) process(poses[i], i + 1 < poses.size() ? &poses[i + 1] : nullptr);
}

// @param next  if it waits already
void SweepGuardNode::process(const PlacedPose& placed, const PlacedPose* next) {
  if (!ledger_.counts(placed.came)) return;
  if (placed.came.epoch != guard_epoch_) {
    guard_.forget();
    passed_.clear();
  }
  guard_epoch_ = placed.came.epoch;
  try {
    if (next != nullptr && knowsAllFramesOf(placed, *next)) return pass(placed);
    sweep(placed);
    if (timeToLookAhead()) lookAhead(placed);
  } catch (const std::exception& error) {  // no memory for the report or its messages
    ledger_.fault(sweep_guard::kDetectorFault, std::string("sweeping failed: ") + error.what());
  }
}

void SweepGuardNode::pass(const PlacedPose& placed) {
  const sweep_guard::ToolPose& pose = placed.pose;
  guard_.pass(pose);
  passed_.push_back(pose.received);
  const std::lock_guard lock(scene_mutex_);
  scene_.trail.add(pose.stamp, pose.X_WT.translation());
}

void SweepGuardNode::sweep(const PlacedPose& placed) {
  const sweep_guard::ToolPose& pose = placed.pose;
  const sweep_guard::SteadyTime begin = std::chrono::steady_clock::now();
  const auto report = reports_.take();
  guard_.sweep(pose, workpieces_.snapshot(), *report);
  const sweep_guard::SteadyTime swept = std::chrono::steady_clock::now();
  swept_ = {pose.stamp, pose.received};
  if (!report->objects.empty()) publishContacts(*report);
  ledger_.swept(*report, *swept_, placed.came, swept);
  warn(/*only_on_change=*/true);

  const sweep_guard::SteadyTime warned = std::chrono::steady_clock::now();
  for (const sweep_guard::SteadyTime received : passed_) workload_.swept(warned - received, {});
  passed_.clear();
  workload_.swept(warned - pose.received, swept - begin);
  for (const auto& failure : report->failures) tellFailure(failure);
  const std::lock_guard lock(scene_mutex_);
  scene_.X_WT = pose.X_WT;
  scene_.trail.add(pose.stamp, pose.X_WT.translation());
  scene_.newest = report;
  if (report->contact()) scene_.contact = report;
}

void SweepGuardNode::tellFailure(const sweep_guard::SweepFailure& failure) {
  workload_.failed("'" + failure.workpiece->id + "': " + failure.reason);
  log_.error(failure.workpiece->id, "detection failed: " + failure.reason);
}

// Poses that wait go first, so that each is swept at most one look ahead late; but not for longer than a cycle.
bool SweepGuardNode::timeToLookAhead() {
  if (std::chrono::steady_clock::now() - looked_ahead_ >= parameters_.get()->guard.cycle) return true;
  const std::lock_guard lock(queue_mutex_);
  return queue_.empty();
}

void SweepGuardNode::lookAhead(const PlacedPose& placed) {
  const sweep_guard::Instant at = now();
  looked_ahead_ = at.steady;
  const sweep_guard::Duration age = std::max(sweep_guard::age(*swept_, at), sweep_guard::Duration::zero());
  const auto outlook = outlooks_.take();
  guard_.lookAhead(age, workpieces_.snapshot(), *outlook);
  const sweep_guard::SteadyTime looked = std::chrono::steady_clock::now();
  ledger_.predicted(*outlook, *swept_, placed.came, now());
  warn(/*only_on_change=*/true);
  publishPrediction(*outlook, age);

  workload_.predicted({std::chrono::steady_clock::now() - placed.pose.received, looked - at.steady,
                       outlook->sweeps_made, outlook->sweeps_asked, outlook->coveredUntil() - outlook->stamp - age,
                       outlook->probability()});
  for (const auto& failure : outlook->failures) tellFailure(failure);
  const std::lock_guard lock(scene_mutex_);
  scene_.outlook_from_W = placed.pose.X_WT.translation();
  scene_.outlook = outlook;
}

PredictService::Answer SweepGuardNode::forecast(sweep_guard::Duration horizon) const {
  const sweep_guard::Instant at = now();
  if (const auto asked_by = ledger_.disabledBy()) throw sweep_guard::Error("the guard is disabled by " + *asked_by);
  if (!swept_ || guard_epoch_ != ledger_.mark().epoch) throw sweep_guard::Error("no tool pose yet: nothing is known");
  if (sweep_guard::stale(*swept_, at, parameters_.get()->limits.pose_timeout)) {
    throw sweep_guard::Error("the newest tool pose is stale: nothing is known of the tool now");
  }
  const sweep_guard::Duration age = std::max(sweep_guard::age(*swept_, at), sweep_guard::Duration::zero());
  sweep_guard::Forecast forecast = guard_.forecast(age, horizon);
  if (forecast.path.empty())
    throw sweep_guard::Error("the motion is not known yet: two tool poses in a row are needed");
  return {std::move(forecast), age};
}

void SweepGuardNode::publishContacts(const sweep_guard::SweepReport& report) {
  if (contacts_publisher_.getNumSubscribers() == 0) return;
  const auto contacts = boost::make_shared<sweep_guard::Contacts>(toMsg(report, guard_.tool()));
  const auto parameters = parameters_.get();
  contacts->header.frame_id = parameters->fixed_frame;
  contacts->tool = parameters->tool_frame;
  contacts->volume = sweep_guard::nameOf(parameters->guard.sweep.volume);
  contacts_publisher_.publish(contacts);
}

void SweepGuardNode::publishPrediction(const sweep_guard::Outlook& outlook, sweep_guard::Duration age) {
  if (prediction_publisher_.getNumSubscribers() + time_to_collision_publisher_.getNumSubscribers() == 0) return;
  const auto prediction = boost::make_shared<sweep_guard::Prediction>(predictionMsg(outlook, age, *parameters_.get()));
  std_msgs::Float64 time_to_collision;
  time_to_collision.data = timeToCollision(*prediction);
  prediction_publisher_.publish(prediction);
  time_to_collision_publisher_.publish(time_to_collision);
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
  ledger_.verdict(at, verdict_);
  const bool new_level = static_cast<std::uint8_t>(verdict_.level) != warning_.level;
  if (only_on_change && !new_level && verdict_.reasons == warning_.reasons) return;
  const auto parameters = parameters_.get();
  sweep_guard::Warning next = toMsg(verdict_);
  if (verdict_.tool_part) next.tool_link = parameters->tool->parts()[*verdict_.tool_part].link;
  next.header.frame_id = parameters->fixed_frame;
  next.tool = parameters->tool_frame;
  next.sequence = warning_.sequence + (new_level ? 1 : 0);
  next.level_counts = warning_.level_counts;
  if (new_level) ++next.level_counts[next.level];
  next.valid_until = toMsg(at.stamp + kWarningValid);
  const bool reflex_rises = next.reflex && !warning_.reflex;
  const bool considered_rises = next.considered && !warning_.considered;
  warning_ = next;
  warned_ = at.steady;
  warning_publisher_.publish(next);
  if (reflex_rises) reflex_publisher_.publish(flagMessage(true));
  if (considered_rises) considered_publisher_.publish(flagMessage(true));
}

// As it is now, not as it was when the warning was sent last.
void SweepGuardNode::repeat(const ros::Publisher& publisher, Flag flag) {
  warn(/*only_on_change=*/true);
  const std::lock_guard lock(warning_mutex_);
  publisher.publish(flagMessage(warning_.*flag != 0));
}

MarkerScene SweepGuardNode::sceneNow() {
  MarkerScene scene;
  {
    const std::lock_guard lock(scene_mutex_);
    scene = scene_;
  }
  const auto parameters = parameters_.get();
  scene.tool = parameters->tool;
  scene.namespaces = parameters->marker_namespaces;
  scene.verdict = ledger_.verdict(now());
  return scene;
}

void SweepGuardNode::publishMarkers() {
  if (marker_publisher_.getNumSubscribers() > 0) marker_publisher_.publish(markers_.draw(sceneNow()));
}

}  // namespace sweep_guard_ros
