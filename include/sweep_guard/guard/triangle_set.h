#pragma once

#include <cstdint>
#include <vector>

namespace sweep_guard {

/// Indices of triangles: ascending, each once.
using TriangleSet = std::vector<std::uint32_t>;

TriangleSet united(const TriangleSet& a, const TriangleSet& b);

/// Those of `all` that are not among `others`.
TriangleSet without(const TriangleSet& all, const TriangleSet& others);

}  // namespace sweep_guard
