#include "sweep_guard/guard/workpiece.h"

#include "guard/displacements.h"

namespace sweep_guard_core {

void countUpdate(const Workpiece& before, Workpiece& updated) {
  updated.updates = before.updates + 1;
  updated.path_length = before.path_length + Displacements(before.mesh_M, updated.mesh_M).upperBound();
}

}  // namespace sweep_guard_core
