#include "guard/workpiece_store.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "common/number_text.h"
#include "guard/rigid_shape.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kMaxWorkpieces = 1000;
constexpr size_t kMaxRemoved = 64;
constexpr size_t kRemembered = 512;  // deformations: snapshots that none of them needed are given back

bool before(const std::shared_ptr<const Workpiece>& workpiece, const std::string& id) { return workpiece->id < id; }

void requireOrder(const Workpiece& current, Time stamp, Time latest) {
  if (stamp < current.stamp && current.stamp <= latest) throw InvalidInput("stamp is older than the previous one");
}

InvalidInput attachedAnd(const std::string& id, const std::string& why) {
  return InvalidInput(why + ", but '" + id + "' is attached to the tool: detach it first");
}

void requireNoCamera(const Workpiece& current) {
  if (current.of_camera) throw InvalidInput("'" + current.id + "' is a camera: give the workpiece another id");
}

void requireRevision(const Workpiece& attached, std::uint32_t revision) {
  if (revision != attached.revision) throw attachedAnd(attached.id, "its revision has changed");
}

// Beyond that, positions are too coarse for a contact.
void requireFine(const Eigen::Vector3d& largest) {
  const double rounding = float32Rounding(largest);
  if (!(rounding > kMaxSentRounding)) return;
  std::array<char, 96> text;
  std::snprintf(text.data(), text.size(), "float32 rounds coordinates of %.0f km by up to %.0f mm",
                1e-3 * largest.maxCoeff(), 1e3 * rounding);
  throw InvalidInput(std::string(text.data()) + ": send the vertices in a frame near the workpiece");
}

Eigen::Vector3d largestOf(const std::vector<float>& positions) {
  const auto vertices = static_cast<Eigen::Index>(positions.size() / 3);
  return Eigen::Map<const Eigen::Matrix3Xf>(positions.data(), 3, vertices)
      .cwiseAbs()
      .rowwise()
      .maxCoeff()
      .cast<double>();
}

Eigen::Vector3d largestOf(const TriangleMesh& mesh_M) {
  const Eigen::AlignedBox3d bounds_M = mesh_M.bounds_M();
  return bounds_M.min().cwiseAbs().cwiseMax(bounds_M.max().cwiseAbs());
}

void requireShape(const Workpiece& attached, const RigidFit& fit, double rounding) {
  if (fit.deviation <= WorkpieceStore::rigidWithin(attached.mesh_M.rounding() + rounding)) return;
  throw attachedAnd(attached.id, "it deforms by " + shortText(fit.deviation) + " m");
}

}  // namespace

WorkpieceStore::WorkpieceStore(OnChange on_change) : on_change_(std::move(on_change)) {}

UpdateOutcome WorkpieceStore::set(Workpiece next, Time latest) {
  if (const auto held = attached(next.id)) {
    const Workpiece& workpiece = *held->workpiece;
    if (!sameTriangles(workpiece.mesh_M, next.mesh_M)) throw attachedAnd(next.id, "it has other triangles");
    requireRevision(workpiece, next.revision);
    requireShape(workpiece, rigidFit(workpiece.mesh_M, next.mesh_M), next.mesh_M.rounding());
    return UpdateOutcome::kStored;
  }
  const auto current = find(next.id);
  if (current) requireNoCamera(*current);
  const bool same = current && sameTriangles(current->mesh_M, next.mesh_M);
  if (current) {
    if (same && next.revision == current->revision && next.stamp < current->stamp && current->stamp <= latest) {
      return UpdateOutcome::kIgnored;
    }
    requireOrder(*current, next.stamp, latest);
  } else {
    requireRoom();
  }
  if (same && next.frame == current->frame) countUpdate(*current, next);
  buffers_.erase(next.id);
  replace(std::make_shared<const Workpiece>(std::move(next)));
  return UpdateOutcome::kStored;
}

