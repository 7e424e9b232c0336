#include "guard/cross_check.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "common/number_text.h"
#include "common/xyz.h"
#include "detection/reference_detector.h"
#include "guard/triangle_set.h"

namespace sweep_guard_core {
namespace {

constexpr std::uint64_t kReferencePeriod = 10;  // [queries]
constexpr size_t kMaxNamed = 20;                // [triangles]

TriangleSet difference(const TriangleSet& a, const TriangleSet& b) {
  TriangleSet only_in_a;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only_in_a));
  return only_in_a;
}

SweptVolume shrunk(SweptVolume volume, double distance) {
  volume.box.half_extents = (volume.box.half_extents.array() - distance).max(0.0);
  for (HalfSpace& clip_B : volume.clips_B) clip_B = clip_B.grown(-distance);
  return volume;
}

std::string text(const Eigen::Vector3d& p) {
  std::string numbers;
  for (const double x : xyz(p)) numbers += ' ' + shortestText(x);
  return numbers;
}

std::string text(Time stamp) {
  const std::int64_t total = stamp.time_since_epoch().count();
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%lld.%09lld", static_cast<long long>(total / 1000000000),
                static_cast<long long>(total % 1000000000));
  return seconds;
}

std::string text(const StampedPose& pose) {
  const Eigen::Quaterniond turn(pose.X_WT.linear());
  return text(Eigen::Vector3d(pose.X_WT.translation())) + text(Eigen::Vector3d(turn.vec())) + ' ' +
         shortestText(turn.w()) + " at " + text(pose.stamp);
}

std::string text(const TriangleSet& triangles) {
  std::string numbers;
  for (size_t i = 0; i < std::min(triangles.size(), kMaxNamed); ++i) numbers += ' ' + std::to_string(triangles[i]);
  if (triangles.size() > kMaxNamed) numbers += " and " + std::to_string(triangles.size() - kMaxNamed) + " more";
  return triangles.empty() ? " none" : numbers;
}

std::string text(const SweptVolume& volume) {
  std::string numbers = " axes";
  for (int i = 0; i < 3; ++i) numbers += text(Eigen::Vector3d(volume.box.X_MB.linear().col(i)));
  numbers += " center" + text(Eigen::Vector3d(volume.box.X_MB.translation()));
  numbers += " half_extents" + text(volume.box.half_extents) + " interior" + text(volume.interior_B);
  numbers += " margin " + shortestText(volume.margin) + " clips " + std::to_string(volume.clips_B.size());
  for (const HalfSpace& clip_B : volume.clips_B) numbers += text(clip_B.normal()) + ' ' + shortestText(clip_B.offset());
  return numbers;
}

}  // namespace

void QuerySampler::setWorkpieces(const Workpieces& workpieces, const QueryOrigin& origin) {
  if (every_ == 0) return;
  workpieces_ = workpieces;
  origin_ = origin;
}

// The workpiece last: a query is kept only if all of it could be copied.
void QuerySampler::offer(const std::string& detector, const Submesh& submesh, const SweptVolume& swept_M,
                         const Detection& found) {
  if (every_ == 0) return;
  count_ = std::min(count_ + 1, every_);
  if (count_ < every_) return;
  const auto same = [&](const auto& workpiece) { return &workpiece->mesh_M == &submesh.mesh_M(); };
  const auto workpiece = std::find_if(workpieces_.begin(), workpieces_.end(), same);
  if (workpiece == workpieces_.end() || !mutex_.tryLock()) return;
  const Lock lock(mutex_, std::adopt_lock);
  if (kept_.workpiece) return;
  count_ = 0;
  kept_.detector = detector;
  kept_.origin = origin_;
  kept_.whole = submesh.groups() != nullptr;
  kept_.clusters.clear();
  if (!kept_.whole) kept_.clusters = submesh.clusters();
  kept_.swept_M = swept_M;
  kept_.found = found;
  kept_.workpiece = *workpiece;
  wake();
}

void QuerySampler::wake() {
  if (thread_waits_) sem_post(&signal_);
  thread_waits_ = false;
}

bool QuerySampler::take(SampledQuery& taken) {
  taken.workpiece.reset();
  while (!takeNow(taken)) sem_wait(&signal_);
  return taken.workpiece != nullptr;
}

// Returns false if the thread has to wait. After stop(), nothing is taken.
bool QuerySampler::takeNow(SampledQuery& taken) {
  const Lock lock(mutex_);
  thread_waits_ = !stopping_ && !kept_.workpiece;
  if (!thread_waits_ && !stopping_) std::swap(taken, kept_);
  return !thread_waits_;
}

bool QuerySampler::waiting() {
  const Lock lock(mutex_);
  return stopping_ || kept_.workpiece;
}

void QuerySampler::stop() {
  const Lock lock(mutex_);
  stopping_ = true;
  wake();
}

std::unique_ptr<Detector> sampled(std::unique_ptr<Detector> detector, const std::string& name, QuerySampler& sampler) {
  detector->reportTo([name, &sampler](const Submesh& submesh, const SweptVolume& swept_M, const Detection& found) {
    sampler.offer(name, submesh, swept_M, found);
  });
  return detector;
}

Disagreement crossCheck(const SampledQuery& query, Detector& other) {
  const TriangleMesh& mesh_M = query.workpiece->mesh_M;
  const Detection& found = query.found;
  const Detection& expected = other.detect(mesh_M, query.swept_M);
  Disagreement result{difference(expected.triangles, found.triangles), difference(found.triangles, expected.triangles)};
  if (!result.any()) return result;
  ReferenceDetector reference;
  const double tolerance = expected.inflation + reference.detect(mesh_M, query.swept_M).inflation;
  keepOnly(result.missed, reference.detect(mesh_M, shrunk(query.swept_M, tolerance)).triangles);
  if (!query.whole) keepOnly(result.missed, testedTriangles(query));
  remove(result.invented, reference.detect(mesh_M, query.swept_M.grown(found.inflation)).triangles);
  return result;
}

std::string describe(const SampledQuery& query, const Disagreement& disagreement) {
  const Workpiece& workpiece = *query.workpiece;
  const QueryOrigin& origin = query.origin;
  return "missed" + text(disagreement.missed) + ", invented" + text(disagreement.invented) + "; mesh '" + workpiece.id +
         "' revision " + std::to_string(workpiece.revision) + " at " + text(workpiece.stamp) + " in '" +
         workpiece.frame + "'; tool " + (origin.measured ? "measured" : "predicted") + " from" + text(origin.from) +
         " to" + text(origin.to) + "; volume in the mesh frame:" + text(query.swept_M);
}

TriangleSet testedTriangles(const SampledQuery& query) {
  const TriangleMesh& mesh_M = query.workpiece->mesh_M;
  const MeshOrder& order = mesh_M.order();
  TriangleSet all;
  for (const Cluster& cluster : query.whole ? order.clusters : query.clusters) {
    for (std::uint64_t left = mesh_M.existing(cluster); left != 0; left &= left - 1) {
      const std::uint32_t place = cluster.first + static_cast<std::uint32_t>(__builtin_ctzll(left));
      all.push_back(order.triangle_at.empty() ? place : order.triangle_at[place]);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::string otherDetector(const std::string& name, std::uint64_t number) {
  if (number % kReferencePeriod == 0 && name != "reference") return "reference";
  return name == "halfspace" ? "select" : "halfspace";
}

}  // namespace sweep_guard_core
