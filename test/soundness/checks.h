#pragma once

#include <memory>
#include <string>
#include <vector>

#include "soundness/cases.h"
#include "soundness/report.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core::soundness {

/// A detector under test.
struct TestedDetector {
  std::string name;
  std::unique_ptr<Detector> detector;
};

/// Makes all of detectorNames(), and `select_egl`: `select` on EGL. Prints which ones are skipped for lack of a
/// context.
std::vector<TestedDetector> allDetectors();

/// The origin of a case, the detectors to test and the report.
struct Context {
  std::string family;
  std::string about;  ///< seed and index
  std::vector<TestedDetector>& detectors;
  Report& report;
};

/// Returns whether ascending indices contain a triangle.
bool contains(const std::vector<std::uint32_t>& triangles, std::uint32_t triangle);

/// Checks that every triangle that is met exactly is named, and that every other triangle named is nearer than the
/// inflation. Compares both oracles on one triangle in a hundred.
void checkPair(const Context& context, const PairCase& pair);

/// Checks that every contact is named, with every kind of volume.
void checkPositives(const Context& context, const SweepCase& sweep);

/// Checks that timeOfImpact() finds every contact, and no later than it happens.
void checkImpacts(const Context& context, const SweepCase& sweep);

/// Checks that every triangle that meets the tool at one of many exact poses is named, and that every triangle named is
/// within its margin.
void checkWholeSweep(const Context& context, const SweepCase& sweep);

/// Returns the triangles named that are not nearer than `result.margin` to any tested volume.
std::vector<std::uint32_t> unexplained(const TriangleMesh& mesh_M, const SweepResult& result);

}  // namespace sweep_guard_core::soundness
