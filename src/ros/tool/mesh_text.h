#pragma once

#include <cstddef>
#include <string>

namespace sweep_guard_ros {

// Functions for the bytes of an OBJ or DAE file that find what assimp silently omits or distorts. `format` is obj or dae.

/// Changes text of an OBJ that assimp would omit: removes a byte order mark, and converts to lower case. Blanks its
/// materials, which are in other files. Leaves other formats as they are.
void simplify(std::string& bytes, const std::string& format);

/// Checks a file for contents that assimp does not read.
/// @param bytes  simplified
/// @throws std::runtime_error naming the contents: in an OBJ an unknown keyword, or a vertex that has not 3, 4 or 6
///     numbers; in a DAE bad XML, a unit that is not a length, an invalid index, faces beyond their count, or a surface
///     that has no polygons
void requireReadable(const std::string& bytes, const std::string& format);

/// Returns the number of faces in the text of an OBJ; 0 for a DAE, whose faces requireReadable() checks.
/// @param bytes  simplified
std::size_t expectedFaces(const std::string& bytes, const std::string& format);

}  // namespace sweep_guard_ros
