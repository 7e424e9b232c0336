#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "soundness/body.h"
#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/guard/sweep.h"

namespace sweep_guard_core::soundness {

inline constexpr double kMaxDistance = 9.9e6;  ///< of a case from the origin [m]: leaves room for a tool

/// The triangles of a case.
struct Triangles {
  std::vector<Eigen::Vector3d> corners_M;  ///< three for each [m]
  std::vector<Eigen::Vector3d> before_M;   ///< corners at the start of the motion [m]; empty if they rest
  bool streamed = false;                   ///< passed in float32, as in a MeshVertices message
  bool welded = false;                     ///< equal corners are one vertex

  size_t count() const { return corners_M.size() / 3; }
  TriangleMesh mesh() const;
  TriangleMesh meshBefore() const;  ///< mesh(), if they rest
};

/// Triangles and one volume. An oracle finds the triangles that a detector must name.
struct PairCase {
  Triangles triangles;
  SweptVolume swept_M;
};

/// A point of the moving tool that lies on a triangle.
struct Contact {
  std::uint32_t triangle;
  double fraction;             ///< of the motion, in [0, 1]
  double mesh_fraction = 0.0;  ///< of the triangle's path at that time, in [0, 1]
};

/// Triangles and a motion of a tool.
struct SweepCase {
  Triangles triangles;
  Bodies tool;
  Motion motion;  ///< of the tool in M, or in W if the frame M moves; with a deviation_bound if joints move it
  std::optional<Motion> frame_W;  ///< of M in W
  SweepOptions options;           ///< checks may replace its volume
  std::vector<Contact> contacts;  ///< certain contacts, ascending in their triangles

  /// Returns the sub-motions for checkSweep().
  std::vector<Motion> subMotions() const;
};

/// Runs checkSweep() on a case.
SweepResult checkCase(Detector& detector, const SweepCase& sweep);

/// Returns all kinds of volume.
std::vector<VolumeKind> volumeKinds();

/// Writes a case with hexadecimal numbers, so that readCase() returns the same bits.
/// @param about  family, seed and detector
std::string textOf(const PairCase& pair, const std::string& about);
std::string textOf(const SweepCase& sweep, const std::string& about);

/// A case read from text: either `pair` or `sweep` is set.
struct AnyCase {
  std::string about;
  std::optional<PairCase> pair;
  std::optional<SweepCase> sweep;
};

/// Reads the next case of a stream and skips other lines; empty at the end.
/// @throws InvalidInput if a case is cut off or contains an unknown word
std::optional<AnyCase> readCase(std::istream& stream);

/// Returns the volume with normals that do not change when they are normalized again, as when they are read.
SweptVolume normalized(SweptVolume volume);

}  // namespace sweep_guard_core::soundness
