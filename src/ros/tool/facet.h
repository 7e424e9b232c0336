#pragma once

#include <array>

namespace sweep_guard_ros {

/// Holds the corners of a triangle of a mesh file, in the unit of the file.
using Facet = std::array<std::array<double, 3>, 3>;

}  // namespace sweep_guard_ros
