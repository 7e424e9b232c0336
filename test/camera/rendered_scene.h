#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "camera/depth_surface.h"
#include "scenes.h"

namespace sweep_guard_core {

/// A solid in the fixed frame W.
struct Solid {
  /// Returns the smallest t >= 0 at which origin + t * direction lies in the solid; infinite if none does.
  std::function<double(const Eigen::Vector3d& origin_W, const Eigen::Vector3d& direction_W)> enteredAt;
  std::vector<Eigen::Vector3d> around_W;  ///< the solid is within their hull [m]
};

/// Returns a box along the axes of W [m].
Solid boxOf(const Eigen::Vector3d& lower_W, const Eigen::Vector3d& upper_W);
Solid sphereAt(const Eigen::Vector3d& center_W, double radius);
/// Returns the tool of Tool::cylinder().
Solid cylinderAt(const Eigen::Isometry3d& X_WT, double radius, double length);

/// What a depth camera does to depths: the defaults are those of a Kinect of the first kind, which were measured on 7-Scenes.
struct DepthFaults {
  double noise = 0.0024;  ///< std at a depth of 1 m, grows by its square [m]
  double missing = 0.01;  ///< share of the pixels
  double flying = 0.01;   ///< share of the pixels at an edge that are anywhere between its sides
  double step = 0.001;    ///< of the depths [m]
};

/// A depth camera that looks at solids. Those that rest are rendered once.
class RenderedScene {
 public:
  static constexpr std::uint32_t kWidth = 640;
  static constexpr std::uint32_t kHeight = 480;
  static constexpr Pinhole kCamera{600.0, 600.0, 319.5, 239.5};

  RenderedScene(const Eigen::Isometry3d& X_WC, const std::vector<Solid>& at_rest, const DepthFaults& faults,
                std::uint64_t seed);

  /// Returns an image with these solids besides: z of each pixel [m], row by row. Valid until the next call.
  const std::vector<float>& image(const std::vector<Solid>& moving);

  /// Returns what of the picture shows those that rest, without faults.
  const std::vector<float>& background() const { return background_; }

 private:
  struct Window {
    std::uint32_t left = 0, top = 0, right = kWidth, bottom = kHeight;  // without the last
  };
  struct Edge {
    size_t pixel;
    float depth, beside;
  };

  Window windowOf(const Solid& solid) const;
  void draw(const Solid& solid, const Window& window, std::vector<float>& depths) const;
  static void findEdges(const std::vector<float>& depths, const Window& window, std::vector<Edge>& edges);

  const Eigen::Isometry3d X_WC_;
  const DepthFaults faults_;
  Random random_;
  std::vector<float> noise_;  // of a depth of 1 m; NaN where it is missing
  std::vector<float> background_;
  std::vector<Edge> edges_at_rest_;
  std::vector<Edge> edges_;
  std::vector<float> image_;
};

}  // namespace sweep_guard_core
