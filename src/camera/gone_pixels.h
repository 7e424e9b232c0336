#pragma once

#include <cstdint>
#include <vector>

#include "camera/depth_tolerance.h"
#include "camera/self_pixels.h"
#include "sweep_guard/geometry/grid.h"

namespace sweep_guard_core {

/// Finds the hidden pixels whose surface has gone. Where the camera sees, beside what the robot hides, something that was joined to
/// it has given way to what is farther away. Of a surface that has gone in part, each pixel has the fate of what is fewest steps
/// away from pixel to pixel. Keeps its buffers.
class GonePixels {
 public:
  GonePixels(const Grid& grid, const DepthTolerance& tolerance) : grid_(grid), tolerance_(tolerance) {}

  /// Depths of two images, row by row, with what the robot hides as it was seen last [m]; NaN: nothing.
  struct Depths {
    const std::vector<float>& before;
    const std::vector<float>& now;
    const std::vector<float>& remembered;  ///< NaN where nothing is seen now because it is too far away
    size_t stride;                         ///< of the rows, at least the width of the grid
  };

  /// @param self  the pixels that the robot hides in the newest image
  /// @returns places in the depths; valid until the next call
  const std::vector<size_t>& find(const SelfPixels& self, const Depths& depths);

 private:
  enum class Fate : std::uint8_t { kOpen, kStays, kGone };
  struct Pixel {
    std::uint32_t u, v;
  };

  bool findSeeds(const SelfPixels& self, const Depths& depths);
  Fate besideSeen(const SelfPixels& self, const Depths& depths, const Pixel& pixel) const;
  void spread(const SelfPixels& self, const Depths& depths);
  template <typename Function>
  void forEachNeighbor(const Pixel& pixel, const Function& function) const;

  const Grid grid_;
  const DepthTolerance tolerance_;
  std::vector<Fate> fates_;     // of all pixels
  std::vector<Pixel> decided_;  // in the order of their distance from what is seen
  std::vector<size_t> gone_;
};

}  // namespace sweep_guard_core
