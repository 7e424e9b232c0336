#pragma once

#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/MeshVertices.h>
#include <sweep_guard/ToolShape.h>
#include <sweep_guard/View.h>

namespace sweep_guard_rviz {

constexpr std::uint32_t kSide = 10;                       ///< squares along a side of the sheet
constexpr size_t kTriangles = size_t{2} * kSide * kSide;  ///< of the sheet

/// A sheet of 4 m, its squares cut in two.
sweep_guard::DeformableMesh sheet(double z, std::uint32_t revision = 1);
sweep_guard::MeshVertices verticesOf(const sweep_guard::DeformableMesh& mesh);

/// Some of its triangles are touched, some of these and others are within the reflex interval, and others within the
/// considered one.
sweep_guard::View viewOf(std::uint8_t level);

/// A tool with edges of 0.5 m along its axes.
sweep_guard::ToolShape tetrahedron();

}  // namespace sweep_guard_rviz
