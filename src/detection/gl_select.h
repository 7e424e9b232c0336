#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "sweep_guard/detection/offscreen_context.h"

namespace sweep_guard_core {

/// OpenGL's selection mode [P, Sec. 2]: draws triangles under names and learns which names left something in the
/// viewing volume.
///
/// The viewing volume is the cube [-1, 1]^3 of the coordinates handed in, cut by clipping planes. The caller scales its
/// box to that cube in double precision: the same as glOrtho and gluLookAt [P, Sec. 3.1, Fig. 4], which would round in
/// float32.
///
/// Selection fails in silence: without a current context, with culling on or with a vertex that is not a number it
/// reports no hit and no error. So the whole state is set for every query, and each query draws a canary that must hit.
class GlSelect {
 public:
  struct Query {
    const std::vector<float>& corners;          ///< nine per triangle: x y z of its three corners, finite [-]
    int triangles_per_name;                     ///< >= 1; triangle i is drawn under name i / triangles_per_name
    const std::vector<Eigen::Vector4d>& clips;  ///< kept: (x, y, z, 1) · clip >= 0; at most 6 [-]
    const Eigen::Vector3d& canary;              ///< a point inside of the cube and of every clip [-]
  };

  /// @param hit_records  room for so many hits at first; grows when it does not suffice
  /// @throws DeviceError if an OpenGL function is missing
  explicit GlSelect(std::unique_ptr<OffscreenContext> context, size_t hit_records = 256);
  ~GlSelect();

  /// The names that hit, ascending, each once. Valid until the next call.
  /// @throws DeviceError if OpenGL reports an error, the canary does not hit, or a hit has no name: nothing is known
  /// then
  const std::vector<std::uint32_t>& hits(const Query& query);

 private:
  struct Functions;

  int draw(const Query& query, std::uint32_t canary_name);
  void setState(const Query& query);
  void readHits(int records, std::uint32_t canary_name);

  std::unique_ptr<OffscreenContext> context_;
  std::unique_ptr<const Functions> gl_;
  std::vector<std::uint32_t> hit_buffer_;
  std::vector<std::uint32_t> names_;
};

}  // namespace sweep_guard_core
