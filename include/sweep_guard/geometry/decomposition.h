#pragma once

#include <cstdint>
#include <vector>

#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Controls how finely a mesh is cut.
struct DecompositionOptions {
  int max_depth = 6;            ///< depth of the tree of cuts, 0 to 16: at most 2^max_depth pieces; 0 gives one hull
  double step = 0.002;          ///< distance that the tool moves in one sweep [m], 0 to kMaxCoordinate; see decompose()
  double least_saving = 0.003;  ///< smallest saving that justifies a piece, in [0, 1]; see decompose()
};

/// Partitions the triangles of a mesh into sets whose convex hulls cover the mesh tightly. Splits recursively as an
/// OBBTree does [Gottschalk et al. 1996]: at the mean, across the longest side of the box along the principal axes, or
/// across the next side if all triangles fall on one side. A triangle belongs where its centroid is; no triangle is
/// cut. Unconnected components may be separated first, if that gives the better result.
///
/// Undoes cuts that save too little, from the leaves up. A hull with volume V and surface S that moves by a step covers
/// on average over all directions V + S * step / 4 (Cauchy: the mean shadow of a convex body is a quarter of its
/// surface). The unused volume is the same sum with another V: the space between the triangles and the surface of the
/// hull, that is the area of each triangle times the shorter distance along its normal from its centroid to the hull.
/// Both sums must fall by more than `least_saving` times the volume that the hull of the whole mesh covers, for each
/// piece after the first. The first sum alone would hollow out a large ball; the second alone would separate objects
/// inside a casing. A convex mesh stays whole, and there are at most 1 + 1 / least_saving pieces.
/// @returns sets of triangle indices: none empty, each triangle in exactly one set, each set ascending
/// @throws InvalidInput if an option is out of range
/// @throws DeviceError if /dev/null cannot be opened (convexHull())
std::vector<std::vector<std::uint32_t>> decompose(const TriangleMesh& mesh, const DecompositionOptions& options = {});

/// Returns the convex hulls of the sets of decompose(), in the same order, padded by the mesh's rounding(). Each hull
/// contains its triangles, also as they were before TriangleMesh rounded the vertices.
/// They need not contain the inside of a closed mesh; nothing gets there without touching the surface as long as motion
/// is swept without gaps.
/// @throws InvalidInput if an option is out of range
/// @throws DeviceError if /dev/null cannot be opened (convexHull())
std::vector<ConvexShape> convexPieces(const TriangleMesh& mesh_T, const DecompositionOptions& options = {});

}  // namespace sweep_guard_core
