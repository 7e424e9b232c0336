#include "ros/scene/environment_source.h"

#include <ros/master.h>
#include <ros/names.h>
#include <std_msgs/UInt32.h>

#include <algorithm>
#include <map>
#include <utility>

#include "ros/connection/publisher_header.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::printable;
using sweep_guard_core::SceneUpdate;

constexpr size_t kMaxMessage = 96U << 20U;       // [bytes], as of a mesh
constexpr size_t kMaxWaiting = 256U << 20U;      // [bytes]
constexpr size_t kOverhead = 512;                // of a job, beside its message [bytes]
constexpr std::uint32_t kMessagesQueued = 1000;  // each may be of another workpiece; taken from it at once
constexpr auto kDropped = "messages come faster than they can be read, and some are lost";
constexpr int kTicksPerLook = 10;
constexpr std::uint32_t kStateAndObjects = 30;  // of moveit_msgs/PlanningSceneComponents: no octomap

EnvironmentTopic resolvedTopic(const ros::NodeHandle& node, EnvironmentTopic topic) {
  topic.topic = node.resolveName(topic.topic);
  if (topic.id.empty()) topic.id = topic.topic;
  return topic;
}

// Returns the types of the topics that somebody publishes, by their names.
std::map<std::string, std::string> publishedTypes() {
  std::map<std::string, std::string> types;
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  for (const auto& topic : topics) types[topic.name] = topic.datatype;
  return types;
}

// The guard would meet what it has drawn itself.
void requireNoGuard(const std::string& topic) {
  if (publishedTypes()[ros::names::parentNamespace(topic) + "/warning"] == "sweep_guard/Warning")
    throw InvalidInput("a guard publishes it, and draws there what it has found: take it out of `environment`");
}

std::string entryOf(const ros::M_string& header, const std::string& key) {
  const auto found = header.find(key);
  return found == header.end() ? std::string() : found->second;
}

// The sender may have sent any id.
void nameChange(sweep_guard_core::SceneChange& change) {
  std::string& id = change.object.id;
  if (sweep_guard_core::isName(id)) return;
  if (!change.object.surface_M.triangles.empty()) {
    change.object.surface_M = {};
    change.refused = "its id is empty, or has more than 128 or unprintable characters";
  }
  id = id.empty() ? "(no id)" : printable(id, sweep_guard_core::kMaxNameLength / 2);
}

}  // namespace

EnvironmentSource::EnvironmentSource(const ros::NodeHandle& node, QueueThread& receiving, const EnvironmentTopic& topic,
                                     const XmlRpcCall& call, Apply apply, Refuse refuse)
    : topic_(resolvedTopic(node, topic)),
      call_(call),
      apply_(std::move(apply)),
      refuse_(std::move(refuse)),
      node_(node),
      receiving_(receiving),
      worker_(kMaxWaiting) {
  subscribe();
}

// Anew: roscpp keeps a topic to the definition of its first publisher.
void EnvironmentSource::subscribe() {
  subscriber_ = {};
  subscriber_ = subscribeRaw(receiving_.on(node_), topic_.topic, kMessagesQueued,
                             [this](const RawMessage& message) { push(message); });
}

void EnvironmentSource::start(Supervisor& supervisor) {
  worker_.start(supervisor, {"environment", sweep_guard_core::Stage::kReceive, /*watched=*/false});
}

EnvironmentSource::State EnvironmentSource::state() const {
  const sweep_guard_core::Lock lock(mutex_);
  return state_;
}

// Returns whether that succeeded.
bool EnvironmentSource::attempt(const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const XmlRpc::XmlRpcException& error) {
    refuse(error.getMessage());
  } catch (const std::exception& error) {  // invalid, no answer, or out of memory
    refuse(error.what());
  }
  return false;
}

// Told under the lock: two threads refuse.
void EnvironmentSource::refuse(const std::string& why) {
  const sweep_guard_core::Lock lock(mutex_);
  if (state_.refused == why) return;
  state_.refused = why;
  refuse_(why);
}

void EnvironmentSource::endRefusal() {
  if (has_lost_ || has_other_ || needs_full_scene_ || has_dropped_) return;
  const sweep_guard_core::Lock lock(mutex_);
  if (state_.refused.empty()) return;
  state_.refused.clear();
  refuse_("");
}

void EnvironmentSource::push(const RawMessage& message) {
  try {
    const size_t size = message.bytes.size <= kMaxMessage ? message.bytes.size : 0;
    const auto bytes = std::make_shared<const Bytes>(message.bytes.bytes, message.bytes.bytes + size);
    worker_.push(
        {[this, bytes, header = message.header] { receive(*bytes, header); }, [this] { drop(); }, kOverhead + size});
  } catch (const std::bad_alloc&) {
    drop();
  }
}

void EnvironmentSource::drop() {
  has_dropped_ = true;
  refuse(kDropped);
}

void EnvironmentSource::receive(const Bytes& bytes, const boost::shared_ptr<ros::M_string>& header) {
  const bool is_read = attempt([&] {
    if (isNew(header)) {
      has_lost_ = false;
      open(*header);
      connections_.emplace_back(header);
    }
    makeUpForDropped();
    if (bytes.empty()) throw InvalidInput("a message exceeds 96 MiB");
    read({bytes.data(), bytes.size()}, now().stamp);
  });
  if (is_read) return;
  has_lost_ = true;
  if (reader_) attempt([this] { restart(); });
}

// Several publishers may take turns.
bool EnvironmentSource::isNew(const boost::shared_ptr<ros::M_string>& header) {
  const auto has_ended = [](const auto& connection) { return connection.expired(); };
  connections_.erase(std::remove_if(connections_.begin(), connections_.end(), has_ended), connections_.end());
  return std::none_of(connections_.begin(), connections_.end(),
                      [&](const auto& connection) { return connection.lock() == header; });
}

