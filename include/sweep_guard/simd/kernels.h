#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/// The loops over vertices and boxes in float32, and over corners and directions in double, on which the speed of a sweep
/// depends. They are compiled for several instruction sets; the best one of the machine is selected at the first use.
/// Rounding differs between the instruction sets, and callers have to allow for it.
namespace sweep_guard_core::simd {

/// Number of vertices in a block: consecutive vertices that share a box.
constexpr std::size_t kBlock = 32;
/// A cluster is a set of neighboring triangles. Its largest number of triangles, and of blocks that hold their corners:
constexpr std::size_t kCluster = 64;
constexpr std::size_t kClusterBlocks = 4;
/// Arrays of boxes and of their bits are padded to a multiple of this length, with unspecified values.
constexpr std::size_t kPadding = 16;
constexpr std::size_t padded(std::size_t count) { return (count + kPadding - 1) / kPadding * kPadding; }
constexpr std::size_t kMaxPlanes = 15;  ///< of one Planes: one bit each in 16 bits, and kInsideAll

/// Boxes with one array for each side [m]: x, y and z of the lower and of the upper corners.
template <typename Number>
struct BoxArrays {
  std::array<Number*, 3> lower;
  std::array<Number*, 3> upper;

  /// Returns the boxes from `first` on.
  BoxArrays from(std::size_t first) const {
    return {{lower[0] + first, lower[1] + first, lower[2] + first},
            {upper[0] + first, upper[1] + first, upper[2] + first}};
  }
};

/// Bounds of coordinates [m], for each of x, y, z.
struct Extremes {
  std::array<float, 3> lower;
  std::array<float, 3> upper;
};

using PerPlane = std::array<float, kMaxPlanes + 1>;  ///< the last one is unused

/// Planes n·p = d, in the frame of the vertices and boxes that they are compared with. Beyond a plane is n·p > d. The
/// thresholds [m] allow for rounding: a point with n·p > `outside` in float32 is beyond the plane, one with n·p <
/// `inside` is not.
struct Planes {
  std::size_t count = 0;           ///< at most kMaxPlanes
  std::array<PerPlane, 3> normal;  ///< x, y and z of the unit normals; from `count` on unused
  PerPlane outside;
  PerPlane inside;
};

/// The bits of a vertex inside of all planes. Otherwise bit i is set if the vertex is beyond plane i.
constexpr std::uint16_t kInsideAll = 1U << kMaxPlanes;

/// The first, second and third corners of the triangles of a cluster, as places among the vertices of its blocks: place
/// i is vertex i % kBlock of block i / kBlock.
using ClusterCorners = std::array<std::array<std::uint8_t, kCluster>, 3>;

/// Sets of triangles of a cluster: bit i stands for its triangle i, counted from the lowest bit.
struct TriangleBits {
  std::uint64_t not_beyond;     ///< not wholly beyond one plane
  std::uint64_t corner_inside;  ///< with a corner inside of all planes
};

/// Linear functions x p_x + y p_y + z p_z + w of a point p, with one array for each coefficient. Their number is a multiple
/// of kFunctions.
struct LinearFunctions {
  const double* x;
  const double* y;
  const double* z;
  const double* w;
  std::size_t count;  ///< > 0
};
constexpr std::size_t kFunctions = 8;

constexpr std::size_t kBatch = 16;
/// Triangles whose corners are tested at once, each before and after its motion.
struct TriangleBatch {
  std::size_t corners = 3;                                            ///< of each triangle: 3 at rest, 6 in motion
  std::array<std::array<std::array<double, kBatch>, 3>, 6> position;  ///< by corner, axis and triangle [m]
};

constexpr std::size_t kMaxDirections = 16;
/// Unit directions n, and for each the least n·q of all points q of a body [m].
struct Directions {
  std::size_t count = 0;  ///< at most kMaxDirections
  std::array<std::array<double, kMaxDirections>, 3> normal;
  std::array<double, kMaxDirections> least;
};

/// For each triangle of a batch, the direction along which it is farthest below a body.
struct BatchGaps {
  std::array<double, kBatch> gap;        ///< least n·q of the body less the largest n·p of the corners [m]
  std::array<double, kBatch> direction;  ///< index of the direction
};

constexpr std::size_t kPrisms = 64;
/// Vertical prisms: the triangles at their upper ends, and the lengths of their vertical edges.
struct PrismBatch {
  std::size_t count = 0;                                                  ///< at most kPrisms
  std::array<std::array<std::array<double, kPrisms>, 3>, 3> corner = {};  ///< by corner, axis and prism [m]; finite
  std::array<std::array<double, kPrisms>, 3> height = {};                 ///< of the edge below each corner [m]; finite
};

/// Integrals over prisms and over the triangles at their upper ends. A prism counts negative for the volume where its
/// corners are clockwise seen from above.
struct PrismSums {
  double volume = 0.0;                                    ///< [m^3]
  std::array<double, 3> volume_moment = {};               ///< of the position over the volume [m^4]
  std::array<double, 3> area = {};                        ///< of the unit normal over the triangles [m^2]
  std::array<std::array<double, 3>, 3> area_moment = {};  ///< of position (row) times unit normal (column) [m^3]
};

/// The kernels for one instruction set.
struct Kernels {
  const char* name;  ///< name of the instruction set

