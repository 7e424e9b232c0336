#pragma once

#include <memory>
#include <vector>

#include "guard/displacements.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Keeps the displacements between deformations, so that the bodies of a tool, and its next sweeps, share one pass over the
/// vertices. Keeps its buffer.
class DisplacementCache {
 public:
  /// Returns the displacements from one deformation of a workpiece to another one, with the same triangles.
  Displacements between(const std::shared_ptr<const Workpiece>& from, const std::shared_ptr<const Workpiece>& to);

  /// Forgets the deformations that between() was not asked for since the last call.
  void forgetUnused();

 private:
  struct Known {
    std::shared_ptr<const Workpiece> from;
    std::shared_ptr<const Workpiece> to;
    Displacements displacements;
    bool used;
  };

  std::vector<Known> known_;
};

}  // namespace sweep_guard_core
