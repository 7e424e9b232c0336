#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace sweep_guard_simulation {

/// What a depth camera makes of a depth: noise that grows with its square, and steps of its inverse, the disparity.
///
/// They are those of a Kinect of the first kind, measured on the images of 7-Scenes (Shotton et al., CVPR 2013, as
/// andyzeng/tsdf-fusion-python has them): a standard deviation of 2.4, 4.7 and 8.4 mm at 1 to 1.5, 1.5 to 2 and 2 to 3 m, and steps of
/// 3, 12 and 26 mm at 1, 2 and 3 m. Pixels at edges that are anywhere between their sides, and pixels without a depth beside them, are
/// left out.
class DepthNoise {
 public:
  static constexpr float kDeviation = 0.0015F;  ///< at depth 1 m [m]
  static constexpr float kStep = 0.003F;        ///< at depth 1 m [m]

  DepthNoise();

  /// Returns depths [m] as an image has them: in mm, 0 where nothing is seen (NaN), or farther than 65 m.
  const std::vector<std::uint16_t>& seen(const std::vector<float>& depths);

 private:
  std::mt19937 random_;       // each time the same
  std::vector<float> noise_;  // at depth 1 m [m]
  std::vector<std::uint16_t> image_;
};

}  // namespace sweep_guard_simulation