void WorkpieceStore::requireRoom() const {
  if (snapshot().size() < kMaxWorkpieces) return;
  throw InvalidInput("there are " + std::to_string(kMaxWorkpieces) + " workpieces already: remove some");
}

void WorkpieceStore::show(const std::shared_ptr<const Workpiece>& image, Time latest) {
  if (const auto current = find(image->id)) {
    if (!current->of_camera) throw InvalidInput("there is a workpiece '" + image->id + "': give the camera another id");
    requireOrder(*current, image->stamp, latest);
  } else {
    requireRoom();
  }
  replace(image);
}

// It may overtake the mesh, which is a message of another topic.
UpdateOutcome WorkpieceStore::confirm(const Deformation& deformation) const {
  const auto held = attached(deformation.id);
  const std::shared_ptr<const Workpiece> current = held ? held->workpiece : find(deformation.id);
  const bool same = current && !current->of_camera && current->revision == deformation.revision &&
                    current->frame == deformation.frame && current->stamp <= deformation.stamp;
  return same ? UpdateOutcome::kConfirmed : UpdateOutcome::kIgnored;
}

UpdateOutcome WorkpieceStore::deform(const Deformation& deformation, Time latest) {
  if (deformation.positions_M.empty()) return confirm(deformation);
  if (const auto held = attached(deformation.id)) {
    const Workpiece& workpiece = *held->workpiece;
    requireRevision(workpiece, deformation.revision);
    workpiece.mesh_M.checkCount(deformation.positions_M);
    const Eigen::Vector3d largest = largestOf(deformation.positions_M);
    requireFine(largest);
    requireShape(workpiece, rigidFit(workpiece.mesh_M, deformation.positions_M), float32Rounding(largest));
    return UpdateOutcome::kStored;
  }
  const auto current = find(deformation.id);
  if (!current) return wasRemoved(deformation) ? UpdateOutcome::kIgnored : UpdateOutcome::kUnknownWorkpiece;
  requireNoCamera(*current);
  if (current->revision != deformation.revision) {
    throw InvalidInput("vertices have revision " + std::to_string(deformation.revision) + ", their mesh has " +
                       std::to_string(current->revision));
  }
  requireOrder(*current, deformation.stamp, latest);
  current->mesh_M.checkCount(deformation.positions_M);
  const auto next = unusedSnapshot(*current);
  std::vector<float>& positions_M = buffers_[deformation.id].positions_M;
  positions_M.assign(deformation.positions_M.begin(), deformation.positions_M.end());
  next->mesh_M.deform(positions_M);
  requireFine(largestOf(next->mesh_M));
  next->revision = deformation.revision;
  next->stamp = deformation.stamp;
  next->received = deformation.received;
  next->frame = deformation.frame;
  countUpdate(*current, *next);
  replace(next);
  buffers_[deformation.id].snapshots.forgetUnneeded(kRemembered);
  return UpdateOutcome::kStored;
}

bool WorkpieceStore::wasRemoved(const Deformation& deformation) const {
  const Lock lock(mutex_);
  return std::any_of(removed_.begin(), removed_.end(), [&](const auto& removed) {
    return removed.first == deformation.id && deformation.stamp <= removed.second;
  });
}

std::shared_ptr<Workpiece> WorkpieceStore::unusedSnapshot(const Workpiece& current) {
  Pool<Workpiece>& pool = buffers_[current.id].snapshots;
  const auto fits = [&](const Workpiece& one) { return &one.mesh_M.triangles() == &current.mesh_M.triangles(); };
  auto unused = pool.take(fits);
  return unused ? unused : pool.add(current);
}

std::shared_ptr<const Workpiece> WorkpieceStore::find(const std::string& id) const {
  const Lock lock(mutex_);
  const auto found = std::lower_bound(workpieces_.begin(), workpieces_.end(), id, before);
  return found != workpieces_.end() && (*found)->id == id ? *found : nullptr;
}

