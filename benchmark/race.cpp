#include "race.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <iterator>

#include "microseconds.h"

namespace sweep_guard_benchmark {
namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kWarmUpFrames = 3;
constexpr size_t kMinFrames = 3;
constexpr double kRounding = 1e-9;  // of the polytope in M and of its clipping [m]

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

Entrant::Entrant(const Workload& workload, const Factory& make)
    : surface_(std::make_unique<Surface>(workload.surface)), peer_(make(*surface_)), ids_(workload.queries) {}

double Entrant::run(const Frame& frame) {
  peer_->prepare(frame.volumes_M);
  for (TriangleIds& ids : ids_) ids.clear();
  std::memcpy(surface_->positions_M.data(), frame.positions_M.data(), sizeof(float) * frame.positions_M.size());
  const double time = sweep_guard_core::microseconds([&] {
    peer_->update();
    peer_->queryAll(ids_);
  });
  if (peer_->answers()) check(frame);
  return time;
}

void Entrant::check(const Frame& frame) {
  const auto corner = [&](size_t vertex) { return &frame.positions_M[3 * vertex]; };
  for (size_t volume = 0; volume < ids_.size(); ++volume) {
    TriangleIds ids = ids_[volume];
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    const TriangleIds& truth = frame.truth[volume];
    TriangleIds missed;
    std::set_difference(truth.begin(), truth.end(), ids.begin(), ids.end(), std::back_inserter(missed));
    misses_ += missed.size();
    TriangleIds added;
    std::set_difference(ids.begin(), ids.end(), truth.begin(), truth.end(), std::back_inserter(added));
    for (const std::uint32_t id : added) {
      const auto& [a, b, c] = surface_->triangles[id];
      const double grown = peer_->inflation() + kRounding;
      if (!meets(frame.volumes_M[volume], corner(a), corner(b), corner(c), grown)) ++extras_;
    }
  }
}

Race race(const Workload& workload, Entrant& ours, Entrant& peer, const Limits& limits) {
  const auto start = Clock::now();
  const auto frame = [&](size_t i) -> const Frame& { return workload.frames[i % workload.frames.size()]; };
  for (size_t i = 0; i < kWarmUpFrames && secondsSince(start) < 0.1 * limits.seconds; ++i) {
    ours.run(frame(i));
    peer.run(frame(i));
  }
  Race race;
  for (size_t i = 0; i < limits.frames; ++i) {
    if (race.ratio.size() >= kMinFrames && secondsSince(start) > limits.seconds) break;
    const bool ours_first = i % 2 == 0;
    double ours_us = ours_first ? ours.run(frame(i)) : 0.0;
    const double peer_us = peer.run(frame(i));
    if (!ours_first) ours_us = ours.run(frame(i));
    race.ours_us.push_back(ours_us);
    race.peer_us.push_back(peer_us);
    race.ratio.push_back(peer_us / ours_us);
  }
  return race;
}

}  // namespace sweep_guard_benchmark
