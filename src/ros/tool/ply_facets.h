#pragma once

#include <string_view>
#include <vector>

#include "ros/tool/facet.h"

namespace sweep_guard_ros {

/// Returns the faces of a PLY file, text or binary, as fans of triangles. A face of one or two corners becomes a triangle
/// without area. Ignores unknown lines of the header, other elements, properties but for x, y, z and vertex_index or
/// vertex_indices, and vertices that no face has. Coordinates may be NaN.
/// @throws std::runtime_error in the terms of the file: what of the header is not supported; that there are no faces; the
///     element in which the file ends, or that has not the numbers which the header names; the face that names a missing
///     vertex; or that data follow the last element
std::vector<Facet> readPlyFacets(std::string_view bytes);

}  // namespace sweep_guard_ros
