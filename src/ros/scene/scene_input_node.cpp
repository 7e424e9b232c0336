#include "ros/scene/scene_input_node.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "ros/connection/own_services.h"
#include "ros/connection/publisher_links.h"
#include "ros/parameters/finish_reading.h"
#include "scene/primitives.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using sweep_guard_core::kMaxNameLength;
using sweep_guard_core::printable;
using sweep_guard_core::SceneChange;
using sweep_guard_core::SceneUpdate;

constexpr auto kConfirmPeriod = std::chrono::milliseconds(100);
constexpr auto kReportPeriod = std::chrono::seconds(1);
const std::string kSceneSource = "the scene";

bool sameTopics(const std::vector<EnvironmentTopic>& a, const std::vector<EnvironmentTopic>& b) {
  const auto same = [](const EnvironmentTopic& one, const EnvironmentTopic& other) {
    return one.values() == other.values();
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

template <typename BySource>
std::string listedSources(const BySource& sources) {
  std::string list;
  for (const auto& [source, change] : sources) list += (list.empty() ? "" : " and ") + source;
  return list;
}

bool isGone(const SceneChange& change) { return change.refused.empty() && change.object.surface_M.triangles.empty(); }

// While the guard has not attached it: the guard would not attach what is refused.
std::string heldId(const std::string& id) { return id.substr(0, kMaxNameLength - 6) + " (held)"; }

}  // namespace

SceneInputNode::SceneInputNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process)
    : SceneInputNode(node, private_node, process, ParameterReader(private_node)) {}

SceneInputNode::SceneInputNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process,
                               ParameterReader read)
    : master_watch_(private_node, [this] { return settings_; }),
      supervisor_(process),
      scene_(read.name("scene", "{}")),
      workpieces_(calls_.on(node), [this] { attachments_.beginAnew(); }),
      attachments_(node, read.node("guard", "sweep_guard"),
                   [this](const std::string& id, const std::string& why) { reportAttachment(id, why); }),
      topics_id_("topics of " + printable(private_node.getNamespace(), kMaxNameLength / 2)),
      updater_(node, private_node, private_node.getNamespace()) {
  settings_ = finishReading(read);
  Scene scene = readScene(scene_);
  topics_ = std::move(scene.topics);
  updater_.setHardwareID("none");
  updater_.add("scene", [this](Status& status) { report(status); });
  workpieces_.withdraw(topics_id_);
  for (const EnvironmentTopic& topic : topics_) {
    const std::string name = node.resolveName(topic.topic);
    EnvironmentSource& source = sources_.emplace_back(
        node, receiving_, topic, confirmations_.call(),
        [this, name](SceneUpdate update) { apply(name, std::move(update)); },
        [this, name](const std::string& why) { refuseTopic(name, why); });
    updater_.add(source.topic(), [this, &source](Status& status) { report(source, status); });
  }
  replaceObjects(std::move(scene.objects));
  auto options = ros::AdvertiseServiceOptions::create<std_srvs::Trigger>(
      "load_scene", [this](auto& request, auto& response) { return load(request, response); }, nullptr,
      &calls_.queue());
  ros::NodeHandle own(private_node);
  load_service_ = advertiseOwn(own, options);
  confirmations_.every(kConfirmPeriod, [this] { confirm(); });
  reports_.every(kReportPeriod, [this] { updater_.force_update(); });
}

SceneInputNode::~SceneInputNode() {
  reports_.stop();
  master_watch_.stop();  // its thread uses what is declared after it
  confirmations_.stop();
  attachments_.stop();
  receiving_.stop();
  calls_.stop();
}

void SceneInputNode::start() {
  calls_.start(supervisor_, {"calls"});
  for (EnvironmentSource& source : sources_) source.start(supervisor_);
  receiving_.start(supervisor_, {"messages", sweep_guard_core::Stage::kReceive});
  attachments_.start(supervisor_);
  confirmations_.start(supervisor_);
  reports_.start(supervisor_, {"reports", sweep_guard_core::Stage::kPublish});
  master_watch_.start(supervisor_);
  supervisor_.start();
  ROS_INFO("workpieces of the scene and of %zu topics go to %s; round shapes are up to %g %% of their radius larger",
           sources_.size(), workpieces_.meshTopic().c_str(), 100.0 * sweep_guard_core::kPrimitiveDeviation);
}

bool SceneInputNode::load(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  try {
    Scene scene = readScene(scene_);
    if (!sameTopics(scene.topics, topics_))
      throw sweep_guard_core::InvalidInput(
          "the topics under `environment` have changed: end scene_input, so that it starts anew");
    const size_t count = scene.objects.size();
    replaceObjects(std::move(scene.objects));
    response.success = 1;
    response.message = std::to_string(count) + " workpieces";
  } catch (const std::exception& error) {
    response.message = error.what();
    ROS_ERROR("the scene stays as it was: %s", error.what());
  }
  return true;
}

void SceneInputNode::replaceObjects(std::vector<sweep_guard_core::SceneObject> objects) {
  std::set<std::string> gone;
  {
    const sweep_guard_core::Lock lock(mutex_);
    for (const auto& [id, sources] : workpieces_by_id_) {
      if (sources.count(kSceneSource) != 0) gone.insert(id);
    }
  }
  SceneUpdate update;
  for (auto& object : objects) {
    gone.erase(object.id);
    update.changes.emplace_back().object = std::move(object);
  }
  for (const std::string& id : gone) update.changes.emplace_back().object.id = id;
  apply(kSceneSource, std::move(update));
}

