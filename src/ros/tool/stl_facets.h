#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace sweep_guard_ros {

/// Holds the corners of a triangle of an STL file, in the unit of the file.
using StlFacet = std::array<std::array<float, 3>, 3>;

/// Returns the triangles of an STL file, binary or text, as programs write it. Ignores names, attributes and normals of any
/// kind, and what follows the last triangle, unless that could be triangles. In a text, case does not matter, and `end solid`,
/// `end loop` and `end facet` are taken for one word each. Coordinates may be NaN.
/// @throws std::runtime_error in the terms of the file: the number of triangles in its header and the number that it has room
///     for; or the word of a text that is not as expected, or its end that is missing
std::vector<StlFacet> readStlFacets(std::string_view bytes);

}  // namespace sweep_guard_ros
