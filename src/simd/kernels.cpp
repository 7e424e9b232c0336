// Compiled once for every instruction set. The object may not define anything that another file could define, too: the
// linker could use an inline function compiled for AVX-512 in code that runs everywhere.
#include <experimental/simd>
#include <utility>
#ifdef __AVX512BW__
#include <immintrin.h>
#endif

#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core::simd {
namespace {

namespace stdx = std::experimental;
using Float = stdx::native_simd<float>;
using Vector [[gnu::vector_size(sizeof(Float))]] = float;
constexpr std::size_t kWidth = Float::size();
using Ints [[gnu::vector_size(sizeof(Float))]] = std::int32_t;
using Words [[gnu::vector_size(sizeof(Float) / 2)]] = std::uint16_t;
constexpr std::size_t kFloats = 3 * kBlock;
constexpr std::size_t kInPhase = kWidth / 3 * 3;  // lanes of whole vertices: each load begins with an x
constexpr std::size_t kAhead = 32;  // blocks, 12 KB: the hardware's prefetching alone does not saturate the memory

static_assert(kWidth == 4 || kWidth == 8 || kWidth == 16);

// Loads once: otherwise GCC repeats the load for each use, across cache lines.
[[gnu::always_inline]] inline Float load(const float* from) {
  auto lanes = static_cast<Vector>(Float(from, stdx::element_aligned));
#ifdef __x86_64__
  asm("" : "+v"(lanes));
#endif
  return Float(lanes);
}

template <std::size_t by, std::size_t... lane>
[[gnu::always_inline]] inline Float turned(const Float& lanes, std::index_sequence<lane...> /*all*/) {
  const auto from = static_cast<Vector>(lanes);
  return Float(__builtin_shufflevector(from, from, static_cast<int>((lane + by) % kWidth)...));
}

// Lane i takes the value of lane i + by.
template <std::size_t by>
[[gnu::always_inline]] inline Float turned(const Float& lanes) {
  return turned<by>(lanes, std::make_index_sequence<kWidth>());
}

// Reduces the lanes in phase to the best x, y and z.
template <typename Best>
[[gnu::always_inline]] inline Float perAxis(const Float& lanes, const Best& best) {
  if (kWidth == 4) return lanes;
  const Float two = best(lanes, turned<3>(lanes));
  if (kWidth == 8) return two;
  return best(best(two, turned<6>(two)), turned<12>(lanes));
}

struct Lower {
  [[gnu::always_inline]] Float operator()(const Float& a, const Float& b) const { return stdx::min(a, b); }
};
struct Upper {
  [[gnu::always_inline]] Float operator()(const Float& a, const Float& b) const { return stdx::max(a, b); }
};

void store(const Float& lower, const Float& upper, const BoxArrays<float>& boxes, std::size_t at) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    boxes.lower[axis][at] = lower[axis];
    boxes.upper[axis][at] = upper[axis];
  }
}

struct Bounds {
  Float lower;
  Float upper;

  [[gnu::always_inline]] void widen(const Float& low, const Float& high) {
    lower = stdx::min(lower, low);
    upper = stdx::max(upper, high);
  }
};

bool bound(const float* vertices, std::size_t blocks, const BoxArrays<float>& boxes, Extremes& extremes) {
  Bounds all{Float([&](std::size_t lane) { return extremes.lower[lane % 3]; }),
             Float([&](std::size_t lane) { return extremes.upper[lane % 3]; })};
  Float sums[4] = {};  // NaN and infinity stay in a sum; four independent sums are faster
  for (std::size_t block = 0; block < blocks; ++block, vertices += kFloats) {
    for (std::size_t line = 0; line < kFloats; line += 16) __builtin_prefetch(vertices + kAhead * kFloats + line);
    const Float last = load(vertices + kFloats - kInPhase);
    Bounds one{last, last};
    sums[3] += last;
    for (std::size_t i = 0; i + kInPhase < kFloats; i += kInPhase) {
      const Float lanes = load(vertices + i);
      one.widen(lanes, lanes);
      sums[i / kInPhase % 4] += lanes;
    }
    one = {perAxis(one.lower, Lower()), perAxis(one.upper, Upper())};
    store(one.lower, one.upper, boxes, block);
    all.widen(one.lower, one.upper);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extremes.lower[axis] = all.lower[axis];
    extremes.upper[axis] = all.upper[axis];
  }
  return stdx::all_of((sums[0] + sums[1] + sums[2] + sums[3]) * 0.0F == 0.0F);
}

// Sums of powers of two, below 2^16.
[[gnu::always_inline]] inline void storeBits(const Float& sums, std::uint16_t* bits) {
  const auto ints = __builtin_convertvector(static_cast<Vector>(sums), Ints);
  const auto words = __builtin_convertvector(ints, Words);
  __builtin_memcpy(bits, &words, sizeof(words));
}

