// Starts the player of a bag, records the messages of the guard, and reports them.
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <topic_tools/shape_shifter.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <future>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "recording/object_contacts.h"
#include "recording/run_node.h"
#include "session/held_warnings.h"
#include "session/patient_call.h"
#include "session/report_files.h"
#include "session/session_bag.h"
#include "session/session_config.h"
#include "session/session_files.h"
#include "session/session_log.h"
#include "session/session_report.h"
#include "session/start_publisher.h"
#include "session/touch_report.h"
#include "sound/earcon.h"
#include "sweep_guard/Contacts.h"
#include "sweep_guard/Warning.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_session {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::Time;
using sweep_guard_core::toSeconds;
using sweep_guard_ros::fromMsg;

constexpr std::uint32_t kQueue = 100000;
constexpr double kConnectTimeout = 60.0;    // [s] of wall time, for guard and player
constexpr std::uint32_t kSoundRate = 8000;  // samples per second
constexpr double kAnswerTimeout = 2.0;      // [s] of wall time, for answers
constexpr double kMaxStart = 1e9;           // [s]
constexpr const char* kHoldTime = "warning/hold_time";
constexpr double kDefaultHoldTime = 0.5;  // [s]
constexpr double kMaxHoldTime = 60.0;     // [s] that the guard accepts

Time now() { return fromMsg(ros::Time::now()); }

void handleMessages() { ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01)); }

/// Returns whether the condition was met within the timeout [s] and before the node shuts down.
bool waitUntil(const std::function<bool()>& condition, double timeout) {
  for (const ros::WallTime begin = ros::WallTime::now(); ros::ok(); handleMessages()) {
    if (condition()) return true;
    if ((ros::WallTime::now() - begin).toSec() > timeout) return false;
  }
  return false;
}

// The guard ends with a value that is out of range.
Duration readHoldTime(const ros::NodeHandle& guard) {
  const double seconds = guard.param(kHoldTime, kDefaultHoldTime);
  return sweep_guard_core::fromSeconds(seconds >= 0.0 && seconds <= kMaxHoldTime ? seconds : kDefaultHoldTime);
}

SweepContact toSweepContact(const sweep_guard::Contacts& contacts, const sweep_guard::ObjectContacts& object) {
  SweepContact contact;
  contact.first = fromMsg(contacts.interval_start);
  contact.stamp = fromMsg(contacts.header.stamp);
  contact.mesh_id = object.mesh_id;
  contact.triangles = sweep_guard_recording::trianglesInContact(object);
  double first = std::numeric_limits<double>::infinity();
  for (const sweep_guard::TriangleContact& impact : object.impacts) {
    contact.depth = std::fmax(contact.depth, impact.depth);
    if (impact.time_of_impact >= first) continue;
    first = impact.time_of_impact;
    contact.first = fromMsg(contacts.interval_start + (contacts.header.stamp - contacts.interval_start) * first);
    contact.tool_link = impact.tool_link;
  }
  return contact;
}

class ReplayReport {
 public:
  explicit ReplayReport(sweep_guard_ros::ParameterReader& parameters)
      : paths_(bagFiles(parameters.text("bag", ""), parameters.text("folder", "/"))),
        files_(paths_),
        output_(parameters.name("output", files_.name() + ".report")),
        rate_(parameters.number("rate", 1.0, {1e-3, 1e3})),  // of the player, which reports no range
        guard_(parameters.name("guard", "sweep_guard")),
        hold_time_(readHoldTime(guard_)) {
    topics_ = readTopics(parameters);
    const std::chrono::duration<double> start(parameters.number("start", 0.0, {0.0, kMaxStart}));
    bag_ = inspectSession(files_, topics_, std::chrono::duration_cast<sweep_guard_core::Duration>(start));
    if (bag_.meshes == 1 && bag_.vertices == 0 && std::isfinite(guard_.param("timing/mesh_timeout", 0.5))) {
      bag_.missing.push_back(
          "there are no vertices on " + topics_.mesh_vertices +
          ": after timing/mesh_timeout the workpiece is stale and the level UNKNOWN. Give mesh_vertices:=TOPIC, or set "
          "timing/mesh_timeout: .inf in your config if the workpiece is rigid");
    }
    for (const std::string& missing : bag_.missing) ROS_WARN("%s", missing.c_str());
    bag_.config = describeConfig(parameters.text("config", ""), paths_);
    for (std::size_t i = 1; i < bag_.config.size(); ++i) ROS_WARN("%s", bag_.config[i].c_str());
    listenTo(parameters.text("topics", ""));
    makeFolder();
  }

