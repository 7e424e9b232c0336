#pragma once

#include <string>
#include <vector>

#include "hull.h"
#include "peers/peer.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_benchmark {

/// One deformation, and what is asked about it.
struct Frame {
  std::vector<float> positions_M;
  std::vector<sweep_guard_core::Motion> motions_M;
  std::vector<sweep_guard_core::SweptVolume> swept_M;  ///< of the motions
  std::vector<Polytope> volumes_M;                     ///< the same
  std::vector<TriangleIds> truth;                      ///< what each meets, ascending
};

/// Frames of one kind.
struct Workload {
  std::string name;
  Surface surface;  ///< before the first frame
  size_t queries;   ///< in each frame
  std::vector<Frame> frames;

  /// Triangles met per frame.
  double hits() const;
};

/// What a frame asks: nothing, one sweep of 2 cm and 5 degrees, or twenty one after the other of 1 cm and 2.5 degrees.
enum class Question { kNothing, kSweep, kTwentySweeps };

/// Tips from 15 mm inside to 5 mm outside of the surface.
Workload ordinary(const Hull& hull, Question question, size_t frames);

/// The same frames of a mesh whose vertices and triangles are in random order.
Workload shuffled(Workload workload);

/// Single sweeps that meet exactly `hits` triangles, 0 or 1.
Workload grazing(const Hull& hull, size_t hits, size_t frames);

}  // namespace sweep_guard_benchmark
