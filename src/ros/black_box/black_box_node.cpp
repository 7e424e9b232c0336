#include "ros/black_box/black_box_node.h"

#include <ros/console.h>

#include <algorithm>

#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr auto kTickPeriod = std::chrono::milliseconds(50);
constexpr auto kDiagnosticsPeriod = std::chrono::seconds(1);

double inMebibytes(std::uintmax_t size) { return static_cast<double>(size) / (1U << 20U); }

}  // namespace

BlackBoxNode::BlackBoxNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process)
    : parameters_(loadBlackBoxParameters(private_node)),
      master_watch_(private_node, [this] { return parameters_.settings; }),
      supervisor_(process),
      recorder_(parameters_),
      topics_(recordedTopics(node, parameters_)),
      subscribers_(subscribe(node)),
      save_(calls_.advertise<SaveEvent>(
          private_node, "save", kMaxRequest, [this](SaveEvent& event) { return onSave(event); },
          [](const std::string& reason, std_srvs::Trigger::Response& response) {
            response.message = reason;
            return true;
          })),
      updater_(node, private_node, private_node.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("memory", [this](Status& status) { memory(status); });
  updater_.add("recordings", [this](Status& status) { recordings(status); });
  ticks_.every(kTickPeriod, [this] { recorder_.tick(); });
  reports_.every(kDiagnosticsPeriod, [this] { updater_.force_update(); });
}

// Not in the constructor: where one thread cannot be started, the destructor ends the others.
void BlackBoxNode::start() {
  recorder_.start(supervisor_);
  thread_.start(supervisor_,
                {"black box", sweep_guard_core::Stage::kReceive, /*watched=*/true, /*loses_latched=*/true});
  saves_.start(supervisor_, {"save", sweep_guard_core::Stage::kOther, /*watched=*/false});
  refusals_.start(supervisor_, {"busy", sweep_guard_core::Stage::kOther, /*watched=*/false});
  ticks_.start(supervisor_, {"ticks"});
  reports_.start(supervisor_, {"reports", sweep_guard_core::Stage::kPublish});
  master_watch_.start(supervisor_);
  supervisor_.start();
  ROS_INFO("keeping the last %g s of %s and of its inputs; recordings go to %s",
           sweep_guard_core::toSeconds(parameters_.window), parameters_.guard.c_str(), parameters_.folder.c_str());
}

BlackBoxNode::~BlackBoxNode() {
  ticks_.stop();
  reports_.stop();
  master_watch_.stop();  // its thread uses the supervisor, which is declared after it
  saves_.stop();
  refusals_.stop();
}

std::vector<ros::Subscriber> BlackBoxNode::subscribe(const ros::NodeHandle& node) {
  using Event = ros::MessageEvent<const topic_tools::ShapeShifter>;
  std::vector<ros::Subscriber> subscribers;
  for (const RecordedTopic& topic : topics_) {
    const boost::function<void(const Event&)> hear = [this, &topic](const Event& event) {
      recorder_.hear(topic, event);
    };
    ros::SubscribeOptions options;
    options.initByFullCallbackType<const Event&>(topic.topic, topic.queue_length, hear);
    options.callback_queue = &thread_.queue();
    options.transport_hints = ros::TransportHints().tcpNoDelay();
    subscribers.push_back(ros::NodeHandle(node).subscribe(options));
  }
  return subscribers;
}

const ros::Subscriber& BlackBoxNode::warnings() const {
  const auto found = std::find_if(topics_.begin(), topics_.end(),
                                  [](const RecordedTopic& topic) { return topic.recorded == kRecordedWarning; });
  return subscribers_.at(static_cast<std::size_t>(found - topics_.begin()));
}

bool BlackBoxNode::onSave(SaveEvent& event) {
  const std::string problem = recorder_.requestRecording();
  std_srvs::Trigger::Response& response = event.getResponse();
  response.success = problem.empty();
  response.message = problem.empty() ? "the recording follows in " + parameters_.folder.string() : problem;
  ROS_INFO("~save called by %s", sweep_guard_core::printable(event.getCallerName()).c_str());
  return true;
}

void BlackBoxNode::memory(Status& status) const {
  const Recorder::Summary summary = recorder_.summary();
  status.summary(DiagnosticStatus::OK, "listening");
  if (warnings().getNumPublishers() == 0) {
    status.summary(DiagnosticStatus::WARN, "no guard publishes " + warnings().getTopic() + ": no contact is noticed");
  }
  if (summary.too_large > 0) {
    status.mergeSummary(DiagnosticStatus::WARN, "messages are larger than half of memory: see the log");
  }
  status.addf("time kept [s]", "%.1f", sweep_guard_core::toSeconds(summary.length));
  status.add("messages", summary.messages);
  status.addf("size [MiB]", "%.1f", inMebibytes(summary.size));
  status.add("messages too large", summary.too_large);
}

void BlackBoxNode::recordings(Status& status) const {
  const Recorder::Summary summary = recorder_.summary();
  std::uintmax_t size = 0;
  for (const auto& [name, bytes] : summary.stored) size += bytes;
  status.summary(DiagnosticStatus::OK, summary.writing ? "a recording is being written" : "ready");
  if (summary.failed > 0) status.summary(DiagnosticStatus::WARN, "a recording could not be written: see the log");
  if (!summary.problem.empty()) status.summary(DiagnosticStatus::ERROR, "nothing can be written: " + summary.problem);
  status.add("folder", parameters_.folder.string());
  status.add("recordings there", summary.stored.size());
  status.addf("size [MiB]", "%.1f", inMebibytes(size));
  status.add("written", summary.written);
  status.add("failed", summary.failed);
  status.add("event that waits", summary.waiting ? nameOf(*summary.waiting) : "none");
  if (!summary.newest.empty()) status.add("newest", summary.newest);
}

}  // namespace sweep_guard_ros
