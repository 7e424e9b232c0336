#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sweep_guard/detection/time_of_impact.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/intention.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/sweep.h"

namespace sweep_guard_core {

/// Decides which triangles one link of the tool is meant to touch during one motion. What is not proven to be intended is
/// not.
class IntendedTriangles {
 public:
  /// No triangles.
  IntendedTriangles() = default;
  /// @param regions        of this link; must outlive this
  /// @param sub_motions_M  of one motion
  /// @param margin         the tool is grown by this [m], >= 0
  IntendedTriangles(std::vector<const Intention*> regions, const Tool& tool, const std::string& link,
                    const std::vector<Motion>& sub_motions_M, double margin);

  bool empty() const { return regions_.empty(); }

  /// Returns whether the link may touch a triangle: the triangle is in a region, and depthBehind() is at most the depth
  /// of this region.
  bool contains(std::uint32_t triangle, const MovingTriangle& triangle_M);
  bool contains(std::uint32_t triangle, const TriangleMesh& at_rest_M);  ///< the same, of a mesh at rest

  /// Returns an upper bound on how far the pieces of the link, with the margin, reach behind the plane of a triangle
  /// during the motion [m]; negative if they stay in front of it. The normal is that of the triangle before and after its
  /// own motion. Empty if the triangle has no normal.
  std::optional<double> depthBehind(const MovingTriangle& triangle_M);

 private:
  struct Body {
    const ConvexShape* shape_T;
    Motion motion_M;
    double growth;
  };

  bool isProvenWithin(double depth, const MovingTriangle& triangle_M) const;
  double surface(const Eigen::Vector3d& normal, const MovingTriangle& triangle_M) const;
  double reachBehind(const Eigen::Vector3d& normal);

  std::vector<const Intention*> regions_;
  std::vector<Body> bodies_;                          // each piece of the link in each sub-motion
  Eigen::Vector3d base_M_ = Eigen::Vector3d::Zero();  // near the tool
  double radius_ = 0.0;                               // largest distance of a tool point from there [m]
  Eigen::Vector3d last_normal_ = Eigen::Vector3d::Zero();
  double last_reach_ = 0.0;  // reachBehind(last_normal_)
};

/// Keeps which links of the tool have touched a workpiece as intended: each until it is 10 mm away from the box around
/// the regions, in M, until nothing is intended there any more, or until a sweep leaves the workpiece out.
class IntendedTouches {
 public:
  /// Takes over what a sweep found.
  /// @param report      of one body
  /// @param pose, X_WB  where its sweep ended
  void update(const SweepReport& report, const PoseWithFrames& pose, const Eigen::Isometry3d& X_WB, const Tool& body,
              const Intentions& intentions);
  void clear() { links_.clear(); }

  bool contains(const std::string& mesh_id, const std::string& link) const;

 private:
  std::map<std::string, std::set<std::string>> links_;  // that have touched, by id of the workpiece
};

}  // namespace sweep_guard_core
