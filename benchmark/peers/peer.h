#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "peers/polytope.h"

namespace sweep_guard_benchmark {

using TriangleIds = std::vector<std::uint32_t>;

/// A surface whose vertices someone else moves, all of them, before every update.
struct Surface {
  std::vector<float> positions_M;                       ///< x0 y0 z0 x1 ... [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< vertex indices; they stay

  const float* vertex(size_t i) const { return positions_M.data() + 3 * i; }
};

/// A way to find the triangles of a deforming surface that convex volumes meet. Made once per surface, which outlives
/// it. No Eigen in here: some of the peers are compiled for other processors than the rest.
class Peer {
 public:
  virtual ~Peer() = default;

  /// Takes in what is asked next; not timed. The volumes stay until the next call.
  virtual void prepare(const std::vector<Polytope>& volumes_M) = 0;

  /// Takes in the positions of the surface. May exchange the vector of positions for another one of the same size.
  virtual void update() = 0;

  /// Adds the triangles that the volume of this index meets: in any order, possibly more than once. A peer that takes
  /// all volumes at once has queryAll() instead.
  virtual void query(size_t /*volume*/, TriangleIds& /*ids*/) {}

  /// Adds the triangles that each volume meets.
  virtual void queryAll(std::vector<TriangleIds>& ids) {
    for (size_t volume = 0; volume < ids.size(); ++volume) query(volume, ids[volume]);
  }

  /// Whether it answers at all.
  virtual bool answers() const { return true; }

  /// Triangles nearer to the volume than this [m] may be named, too.
  virtual double inflation() const { return 0.0; }

 protected:
  Peer() = default;
  Peer(const Peer&) = default;
  Peer& operator=(const Peer&) = default;
};

}  // namespace sweep_guard_benchmark
