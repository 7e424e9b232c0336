#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/prediction/horizon.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard {

/// One sweep along the predicted path, or a piece of one, tested against one workpiece.
struct PredictedSweep {
  Duration from{};           ///< after the newest pose; it lasts until the next one begins
  bool met = false;          ///< the predicted path itself meets the workpiece
  double probability = 0.0;  ///< that the tool meets the workpiece in this sweep, in [0, 1]; below 0.001 it is 0
  /// Index of the part of the tool that is likeliest to: of those that meet it if `met`. Empty without any.
  std::optional<size_t> tool_part = {};
};

/// How the predicted path fares with one workpiece.
struct PredictedObject {
  std::shared_ptr<const Workpiece> workpiece;
  std::vector<PredictedSweep> sweeps;     ///< end to end, ascending; a sweep that might meet is told in pieces
  std::vector<std::uint32_t> reflex;      ///< triangles met within the reflex interval: ascending, each once
  std::vector<std::uint32_t> considered;  ///< triangles met later: ascending, each once, none of `reflex`
  std::vector<SweptVolume> volumes_M;     ///< those of the sweeps, end to end, in the mesh's frame
  size_t volumes_tested = 0;              ///< and the ones of the pieces, as far as there was time

  std::vector<std::uint32_t> triangles() const;  ///< all that are met: ascending, each once
  std::optional<Duration> met() const;           ///< when the path first meets it, after the newest pose
  void clear();                                  ///< as new; keeps its buffers
};

/// What is expected to happen after a pose.
struct Outlook {
  Time stamp;                            ///< of the newest measured pose: the path begins there
  PredictedPath path;                    ///< empty: the motion is not known yet
  size_t reflex_sweeps = 0;              ///< the first so many end within the reflex interval
  size_t sweeps_asked = 0;               ///< one for every pose of the path
  size_t sweeps_made = 0;                ///< fewer where time did not allow: a sweep then passes several poses
  std::vector<PredictedObject> objects;  ///< every workpiece tested
  Workpieces unplaced;                   ///< workpieces whose frame is not known at the pose: not tested
  std::vector<SweepFailure> failures;    ///< workpieces whose detection failed: not tested

  /// Up to where every workpiece has been tested: the end of the path, or the pose itself.
  Time coveredUntil() const;
  bool complete() const;                ///< the motion is known, and every workpiece was tested, and there is one
  double probability() const;           ///< that the tool meets a workpiece: the largest of all sweeps, in [0, 1]
  std::optional<Duration> met() const;  ///< when the path first meets a workpiece, after the newest pose
};

/// A contact that an operator is warned of.
struct ExpectedContact {
  Time from;                 ///< it does not begin earlier
  std::optional<Time> met;   ///< when the predicted path itself meets the workpiece; empty: contact is merely probable
  double probability = 0.0;  ///< largest of the sweeps from `from` on, in [0, 1]
  std::string mesh_id;
  std::vector<std::uint32_t> triangles;  ///< met by the predicted path: ascending, each once; empty if it meets none
  /// Index of the part of the tool that meets it first; of one that is merely probable, the likeliest to.
  std::optional<size_t> tool_part = {};
};

/// The earliest sweep that meets a workpiece, or does so with at least this probability; empty if none does.
/// @param min_probability  in (0, 1]
/// @param[out] expected    what was in it is replaced
void expectedContact(const Outlook& outlook, double min_probability, std::optional<ExpectedContact>& expected);
std::optional<ExpectedContact> expectedContact(const Outlook& outlook, double min_probability);

}  // namespace sweep_guard