  /// Computes the boxes of blocks of vertices.
  /// @param vertices  x0 y0 z0 x1 ... [m] of `blocks` times kBlock vertices; kPadding more floats must be readable
  /// @param[out] boxes        one entry for each block, not padded
  /// @param[in,out] extremes  widened to contain all vertices
  /// @returns whether all coordinates are finite; also false if sums of them overflow float32
  bool (*bound)(const float* vertices, std::size_t blocks, const BoxArrays<float>& boxes, Extremes& extremes);

  /// Computes for each box the bits of the planes that the whole box is beyond; never sets kInsideAll.
  /// @param boxes      arrays of padded(count) entries
  /// @param[out] bits  one entry for each box; room for padded(count) entries
  void (*classifyBoxes)(const BoxArrays<const float>& boxes, std::size_t count, const Planes& planes,
                        std::uint16_t* bits);

  /// Computes for each box how many scales it lies at least beyond the planes: the largest (n·p - outside) / scale of all
  /// planes, p the corner of the box that is least far beyond the plane. Up to rounding: a few 2^-23 of it.
  /// @param boxes        arrays of padded(count) entries
  /// @param inverse      1 / scale of each plane [1/m], > 0
  /// @param[out] scores  one entry for each box; room for padded(count) entries
  void (*scoreBoxes)(const BoxArrays<const float>& boxes, std::size_t count, const Planes& planes,
                     const PerPlane& inverse, float* scores);

  /// Returns the square of the least distance of a point from the boxes [m^2]. Up to rounding: a few 2^-23 of it.
  /// @param count  a multiple of kPadding, > 0
  float (*nearestBox)(const BoxArrays<const float>& boxes, std::size_t count, const std::array<float, 3>& point);

  /// Returns the same as scoreBoxes() for the vertex of a block for which it is least.
  /// @param vertices  x0 y0 z0 x1 ... [m] of kBlock vertices
  float (*scoreBlock)(const float* vertices, const Planes& planes, const PerPlane& inverse);

  /// Computes the bits of the vertices of one block: kInsideAll, or the planes that the vertex is beyond.
  /// @param vertices   x0 y0 z0 x1 ... [m] of kBlock vertices
  /// @param[out] bits  kBlock entries
  void (*classifyBlock)(const float* vertices, const Planes& planes, std::uint16_t* bits);

  /// Classifies the triangles of a cluster by the bits of the vertices of its blocks. Bits above the last triangle are
  /// not valid.
  /// @param bits  kBlock entries from classifyBlock() for each block of the cluster; all kClusterBlocks are read
  TriangleBits (*classifyTriangles)(const ClusterCorners& corners,
                                    const std::array<const std::uint16_t*, kClusterBlocks>& bits);

  /// Returns the index of the function that is largest at a point; of several that are, up to rounding, any.
  std::size_t (*largest)(const LinearFunctions& functions, const std::array<double, 3>& point);

  /// Computes the largest gap of each triangle of a batch. Without directions it is -infinity.
  void (*separate)(const TriangleBatch& triangles, const Directions& directions, BatchGaps& gaps);

  /// Adds the integrals of all prisms of a batch.
  void (*addPrisms)(const PrismBatch& prisms, PrismSums& sums);
};

/// Returns the kernels that this machine can run, the best first; `baseline` is always among them.
const std::vector<Kernels>& availableKernels();

/// Returns the kernels that the environment variable SWEEP_GUARD_SIMD names (avx512, avx2 or baseline), or the best if
/// it is empty or not set. Reads the variable until a call succeeds, for example by the first TriangleMesh.
/// @throws InvalidInput if the name is unknown or the machine cannot run these kernels
const Kernels& kernels();

}  // namespace sweep_guard_core::simd
