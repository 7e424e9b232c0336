#include "ros/input/mesh_input.h"

#include <ros/console.h>

#include <algorithm>
#include <memory>

#include "ros/input/checked_header.h"
#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InputRecord;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::isName;
using sweep_guard_core::printable;
using sweep_guard_core::SteadyTime;
using sweep_guard_core::TriangleMesh;
using sweep_guard_core::UpdateOutcome;

constexpr size_t kMinCapacity = 256U << 20U;   // [bytes]
constexpr size_t kMaxSendersReason = 500;      // of a sender [bytes]
constexpr size_t kOverhead = 512;              // of a job and its message, beside the serialized bytes
constexpr size_t kMaxEarly = 1024;             // meshes
constexpr size_t kMaxPassedOver = 100;         // ids
constexpr std::uint32_t kMeshesQueued = 1000;  // each message may be of another workpiece; taken from it at once

sweep_guard_core::Time latestStamp() { return now().stamp + kFutureTolerance; }

bool removes(const sweep_guard::DeformableMesh& msg) { return msg.mesh.vertices.empty() && msg.mesh.triangles.empty(); }

void requireGiven(const sweep_guard::DeformableMesh& msg) {
  if (!msg.refused.empty()) throw InvalidInput("its sender says: " + printable(msg.refused, kMaxSendersReason));
}

// All workpieces may arrive at once: latched meshes are not sent again.
size_t capacity(const Parameters& parameters) { return std::max(kMinCapacity, 4 * parameters.max_message_size); }

template <typename Msg>
size_t sizeOf(const Msg& msg) {
  return ros::serialization::serializationLength(msg) + kOverhead;
}

}  // namespace

MeshInput::MeshInput(const ros::NodeHandle& node, const Parameters& parameters,
                     sweep_guard_core::WorkpieceStore& workpieces, sweep_guard_core::WarningMonitor& monitor)
    : mesh_ids_(parameters.mesh_ids),
      other_tools_(parameters.other_tools),
      cameras_(cameraIds(parameters)),
      sheets_(parameters.sheets),
      paddings_(parameters.paddings),
      max_triangles_(parameters.max_triangles),
      max_waiting_bytes_(capacity(parameters)),
      workpieces_(workpieces),
      monitor_(monitor),
      storing_(max_waiting_bytes_),
      converting_(max_waiting_bytes_),
      mesh_(
          subscribe<sweep_guard::DeformableMesh>(thread_.on(node), "mesh", parameters.max_message_size, mesh_record_)),
      vertices_(subscribe<sweep_guard::MeshVertices>(thread_.on(node), "mesh_vertices", parameters.max_message_size,
                                                     vertices_record_)) {}

template <typename Msg>
BoundedSubscriber MeshInput::subscribe(ros::NodeHandle node, const std::string& topic, size_t max_size,
                                       InputRecord& record) {
  return subscribeBounded<Msg>(
      node, {topic, kMeshesQueued, max_size},
      [this](const ros::MessageEvent<const Msg>& event) { onMessage(event.getConstMessage()); },
      [this, &record](const std::string& reason) { unread(reason, record); });
}

void MeshInput::start(Supervisor& supervisor) {
  const auto thread = [](const char* name) {
    return ThreadTraits{name, sweep_guard_core::Stage::kReceive, /*watched=*/true, /*loses_latched=*/true};
  };
  storing_.start(supervisor, thread("storing"));
  converting_.start(supervisor, thread("converting"));
  thread_.start(supervisor, thread("meshes"));
}

void MeshInput::onMessage(const sweep_guard::DeformableMesh::ConstPtr& msg) {
  if (!readable(msg->id, msg->header, mesh_record_)) return;
  const SteadyTime received = std::chrono::steady_clock::now();
  enterConversion(msg->id, /*needed=*/true);
  pushToConversion(msg->id, {[this, msg, received] { convert(msg, received); },
                             [this, msg, received] { drop(*msg, received); }, sizeOf(*msg)});
}

void MeshInput::onMessage(const sweep_guard::MeshVertices::ConstPtr& msg) {
  if (!readable(msg->id, msg->header, vertices_record_)) return;
  const SteadyTime received = std::chrono::steady_clock::now();
  if (!enterConversion(msg->id, /*needed=*/false)) return pushToStore(msg, received);
  pushToConversion(msg->id, {[this, msg, received] { pushToStore(msg, received); },
                             [this, msg, received] { drop(*msg, received); }, sizeOf(*msg), /*replaceable=*/true});
}

