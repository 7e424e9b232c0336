#pragma once

#include <string>
#include <vector>

#include "ros/tool/facet.h"

namespace sweep_guard_ros {

/// Returns the triangles that the scene of a glTF 2.0 file shows [m], text (.gltf) or binary (.glb), in the axes of the
/// file, where the transforms of its nodes put them. Of several scenes it is the default, or else the first one. Strips and
/// fans become triangles. Leaves out points and lines, which are no surface, and ignores materials, images and animations.
/// Coordinates may be NaN.
/// @throws std::runtime_error in the terms of the file: bad JSON; an extension that a reader must support and this one does
///     not, as compression; a buffer in another file; what leads out of its buffer or names something that is missing; a
///     part in a shape that a skin or morph targets give it; or a transform that flattens a part
std::vector<Facet> readGltfFacets(const std::string& bytes);

}  // namespace sweep_guard_ros
