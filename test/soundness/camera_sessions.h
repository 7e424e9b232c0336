#pragma once

#include <map>

#include "soundness/checks.h"
#include "soundness/seen_surfaces.h"

namespace sweep_guard_core::soundness {

/// What one guard found of what a camera saw.
struct CameraFindings {
  std::uint64_t images = 0;                     ///< pairs of consecutive images that were swept
  std::uint64_t touched = 0;                    ///< triangles with a point in the tool, at one time between two images
  std::uint64_t missed = 0;                     ///< of these
  std::string text;                             ///< of those that were missed, and of sweeps that failed
  std::map<int, std::uint64_t> clear;           ///< sweeps without a touch within so many millimeters
  std::map<int, std::uint64_t> false_contacts;  ///< of these, those that report contact
};

/// Shows the images to a guard as a camera does, while a random tool moves to one of the surfaces, and compares what it
/// reports with the surfaces, the exact motion of the tool and closed formulas of its shape.
/// @param looseness  find the sweeps that are clear, which takes half of the time
CameraFindings checkCameraSession(Random& random, const SeenSurfaces& surfaces, bool looseness);

/// Adds the findings: a row for the misses, and one for each distance, with the sweeps that are clear as positives, and
/// those of them that report contact as extras.
void add(const CameraFindings& findings, const std::string& family, const std::string& about, Report& report);

/// Three sessions with the same rendered images.
void checkCamera(const Context& context, std::uint64_t seed);

}  // namespace sweep_guard_core::soundness