void MeshInput::pushToConversion(const std::string& id, const Worker::Job& job) {
  const auto and_leave = [&](const std::function<void()>& work) {
    return [this, id, work] {
      work();
      leaveConversion(id);
    };
  };
  converting_.push({and_leave(job.run), and_leave(job.drop), job.bytes, job.replaceable});
}

// Counts a message that is to go through converting_. One that needs no conversion only follows those that do.
bool MeshInput::enterConversion(const std::string& id, bool needed) {
  const sweep_guard_core::Lock lock(conversion_mutex_);
  if (!needed && in_conversion_.count(id) == 0) return false;
  ++in_conversion_[id];
  return true;
}

void MeshInput::leaveConversion(const std::string& id) {
  const sweep_guard_core::Lock lock(conversion_mutex_);
  const auto messages = in_conversion_.find(id);
  if (--messages->second == 0) in_conversion_.erase(messages);
}

void MeshInput::pushToStore(const sweep_guard::MeshVertices::ConstPtr& msg, SteadyTime received) {
  storing_.push({[this, msg, received] { store(*msg, received); }, [this, msg, received] { drop(*msg, received); },
                 sizeOf(*msg), /*replaceable=*/true});
}

void MeshInput::passOver(const std::string& id) {
  const sweep_guard_core::Lock lock(passed_over_mutex_);
  if (passed_over_.size() < kMaxPassedOver) passed_over_.insert(printable(id));
}

bool MeshInput::readable(const std::string& id, const std_msgs::Header& header, InputRecord& record) {
  if (!mesh_ids_.empty() && mesh_ids_.count(id) == 0) {
    passOver(id);
    return false;
  }
  record.received({fromMsg(header.stamp), std::chrono::steady_clock::now()});
  const auto is_link = [&](const std::string& tool) { return id.compare(0, tool.size() + 1, tool + "/") == 0; };
  if (std::any_of(other_tools_.begin(), other_tools_.end(), is_link)) {
    unread("id '" + printable(id) + "' is that of a link of another tool (other_tools)", record);
    return false;
  }
  if (cameras_.count(id) != 0) {
    unread("id '" + printable(id) + "' is that of a camera (cameras)", record);
    return false;
  }
  if (isName(id)) return true;
  unread(id.empty() ? "id is empty: name the workpiece"
                    : "id '" + printable(id) + "' has more than 128 or unprintable characters",
         record);
  return false;
}

void MeshInput::unread(const std::string& reason, InputRecord& record) {
  const std::string message = "message refused: " + reason;
  record.error(message, /*refused=*/true);
  monitor_.meshUnread(message, std::chrono::steady_clock::now());
  log_.error("unread", message);
}

void MeshInput::convert(const sweep_guard::DeformableMesh::ConstPtr& msg, SteadyTime received) {
  forgetEarly(msg->id);
  try {
    requireGiven(*msg);
    auto mesh_M = std::make_shared<std::optional<TriangleMesh>>();
    if (!removes(*msg)) {
      checkHeader(msg->header);
      mesh_M->emplace(meshOf(*msg));
    }
    storing_.push({[this, msg, received, mesh_M] { store(*msg, received, std::move(*mesh_M)); },
                   [this, msg, received] { drop(*msg, received); }, sizeOf(*msg)});
  } catch (const std::exception& error) {  // invalid, or out of memory
    monitor_.meshRefused(msg->id, refusal(msg->id, error, mesh_record_), received);
    keepIfEarly(msg, received);
  }
}

TriangleMesh MeshInput::meshOf(const sweep_guard::DeformableMesh& msg) const {
  const bool* const is_sheet = sheets_.of(msg.id);
  TriangleMesh mesh_M = fromMsg(msg.mesh, max_triangles_, msg.open != 0 || (is_sheet != nullptr && *is_sheet));
  const double* const padding = paddings_.of(msg.id);
  mesh_M.pad(padding == nullptr ? 0.0 : *padding);
  return mesh_M;
}

// The clock of a simulation may be silent for a while, and a latched mesh is not sent again.
void MeshInput::keepIfEarly(const sweep_guard::DeformableMesh::ConstPtr& msg, SteadyTime received) {
  if (!ros::Time::isSimTime() || fromMsg(msg->header.stamp) <= latestStamp()) return;
  const sweep_guard_core::Lock lock(early_mutex_);
  size_t bytes = sizeOf(*msg);
  for (const auto& [id, early] : early_) bytes += sizeOf(*early.msg);
  if (early_.size() < kMaxEarly && bytes <= max_waiting_bytes_) early_[msg->id] = {msg, received};
}