void EnvironmentSource::makeUpForDropped() {
  if (!has_dropped_.exchange(false)) return;
  restart();
  has_lost_ = !reader_->isComplete();
  if (has_lost_) return refuse(kDropped);
  endRefusal();
}

void EnvironmentSource::begin(const std::string& type) {
  requireNoGuard(topic_.topic);
  reader_ = makeSceneReader(type, topic_);
  {
    const sweep_guard_core::Lock lock(mutex_);
    state_.type = type;
  }
  restart();
  endRefusal();
}

// Of a publisher that is new.
void EnvironmentSource::open(const ros::M_string& header) {
  const std::string type = entryOf(header, "type");
  const std::string md5 = entryOf(header, "md5sum");
  if (!reader_) begin(type);
  if (const std::string known = state().type; type != known)
    throw InvalidInput("publishers send " + printable(type) + " and " + known + ": give each a topic");
  if (!definition_ || md5 != md5_) {
    definition_.reset();
    definition_.emplace(type, entryOf(header, "message_definition"));
    md5_ = md5;
  }
  restart();
}

void EnvironmentSource::restart() { report(reader_->restart()); }

void EnvironmentSource::read(Wire bytes, sweep_guard_core::Time now) {
  {
    const sweep_guard_core::Lock lock(mutex_);
    ++state_.received;
  }
  report(reader_->read(MessageValue(*definition_, bytes), now));
  is_known_ = true;
  if (reader_->isComplete()) has_lost_ = false;
  endRefusal();
}

void EnvironmentSource::report(SceneUpdate update) {
  for (auto& change : update.changes) nameChange(change);
  needs_full_scene_ = update.needs_full_scene;
  apply_(std::move(update));
  {
    const sweep_guard_core::Lock lock(mutex_);
    state_.left_out = reader_->leftOut();
  }
  if (needs_full_scene_)
    refuse("the whole planning scene is not known: it is asked for at " + node_.resolveName(topic_.service));
}

bool EnvironmentSource::tick(const Publishers& publishers) {
  if (!std::includes(publishers.begin(), publishers.end(), publishers_.begin(), publishers_.end())) {
    is_known_ = false;
    restarts_ = true;
  }
  publishers_ = publishers;
  has_publisher_ = !publishers.empty();
  const bool waits = tick_pending_.exchange(true);
  if (!waits) {
    const auto done = [this] { tick_pending_ = false; };
    worker_.push({[this, done] {
                    attempt([this] { checkTopic(); });
                    done();
                  },
                  done, /*bytes=*/0});
  }
  const bool rests = topic_.holds || (has_publisher_ && is_known_ && !topic_.streams);
  return rests && !waits && state().refused.empty();
}

void EnvironmentSource::checkTopic() {
  if (reader_ && restarts_.exchange(false)) restart();
  if (reader_) makeUpForDropped();
  if (reader_ && has_publisher_) {
    apply_(reader_->expire(now().stamp));
  }
  if (ticks_++ % kTicksPerLook != 0) return;
  if (!reader_) {
    const std::string type = publishedTypes()[topic_.topic];
    if (type.empty()) return refuse("nobody has published it yet");
    begin(type);
  }
  if (definition_) checkOthers();
  if (needs_full_scene_) requestFullScene();
}

// Of the publishers that were unconnected at the look before, too: those that are just being connected are not to be disturbed.
std::optional<ros::M_string> EnvironmentSource::otherDefinition() {
  const auto unconnected = unconnectedPublishers(call_, topic_.topic);
  if (!unconnected) return std::nullopt;
  const Publishers before = std::exchange(unconnected_, *unconnected);
  for (const std::string& publisher : unconnected_) {
    if (before.count(publisher) == 0) continue;
    auto header = publisherHeader(call_, topic_.topic, publisher);
    if (header && header->count("md5sum") != 0 && entryOf(*header, "md5sum") != md5_) return header;
  }
  return std::nullopt;
}

void EnvironmentSource::checkOthers() {
  const auto other = otherDefinition();
  if (other && !has_publisher_) return receiving_.post([this] { subscribe(); });
  if (other) {
    const std::string type = entryOf(*other, "type");
    refuse(printable(entryOf(*other, "callerid")) + " sends " + (type == state().type ? "another version of " : "") +
           printable(type) + ", other publishers " + state().type + ": give each a topic");
  }
  const bool had_other = has_other_;
  has_other_ = other || (had_other && !unconnected_.empty());  // it may not have answered
  if (had_other) endRefusal();
}

// Messages that come meanwhile wait, and are read after the answer.
void EnvironmentSource::requestFullScene() {
  if (!definition_) {
    const auto header = publisherHeader(call_, topic_.topic);
    if (!header) return;
    open(*header);
  }
  const std::string service = node_.resolveName(topic_.service);
  ros::ServiceClientOptions options(service, "*", /*persistent=*/false, {});
  ros::ServiceClient client = node_.serviceClient(options);
  if (!client.exists()) return;
  std_msgs::UInt32 components;
  components.data = kStateAndObjects;
  const ros::SerializedMessage request = ros::serialization::serializeMessage(components);
  ros::SerializedMessage response;
  if (!client.call(request, response, "*")) throw InvalidInput(service + " has failed");
  const std::uint8_t* const end = response.buf.get() + response.num_bytes;
  read({response.message_start, static_cast<size_t>(end - response.message_start)}, now().stamp);
}

}  // namespace sweep_guard_ros
