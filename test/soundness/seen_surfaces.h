#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "soundness/depth_images.h"
#include "soundness/real.h"

namespace sweep_guard_core::soundness {

/// A triangle between three neighboring pixels, on its way.
struct SeenTriangle {
  std::uint32_t number = 0;        ///< that of the guard
  std::array<Vector3r, 3> before;  ///< in F [m]
  std::array<Vector3r, 3> now;     ///< in F [m]

  Real length() const;  ///< of the longest way of a corner [m]
  /// @param shares  of the way of each corner
  std::array<Vector3r, 3> at(const std::array<Real, 3>& shares) const;
};

/// States in long double which surfaces a camera sees, and how they move from image to image. Where rounding may decide
/// whether a pixel, a triangle or a way is there, there are two statements: what must be, and what may be.
class SeenSurfaces {
 public:
  enum class Says { kMust, kMay };

  explicit SeenSurfaces(const DepthImages& images);

  size_t count() const { return seen_.size(); }
  const DepthImages& images() const { return images_; }

  /// Returns the triangles near a ball around a point of F.
  /// @param moving  on their way from the image before; otherwise at rest
  std::vector<SeenTriangle> near(size_t image, bool moving, Says says, const Vector3r& center_F, Real radius) const;
  /// Returns one that must be there, if some tries find one.
  std::vector<SeenTriangle> any(Random& random, size_t image, bool moving) const;

 private:
  struct Pixel {
    std::uint32_t u;
    std::uint32_t v;
  };
  struct Seen {
    std::vector<Vector3r> places_F;
    std::vector<Real> depths;            // NaN: not seen
    std::vector<Real> limits;            // a larger difference to a pixel farther away is a step
    std::vector<Real> lengths;           // of the rays up to depth 1
    std::vector<std::uint8_t> existing;  // bits of the triangles at the right of a pixel and below it, see bit()
    std::vector<Real> extents;           // of these, from the pixel to the right [m]
    bool rested = false;                 // the camera, since the image before
    Real reach = 0;                      // along a ray since then [m]
  };

  size_t index(const Pixel& pixel) const { return size_t{pixel.v} * images_.width + pixel.u; }
  std::array<Pixel, 3> corners(const Pixel& pixel, bool lower) const;
  std::uint32_t number(const Pixel& pixel, bool lower) const;
  bool joined(const Seen& seen, size_t pixel, size_t other, Says says) const;
  bool exists(const Seen& seen, const std::array<Pixel, 3>& corners, Says says) const;
  void findTriangles(Seen& seen) const;
  bool goesOn(size_t image, size_t pixel, Says says) const;
  SeenTriangle triangle(size_t image, bool moving, Says says, const Pixel& pixel, bool lower) const;

  const DepthImages& images_;
  std::vector<Seen> seen_;
};

}  // namespace sweep_guard_core::soundness
