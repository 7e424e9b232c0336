#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/// The loops over vertices and boxes that decide how fast a mesh is looked at, in float32. They are compiled for
/// several instruction sets; the best one of the machine is chosen when the first is needed. Rounding differs between
/// them: what rests on their results has to allow for it.
namespace sweep_guard_core::simd {

/// Vertices of a block: consecutive ones, that share a box.
constexpr std::size_t kBlock = 32;
/// Triangles of a cluster at most, and the blocks that hold their corners.
constexpr std::size_t kCluster = 64;
constexpr std::size_t kClusterBlocks = 4;
/// Arrays of boxes and of their bits are as long as a multiple of this.
constexpr std::size_t kPadding = 16;
constexpr std::size_t padded(std::size_t count) { return (count + kPadding - 1) / kPadding * kPadding; }
constexpr std::size_t kMaxPlanes = 15;

/// Boxes, one array for each side: lower x, y, z [m].
template <typename Number>
struct BoxArrays {
  std::array<Number*, 3> lower;
  std::array<Number*, 3> upper;

  /// Those from box `first` on.
  BoxArrays from(std::size_t first) const {
    return {{lower[0] + first, lower[1] + first, lower[2] + first},
            {upper[0] + first, upper[1] + first, upper[2] + first}};
  }
};

/// Bounds of all coordinates seen [m], for each of x, y, z.
struct Extremes {
  std::array<float, 3> lower;
  std::array<float, 3> upper;
};

/// Planes n·p = d by what is certain of a point in float32: n·p > `outside` is beyond, n·p < `inside` is not.
struct Planes {
  std::size_t count = 0;  ///< at most kMaxPlanes
  std::array<std::array<float, kMaxPlanes + 1>, 3> normal;
  std::array<float, kMaxPlanes + 1> outside;
  std::array<float, kMaxPlanes + 1> inside;
};

/// Set in the bits of a vertex that is inside of all planes. Bit i is set where it is beyond plane i.
constexpr std::uint16_t kInsideAll = 1U << kMaxPlanes;

/// The first, second and third corners of the triangles of a cluster, places among the vertices of its blocks: block
/// i / kBlock of them, vertex i % kBlock of that.
struct ClusterCorners {
  std::array<std::array<std::uint8_t, kCluster>, 3> places;
};

/// Triangles of a cluster: bit i for triangle i.
struct TriangleBits {
  std::uint64_t left;  ///< not wholly beyond one plane
  std::uint64_t met;   ///< with a corner inside of all planes
};

struct Kernels {
  const char* name;  ///< of the instruction set

  /// Takes the boxes of blocks of vertices.
  /// @param vertices  x0 y0 z0 x1 ... of `blocks` times kBlock vertices; kPadding floats more must be readable
  /// @param extremes  widened to hold all of them
  /// @returns whether all are finite
  bool (*bound)(const float* vertices, std::size_t blocks, const BoxArrays<float>& boxes, Extremes& extremes);

  /// For each box, the planes that all of it lies beyond. Arrays are padded to kPadding.
  void (*classifyBoxes)(const BoxArrays<const float>& boxes, std::size_t count, const Planes& planes,
                        std::uint16_t* bits);

  /// The bits of the vertices of one block.
  void (*classifyBlock)(const float* vertices, const Planes& planes, std::uint16_t* bits);

  /// The triangles of a cluster, by the bits of the vertices of each of its blocks. Those past its last one mean
  /// nothing.
  TriangleBits (*classifyTriangles)(const ClusterCorners& corners,
                                    const std::array<const std::uint16_t*, kClusterBlocks>& bits);
};

/// Those that this machine can run, the best one first; `baseline` is always among them.
const std::vector<Kernels>& availableKernels();

/// The best; or the one that the environment variable SWEEP_GUARD_SIMD names: avx512, avx2 or baseline.
/// @throws InvalidInput if the machine has not got that
const Kernels& kernels();

}  // namespace sweep_guard_core::simd
