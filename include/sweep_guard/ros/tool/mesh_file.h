#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_ros {

/// Holds the surface of a mesh file, in the unit of its numbers; a DAE file, which names its unit, in meters. Keeps
/// the axes of the file and ignores the up direction that it declares (DAE) or has by its format (glTF: y). Vertices are
/// finite, and there is a triangle.
using MeshSurface = sweep_guard_core::TriangleSurface;

/// Returns the file of a mesh in a URDF: `package://NAME/PATH` or `file:///PATH` (also `file:/PATH` and
/// `file://localhost/PATH`). If there is no file of that name, percent escapes in PATH are decoded as rviz does, see
/// percentDecoded(). A package's folder is the one that rospack knows, or else the folder NAME in an entry of
/// ROS_PACKAGE_PATH. Follows symbolic links. The result must be in the package's folder or, for file:, in a package on
/// ROS_PACKAGE_PATH or in one of the roots.
/// @param roots  absolute folders that file:// paths may lead to
/// @returns a path without symbolic links
/// @throws sweep_guard_core::InvalidInput naming the URI (unless it has a null character), what is wrong and what to
///     write in its place
std::filesystem::path locateMesh(const std::string& uri, const std::vector<std::string>& roots);

/// Reads a regular STL, OBJ, DAE, PLY or glTF file (.gltf, .glb), told apart by its extension (upper or lower case), of
/// at most 32 MiB, a million triangles and three million vertices. Opens no other file: a glTF must have its buffers in
/// itself. The program mesh_reader next to the nodes reads it in a separate process, so that a file on which it crashes is
/// refused. A file is refused, too, if it cannot be read completely, if no triangle has three different corners, or if it
/// takes more than 1 GiB of memory, 10 s of processor time or 30 s in all. Blocks the calling thread meanwhile.
/// @param follow_link  follows a symbolic link at the end of the path, not only those among its folders: for paths from the
///                     user only
/// @throws sweep_guard_core::InvalidInput naming the file and what is wrong
/// @throws sweep_guard_core::DeviceError if mesh_reader cannot be run
MeshSurface readMesh(const std::filesystem::path& path, bool follow_link = false);

}  // namespace sweep_guard_ros