void MeshInput::forgetEarly(const std::string& id) {
  const sweep_guard_core::Lock lock(early_mutex_);
  early_.erase(id);
}

void MeshInput::takeEarly() {
  const sweep_guard_core::Lock lock(early_mutex_);
  for (const auto& [id, early] : early_) {
    if (fromMsg(early.msg->header.stamp) > latestStamp()) continue;
    storing_.push({[this, id = id] { storeEarly(id); }, [] {}, kOverhead + id.size()});
  }
}

// Converted here, before any vertices of later stamps are stored.
void MeshInput::storeEarly(const std::string& id) {
  const auto early = dueOf(id);
  if (!early) return;
  const auto& [msg, received] = *early;
  try {
    requireGiven(*msg);
    checkHeader(msg->header);
    store(*msg, received, meshOf(*msg));
  } catch (const std::exception& error) {  // invalid, or out of memory
    monitor_.meshRefused(id, refusal(id, error, mesh_record_), received);
  }
}

std::optional<MeshInput::EarlyMesh> MeshInput::dueOf(const std::string& id) {
  const sweep_guard_core::Lock lock(early_mutex_);
  const auto early = early_.find(id);
  if (early == early_.end() || fromMsg(early->second.msg->header.stamp) > latestStamp()) return {};
  EarlyMesh due = std::move(early->second);
  early_.erase(early);
  return due;
}

void MeshInput::store(const sweep_guard::DeformableMesh& msg, SteadyTime received, std::optional<TriangleMesh> mesh_M) {
  try {
    const sweep_guard_core::Time stamp = fromMsg(msg.header.stamp);
    bool removed = true;
    if (!mesh_M) {
      removed = workpieces_.remove(msg.id, std::min(stamp, latestStamp()));
    } else if (workpieces_.set({msg.id, msg.revision, stamp, received, msg.header.frame_id, std::move(*mesh_M)},
                               latestStamp()) == UpdateOutcome::kIgnored) {
      return;
    }
    const bool was_refused = monitor_.meshAccepted(msg.id, received);
    if (!removed && !was_refused) ROS_INFO_THROTTLE(1.0, "no workpiece '%s' to remove", msg.id.c_str());
  } catch (const std::exception& error) {  // invalid, or out of memory
    monitor_.meshRefused(msg.id, refusal(msg.id, error, mesh_record_), received);
  }
}

void MeshInput::store(const sweep_guard::MeshVertices& msg, SteadyTime received) {
  try {
    checkHeader(msg.header);
    storeEarly(msg.id);
    const UpdateOutcome outcome = workpieces_.deform(
        {msg.id, msg.revision, fromMsg(msg.header.stamp), received, msg.header.frame_id, msg.positions}, latestStamp());
    if (outcome == UpdateOutcome::kStored) monitor_.verticesAccepted(msg.id, received);
    if (outcome == UpdateOutcome::kConfirmed) monitor_.confirmed(msg.id, {fromMsg(msg.header.stamp), received});
    if (outcome == UpdateOutcome::kUnknownWorkpiece) {
      unread("vertices of '" + msg.id + "' came before their mesh: publish DeformableMesh latched", vertices_record_);
    }
  } catch (const std::exception& error) {  // invalid, or out of memory
    const bool known = workpieces_.contains(msg.id) || workpieces_.attached(msg.id);
    const bool lasts = known && !msg.positions.empty();  // until the next positions
    if (!lasts) return unread("vertices of '" + msg.id + "': " + error.what(), vertices_record_);
    monitor_.verticesRefused(msg.id, refusal(msg.id, error, vertices_record_), received);
  }
}

std::string MeshInput::refusal(const std::string& id, const std::exception& error, InputRecord& record) {
  std::string message = "workpiece '" + id + "' refused: " + error.what();
  record.error(message, /*refused=*/true);
  log_.error(id, message);
  return message;
}

void MeshInput::drop(const sweep_guard::DeformableMesh& msg, SteadyTime received) {
  ++dropped_;
  const InvalidInput error("too many messages wait: publish more slowly");
  monitor_.meshRefused(msg.id, refusal(msg.id, error, mesh_record_), received);
}

void MeshInput::drop(const sweep_guard::MeshVertices& msg, SteadyTime received) {
  ++dropped_;
  if (msg.positions.empty()) return;
  if (!workpieces_.contains(msg.id)) return unread("vertices of '" + msg.id + "' were dropped", vertices_record_);
  monitor_.updateDropped(msg.id, received);
}

}  // namespace sweep_guard_ros