void SceneInputNode::apply(const std::string& source, SceneUpdate update) {
  for (SceneChange& change : update.changes) {
    const std::string id = change.object.id;
    if (!change.refused.empty()) log_.error(id, "'" + id + "' of " + source + " refused: " + change.refused);
    if (change.object.stamp == sweep_guard_core::Time()) change.object.stamp = now().stamp;
    const sweep_guard_core::Lock lock(mutex_);
    BySource& sources = workpieces_by_id_[id];
    if (isGone(change)) {
      sources.erase(source);
    } else {
      sources[source] = std::make_shared<const SceneChange>(std::move(change));
    }
    publish(id);
  }
}

// Under one id, so that the refusals of a process before this one end.
void SceneInputNode::refuseTopic(const std::string& topic, const std::string& why) {
  if (!why.empty()) log_.error(topic, "topic " + topic + " refused: " + why);
  const sweep_guard_core::Lock lock(mutex_);
  refused_topics_.erase(topic);
  if (!why.empty()) refused_topics_.emplace(topic, why);
  std::string all;
  for (const auto& [name, reason] : refused_topics_)
    all.append(all.empty() ? "" : "; ").append(name).append(": ").append(reason);
  if (all.empty()) return workpieces_.withdraw(topics_id_);
  workpieces_.refuse(topics_id_, all);
}

// What holds of a workpiece follows from what all sources say of it. One that is attached is the guard's.
void SceneInputNode::publish(const std::string& id) {
  const BySource& sources = workpieces_by_id_.at(id);
  const std::string link = sources.size() == 1 ? sources.begin()->second->link : std::string();
  const bool is_done = attachments_.setLink(id, link);
  if (!is_done) {
    workpieces_.refuse(heldId(id), link.empty() ? "the tool holds it until it is detached"
                                                : "held by the link '" + link + "', and not attached yet");
  }
  if (sources.empty()) {
    workpieces_by_id_.erase(id);
    workpieces_.remove(id);
  } else if (sources.size() > 1) {
    workpieces_.refuse(id, "both " + listedSources(sources) + " give it: give one of them another id");
  } else if (const auto& change = sources.begin()->second; !change->refused.empty()) {
    workpieces_.refuse(id, change->refused);
  } else if (link.empty() == is_done) {
    workpieces_.show({change, &change->object}, /*as_mesh=*/!link.empty());
  }
}

// What is detached is where the tool left it, and from now on where the sources say.
void SceneInputNode::reportAttachment(const std::string& id, const std::string& why) {
  const sweep_guard_core::Lock lock(mutex_);
  if (!why.empty()) return workpieces_.refuse(heldId(id), why);
  workpieces_.remove(heldId(id));
  const auto sources = workpieces_by_id_.find(id);
  if (sources == workpieces_by_id_.end()) return workpieces_.remove(id);
  auto& change = sources->second.begin()->second;
  if (!change->link.empty()) return;
  SceneChange since = *change;
  since.object.stamp = now().stamp;
  change = std::make_shared<const SceneChange>(std::move(since));
  publish(id);
}

void SceneInputNode::confirm() {
  const auto links = publisherLinks(confirmations_.call());
  std::set<std::string> resting = {kSceneSource};
  for (EnvironmentSource& source : sources_) {
    Publishers publishers;
    if (links && links->all.count(source.topic()) != 0) publishers = links->all.at(source.topic());
    if (links && links->down.count(source.topic()) != 0) {
      for (const std::string& down : links->down.at(source.topic())) publishers.erase(down);
    }
    if (source.tick(publishers)) resting.insert(source.topic());
  }
  std::map<std::string, std::string> source_of;
  {
    const sweep_guard_core::Lock lock(mutex_);
    for (const auto& [id, sources] : workpieces_by_id_) source_of[id] = sources.begin()->first;
  }
  workpieces_.confirm([&](const std::string& id) {
    const auto found = source_of.find(id);
    return found != source_of.end() && resting.count(found->second) != 0;
  });
}

void SceneInputNode::report(Status& status) const {
  const sweep_guard_core::Lock lock(mutex_);
  status.summary(DiagnosticStatus::OK, std::to_string(workpieces_by_id_.size()) + " ids");
  for (const auto& [id, sources] : workpieces_by_id_) {
    status.add("'" + id + "'", "from " + listedSources(sources));
    if (sources.size() > 1) status.mergeSummary(DiagnosticStatus::ERROR, "'" + id + "' has more than one source");
  }
}

void SceneInputNode::report(const EnvironmentSource& source, Status& status) const {
  const EnvironmentSource::State state = source.state();
  status.summary(DiagnosticStatus::OK, state.type.empty() ? "no type yet" : state.type);
  if (!state.left_out.empty()) status.mergeSummary(DiagnosticStatus::WARN, state.left_out);
  if (!state.refused.empty()) status.mergeSummary(DiagnosticStatus::ERROR, state.refused);
  status.add("messages", state.received);
}

}  // namespace sweep_guard_ros
