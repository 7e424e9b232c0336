#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_ros {

/// The surface that a mesh file holds, in the unit of the file's numbers; DAE files in metres, as they say what theirs
/// is. Axes are taken as they stand in the file, whatever it calls up.
struct MeshSurface {
  std::vector<Eigen::Vector3d> vertices;              ///< finite
  std::vector<sweep_guard_core::Triangle> triangles;  ///< at least one, every index below vertices.size()
};

/// Where the mesh of a URDF is: `package://NAME/PATH`, or `file:///PATH`. A package's folder is the one that rospack
/// knows, or else the folder NAME in an entry of ROS_PACKAGE_PATH. Symbolic links are followed, and what they lead to
/// has to be inside the package's folder; a file:// path inside a package on ROS_PACKAGE_PATH or one of the roots.
/// @param roots  folders, absolute, that file:// paths may lead to
/// @returns without symbolic links
/// @throws sweep_guard_core::InvalidInput naming the URI and what to do
std::filesystem::path locateMesh(const std::string& uri, const std::vector<std::string>& roots);

/// Whether a path may end with a symbolic link: one that its user has chosen may, one that locateMesh() has checked has
/// none left, unless it was swapped just now.
enum class Links { kRefuse, kFollow };

/// Reads an STL, OBJ or DAE file, a regular one of 32 MiB and a million triangles at most, in a process of its own:
/// what crashes, hangs or eats memory there is refused here. The program mesh_reader next to the nodes does the
/// reading. Nothing of a file is left out in silence: what cannot be read as a whole is refused.
/// @throws sweep_guard_core::InvalidInput naming the file, what is wrong and what to do
/// @throws sweep_guard_core::DeviceError if mesh_reader cannot be run
MeshSurface readMesh(const std::filesystem::path& path, Links links = Links::kRefuse);

}  // namespace sweep_guard_ros