void WorkpieceStore::replace(std::shared_ptr<const Workpiece> snapshot) {
  const Lock lock(mutex_);
  if (attached_.count(snapshot->id) != 0) throw attachedAnd(snapshot->id, "it came while it was attached");
  replaceLocked(std::move(snapshot));
}

void WorkpieceStore::replaceLocked(std::shared_ptr<const Workpiece> snapshot) {
  const auto place = std::lower_bound(workpieces_.begin(), workpieces_.end(), snapshot->id, before);
  const bool known = place != workpieces_.end() && (*place)->id == snapshot->id;
  const bool same_frame = known && (*place)->frame == snapshot->frame;
  if (known) {
    *place = std::move(snapshot);
  } else {
    workpieces_.insert(place, std::move(snapshot));
  }
  if (!same_frame) updateFrames();
  on_change_(workpieces_);
}

bool WorkpieceStore::remove(const std::string& id, Time stamp) {
  buffers_.erase(id);
  const Lock lock(mutex_);
  const auto found = std::lower_bound(workpieces_.begin(), workpieces_.end(), id, before);
  if (found == workpieces_.end() || (*found)->id != id) return false;
  requireNoCamera(**found);
  removed_.emplace_back(id, std::max(stamp, (*found)->stamp));
  if (removed_.size() > kMaxRemoved) removed_.pop_front();
  workpieces_.erase(found);
  updateFrames();
  on_change_(workpieces_);
  return true;
}

void WorkpieceStore::attach(const std::shared_ptr<const Workpiece>& workpiece, const Eigen::Isometry3d& X_BM) {
  const Lock lock(mutex_);
  const auto found = std::lower_bound(workpieces_.begin(), workpieces_.end(), workpiece->id, before);
  const bool same = found != workpieces_.end() && (*found)->id == workpiece->id &&
                    (*found)->frame == workpiece->frame && sameTriangles((*found)->mesh_M, workpiece->mesh_M);
  if (!same) throw InvalidInput("'" + workpiece->id + "' was replaced meanwhile: ask again");
  attached_.insert_or_assign(workpiece->id, Attached{workpiece, X_BM});
  workpieces_.erase(found);
  updateFrames();
  on_change_(workpieces_);
}

void WorkpieceStore::detach(Workpiece workpiece) {
  const Lock lock(mutex_);
  attached_.erase(workpiece.id);
  replaceLocked(std::make_shared<const Workpiece>(std::move(workpiece)));
}

std::optional<WorkpieceStore::Attached> WorkpieceStore::attached(const std::string& id) const {
  const Lock lock(mutex_);
  const auto found = attached_.find(id);
  return found == attached_.end() ? std::nullopt : std::optional(found->second);
}

bool WorkpieceStore::contains(const std::string& id) const { return find(id) != nullptr; }

Workpieces WorkpieceStore::snapshot() const {
  const Lock lock(mutex_);
  return workpieces_;
}

Workpieces WorkpieceStore::snapshotBeside(const std::set<std::string>& attached) const {
  const Lock lock(mutex_);
  const auto is = [](const auto& held, const std::string& id) { return held.first == id; };
  if (std::equal(attached_.begin(), attached_.end(), attached.begin(), attached.end(), is)) return workpieces_;
  throw Error("a workpiece was attached or detached meanwhile: ask again");
}

std::shared_ptr<const std::set<std::string>> WorkpieceStore::frames() const {
  const Lock lock(mutex_);
  return frames_;
}

void WorkpieceStore::updateFrames() {
  std::set<std::string> frames;
  for (const auto& workpiece : workpieces_) frames.insert(workpiece->frame);
  frames_ = std::make_shared<const std::set<std::string>>(std::move(frames));
}

void WorkpieceStore::clearStamps() {
  const Lock lock(mutex_);
  removed_.clear();
  for (auto& workpiece : workpieces_) {
    Workpiece undated = *workpiece;
    undated.stamp = {};
    workpiece = std::make_shared<const Workpiece>(std::move(undated));
  }
  on_change_(workpieces_);
}

}  // namespace sweep_guard_core
