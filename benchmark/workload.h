#pragma once

#include <string>
#include <vector>

#include "hull.h"
#include "peers/peer.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_benchmark {

/// One deformation and its queries.
struct Frame {
  std::vector<float> positions_M;
  std::vector<sweep_guard_core::Motion> motions_M;
  std::vector<sweep_guard_core::SweptVolume> swept_M;  ///< of the motions
  std::vector<Polytope> volumes_M;                     ///< the same volumes for the peers
  std::vector<TriangleIds> truth;                      ///< triangles that each volume meets, ascending
};

/// Frames of one kind.
struct Workload {
  std::string name;
  Surface surface;  ///< before the first frame
  size_t queries;   ///< in each frame
  std::vector<Frame> frames;

  /// Returns the mean number of triangles met per frame.
  double hits() const;
};

/// The queries of a frame: none, one sweep of 2 cm and 5 degrees, or twenty successive ones of 1 cm and 2.5 degrees.
enum class Queries { kNone, kSweep, kTwentySweeps };

/// Makes sweeps whose tips start 15 mm inside to 5 mm outside the surface.
Workload ordinary(const Hull& hull, Queries queries, size_t frames);

/// Returns the same frames with vertices and triangles in random order.
Workload shuffled(Workload workload);

/// Makes single sweeps that meet exactly `hits` triangles, 0 or 1.
Workload grazing(const Hull& hull, size_t hits, size_t frames);

}  // namespace sweep_guard_benchmark
