#include "ros/input/workpiece_store.h"

#include <ros/console.h>

#include <algorithm>

#include "ros/input/future_stamp.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/guard/displacements.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::Workpiece;

constexpr size_t kMaxWorkpieces = 1000;

void checkHeader(const std::string& id, const std_msgs::Header& header) {
  if (id.empty()) throw InvalidInput("the id is empty: name the workpiece");
  if (header.frame_id.empty()) throw InvalidInput("header.frame_id is empty: name the frame of the vertices");
  if (liesInFuture(fromMsg(header.stamp))) {
    throw InvalidInput("its stamp lies in the future: are the clocks synchronised?");
  }
}

bool before(const std::shared_ptr<const Workpiece>& workpiece, const std::string& id) { return workpiece->id < id; }

}  // namespace

WorkpieceStore::WorkpieceStore(size_t max_triangles, sweep_guard_core::WarningMonitor& monitor)
    : max_triangles_(max_triangles), monitor_(monitor) {}

void WorkpieceStore::accept(const sweep_guard::DeformableMesh& msg) {
  const auto refusal = refusalOf(msg, meshes_);
  refusal ? monitor_.meshRefused(msg.id, *refusal) : monitor_.meshAccepted(msg.id);
}

void WorkpieceStore::accept(const sweep_guard::MeshVertices& msg) {
  const auto refusal = refusalOf(msg, vertices_);
  refusal ? monitor_.verticesRefused(msg.id, *refusal) : monitor_.verticesAccepted(msg.id);
}

// Stores it, or says why not.
template <typename Msg>
std::optional<std::string> WorkpieceStore::refusalOf(const Msg& msg, InputRecord& record) {
  record.came({fromMsg(msg.header.stamp), std::chrono::steady_clock::now()});
  try {
    store(msg);
    return std::nullopt;
  } catch (const std::exception& error) {  // invalid, or no memory for it
    const std::string story = "workpiece '" + msg.id + "' refused: " + error.what();
    record.refused(story);
    log_.error(msg.id, story);
    return story;
  }
}

void WorkpieceStore::store(const sweep_guard::DeformableMesh& msg) {
  if (msg.mesh.vertices.empty() && msg.mesh.triangles.empty()) return remove(msg.id);
  checkHeader(msg.id, msg.header);
  const auto current = find(msg.id);
  if (current) {
    checkOrder(*current, fromMsg(msg.header.stamp));
  } else if (snapshot().size() >= kMaxWorkpieces) {
    throw InvalidInput("there are " + std::to_string(kMaxWorkpieces) + " workpieces already: remove some");
  }
  sweep_guard_core::TriangleMesh mesh_M = fromMsg(msg.mesh, max_triangles_);
  const bool deforms = current && current->frame == msg.header.frame_id &&
                       current->mesh_M.vertexCount() == mesh_M.vertexCount() &&
                       current->mesh_M.triangles() == mesh_M.triangles();
  const std::uint64_t updates = deforms ? current->updates + 1 : 0;
  const double way =
      deforms ? current->path_length + sweep_guard_core::Displacements(current->mesh_M, mesh_M).farthest() : 0.0;
  deformations_.erase(msg.id);
  replace(std::make_shared<const Workpiece>(Workpiece{msg.id, msg.revision, fromMsg(msg.header.stamp),
                                                      std::chrono::steady_clock::now(), msg.header.frame_id,
                                                      std::move(mesh_M), updates, way}));
}

void WorkpieceStore::store(const sweep_guard::MeshVertices& msg) {
  checkHeader(msg.id, msg.header);
  const auto current = find(msg.id);
  if (!current) throw InvalidInput("its vertices came, but not its mesh: publish DeformableMesh latched");
  if (current->revision != msg.revision) {
    throw InvalidInput("its vertices have revision " + std::to_string(msg.revision) + ", its mesh " +
                       std::to_string(current->revision));
  }
  const sweep_guard_core::Time stamp = fromMsg(msg.header.stamp);
  checkOrder(*current, stamp);
  const auto next = deformed(*current, msg.positions);
  next->revision = msg.revision;
  next->stamp = stamp;
  next->received = std::chrono::steady_clock::now();
  next->frame = msg.header.frame_id;
  next->updates = current->updates + 1;
  next->path_length = current->path_length + sweep_guard_core::Displacements(current->mesh_M, next->mesh_M).farthest();
  replace(next);
}

// In a snapshot that nobody holds, where there is one. The only copy of the positions.
std::shared_ptr<Workpiece> WorkpieceStore::deformed(const Workpiece& current, const std::vector<float>& positions_M) {
  Deformations& deformations = deformations_[current.id];
  const auto fits = [&](const Workpiece& one) { return &one.mesh_M.triangles() == &current.mesh_M.triangles(); };
  auto next = deformations.snapshots.take(fits);
  if (!next) next = deformations.snapshots.add(current);
  deformations.positions_M.assign(positions_M.begin(), positions_M.end());
  next->mesh_M.deform(deformations.positions_M);
  return next;
}

// A current stamp that lies in the future is from before time went back: it says nothing about order.
void WorkpieceStore::checkOrder(const Workpiece& current, sweep_guard_core::Time stamp) const {
  if (stamp < current.stamp && current.stamp <= now().stamp + kFutureTolerance) {
    throw InvalidInput("its stamp goes back");
  }
}

std::shared_ptr<const Workpiece> WorkpieceStore::find(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = std::lower_bound(workpieces_.begin(), workpieces_.end(), id, before);
  return found != workpieces_.end() && (*found)->id == id ? *found : nullptr;
}

void WorkpieceStore::replace(std::shared_ptr<const Workpiece> snapshot) {
  const std::lock_guard lock(mutex_);
  const auto place = std::lower_bound(workpieces_.begin(), workpieces_.end(), snapshot->id, before);
  const bool known = place != workpieces_.end() && (*place)->id == snapshot->id;
  const bool stays = known && (*place)->frame == snapshot->frame;
  if (known) {
    *place = std::move(snapshot);
  } else {
    workpieces_.insert(place, std::move(snapshot));
  }
  if (!stays) gatherFrames();  // rarely; each pose asks for them
  monitor_.setWorkpieces(workpieces_);
}

void WorkpieceStore::remove(const std::string& id) {
  deformations_.erase(id);
  if (!find(id)) ROS_WARN("workpiece '%s' is to be removed, but there is none", id.c_str());
  const std::lock_guard lock(mutex_);
  workpieces_.erase(std::remove_if(workpieces_.begin(), workpieces_.end(),
                                   [&](const auto& workpiece) { return workpiece->id == id; }),
                    workpieces_.end());
  gatherFrames();
  monitor_.setWorkpieces(workpieces_);
}

sweep_guard_core::Workpieces WorkpieceStore::snapshot() const {
  const std::lock_guard lock(mutex_);
  return workpieces_;
}

std::shared_ptr<const std::set<std::string>> WorkpieceStore::frames() const {
  const std::lock_guard lock(mutex_);
  return frames_;
}

void WorkpieceStore::gatherFrames() {
  std::set<std::string> frames;
  for (const auto& workpiece : workpieces_) frames.insert(workpiece->frame);
  frames_ = std::make_shared<const std::set<std::string>>(std::move(frames));
}

void WorkpieceStore::timeJumped() {
  const std::lock_guard lock(mutex_);
  for (auto& workpiece : workpieces_) {
    Workpiece undated = *workpiece;
    undated.stamp = {};
    workpiece = std::make_shared<const Workpiece>(std::move(undated));
  }
  monitor_.setWorkpieces(workpieces_);
}

}  // namespace sweep_guard_ros
