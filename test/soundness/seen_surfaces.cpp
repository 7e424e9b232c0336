#include "soundness/seen_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sweep_guard_core::soundness {
namespace {

constexpr Real kUnsure = 1e-5L;  // of a limit: float32 may be off by that

Real factor(SeenSurfaces::Says says) { return says == SeenSurfaces::Says::kMust ? 1 - kUnsure : 1 + kUnsure; }

Real margin(const DepthImages& images, Real z) {
  return static_cast<Real>(images.options.margin[0]) + static_cast<Real>(images.options.margin[1]) * z * z;
}

unsigned bit(bool lower, SeenSurfaces::Says says) {
  return 1U << ((lower ? 1U : 0U) + (says == SeenSurfaces::Says::kMust ? 0U : 2U));
}

}  // namespace

Real SeenTriangle::length() const {
  return std::max({(now[0] - before[0]).norm(), (now[1] - before[1]).norm(), (now[2] - before[2]).norm()});
}

std::array<Vector3r, 3> SeenTriangle::at(const std::array<Real, 3>& shares) const {
  std::array<Vector3r, 3> corners;
  for (size_t i = 0; i < 3; ++i) corners[i] = before[i] + shares[i] * (now[i] - before[i]);
  return corners;
}

SeenSurfaces::SeenSurfaces(const DepthImages& images) : images_(images) {
  const auto& [fx, fy, cx, cy] = images.camera;
  const Real diagonal = std::hypot(1 / static_cast<Real>(fx), 1 / static_cast<Real>(fy));
  for (size_t i = 0; i < images.images.size(); ++i) {
    const DepthImages::Image& image = images.images[i];
    Seen seen;
    for (std::uint32_t v = 0; v < images.height; ++v) {
      for (std::uint32_t u = 0; u < images.width; ++u) {
        const Vector3r ray((static_cast<Real>(u) - static_cast<Real>(cx)) / static_cast<Real>(fx),
                           (static_cast<Real>(v) - static_cast<Real>(cy)) / static_cast<Real>(fy), 1);
        const auto z = static_cast<Real>(image.depths[index({u, v})]);
        const bool counts =
            z >= static_cast<Real>(images.options.nearest) && z <= static_cast<Real>(images.options.farthest);
        const Real from_camera = std::max<Real>(0, z * ray.norm() - margin(images, z));
        // A step is what would be a surface that one sees at less than 6 degrees, as steep as 10 to 1: the depth
        // changes by more than ten times the diagonal of a pixel, and by more than what both may be off.
        seen.limits.push_back(10 * diagonal * z + 2 * margin(images, z));
        seen.lengths.push_back(ray.norm());
        seen.depths.push_back(counts ? z : std::numeric_limits<Real>::quiet_NaN());
        seen.places_F.emplace_back(image.X_FC.linear().cast<Real>() * (from_camera * ray.normalized()) +
                                   image.X_FC.translation().cast<Real>());
      }
    }
    if (i > 0) {
      const DepthImages::Image& before = images.images[i - 1];
      seen.rested = image.X_FC.matrix() == before.X_FC.matrix();
      seen.reach = static_cast<Real>(images.options.surface_speed) *
                   static_cast<Real>((image.stamp - before.stamp).count()) * 1e-9L;
    }
    findTriangles(seen);
    seen_.push_back(std::move(seen));
  }
}

std::array<SeenSurfaces::Pixel, 3> SeenSurfaces::corners(const Pixel& pixel, bool lower) const {
  const auto& [u, v] = pixel;
  if (lower) return {Pixel{u + 1, v}, Pixel{u, v + 1}, Pixel{u + 1, v + 1}};
  return {Pixel{u, v}, Pixel{u, v + 1}, Pixel{u + 1, v}};
}

// In tiles of 8 x 4 pixels, two for each pixel.
std::uint32_t SeenSurfaces::number(const Pixel& pixel, bool lower) const {
  const std::uint32_t tile = pixel.v / 4 * ((images_.width + 7) / 8) + pixel.u / 8;
  return 2 * (32 * tile + pixel.v % 4 * 8 + pixel.u % 8) + (lower ? 1 : 0);
}

bool SeenSurfaces::joined(const Seen& seen, size_t pixel, size_t other, Says says) const {
  const Real limit = std::min(seen.limits[pixel], seen.limits[other]);
  return std::abs(seen.depths[pixel] - seen.depths[other]) <= factor(says) * limit;
}

