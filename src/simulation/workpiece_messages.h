#pragma once

#include "simulation/workpiece.h"
#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/MeshVertices.h"

namespace sweep_guard_simulation {

/// The whole workpiece as it is at time `t` [s], as revision 1. The header and the id are the caller's.
sweep_guard::DeformableMesh meshMessage(const Workpiece& workpiece, double t);

/// Its vertices at time `t` [s], of the same revision.
sweep_guard::MeshVertices verticesMessage(const Workpiece& workpiece, double t);

}  // namespace sweep_guard_simulation
