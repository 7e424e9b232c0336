#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "camera/depth_tolerance.h"
#include "camera/free_memory.h"
#include "camera/gone_pixels.h"
#include "camera/picture_point.h"
#include "camera/pinhole.h"
#include "camera/self_pixels.h"
#include "sweep_guard/geometry/grid.h"

namespace sweep_guard_core {

/// How the depths of a camera are taken.
struct DepthOptions {
  double nearest = 0.1;   ///< smallest depth that counts [m], > 0
  double farthest = 4.0;  ///< largest [m], > nearest
  /// A surface counts as nearer to the camera by margin[0] + margin[1] z^2, z its depth: the error of the camera [m], [1/m], >= 0.
  std::array<double, 2> margin = {0.005, 0.003};
  double surface_speed = 1.0;  ///< with which what is seen may move along a ray [m/s], >= 0
  double remember = 2.0;       ///< what was free when the robot came before it counts as free for so long [s], >= 0
};

/// The surface that a depth camera sees, from image to image. A pixel without a depth is no vertex: no triangle at it exists. Nor does
/// one across a step, where something nearer ends in front of something else: between them nothing was seen. A step is what would be
/// a surface that one sees at less than 6 degrees.
///
/// While the camera rests, a pixel that shows the robot itself, or that has no depth where the robot is, is a vertex where it was
/// last before the robot hid it, until that has gone (see GonePixels). A pixel whose depth changes by little has moved along its ray.
/// A larger change says that something came or went. A camera rests as long as no point that it may see moves by more than kStill in
/// the picture.
///
/// Reads and writes each pixel once, a row of tiles after the other, on two threads. Once it is made, an image allocates only
/// what starting the second thread takes.
class DepthSurface {
 public:
  static constexpr double kStill = 1e-5;  ///< [m]; where it rests, its vertices are as far from where they are

  /// @throws InvalidInput if camera or options are not as above, or not finite
  DepthSurface(const Grid& grid, const Pinhole& camera, const DepthOptions& options);

  /// Takes an image.
  /// @param depths  depth z of each pixel [m], row by row; NaN, infinite, or out of range: not seen
  /// @param X_FC    pose of the camera in the frame F of the surface [m]
  /// @param since   time since the image before [s], >= 0
  /// @param bodies_F  volumes around the bodies of the robot, see SelfPixels
  void take(const std::vector<float>& depths, const Eigen::Isometry3d& X_FC, double since = 0.0,
            const std::vector<SweptVolume>& bodies_F = {});

  /// Returns the vertices at their places: x0 y0 z0 x1 ... in F [m]. Where nothing is seen, that of the place before, so
  /// that boxes around blocks stay small. TriangleMesh::deform() may exchange the buffer.
  std::vector<float>& places_F() { return places_F_; }
  /// Returns where the vertices were in the image before; where they are if they have not moved since, or came; the same.
  std::vector<float>& before_F() { return before_F_; }
  /// Returns for each cluster the bits of its triangles that exist; the same.
  std::vector<std::uint64_t>& existing() { return existing_; }
  /// Returns what the newest image shows to be free, less the margin. While the camera rests, also what it showed to be free before
  /// the robot hid it. Null before the first image.
  std::shared_ptr<const FreeSpace> freeSpace() const { return free_.newest(); }
  size_t seen() const;                           ///< pixels of the newest image that are vertices
  size_t self() const { return self_.count(); }  ///< pixels of the newest image that the robot hides
  size_t hidden() const;                         ///< those of them that are vertices: where it was seen last
  bool rests() const { return rests_; }          ///< the camera, since the image before

  /// Points of the robot that the newest image has to show, and how many it shows where they are expected.
  struct Expected {
    size_t points = 0;
    size_t found = 0;
  };
  /// Counts the points in the picture that nothing stands before. One is found if a pixel near to its own shows the robot.
  /// @param depths    of the newest image
  /// @param points_F  within bodies of the robot that were there [m]
  /// @param distance  how near [m], >= 0: that by which the bodies were grown
  Expected compare(const std::vector<float>& depths, const std::vector<Eigen::Vector3d>& points_F,
                   double distance) const;