  void run() {
    startPlayer();
    await([this] { return clock_.getNumPublishers() == 0 || contacts_.getNumPublishers() == 0; });
    if (contacts_.getNumPublishers() == 0) throw InvalidInput("the guard ended during the session; see its log");
    waitUntil([this] { return sweptToTheEnd(); }, kAnswerTimeout);
    logWarnings();
    playing_ = false;
    waitUntil([this] { return fromMsg(touches_.touches().header.stamp) >= last_touch_; }, kAnswerTimeout);
    if (ros::ok()) report();
  }

 private:
  // Listens to the topics of the tool that the guard does not listen to, and leaves them out.
  SessionTopics readTopics(sweep_guard_ros::ParameterReader& parameters) {
    SessionTopics topics;
    topics.tool_pose = parameters.text("tool_pose", "/tool_pose");
    topics.joint_states = parameters.text("joint_states", "/joint_states");
    topics.mesh = parameters.text("mesh", "/mesh");
    topics.mesh_vertices = parameters.text("mesh_vertices", "/mesh_vertices");
    topics.cameras = camerasOf(guard_);
    if (!topics.cameras.empty() && files_.count(topics.mesh) == 0) topics.mesh.clear();
    topics.fixed_frame = guard_.param<std::string>("fixed_frame", topics.fixed_frame);
    const auto source = guard_.param<std::string>("tool_source", "topic");
    if (source != "topic") {
      listenTo(std::exchange(topics.tool_pose, ""));
      if (const auto frame = guard_.param<std::string>("tool_frame", ""); !frame.empty()) topics.frames = {frame};
    }
    if (source != "joint_states" && !guard_.param("tool/joint_states", false)) {
      listenTo(std::exchange(topics.joint_states, ""));
    }
    return topics;
  }

  bool sweptToTheEnd() const {
    const auto last = log_.swept().last();
    return last && (bag_.poses.empty() || *last >= bag_.poses.back());
  }

  // The player waits for a subscriber on each topic: of what it plays to the guard, that has to be the guard. Others may come later or never.
  void listenTo(const std::string& topics) {
    std::istringstream words(topics);
    for (std::string topic; words >> topic;) subscribers_.push_back(subscribe(topic));
  }

  // Ignores the messages.
  ros::Subscriber subscribe(const std::string& topic) {
    const boost::function<void(const topic_tools::ShapeShifter::ConstPtr&)> ignore = [](const auto&) {};
    return node_.subscribe<topic_tools::ShapeShifter>(topic, 1, ignore);
  }

  void makeFolder() const {
    std::error_code error;
    std::filesystem::create_directories(output_, error);
    if (error) throw InvalidInput(output_ + ": " + error.message() + "; give output:=FOLDER");
  }

  void require(const std::function<bool()>& condition, const std::string& problem) {
    if (!waitUntil(condition, kConnectTimeout) && ros::ok()) throw InvalidInput(problem);
  }

  static void await(const std::function<bool()>& condition) {
    waitUntil(condition, std::numeric_limits<double>::infinity());
  }

