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
#include "sweep_guard/guard/sweep_checker.h"

namespace sweep_guard_core::soundness {

/// Triangles as the product gets them.
struct Triangles {
  std::vector<Eigen::Vector3d> corners_M;  ///< three for each [m]
  std::vector<Eigen::Vector3d> before_M;   ///< where they came from meanwhile [m]; empty if they rest
  bool streamed = false;                   ///< handed over in float32, as in a MeshVertices message
  bool welded = false;                     ///< equal corners are one vertex

  size_t count() const { return corners_M.size() / 3; }
  TriangleMesh mesh() const;
  TriangleMesh meshBefore() const;  ///< mesh(), if they rest
};

/// Triangles against one volume: which of them a detector has to name, an oracle tells.
struct PairCase {
  Triangles triangles;
  SweptVolume swept_M;
};

/// A point of the moving tool that lies on a triangle.
struct Contact {
  std::uint32_t triangle;
  double fraction;    ///< of the motion, in [0, 1]
  double pace = 0.0;  ///< fraction of its way that the triangle has gone by then, in [0, 1]
};

/// Triangles against the whole motion of a tool.
struct SweepCase {
  Triangles triangles;
  Bodies tool;
  Motion motion;                  ///< of the tool in M, or in W if the frame M moves
  std::optional<Motion> frame_W;  ///< of M in W
  SweepOptions options;           ///< its volume is the checker's choice
  std::vector<Contact> contacts;  ///< these triangles are met for certain, in ascending order

  /// The motion cut for checkSweep().
  std::vector<Motion> subMotions() const;
};

/// What checkSweep() finds.
SweepResult findingsOf(Detector& detector, const SweepCase& sweep);

/// All kinds of volume that the product knows.
std::vector<VolumeKind> volumeKinds();

/// As text, numbers in hexadecimal, so that readCase() gives the same bits. `about` names family, seed and detector.
std::string textOf(const PairCase& pair, const std::string& about);
std::string textOf(const SweepCase& sweep, const std::string& about);

/// A case read from text; one of both is there.
struct AnyCase {
  std::string about;
  std::optional<PairCase> pair;
  std::optional<SweepCase> sweep;
};

/// The next case of a stream, what stands around it skipped; empty at the end.
/// @throws InvalidInput if a case is cut off or has an unknown word
std::optional<AnyCase> readCase(std::istream& stream);

/// The same volume with normals that survive being written down: normalising them again changes nothing.
SweptVolume settled(SweptVolume volume);

}  // namespace sweep_guard_core::soundness
