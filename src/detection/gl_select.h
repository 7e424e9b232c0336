#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "detection/offscreen_context.h"

namespace sweep_guard_core {

/// Runs OpenGL's selection mode [P, Sec. 2]: draws triangles under names, and reads which names reach into the viewing
/// volume.
///
/// The viewing volume is the cube [-1, 1]^3 of the given coordinates, cut by clipping planes. The caller scales its box
/// to that cube in double precision; glOrtho and gluLookAt [P, Sec. 3.1, Fig. 4] do the same but round to float32.
///
/// Selection fails silently: without a current context, with culling on or with a NaN vertex it reports neither a hit
/// nor an error. Every query therefore sets the whole state, and draws a canary that must hit.
class GlSelect {
 public:
  struct Query {
    const std::vector<float>& corners;          ///< nine per triangle: x y z of its three corners, finite [-]
    int triangles_per_name;                     ///< >= 1; triangle i is drawn under name i / triangles_per_name
    const std::vector<Eigen::Vector4d>& clips;  ///< keep (x, y, z, 1) · clip >= 0; at most 6 [-]
    const Eigen::Vector3d& canary;              ///< a point inside the cube and every clip [-]
  };

  /// @param hit_records  initial number of hits that the buffer holds; it grows when necessary
  /// @throws DeviceError if an OpenGL function is missing
  explicit GlSelect(std::unique_ptr<OffscreenContext> context, size_t hit_records = 256);
  ~GlSelect();

  /// Returns the names that hit, ascending, each once. Valid until the next call.
  /// @throws DeviceError if OpenGL reports an error, the canary does not hit, or a hit has no name: then nothing is
  ///     known
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