  /// Returns the vertices that the newest image has, and the robot where it is seen.
  /// @param depths      of the newest image
  /// @param max_pixels  of a larger image, only some columns and rows are taken, evenly; > 0
  std::vector<PicturePoint> points(const std::vector<float>& depths, size_t max_pixels) const;

 private:
  static constexpr size_t kColumns = Grid::kTileColumns;
  static constexpr size_t kRows = Grid::kTileRows;

  // Rows of pixels that one thread takes: whole rows of tiles.
  struct Rows {
    size_t first, end;
    // Of the triangles of each pixel in a row of tiles: bits 0 and 1 are set if they exist.
    std::vector<std::uint8_t> pairs;
  };

  void findRest(const Eigen::Isometry3d& X_FC);
  void forget();
  void readRow(const std::vector<float>& depths, size_t row);
  void setDepth(size_t pixel, float depth);
  void beginSelf(const std::vector<SweptVolume>& bodies_F);
  void takeRows(const std::vector<float>& depths, float reach, Rows& rows);
  // The following take the first of the rows of pixels in a row of tiles.
  void placeTiles(size_t row);
  void hideSelf(size_t row);
  void remember(size_t row);
  void findMotion(size_t row, float reach);
  void findTriangles(size_t row, std::vector<std::uint8_t>& pairs);
  size_t placeOf(size_t row) const { return row * grid_.tileColumns() * kColumns; }  // first of its tiles
  bool beginsHalf(size_t place) const { return place == 0 || place == placeOf(halves_[1].first); }
  void hide(size_t tile);
  bool showsSelf(const std::vector<float>& depths, std::uint32_t column, std::uint32_t row, double pixels) const;
  void endMotions(float reach, size_t pixel, size_t place);
  // Those in a row of a tile. Where nothing is seen, that of the place before.
  void placeRow(size_t column, size_t row, const float* before_F, float* places_F) const;
  void placeUnseen();
  void copyPlace(size_t from, size_t begin, size_t end);
  size_t firstSeen(size_t place) const;
  void forgetGone(float reach);
  bool isSeen(size_t place) const;
  void findPairs(size_t first, std::uint8_t* pairs) const;
  std::uint64_t trianglesAt(size_t column, const std::vector<std::uint8_t>& pairs) const;

  const Grid grid_;
  const Pinhole camera_;
  const DepthOptions options_;
  const DepthTolerance tolerance_;
  std::vector<double> x_;             // of a ray at depth 1, by column of the tiles
  std::vector<double> y_;             // by row
  const size_t stride_;               // of the rows of the following, which have a column and a row more than the tiles
  std::vector<float> inverse_;        // of the length of a ray up to depth 1; 0: beyond the image
  std::vector<float> depths_;         // NaN: not seen
  std::vector<float> nearer_;         // depth less the margin [m]; NaN: not seen
  std::array<Rows, 2> halves_;        // the upper one is empty if there is one row of tiles
  std::vector<float> remembered_;     // depth where a pixel last showed something else than the robot; NaN: never
  std::vector<float> farthest_;       // that was remembered; NaN: none
  std::vector<float> nearer_before_;  // of the image before; NaN: not seen, or nothing is known of it
  std::vector<float> places_before_F_;
  std::vector<float> places_F_;
  std::vector<float> before_F_;
  std::vector<std::uint64_t> existing_;
  Eigen::Isometry3d X_FC_ = Eigen::Isometry3d::Identity();
  bool rests_ = false;
  bool interrupted_ = false;  // by an exception, while the last image was taken
  SelfPixels self_;
  GonePixels gone_;
  std::vector<SweptVolume> bodies_F_;  // with the margin
  FreeMemory free_;
};

}  // namespace sweep_guard_core
