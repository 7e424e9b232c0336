#pragma once

#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>
#include <sweep_guard/ToolShape.h>
#include <sweep_guard/View.h>

namespace sweep_guard_rviz {

constexpr std::uint32_t kSide = 10;                       ///< squares along a side of the square
constexpr size_t kTriangles = size_t{2} * kSide * kSide;  ///< number in the square

/// Makes a square of 4 m with two triangles per square.
sweep_guard::DeformableMesh square(double z, std::uint32_t revision = 1);
sweep_guard::MeshVertices verticesOf(const sweep_guard::DeformableMesh& mesh);

/// Makes a view in which the lists of touched, reflex and considered triangles overlap.
sweep_guard::View viewOf(std::uint8_t level);

/// Makes a tool with edges of 0.5 m along its axes.
sweep_guard::ToolShape tetrahedron();

}  // namespace sweep_guard_rviz
