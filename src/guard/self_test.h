#pragma once

#include <string>

#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {

/// Asks a detector about 160 triangles whose answers follow from formulas: deep inside, far away, barely in and barely
/// out at faces, edges and corners, degenerate, huge; bodies that are flat, thin, round, at rest, turning; each kind of
/// volume; up to 1000 km from the origin. Asks once more with these triangles spread over a mesh of two thousand. Takes
/// some tens of milliseconds.
/// @returns which answer is wrong, in words; empty if all are right
std::string selfTest(Detector& detector);

}  // namespace sweep_guard_core
