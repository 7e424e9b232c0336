#pragma once

#include <filesystem>
#include <istream>
#include <ostream>
#include <string>

#include "guard/cross_check.h"

namespace sweep_guard_core {

/// A query of which two detectors disagreed: all that is needed to ask again.
struct DetectorCase {
  std::string mesh_id;
  std::string detector;  ///< the one that was sampled
  std::string other;
  TriangleMesh mesh_M;  ///< the tested triangles; M has the origin() of the workpiece's mesh
  TriangleSet numbers;  ///< of these triangles in the workpiece
  SweptVolume swept_M;
  Detection found;  ///< by the sampled detector; indices into mesh_M
};

/// Copies what was tested.
DetectorCase caseOf(const SampledQuery& query, const std::string& other);

/// Returns the query again, of a workpiece that is the tested triangles alone.
SampledQuery queryOf(const DetectorCase& saved);

/// Writes a case as text, with all digits.
void write(const DetectorCase& saved, std::ostream& stream);

/// Reads what write() has written.
/// @throws InvalidInput naming the line if it is something else
DetectorCase readDetectorCase(std::istream& stream);

/// Writes the case of a query to a new file in a folder of cases. Makes no copy of a mesh that will not fit.
/// @param max_folder  the files of the folder take at most this [bytes]
/// @returns `saved as FILE`, or `not saved: ` and why. Throws only std::bad_alloc
std::string save(const SampledQuery& query, const std::string& other, const std::filesystem::path& folder,
                 std::uintmax_t max_folder);

}  // namespace sweep_guard_core
