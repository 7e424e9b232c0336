#pragma once

#include <exception>

#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Tests every workpiece whose frame is known at a pose, and reports the others as unplaced or as failed.
/// @param report  its objects are used again
/// @param test    called with the workpiece, X_WM and the object for its result; a workpiece for which it throws failed
template <typename Report, typename Test>
void testPlaced(const Workpieces& workpieces, const PoseWithFrames& pose, Report& report, const Test& test) {
  report.unplaced.clear();
  report.failures.clear();
  size_t tested = 0;
  for (const auto& workpiece : workpieces) {
    const auto X_WM = pose.X_WM.find(workpiece->frame);
    if (X_WM == pose.X_WM.end()) {
      report.unplaced.push_back(workpiece);
      continue;
    }
    try {
      if (tested == report.objects.size()) report.objects.emplace_back();
      test(workpiece, X_WM->second, report.objects[tested]);
      ++tested;
    } catch (const std::exception& error) {  // of the detector, or no memory: the other workpieces are tested
      report.failures.push_back({workpiece, error.what()});
    }
  }
  report.objects.resize(tested);
}

}  // namespace sweep_guard_core
