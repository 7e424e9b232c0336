#include "ros/black_box/black_box_node.h"

#include <ros/console.h>

#include <algorithm>

#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kTickPeriod = std::chrono::milliseconds(50);
constexpr auto kDiagnosticsPeriod = std::chrono::seconds(1);

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
      diagnostics_(node, private_node, parameters_, recorder_, warnings()) {
  ticks_.every(kTickPeriod, [this] { recorder_.tick(); });
  reports_.every(kDiagnosticsPeriod, [this] { diagnostics_.publish(); });
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

}  // namespace sweep_guard_ros