bool SeenSurfaces::exists(const Seen& seen, const std::array<Pixel, 3>& corners, Says says) const {
  for (size_t i = 0; i < 3; ++i) {
    if (!(joined(seen, index(corners[i]), index(corners[(i + 1) % 3]), says))) return false;
  }
  return true;
}

void SeenSurfaces::findTriangles(Seen& seen) const {
  seen.existing.assign(seen.depths.size(), 0);
  seen.extents.assign(seen.depths.size(), 0);
  for (std::uint32_t v = 0; v + 1 < images_.height; ++v) {
    for (std::uint32_t u = 0; u + 1 < images_.width; ++u) {
      const size_t pixel = index({u, v});
      for (const bool lower : {false, true}) {
        const auto pixels = corners({u, v}, lower);
        if (!exists(seen, pixels, Says::kMay)) continue;
        const unsigned must = exists(seen, pixels, Says::kMust) ? bit(lower, Says::kMust) : 0;
        seen.existing[pixel] = static_cast<std::uint8_t>(seen.existing[pixel] | bit(lower, Says::kMay) | must);
        for (const Pixel& corner : pixels)
          seen.extents[pixel] =
              std::max(seen.extents[pixel], (seen.places_F[index(corner)] - seen.places_F[pixel + 1]).norm());
      }
    }
  }
}

bool SeenSurfaces::goesOn(size_t image, size_t pixel, Says says) const {
  if (image == 0 || !seen_[image].rested) return false;
  const Real way = std::abs(seen_[image].depths[pixel] - seen_[image - 1].depths[pixel]) * seen_[image].lengths[pixel];
  return way <= factor(says) * seen_[image].reach;
}

SeenTriangle SeenSurfaces::triangle(size_t image, bool moving, Says says, const Pixel& pixel, bool lower) const {
  SeenTriangle triangle;
  triangle.number = number(pixel, lower);
  const auto pixels = corners(pixel, lower);
  for (size_t i = 0; i < 3; ++i) {
    const size_t at = index(pixels[i]);
    triangle.now[i] = seen_[image].places_F[at];
    triangle.before[i] = moving && goesOn(image, at, says) ? seen_[image - 1].places_F[at] : triangle.now[i];
  }
  return triangle;
}

std::vector<SeenTriangle> SeenSurfaces::near(size_t image, bool moving, Says says, const Vector3r& center_F,
                                             Real radius) const {
  const Seen& seen = seen_[image];
  std::vector<SeenTriangle> triangles;
  for (std::uint32_t v = 0; v + 1 < images_.height; ++v) {
    for (std::uint32_t u = 0; u + 1 < images_.width; ++u) {
      const size_t pixel = index({u, v});
      if (seen.existing[pixel] == 0) continue;
      const Real enough = radius + seen.extents[pixel] + (moving ? 2 * seen.reach : 0);
      if ((seen.places_F[pixel + 1] - center_F).squaredNorm() > enough * enough) continue;
      for (const bool lower : {false, true}) {
        if ((seen.existing[pixel] & bit(lower, says)) == 0) continue;
        SeenTriangle found = triangle(image, moving, says, {u, v}, lower);
        const Vector3r middle = (found.now[0] + found.now[1] + found.now[2]) / 3;
        Real size = 0;
        for (size_t i = 0; i < 3; ++i)
          size = std::max({size, (found.now[i] - middle).norm(), (found.before[i] - middle).norm()});
        if ((middle - center_F).norm() <= radius + size) triangles.push_back(found);
      }
    }
  }
  return triangles;
}

std::vector<SeenTriangle> SeenSurfaces::any(Random& random, size_t image, bool moving) const {
  for (int tries = 0; tries < 200; ++tries) {
    const Pixel pixel{static_cast<std::uint32_t>(random.below(static_cast<int>(images_.width - 1))),
                      static_cast<std::uint32_t>(random.below(static_cast<int>(images_.height - 1)))};
    const bool lower = random.chance(0.5);
    if ((seen_[image].existing[index(pixel)] & bit(lower, Says::kMust)) != 0)
      return {triangle(image, moving, Says::kMust, pixel, lower)};
  }
  return {};
}

}  // namespace sweep_guard_core::soundness
