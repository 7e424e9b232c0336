#pragma once

#include "simulation/elastic/bar_model.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_simulation {

/// What a workpiece is made of.
struct ElasticMaterial {
  double youngs_modulus = 1e4;  ///< [Pa], > 0; Poisson's ratio is 1/4, of sheets 1/3
  double density = 1000.0;      ///< [kg/m^3], > 0
  double skin = 0.003;          ///< thickness of the sheet of the same material along the surface [m], > 0
  int inner_points = 800;       ///< approximate number inside a closed mesh, in [0, 100000]
  double bedding = 3e5;         ///< force per area and displacement that holds an open mesh in its shape [N/m^3], > 0
};

/// Makes bars of a mesh, whose vertices are the first nodes, in their order.
///
/// All edges are bars: of each triangle, they have the stiffness of the skin. A mesh that encloses something is filled:
/// points inside of it, in a body-centered cubic lattice, and its vertices are the corners of Delaunay tetrahedra. The
/// edges of those whose middle is inside are bars of equal cross-section, with a sum of stiffness times squared length
/// of six times volume and Young's modulus, as is needed for bars in all directions. Any other mesh has no inside: each
/// vertex is held at its place by a spring. Vertices that belong to no triangle are fixed.
/// @throws sweep_guard_core::InvalidInput if a number of the material is out of range
BarStructure barsOf(const sweep_guard_core::TriangleMesh& mesh, const ElasticMaterial& material);

/// Returns the area of the triangles around each vertex, a third of each [m^2].
Eigen::VectorXd vertexAreas(const sweep_guard_core::TriangleMesh& mesh);

}  // namespace sweep_guard_simulation
