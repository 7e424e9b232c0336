#pragma once

#include <map>
#include <string>
#include <vector>

#include "motion/facing.h"
#include "sweep_guard/motion/proximity_finder.h"

namespace sweep_guard_core {

/// Each piece of a tool with each mesh around it, at one pose. Remembers how the surfaces move.
class Facings {
 public:
  /// Places the meshes of a request. What it found before ends.
  /// @param[out] unplaced  meshes without a frame at the pose are added
  void begin(const ProximityRequest& request, Workpieces& unplaced);
  void end();                         ///< keeps no mesh alive
  void reset() { motions_.clear(); }  ///< forgets how surfaces moved

  size_t size() const { return count_; }
  Facing& operator[](size_t index) { return facings_[index]; }

  double rounding() const { return rounding_; }  ///< the largest of the meshes [m]
  double fastest() const;                        ///< bound on the speed of any vertex [m/s]
  double longestWay() const;                     ///< bound on the way of any vertex since its deformation [m]

 private:
  static double fastest(const PlacedSurface& surface);
  void forgetRemoved(const Workpieces& workpieces);
  void place(const ProximityRequest& request, const std::shared_ptr<const Workpiece>& workpiece,
             const Eigen::Isometry3d& X_WM);
  void face(const ProximityRequest& request, const PlacedSurface& surface, const AllowedPieces& allowed,
            const Eigen::Isometry3d& X_WM);

  std::map<std::string, SurfaceMotion> motions_;  // by id
  std::vector<PlacedSurface> surfaces_;           // the first surface_count_
  size_t surface_count_ = 0;
  std::vector<Facing> facings_;  // the first count_
  size_t count_ = 0;
  double rounding_ = 0.0;
};

}  // namespace sweep_guard_core
