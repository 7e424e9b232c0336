#pragma once

#include <cstddef>
#include <string>

namespace sweep_guard_ros {

// The bytes of an STL, OBJ or DAE file (`format`: stl, obj, dae), seen as text: what assimp leaves out or distorts
// without a word.

/// Makes readable what assimp would drop: a byte order mark, and keywords in capitals, which become small letters.
/// Materials of an OBJ are blanked: they stand in files of their own, which there is no need to open.
void simplify(std::string& bytes, const std::string& format);

/// @param bytes  simplified
/// @throws std::runtime_error saying what cannot be read: in an OBJ an unknown keyword, or a vertex that is not of 3, 4
///     or 6 numbers; in a DAE a unit that is no length, an index that is none, faces that are not counted, surfaces
///     that are no polygons
void requireReadable(const std::string& bytes, const std::string& format);

/// Faces that the text has: those of an OBJ, the facets of an STL; 0 where assimp compares them itself.
/// @param bytes  simplified
/// @throws std::runtime_error if the end of an STL is missing
std::size_t facesAnnounced(const std::string& bytes, const std::string& format);

}  // namespace sweep_guard_ros
