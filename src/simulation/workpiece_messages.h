#pragma once

#include <vector>

#include "sweep_guard/DeformableMesh.h"
#include "sweep_guard/MeshVertices.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_simulation {

/// Returns a mesh as revision 1. The caller sets header and id.
/// @param positions  of the vertices: x0 y0 z0 x1 ... [m]
sweep_guard::DeformableMesh meshMessage(const std::vector<float>& positions,
                                        const std::vector<sweep_guard_core::Triangle>& triangles);

/// Returns vertices of the same revision. The caller sets header and id.
sweep_guard::MeshVertices verticesMessage(std::vector<float> positions);

}  // namespace sweep_guard_simulation
