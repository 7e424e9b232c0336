#pragma once

#include <vector>

#include "guard/contact_probability.h"
#include "guard/nearest_piece.h"
#include "guard/triangle_set.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {

/// The contacts of the tool with a mesh in one segment of a predicted path.
struct SegmentContacts {
  bool meets = false;        ///< a piece meets the mesh
  PieceApproach nearest;     ///< of the pieces that meet it
  TriangleSet newly_met;     ///< triangles that they meet; of detect(), only those not reported before: ascending
  bool only_volume = false;  ///< the hulls of all pieces miss what their volumes meet; only looked at if asked for

  void clear();  ///< keeps the buffer
};

/// Finds the contacts of the pieces that no plane separates from a mesh in one segment. Keeps its buffers between calls.
class SegmentContactFinder {
 public:
  /// Hands each piece to the detector. If the volume is `hull`, triangles count that the hull of the piece meets.
  /// @param so_far         its triangles need not be reported again
  /// @param compare_hulls  also tells whether the hulls of the pieces miss all that their volumes meet
  /// @param[out] contacts  overwritten; its buffer is used again
  /// @throws DeviceError if the detector fails
  void detect(Detector& detector, const WorkpieceOnPath& on_path, const Submesh& submesh,
              const std::vector<UnseparatedPiece>& pieces, const PredictedObject& so_far, bool compare_hulls,
              SegmentContacts& contacts);

  /// Takes each triangle that no plane of a volume separates from it for met, without the detector: conservative and fast.
  /// @param[out] contacts  overwritten; its buffer is used again
  void assume(const WorkpieceOnPath& on_path, const Submesh& submesh, const std::vector<UnseparatedPiece>& pieces,
              SegmentContacts& contacts);

 private:
  bool keepNewlyMet(const WorkpieceOnPath& on_path, const TriangleMesh& mesh_M, const UnseparatedPiece& piece,
                    const PredictedObject& so_far, bool& only_volume);

  ClearanceMeter meter_;
  Detection detection_;
  std::vector<char> assumed_;  // for each triangle of the mesh: newly met
};

}  // namespace sweep_guard_core
