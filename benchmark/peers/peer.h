#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "peers/polytope.h"

namespace sweep_guard_benchmark {

using TriangleIds = std::vector<std::uint32_t>;

/// A surface whose vertices the caller moves before every update.
struct Surface {
  std::vector<float> positions_M;                       ///< x0 y0 z0 x1 ... [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< vertex indices; constant

  const float* vertex(size_t i) const { return positions_M.data() + 3 * i; }
};

/// Finds the triangles of a deforming surface that convex volumes meet. Made once per surface, which must outlive it.
/// Uses no Eigen: some peers are compiled for another instruction set, and would link its inline functions.
class Peer {
 public:
  virtual ~Peer() = default;

  /// Sets the volumes of the next queries; not timed. They stay until the next call.
  virtual void prepare(const std::vector<Polytope>& volumes_M) { volumes_M_ = &volumes_M; }

  /// Reads the positions of the surface. May exchange the vector of positions for another one of the same size.
  virtual void update() = 0;

  /// Adds the triangles that one volume meets, in any order, possibly more than once. A peer that tests all volumes at
  /// once overrides queryAll() instead.
  virtual void query(size_t /*volume*/, TriangleIds& /*ids*/) {}

  /// Adds the triangles that each volume meets.
  virtual void queryAll(std::vector<TriangleIds>& ids) {
    for (size_t volume = 0; volume < ids.size(); ++volume) query(volume, ids[volume]);
  }

  /// Returns whether the peer answers queries.
  virtual bool answers() const { return true; }

  /// Returns the distance from the volume [m] at which triangles may still be named.
  virtual double inflation() const { return 0.0; }

 protected:
  Peer() = default;
  Peer(const Peer&) = default;
  Peer& operator=(const Peer&) = default;

  const std::vector<Polytope>* volumes_M_ = nullptr;  ///< of the next queries
};

}  // namespace sweep_guard_benchmark
