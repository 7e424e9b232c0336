#pragma once

#include <memory>
#include <string>
#include <vector>

#include "soundness/cases.h"
#include "soundness/report.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core::soundness {

/// A detector under test, and its name.
struct Suspect {
  std::string name;
  std::unique_ptr<Detector> detector;
};

/// All of detectorNames(), and `select_egl`: `select` on EGL. What the machine has no context for is said to be
/// skipped.
std::vector<Suspect> allSuspects();

/// Where a case came from, and where to say what is wrong with it.
struct Context {
  std::string family;
  std::string about;  ///< seed and index
  std::vector<Suspect>& suspects;
  Report& report;
};

/// Every triangle that exact arithmetic says is met is named; what is named besides is nearer than the inflation. Of
/// one in a hundred triangles the second oracle has to say the same as the first.
void checkPair(const Context& context, const PairCase& pair);

/// Every contact is named, with every kind of volume.
void checkPositives(const Context& context, const SweepCase& sweep);

/// The fine phase finds every contact, and no later than it happens.
void checkImpacts(const Context& context, const SweepCase& sweep);

/// Every triangle found to meet the tool at one of many exact poses is named; what is named is within its margin.
void checkWholeSweep(const Context& context, const SweepCase& sweep);

/// The triangles named that are no nearer than `result.margin` to any volume tested.
std::vector<std::uint32_t> unexplained(const TriangleMesh& mesh_M, const SweepResult& result);

}  // namespace sweep_guard_core::soundness