// The corner of each box that is least far beyond each plane.
struct NearestCorners {
  NearestCorners(const BoxArrays<const float>& boxes, const Planes& planes) {
    for (std::size_t i = 0; i < planes.count; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        from[i][axis] = planes.normal[axis][i] < 0.0F ? boxes.upper[axis] : boxes.lower[axis];
      }
    }
  }

  const float* from[kMaxPlanes][3];
};

// Handles several independent registers of boxes at a time.
template <std::size_t registers>
void classifyBoxesFrom(std::size_t first, const NearestCorners& nearest, const Planes& planes, std::uint16_t* bits) {
  Float found[registers];  // sums of powers of two: lanes of float select faster than those of int
  for (std::size_t k = 0; k < registers; ++k) found[k] = 0.0F;
  float bit = 1.0F;
  for (std::size_t i = 0; i < planes.count; ++i, bit *= 2.0F) {
    for (std::size_t k = 0; k < registers; ++k) {
      const auto along = [&](std::size_t axis) {
        return planes.normal[axis][i] * Float(nearest.from[i][axis] + first + k * kWidth, stdx::element_aligned);
      };
      stdx::where(along(0) + along(1) + along(2) > planes.outside[i], found[k]) += bit;
    }
  }
  for (std::size_t k = 0; k < registers; ++k) {
    storeBits(found[k], bits + first + k * kWidth);
  }
}

void classifyBoxes(const BoxArrays<const float>& boxes, std::size_t count, const Planes& planes, std::uint16_t* bits) {
  const NearestCorners nearest(boxes, planes);
  std::size_t first = 0;
  for (; first + 4 * kWidth <= count; first += 4 * kWidth) classifyBoxesFrom<4>(first, nearest, planes, bits);
  for (; first < count; first += kWidth) classifyBoxesFrom<1>(first, nearest, planes, bits);
}

// Gathers one axis of kWidth vertices from the three registers that contain them.
template <std::size_t axis, std::size_t... lane>
[[gnu::always_inline]] inline Float oneAxis(const Float (&of)[3], std::index_sequence<lane...> /*all*/) {
  const auto first = static_cast<Vector>(of[0]);
  const auto second = static_cast<Vector>(of[1]);
  const auto third = static_cast<Vector>(of[2]);
  const Vector two = __builtin_shufflevector(first, second, static_cast<int>((3 * lane + axis) % (2 * kWidth))...);
  return Float(__builtin_shufflevector(
      two, third, static_cast<int>(3 * lane + axis < 2 * kWidth ? lane : 3 * lane + axis - kWidth)...));
}

struct Points {
  explicit Points(const float* vertices) {
    const Float of[3] = {load(vertices), load(vertices + kWidth), load(vertices + 2 * kWidth)};
    constexpr auto kAll = std::make_index_sequence<kWidth>();
    x = oneAxis<0>(of, kAll);
    y = oneAxis<1>(of, kAll);
    z = oneAxis<2>(of, kAll);
  }

  Float x;
  Float y;
  Float z;
};

// Handles two independent registers of vertices at a time.
void classifyBlock(const float* vertices, const Planes& planes, std::uint16_t* bits) {
  for (std::size_t first = 0; first < kBlock; first += 2 * kWidth) {
    const Points at[2] = {Points(vertices + 3 * first), Points(vertices + 3 * (first + kWidth))};
    Float found[2] = {0.0F, 0.0F};
    Float::mask_type inside[2] = {Float::mask_type(true), Float::mask_type(true)};
    float bit = 1.0F;
    for (std::size_t i = 0; i < planes.count; ++i, bit *= 2.0F) {
      for (std::size_t k = 0; k < 2; ++k) {
        const Float out = planes.normal[0][i] * at[k].x + planes.normal[1][i] * at[k].y + planes.normal[2][i] * at[k].z;
        stdx::where(out > planes.outside[i], found[k]) += bit;
        inside[k] = inside[k] && out < planes.inside[i];
      }
    }
    for (std::size_t k = 0; k < 2; ++k) {
      stdx::where(inside[k], found[k]) = static_cast<float>(kInsideAll);
      storeBits(found[k], bits + first + k * kWidth);
    }
  }
}

constexpr int kBeyondAny = kInsideAll - 1;
static_assert(kInsideAll == 1U << 15U);  // the sign of a word

#ifdef __AVX512BW__

// The bits of a cluster's vertices fit into four registers: corners are looked up there instead of in memory.
class VertexBits {
 public:
  explicit VertexBits(const std::array<const std::uint16_t*, kClusterBlocks>& bits)
      : of_{_mm512_loadu_si512(bits[0]), _mm512_loadu_si512(bits[1]), _mm512_loadu_si512(bits[2]),
            _mm512_loadu_si512(bits[3])} {
    static_assert(kClusterBlocks == 4 && kBlock == 32 && sizeof(__m512i) == kBlock * sizeof(std::uint16_t));
  }

