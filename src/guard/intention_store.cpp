#include "guard/intention_store.h"

#include <algorithm>

#include "guard/triangle_set.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr Duration kMaxDuration = std::chrono::hours(24);

const Workpiece& workpieceOf(const std::string& id, const Workpieces& workpieces) {
  const auto same = [&](const auto& workpiece) { return workpiece->id == id; };
  const auto found = std::find_if(workpieces.begin(), workpieces.end(), same);
  if (found == workpieces.end()) throw InvalidInput("there is no workpiece '" + id + "'");
  return **found;
}

bool isWithin(const Eigen::Vector3d& center_M, double radius, const Triangle& triangle, const TriangleMesh& mesh_M) {
  return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
    return (mesh_M.vertex(corner) - center_M).norm() + mesh_M.rounding() <= radius;
  });
}

TriangleSet trianglesWithin(const Eigen::Vector3d& center_M, double radius, const Workpiece& workpiece) {
  if (!(radius > 0.0) || !(radius <= kMaxCoordinate)) throw InvalidInput("radius must be above 0");
  if (!center_M.allFinite()) throw InvalidInput("center of the ball is not finite");
  const std::vector<Triangle>& triangles = workpiece.mesh_M.triangles();
  TriangleSet within;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (isWithin(center_M, radius, triangles[i], workpiece.mesh_M)) within.push_back(i);
  }
  if (within.empty()) throw InvalidInput("no triangle of '" + workpiece.id + "' lies wholly in the ball");
  return within;
}

TriangleSet regionOf(const IntentionRequest& request, const Workpiece& workpiece) {
  TriangleSet region = request.triangles;
  std::sort(region.begin(), region.end());
  region.erase(std::unique(region.begin(), region.end()), region.end());
  if (!region.empty() && region.back() >= workpiece.mesh_M.triangles().size()) {
    throw InvalidInput("'" + workpiece.id + "' has no triangle " + std::to_string(region.back()));
  }
  if (request.radius) unite(region, trianglesWithin(request.center_M, *request.radius, workpiece));
  return region;
}

void checkLimits(const IntentionRequest& request) {
  if (!(request.depth > 0.0) || !(request.depth <= kMaxIntendedDepth)) {
    throw InvalidInput("depth must be above 0 and at most 0.5 m");
  }
  if (request.duration < Duration::zero() || request.duration > kMaxDuration) {
    throw InvalidInput("duration must be from 0 to 24 h");
  }
}

// Without triangles: takes back.
Intention intentionOf(const IntentionRequest& request, const Workpieces& workpieces, SteadyTime now) {
  if (request.takesBack()) return {request.mesh_id, nullptr, {}};
  const Workpiece& workpiece = workpieceOf(request.mesh_id, workpieces);
  if (workpiece.of_camera) {
    throw InvalidInput("'" + workpiece.id +
                       "' is what a camera sees: its triangles are pixels, and stand for no region");
  }
  checkLimits(request);
  Intention intention{request.mesh_id, workpiece.mesh_M.sharedTriangles(), regionOf(request, workpiece), request.depth,
                      request.tool_links};
  if (request.duration > Duration::zero()) intention.until = now + request.duration;
  return intention;
}

bool sameButForTriangles(const Intention& a, const Intention& b) {
  return a.mesh_id == b.mesh_id && a.depth == b.depth && a.tool_links == b.tool_links && !a.until && !b.until;
}

void addTo(Intentions& all, Intention intention) {
  const auto same = [&](const Intention& other) { return sameButForTriangles(other, intention); };
  const auto known = std::find_if(all.begin(), all.end(), same);
  if (known == all.end()) {
    all.push_back(std::move(intention));
  } else {
    unite(known->triangles, intention.triangles);
  }
  if (all.size() > kMaxIntentions) throw InvalidInput("64 regions are intended already: take some back");
}

}  // namespace

// The triangles of a ball are searched without the lock, which the guard's thread takes for every sweep.
void IntentionStore::set(const std::vector<IntentionRequest>& requests, SteadyTime now) {
  const Workpieces workpieces = newest();
  Intentions regions;
  for (const IntentionRequest& request : requests) regions.push_back(intentionOf(request, workpieces, now));
  const Lock lock(mutex_);
  endBefore(now);
  Intentions all = *intentions_;
  for (Intention& region : regions) apply(std::move(region), all);
  replace(std::move(all));
}

Workpieces IntentionStore::newest() const {
  const Lock lock(mutex_);
  return newest_;
}

void IntentionStore::apply(Intention region, Intentions& all) const {
  if (region.triangles.empty()) {
    const auto same = [&](const Intention& intention) { return intention.mesh_id == region.mesh_id; };
    all.erase(std::remove_if(all.begin(), all.end(), same), all.end());
    return;
  }
  if (!region.concerns(workpieceOf(region.mesh_id, newest_))) {
    throw InvalidInput("'" + region.mesh_id + "' was replaced meanwhile: ask again");
  }
  addTo(all, std::move(region));
}

void IntentionStore::follow(const Workpieces& newest) {
  const Lock lock(mutex_);
  newest_ = newest;
  if (intentions_->empty()) return;
  const auto find = [&](const Intention& intention) {
    return std::find_if(newest.begin(), newest.end(), [&](const auto& one) { return one->id == intention.mesh_id; });
  };
  const auto concerns = [&](const Intention& intention) {
    const auto workpiece = find(intention);
    return workpiece != newest.end() && intention.concerns(**workpiece);
  };
  if (std::all_of(intentions_->begin(), intentions_->end(), concerns)) return;
  Intentions kept;
  for (Intention intention : *intentions_) {
    const auto workpiece = find(intention);
    if (workpiece == newest.end() || (*workpiece)->mesh_M.triangles() != *intention.mesh_triangles) continue;
    intention.mesh_triangles = (*workpiece)->mesh_M.sharedTriangles();
    kept.push_back(std::move(intention));
  }
  replace(std::move(kept));
}

void IntentionStore::clear() {
  const Lock lock(mutex_);
  if (!intentions_->empty()) replace({});
}

std::shared_ptr<const Intentions> IntentionStore::at(SteadyTime now) {
  const Lock lock(mutex_);
  endBefore(now);
  return intentions_;
}

void IntentionStore::endBefore(SteadyTime now) {
  const auto is_over = [&](const Intention& intention) { return intention.until && *intention.until <= now; };
  if (std::none_of(intentions_->begin(), intentions_->end(), is_over)) return;
  Intentions kept = *intentions_;
  kept.erase(std::remove_if(kept.begin(), kept.end(), is_over), kept.end());
  replace(std::move(kept));
}

void IntentionStore::replace(Intentions all) { intentions_ = std::make_shared<const Intentions>(std::move(all)); }

}  // namespace sweep_guard_core
