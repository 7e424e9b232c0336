#pragma once

#include <exception>

#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// Tests every workpiece whose frame is known, and reports the others as unplaced or as failed.
/// @param is_placed  returns whether the frame of a workpiece is known
/// @param report     its objects are used again
/// @param test       called with the workpiece and the object for its result; a workpiece for which it throws failed
template <typename IsPlaced, typename Report, typename Test>
void testPlaced(const Workpieces& workpieces, const IsPlaced& is_placed, Report& report, const Test& test) {
  report.unplaced.clear();
  report.failures.clear();
  size_t tested = 0;
  for (const auto& workpiece : workpieces) {
    if (!is_placed(*workpiece)) {
      report.unplaced.push_back(workpiece);
      continue;
    }
    try {
      if (tested == report.objects.size()) report.objects.emplace_back();
      test(workpiece, report.objects[tested]);
      ++tested;
    } catch (const std::exception& error) {  // of the detector, or no memory: the other workpieces are tested
      report.failures.push_back({workpiece, error.what()});
    }
  }
  report.objects.resize(tested);
}

}  // namespace sweep_guard_core