  // Returns the bits of the vertices at kBlock places.
  __m512i operator()(const std::uint8_t* places) const {
    const __m512i at = _mm512_cvtepu8_epi16(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(places)));
    const __mmask32 in_last_two = _mm512_test_epi16_mask(at, _mm512_set1_epi16(2 * kBlock));
    return _mm512_mask_blend_epi16(in_last_two, _mm512_permutex2var_epi16(of_[0], at, of_[1]),
                                   _mm512_permutex2var_epi16(of_[2], at, of_[3]));
  }

 private:
  __m512i of_[kClusterBlocks];
};

TriangleBits classifyTriangles(const ClusterCorners& corners,
                               const std::array<const std::uint16_t*, kClusterBlocks>& bits) {
  const VertexBits bits_of(bits);
  TriangleBits found = {0, 0};
  for (std::size_t first = 0; first < kCluster; first += kBlock) {
    const __m512i a = bits_of(&corners.places[0][first]);
    const __m512i b = bits_of(&corners.places[1][first]);
    const __m512i c = bits_of(&corners.places[2][first]);
    const __mmask32 left = _mm512_testn_epi16_mask(a & b & c, _mm512_set1_epi16(kBeyondAny));
    const __mmask32 inside = _mm512_movepi16_mask(a | b | c);
    found.not_beyond |= std::uint64_t{left} << first;
    found.corner_inside |= std::uint64_t{inside} << first;
  }
  return found;
}

#else

TriangleBits classifyTriangles(const ClusterCorners& corners,
                               const std::array<const std::uint16_t*, kClusterBlocks>& bits) {
  std::uint16_t of[kClusterBlocks * kBlock];
  for (std::size_t i = 0; i < kClusterBlocks; ++i)
    __builtin_memcpy(of + i * kBlock, bits[i], sizeof(of) / kClusterBlocks);
  TriangleBits found = {0, 0};
  for (std::size_t i = 0; i < kCluster; ++i) {
    const unsigned a = of[corners.places[0][i]];
    const unsigned b = of[corners.places[1][i]];
    const unsigned c = of[corners.places[2][i]];
    found.not_beyond |= std::uint64_t{(a & b & c & kBeyondAny) == 0} << i;
    found.corner_inside |= std::uint64_t{((a | b | c) & kInsideAll) != 0} << i;
  }
  return found;
}

#endif

using Double = stdx::native_simd<double>;
constexpr std::size_t kDoubles = Double::size();

static_assert(kFunctions % kDoubles == 0 && kBatch % kDoubles == 0);

[[gnu::always_inline]] inline Double loadDoubles(const double* from) { return Double(from, stdx::element_aligned); }

std::size_t largest(const LinearFunctions& functions, const std::array<double, 3>& point) {
  const auto value = [&](std::size_t i) {
    return loadDoubles(functions.x + i) * point[0] + loadDoubles(functions.y + i) * point[1] +
           loadDoubles(functions.z + i) * point[2] + loadDoubles(functions.w + i);
  };
  Double most = value(0);
  Double first = 0.0;  // of the register that holds it; lanes of double, as they are selected by a mask of doubles
  Double index = 0.0;
  for (std::size_t i = kDoubles; i < functions.count; i += kDoubles) {
    index += static_cast<double>(kDoubles);
    const Double next = value(i);
    const auto larger = next > most;
    stdx::where(larger, most) = next;
    stdx::where(larger, first) = index;
  }
  std::size_t best = 0;
  for (std::size_t lane = 1; lane < kDoubles; ++lane) {
    if (most[lane] > most[best]) best = lane;
  }
  return static_cast<std::size_t>(static_cast<double>(first[best])) + best;
}

void separate(const TriangleBatch& triangles, const Directions& directions, BatchGaps& gaps) {
  for (std::size_t first = 0; first < kBatch; first += kDoubles) {
    Double most = -__builtin_inf();
    Double best = 0.0;
    for (std::size_t i = 0; i < directions.count; ++i) {
      const auto along = [&](std::size_t corner) {
        const auto& position = triangles.position[corner];
        return directions.normal[0][i] * loadDoubles(&position[0][first]) +
               directions.normal[1][i] * loadDoubles(&position[1][first]) +
               directions.normal[2][i] * loadDoubles(&position[2][first]);
      };
      Double reach = along(0);
      for (std::size_t corner = 1; corner < triangles.corners; ++corner) reach = stdx::max(reach, along(corner));
      const Double gap = directions.least[i] - reach;
      const auto larger = gap > most;
      stdx::where(larger, most) = gap;
      stdx::where(larger, best) = static_cast<double>(i);
    }
    most.copy_to(&gaps.gap[first], stdx::element_aligned);
    best.copy_to(&gaps.direction[first], stdx::element_aligned);
  }
}

}  // namespace

namespace SWEEP_GUARD_ISA {
extern const Kernels kKernels;
const Kernels kKernels = {nullptr, bound, classifyBoxes, classifyBlock, classifyTriangles, largest, separate};
}  // namespace SWEEP_GUARD_ISA

}  // namespace sweep_guard_core::simd
