#pragma once

#include <functional>
#include <memory>

#include "peers/peer.h"
#include "sample.h"
#include "workload.h"

namespace sweep_guard_benchmark {

/// What one peer took for the frames of a workload, and answered.
class Entrant {
 public:
  using Factory = std::function<std::unique_ptr<Peer>(Surface&)>;
  Entrant(const Workload& workload, const Factory& make);

  /// Writes the positions of a frame, which is not timed, and has the peer take them in and answer.
  /// @return the time for that [us]
  double run(const Frame& frame);

  size_t misses() const { return misses_; }  ///< triangles met that were not named, over all frames
  size_t extras() const { return extras_; }  ///< triangles named that lie beyond the stated inflation
  bool answers() const { return peer_->answers(); }

 private:
  void check(const Frame& frame);

  std::unique_ptr<Surface> surface_;
  std::unique_ptr<Peer> peer_;
  std::vector<TriangleIds> ids_;
  size_t misses_ = 0;
  size_t extras_ = 0;
};

/// How long to race.
struct Limits {
  size_t frames = 100;    ///< of each peer
  double seconds = 20.0;  ///< no more frames then, but for the first three
};

/// Two entrants on the same frames.
struct Race {
  sweep_guard_core::Sample ours_us;
  sweep_guard_core::Sample peer_us;
  sweep_guard_core::Sample ratio;  ///< peer's time over ours, frame by frame
};

/// Lets both run each frame, one after the other, in alternating order.
Race race(const Workload& workload, Entrant& ours, Entrant& peer, const Limits& limits);

}  // namespace sweep_guard_benchmark
