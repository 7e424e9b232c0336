#pragma once

#include <cstdint>
#include <vector>

#include "camera/depth_surface.h"
#include "scenes.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_core::soundness {

/// What a camera sends, and how it is to be taken: numbers alone, in the order of the images.
struct DepthImages {
  struct Image {
    Time stamp;
    Eigen::Isometry3d X_FC = Eigen::Isometry3d::Identity();
    std::vector<float> depths;  ///< [m], row by row
  };

  std::uint32_t width = 0;   ///< [pixels]
  std::uint32_t height = 0;  ///< [pixels]
  Pinhole camera = {};
  DepthOptions options = {};
  std::vector<Image> images;
};

/// Renders two to four images of planes, spheres and boxes that rest, come nearer, pass by, appear or leave, by rays in
/// long double; with noise, steps and pixels that see nothing. One camera in four moves.
DepthImages renderedImages(Random& random);

}  // namespace sweep_guard_core::soundness
