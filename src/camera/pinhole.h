#pragma once

namespace sweep_guard_core {

/// A camera without distortion, in its optical frame C: x to the right of the image, y down, z forwards (REP 103). Pixel (u, v) sees
/// along ((u - cx) / fx, (v - cy) / fy, 1).
struct Pinhole {
  double fx, fy;  ///< [pixels]
  double cx, cy;  ///< [pixels]
};

}  // namespace sweep_guard_core