  void startPlayer() {
    clock_ = subscribe("/clock");
    contacts_ =
        node_.subscribe("contacts", kQueue, &ReplayReport::onContacts, this, ros::TransportHints().tcpNoDelay());
    listenToTouches();
    warning_ = node_.subscribe("warning", kQueue, &ReplayReport::onWarning, this, ros::TransportHints().tcpNoDelay());
    require([this] { return contacts_.getNumPublishers() > 0 && warned_; },
            "no guard on " + contacts_.getTopic() + "; see its log");
    require([this] { return meshInBag() || !topics_.cameras.empty() || knows_mesh_; },
            "the guard got no workpiece; see the log of scene_input");
    const std::string service = ros::names::resolve("pause_playback");
    require([this, &service] { return clock_.getNumPublishers() > 0 && ros::service::exists(service, false); },
            "the bag is not played: no service " + service + ". Each topic of the player needs a subscriber");
    publishStart();
    scaleHoldTime();
    unpause(service);
    ROS_INFO("playing %s: %.1f s", files_.name().c_str(), toSeconds(bag_.end - bag_.start));
  }

  // The player answers once each topic has a subscriber.
  void unpause(const std::string& service) {
    playing_ = true;
    start_->beginToPlay();
    std::future<bool> answer = startCall([service] {
      std_srvs::SetBool pause;
      pause.request.data = 0;
      return ros::service::call(service, pause);
    });
    require(
        [&answer] { return hasReturned(answer); },
        "the bag is not played: its player waits for a subscriber on each topic. The log names the topic if the guard "
        "knows another definition of its messages (md5sum)");
    if (ros::ok() && !answer.get()) throw InvalidInput("the player does not answer " + service);
  }

  // The player knows nothing of what was recorded before its start, or the last message of a publisher at the most. Vertices and
  // intentions need their mesh.
  void publishStart() {
    start_.emplace(files_, topics_, bag_.start, guard_.getNamespace());
    publish(kStaticTransformsTopic, &SessionStart::transforms);
    publish(topics_.mesh, &SessionStart::meshes);
    if (!start_->start().meshes.empty()) waitUntil([this] { return knows_mesh_; }, kAnswerTimeout);
    publish(topics_.mesh_vertices, &SessionStart::vertices);
    publish(kIntendTopic, &SessionStart::intends);
  }

  template <typename Pointer>
  void publish(const std::string& topic, std::vector<Pointer> SessionStart::*messages) {
    if ((start_->start().*messages).empty()) return;
    start_->publish(topic, messages);
    require([this, &topic] { return start_->hasGiven(topic); }, "the guard does not subscribe to " + topic);
  }

  // The guard holds a warning by the clock of the machine, which is not that of the session. While it holds one, it
  // tells nothing of those that are lower: half of the time is over before the session's, even if a contact came late.
  void scaleHoldTime() {
    if (rate_ == 1.0) return;
    dynamic_reconfigure::Reconfigure change;
    change.request.config.doubles.resize(1);
    change.request.config.doubles[0].name = kHoldTime;
    change.request.config.doubles[0].value = std::min(0.5 * toSeconds(hold_time_) / rate_, kMaxHoldTime);
    if (ros::service::call(guard_.resolveName("set_parameters"), change)) return;
    ROS_WARN("the guard does not change %s: levels that begin while it holds a higher one may be reported late",
             kHoldTime);
  }

  void listenToTouches() {
    touched_ = {takeFrom<sweep_guard::Touches>("touches")};
    if (!meshInBag()) touched_.push_back(takeFrom<sweep_guard::DeformableMesh>("mesh"));
  }

  bool meshInBag() const { return !topics_.mesh.empty(); }

  template <typename Message>
  ros::Subscriber takeFrom(const std::string& topic) {
    const boost::function<void(const typename Message::ConstPtr&)> take = [this](const auto& message) {
      touches_.take(message);
    };
    return node_.subscribe<Message>(topic, kQueue, take);
  }

