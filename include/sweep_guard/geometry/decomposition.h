#pragma once

#include <cstdint>
#include <vector>

#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// How finely a mesh is cut.
struct DecompositionOptions {
  int max_depth = 6;    ///< of the tree of cuts, 0 to 16: at most 2^max_depth parts; 0 leaves one hull
  double step = 0.002;  ///< how far the tool goes in one sweep [m], >= 0: small ones make gaps of its size count
  double least_saving = 0.003;  ///< by how much each part must make the cover tighter, see decompose(); in [0, 1]
};

/// Cuts the triangles of a mesh into sets whose convex hulls are a tight cover of it: recursively as the OBBTree does
/// [Gottschalk et al. 1996], across the longest side of the box of their moments, at the mean; across the next side if
/// that leaves all triangles on one hand. A triangle goes where its centroid is; none is cut. Pieces that do not hang
/// together may be taken apart first, if that is the better start.
///
/// Cuts are undone, from the leaves up, where they do not pay. What a hull with volume V and surface S covers while it
/// goes a step, averaged over all directions, is V + S * step / 4 (Cauchy: the mean shadow of a convex body is a
/// quarter of its surface). What of that is wasted is the same with the space between the triangles and the surface of
/// the hull for V: area times how far the centroid's normal runs before it leaves the hull, the shorter way. Both sums
/// have to fall by `least_saving` times what the hull of the whole mesh covers, for each part after the first. The
/// first sum alone would make a hollow of a large ball, the second would go after what is inside of a casing. So a
/// convex mesh stays whole, and there are at most 1 + 1 / least_saving parts.
/// @returns sets of triangle indices: none empty, every triangle in one of them, ascending
/// @throws InvalidInput if an option is out of range
std::vector<std::vector<std::uint32_t>> decompose(const TriangleMesh& mesh, const DecompositionOptions& options = {});

/// The convex hulls of these sets, in this order: of ALL corners of their triangles, so that together they hold every
/// point of every triangle, and of the mesh as it was before it was rounded. What a closed mesh encloses they need not
/// hold: there they may leave a hollow. Nothing gets there without meeting the surface, as long as motion is swept
/// without gaps.
/// @throws InvalidInput if an option is out of range
std::vector<ConvexShape> convexPieces(const TriangleMesh& mesh_T, const DecompositionOptions& options = {});

}  // namespace sweep_guard_core
