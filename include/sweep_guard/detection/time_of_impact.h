#pragma once

// Idea: conservative advancement [Mirtich 1996] along separating directions. At one time, GJK [Gilbert et al. 1988] finds
// a direction that separates piece and triangle, and the gap along it is followed in time: a bound on its second
// derivative proves how long it stays open; there the next direction is found. Invariant: before the fraction that has
// been reached, the piece is proven not to come as close as the margin, so a time of impact is never late, and "no impact"
// is a proof. Cost: each direction takes one GJK and a few supports of the piece, and there are 1000 at most; triangles of
// a patch try each other's directions first, without GJK. Nothing is allocated for a triangle. The bound for rotations and
// the secant are derived at timeOfImpact().

#include <Eigen/Core>
#include <array>
#include <boost/container/static_vector.hpp>
#include <optional>
#include <vector>

#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core {

/// A triangle in mesh frame M [m] that moves while the tool does: each corner moves straight at constant speed. If the
/// mesh is at rest, start and end are equal.
struct MovingTriangle {
  std::array<Eigen::Vector3d, 3> start_M;
  std::array<Eigen::Vector3d, 3> end_M;
};

/// The first moment when a convex piece of the tool comes as close to a triangle as timeOfImpact() asks for.
struct Impact {
  double time_of_impact;    ///< fraction of the motion, in [0, 1]
  Eigen::Vector3d point_M;  ///< on the triangle, at the time of impact [m]
  /// Unit, from the triangle to the tool, along the closest points at the time of impact; see timeOfImpact() for an
  /// overlap.
  Eigen::Vector3d normal_M;
  double depth;  ///< distance [m] along `normal_M` that frees the piece at the end of the motion, >= 0
};

/// Computes when a convex piece of the tool first comes as close to a triangle as `margin`. The time of impact is never
/// later than the true one. Returns empty only if it is *proven* that the piece never comes so close; an impact may
/// thus be merely not ruled out.
///
/// Conservative advancement: separation() finds a direction n that separates piece and triangle at one time, and n is
/// then followed in time. G(s) = min over the piece of n · q(s) - max over the triangle of n · p(s) is evaluated
/// exactly by the support mapping. A corner's n · p(s) is linear in s. A tool point turns by w s about an axis k
/// through the origin of T, at most rho = radiusAbout(k) from it, while that origin moves straight: |n · q''| <= K =
/// w^2 rho |n x k|.
/// Linear interpolation between 0 and s errs by at most K/2 x (s - x) for each point, and so for the smallest of them:
///
///     G(x) >= (1 - x/s) G(0) + x/s G(s) - K/2 x (s - x)    for x in [0, s]
///
/// If the minimum of the right side exceeds the margin, there is no impact before s. A secant finds such an s, where
/// the next direction is computed. This repeats until the gap is the margin, or the end is reached.
///
/// Where a corner of the triangle is closest, n turns with the tool instead, as the face of the piece next to the corner
/// does. Then min over the piece of n · (q - o) is constant, o the origin of T. With x from o to a corner, |(n · x)''| <=
/// K = w |n x k| (w |x| + 2 |x'|), because x' is constant; the rest stays.
///
/// It stops within a tolerance above the margin [m]: 2e-9 of the sum of the piece's boundingRadius() and the triangle's
/// longest edge, plus 1e-14 of the distance between triangle and tool frame and of the triangle's distance from the
/// origin of M, because the poses have been rounded. The time of impact is early by at most this tolerance divided by
/// the closing speed. After 1000 directions, returns the last time that is proven free as the time of impact.
///
/// If the piece overlaps the triangle at the start, the time of impact is 0, and the normal is `contact_normal_M` if it
/// is given and the minimum translation direction if not.
/// @param sub_motions       sub-motions of one motion, of equal duration, end to end, as from split(); not empty
///                          (asserted). The `deviation_bound` of each is added to the margin; its `mesh_translation` is
///                          ignored, for the triangle has a motion of its own
/// @param margin            [m], >= 0 (asserted); not part of the depth
/// @param contact_normal_M  unit: normal of the contact if it began before the start; used only if they overlap there
std::optional<Impact> timeOfImpact(const ConvexShape& shape_T, const std::vector<Motion>& sub_motions,
                                   const MovingTriangle& triangle, double margin,
                                   const std::optional<Eigen::Vector3d>& contact_normal_M = std::nullopt);

/// Computes the times of impact of one convex piece with many triangles, each as timeOfImpact() does. The triangles of a
/// patch share what depends on the motion alone, and learn from each other: a direction that separates the piece from one
/// triangle is tried first for the next, and if a normal found before is near the minimum translation direction, libccd is
/// not asked for another. Keeps its buffers.
class ImpactFinder {
 public:
  /// Begins a patch. Arguments as for timeOfImpact(); those given by reference must outlive the calls that follow.
  void begin(const ConvexShape& shape_T, const std::vector<Motion>& sub_motions, double margin);

  /// Returns the impact if a corner of the triangle lies in the piece at the start: cheaper than find(). Empty proves
  /// nothing.
  std::optional<Impact> overlapAtStart(const MovingTriangle& triangle,
                                       const std::optional<Eigen::Vector3d>& contact_normal_M);

  /// Result of find().
  struct Found {
    std::optional<Impact> impact;  ///< as from timeOfImpact()
    /// Unit: the direction that separated piece and triangle last, turned back to the start if there is an impact. Zero:
    /// they overlap from the start.
    Eigen::Vector3d separating_M = Eigen::Vector3d::Zero();
  };
  /// Computes the impact, as timeOfImpact() does.
  /// @param guess_M  unit direction from the triangle to the piece that may separate them; zero for none
  Found find(const MovingTriangle& triangle, const std::optional<Eigen::Vector3d>& contact_normal_M,
             const Eigen::Vector3d& guess_M = Eigen::Vector3d::Zero());

 private:
  // What the triangles share.
  struct SubMotion {
    Eigen::Matrix3d R_MT_start;
    Eigen::Matrix3d R_MT_end;
    Eigen::Vector3d p_MT_start;
    Eigen::Vector3d travel_M;
    double margin;
    double angle;
    Eigen::Vector3d axis_T;
    Eigen::Vector3d axis_M;
    double radius;  // about the axis
  };
  class Trajectory;
  class Search;
  static constexpr size_t kNormals = 8;

  double depthAtEnd(const MovingTriangle& triangle, const Eigen::Vector3d& normal_M);
  Eigen::Vector3d lastNormal() const;
  const Eigen::Vector3d& remember(const Eigen::Vector3d& normal_M);

  const ConvexShape* shape_T_ = nullptr;
  std::vector<SubMotion> sub_motions_;
  // Minimum translation directions of the patch, the newest last.
  boost::container::static_vector<Eigen::Vector3d, kNormals> normals_M_;
  Eigen::Vector3d depth_normal_M_ = Eigen::Vector3d::Zero();  // of the contact whose depth was computed last
  double depth_reach_ = 0.0;                                  // support of the piece against it at the end [m]
};

}  // namespace sweep_guard_core
