#pragma once

#include "simulation/workpiece.h"
#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/MeshVertices.h"

namespace sweep_guard_simulation {

/// Returns the mesh at time `t` [s] as revision 1. The caller sets header and id.
sweep_guard::DeformableMesh meshMessage(const Workpiece& workpiece, double t);

/// Returns the vertices at time `t` [s] of the same revision. The caller sets header and id.
sweep_guard::MeshVertices verticesMessage(const Workpiece& workpiece, double t);

}  // namespace sweep_guard_simulation
