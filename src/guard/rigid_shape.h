#pragma once

#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Returns how far a vertex is at most from where the rigid motion puts it that fits all vertices best [m]: 0 if the mesh
/// keeps its shape, wherever it is. Least squares [Umeyama 1991]; infinite if a position is not finite.
/// @param positions_M  x0 y0 z0 x1 ... [m], as many as the mesh has vertices (asserted)
double deviationFromRigid(const TriangleMesh& mesh_M, const std::vector<float>& positions_M);

}  // namespace sweep_guard_core
