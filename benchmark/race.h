#pragma once

#include <functional>
#include <memory>

#include "peers/peer.h"
#include "workload.h"

namespace sweep_guard_benchmark {

/// Runs one peer on the frames of a workload, and counts its errors.
class Entrant {
 public:
  using Factory = std::function<std::unique_ptr<Peer>(Surface&)>;
  Entrant(const Workload& workload, const Factory& make);

  /// Writes the positions of a frame, which is not timed; then lets the peer update and answer.
  /// @returns the time for both [us]
  double run(const Frame& frame);

  size_t misses() const { return misses_; }  ///< triangles met and not named, over all frames
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

/// How long a race lasts.
struct Limits {
  size_t frames = 100;    ///< of each peer
  double seconds = 20.0;  ///< after this time only the first three frames are completed
};

/// The times of two entrants, frame by frame.
struct Race {
  std::vector<double> ours_us;
  std::vector<double> peer_us;
  std::vector<double> ratio;  ///< peer's time over ours
};

/// Lets both entrants run each frame in turn; they alternate in who goes first.
Race race(const Workload& workload, Entrant& ours, Entrant& peer, const Limits& limits);

}  // namespace sweep_guard_benchmark