  void onContacts(const sweep_guard::Contacts::ConstPtr& contacts) {
    log_.addSweep(fromMsg(contacts->interval_start), fromMsg(contacts->header.stamp));
    for (const sweep_guard::ObjectContacts& object : contacts->objects) {
      if (sweep_guard_recording::isInContact(object)) {
        log_.add(toSweepContact(*contacts, object));
        touched_at_.push_back(fromMsg(contacts->header.stamp));
      }
      if (!sweep_guard_recording::trianglesInContact(object).empty()) last_touch_ = fromMsg(contacts->header.stamp);
    }
  }

  void onWarning(const sweep_guard::Warning::ConstPtr& warning) {
    warned_ = true;
    knows_mesh_ = (warning->reasons & sweep_guard::Warning::NO_MESH) == 0;
    if (playing_) heard_.push_back(toGuardWarning(*warning));
  }

  // What is only held says when it was over, by the clock of the machine.
  GuardWarning toGuardWarning(const sweep_guard::Warning& warning) const {
    GuardWarning heard;
    const Time computed = fromMsg(warning.valid_until) - sweep_guard_core::kWarningValid;
    heard.computed = std::max(computed, heard_.empty() ? bag_.begin : heard_.back().computed);
    heard.pose = fromMsg(warning.header.stamp);
    heard.level = static_cast<sweep_guard_core::WarningLevel>(warning.level);
    heard.text = warning.text;
    if (warning.time_to_collision >= ros::Duration(0))
      heard.time_to_collision = Duration(warning.time_to_collision.toNSec());
    if (warning.held) {
      const Duration over_for = computed - fromMsg(warning.held_since);
      heard.over_for = sweep_guard_core::fromSeconds(rate_ * toSeconds(over_for));
    }
    return heard;
  }

  void logWarnings() {
    const Time end = std::max(now(), bag_.begin);
    for (const LoggedWarning& warning : holdWarnings(heard_, touched_at_, hold_time_, end)) log_.add(warning);
    log_.end(end);
  }

  void report() {
    const std::filesystem::path folder(output_);
    removePictures(folder);
    if (meshInBag()) touches_.readShapes(files_, topics_);
    write(folder / "contacts.csv", contactsCsv(log_, bag_.begin));
    write(folder / "levels.csv", levelsCsv(log_, bag_.begin));
    write(folder / "collisions.csv", collisionsCsv(log_, bag_.begin));
    write(folder / "sound.wav", sweep_guard_core::wavFile(soundOf(log_, kSoundRate), kSoundRate));
    write(folder / "touches.csv", touchesCsv(touches_.touches()));
    write(folder / "surfaces.csv", surfacesCsv(touches_));
    const std::string name = std::filesystem::path(files_.name()).filename();
    std::cout << summary(log_, bag_) << "written to " << output_ << ": "
              << (drawPictures(folder, name) ? "timeline.png, contacts.png, touches.png, " : "no pictures, but ")
              << "contacts.csv, touches.csv, surfaces.csv, levels.csv, collisions.csv, sound.wav" << std::endl;
  }

  std::vector<std::string> paths_;
  SessionFiles files_;
  std::string output_;
  double rate_;
  ros::NodeHandle guard_;
  Duration hold_time_;  // of the guard
  SessionTopics topics_;
  SessionBag bag_;
  std::optional<StartPublisher> start_;
  SessionLog log_;
  std::vector<GuardWarning> heard_;
  std::vector<Time> touched_at_;  // stamps, ascending
  TouchLog touches_;
  Time last_touch_;  // stamp of the newest pose that touched
  bool warned_ = false;
  bool knows_mesh_ = false;
  bool playing_ = false;
  ros::NodeHandle node_;
  ros::Subscriber clock_;
  ros::Subscriber contacts_;
  ros::Subscriber warning_;
  std::vector<ros::Subscriber> touched_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace

}  // namespace sweep_guard_session

int main(int argc, char** argv) {
  return sweep_guard_recording::runNode<sweep_guard_session::ReplayReport>(argc, argv, "replay_report");
}
