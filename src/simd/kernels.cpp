// Compiled once for every instruction set. The object may not define anything that another file could define, too: the
// linker could use an inline function compiled for AVX-512 in code that runs everywhere.
#include <algorithm>
#include <utility>
#ifdef __AVX512BW__
#include <immintrin.h>
#endif

#include "simd/lanes.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core::simd {
namespace {

constexpr std::size_t kFloats = 3 * kBlock;
constexpr std::size_t kInPhase = kWidth / 3 * 3;  // lanes of whole vertices: each load begins with an x
constexpr std::size_t kLoads = (kFloats + kInPhase - 1) / kInPhase;
constexpr std::size_t kAhead = 32;  // blocks, 12 KB: the hardware's prefetching alone does not saturate the memory

static_assert(kWidth == 4 || kWidth == 8 || kWidth == 16);
static_assert(kFunctions % kDoubles == 0 && kBatch % kDoubles == 0);

template <std::size_t by, std::size_t... lane>
[[gnu::always_inline]] inline Float turned(const Float& lanes, std::index_sequence<lane...> /*all*/) {
  return shuffle<(lane + by) % kWidth...>(lanes, lanes);
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
  return best(best(two, turned<12>(lanes)), turned<6>(two));
}

struct Lower {
  [[gnu::always_inline]] Float operator()(const Float& a, const Float& b) const { return min(a, b); }
};
struct Upper {
  [[gnu::always_inline]] Float operator()(const Float& a, const Float& b) const { return max(a, b); }
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
    lower = min(lower, low);
    upper = max(upper, high);
  }
};

// Repeats three numbers in all lanes.
Float repeated(const std::array<float, 3>& numbers) {
  float lanes[kWidth];
  for (std::size_t lane = 0; lane < kWidth; ++lane) lanes[lane] = numbers[lane % 3];
  return load(lanes);
}

// Bounds `count` loads of a block, by halves: a chain of comparisons is slower. NaN and infinity stay in a sum; four
// independent sums are faster.
template <std::size_t first, std::size_t count>
[[gnu::always_inline]] inline Bounds boundsOf(const float* block, Float (&sums)[4]) {
  if constexpr (count == 1) {
    constexpr std::size_t kFrom = std::min(first * kInPhase, kFloats - kInPhase);
    const Float lanes = loadOnce(block + kFrom);
    sums[first % 4] += lanes;
    return {lanes, lanes};
  } else {
    Bounds bounds = boundsOf<first, (count + 1) / 2>(block, sums);
    const Bounds second = boundsOf<first + (count + 1) / 2, count / 2>(block, sums);
    bounds.widen(second.lower, second.upper);
    return bounds;
  }
}

bool bound(const float* vertices, std::size_t blocks, const BoxArrays<float>& boxes, Extremes& extremes) {
  Bounds all{repeated(extremes.lower), repeated(extremes.upper)};
  Float sums[4] = {};
  for (std::size_t block = 0; block < blocks; ++block, vertices += kFloats) {
    for (std::size_t line = 0; line < kFloats; line += 16) __builtin_prefetch(vertices + kAhead * kFloats + line);
    Bounds one = boundsOf<0, kLoads>(vertices, sums);
    one = {perAxis(one.lower, Lower()), perAxis(one.upper, Upper())};
    store(one.lower, one.upper, boxes, block);
    all.widen(one.lower, one.upper);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extremes.lower[axis] = all.lower[axis];
    extremes.upper[axis] = all.upper[axis];
  }
  return finite(sums[0] + sums[1] + sums[2] + sums[3]);
}

// Sums of powers of two, below 2^16.
[[gnu::always_inline]] inline void storeBits(const Float& sums, std::uint16_t* bits) {
  const auto ints = __builtin_convertvector(sums, Ints);
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
  for (std::size_t k = 0; k < registers; ++k) found[k] = Float{};
  float bit = 1.0F;
  for (std::size_t i = 0; i < planes.count; ++i, bit *= 2.0F) {
    for (std::size_t k = 0; k < registers; ++k) {
      const auto corner = [&](std::size_t axis) { return load(nearest.from[i][axis] + first + k * kWidth); };
      const Float out =
          dot(planes.normal[0][i], planes.normal[1][i], planes.normal[2][i], corner(0), corner(1), corner(2));
      found[k] += out > planes.outside[i] ? broadcast(bit) : Float{};
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

// Handles several independent registers of boxes at a time.
template <std::size_t registers>
void scoreBoxesFrom(std::size_t first, const NearestCorners& nearest, const Planes& planes, const PerPlane& inverse,
                    float* scores) {
  Float most[registers];
  for (std::size_t k = 0; k < registers; ++k) most[k] = broadcast(-__builtin_inff());
  for (std::size_t i = 0; i < planes.count; ++i) {
    for (std::size_t k = 0; k < registers; ++k) {
      const auto corner = [&](std::size_t axis) { return load(nearest.from[i][axis] + first + k * kWidth); };
      const Float out =
          dot(planes.normal[0][i], planes.normal[1][i], planes.normal[2][i], corner(0), corner(1), corner(2));
      most[k] = max(most[k], (out - planes.outside[i]) * inverse[i]);
    }
  }
  for (std::size_t k = 0; k < registers; ++k) __builtin_memcpy(scores + first + k * kWidth, &most[k], sizeof(Float));
}

void scoreBoxes(const BoxArrays<const float>& boxes, std::size_t count, const Planes& planes, const PerPlane& inverse,
                float* scores) {
  const NearestCorners nearest(boxes, planes);
  std::size_t first = 0;
  for (; first + 4 * kWidth <= count; first += 4 * kWidth) scoreBoxesFrom<4>(first, nearest, planes, inverse, scores);
  for (; first < count; first += kWidth) scoreBoxesFrom<1>(first, nearest, planes, inverse, scores);
}

float leastOf(const Float& lanes) {
  float least = lanes[0];
  for (std::size_t lane = 1; lane < kWidth; ++lane) least = lanes[lane] < least ? lanes[lane] : least;
  return least;
}

float nearestBox(const BoxArrays<const float>& boxes, std::size_t count, const std::array<float, 3>& point) {
  const Float zero{};
  Float least = broadcast(__builtin_inff());
  for (std::size_t first = 0; first < count; first += kWidth) {
    Float squared{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Float below = load(boxes.lower[axis] + first) - point[axis];
      const Float above = point[axis] - load(boxes.upper[axis] + first);
      const Float apart = max(max(below, above), zero);
      squared += apart * apart;
    }
    least = min(least, squared);
  }
  return leastOf(least);
}

// Gathers one axis of kWidth vertices from the three registers that contain them.
template <std::size_t axis, std::size_t... lane>
[[gnu::always_inline]] inline Float oneAxis(const Float (&of)[3], std::index_sequence<lane...> /*all*/) {
  const Float two = shuffle<(3 * lane + axis) % (2 * kWidth)...>(of[0], of[1]);
  return shuffle<(3 * lane + axis < 2 * kWidth ? lane : 3 * lane + axis - kWidth)...>(two, of[2]);
}

struct Points {
  explicit Points(const float* vertices) {
    const Float of[3] = {loadOnce(vertices), loadOnce(vertices + kWidth), loadOnce(vertices + 2 * kWidth)};
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
float scoreBlock(const float* vertices, const Planes& planes, const PerPlane& inverse) {
  Float least = broadcast(__builtin_inff());
  for (std::size_t first = 0; first < kBlock; first += 2 * kWidth) {
    const Points at[2] = {Points(vertices + 3 * first), Points(vertices + 3 * (first + kWidth))};
    Float most[2] = {broadcast(-__builtin_inff()), broadcast(-__builtin_inff())};
    for (std::size_t i = 0; i < planes.count; ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        const Float out = dot(planes.normal[0][i], planes.normal[1][i], planes.normal[2][i], at[k].x, at[k].y, at[k].z);
        most[k] = max(most[k], (out - planes.outside[i]) * inverse[i]);
      }
    }
    least = min(least, min(most[0], most[1]));
  }
  return leastOf(least);
}

constexpr auto kInside = static_cast<float>(kInsideAll);

// Handles two independent registers of vertices at a time.
void classifyBlock(const float* vertices, const Planes& planes, std::uint16_t* bits) {
  for (std::size_t first = 0; first < kBlock; first += 2 * kWidth) {
    const Points at[2] = {Points(vertices + 3 * first), Points(vertices + 3 * (first + kWidth))};
    Float found[2] = {};
    Float inside[2] = {broadcast(kInside), broadcast(kInside)};  // or 0
    float bit = 1.0F;
    for (std::size_t i = 0; i < planes.count; ++i, bit *= 2.0F) {
      for (std::size_t k = 0; k < 2; ++k) {
        const Float out = dot(planes.normal[0][i], planes.normal[1][i], planes.normal[2][i], at[k].x, at[k].y, at[k].z);
        found[k] += out > planes.outside[i] ? broadcast(bit) : Float{};
        inside[k] = out < planes.inside[i] ? inside[k] : Float{};
      }
    }
    for (std::size_t k = 0; k < 2; ++k) {
      storeBits(inside[k] == kInside ? inside[k] : found[k], bits + first + k * kWidth);
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

std::size_t largest(const LinearFunctions& functions, const std::array<double, 3>& point) {
  const auto value = [&](std::size_t i) {
    return dot(point[0], point[1], point[2], load(functions.x + i), load(functions.y + i), load(functions.z + i)) +
           load(functions.w + i);
  };
  Double most = value(0);
  Double first = {};  // of the register that holds it; lanes of double, as they are selected by a mask of doubles
  Double index = {};
  for (std::size_t i = kDoubles; i < functions.count; i += kDoubles) {
    index += static_cast<double>(kDoubles);
    const Double next = value(i);
    first = next <= most ? first : index;
    most = max(next, most);
  }
  std::size_t best = 0;
  for (std::size_t lane = 1; lane < kDoubles; ++lane) {
    if (most[lane] > most[best]) best = lane;
  }
  return static_cast<std::size_t>(first[best]) + best;
}

struct Vector {
  Double x;
  Double y;
  Double z;
};

[[gnu::always_inline]] inline Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[gnu::always_inline]] inline Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline Vector operator*(const Double& scale, const Vector& a) {
  return {scale * a.x, scale * a.y, scale * a.z};
}
[[gnu::always_inline]] inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

[[gnu::always_inline]] inline Vector load(const std::array<std::array<double, kPrisms>, 3>& axes, std::size_t first) {
  return {load(&axes[0][first]), load(&axes[1][first]), load(&axes[2][first])};
}

double sumOf(const Double& lanes) {
  double sum = 0.0;
  for (std::size_t lane = 0; lane < kDoubles; ++lane) sum += lanes[lane];
  return sum;
}

void addTo(std::array<double, 3>& sums, const Vector& lanes) {
  sums[0] += sumOf(lanes.x);
  sums[1] += sumOf(lanes.y);
  sums[2] += sumOf(lanes.z);
}

// Triangle and floor are linear, so products of two positions or heights have exact integrals.
void addPrisms(const PrismBatch& prisms, PrismSums& sums) {
  Double volume = {};
  Vector volume_moment = {};
  Vector area = {};
  Vector area_moment[3] = {};
  Double lane;
  for (std::size_t i = 0; i < kDoubles; ++i) lane[i] = static_cast<double>(i);
  for (std::size_t first = 0; first < prisms.count; first += kDoubles) {
    const Vector a = load(prisms.corner[0], first);
    const Vector b = load(prisms.corner[1], first);
    const Vector c = load(prisms.corner[2], first);
    const Vector heights = load(prisms.height, first);
    const Double half = lane < static_cast<double>(prisms.count - first) ? broadcast(0.5) : Double{};
    const Vector normal = half * cross(b - a, c - a);
    const Vector center = broadcast(1.0 / 3.0) * (a + b + c);
    area = area + normal;
    area_moment[0] = area_moment[0] + center.x * normal;
    area_moment[1] = area_moment[1] + center.y * normal;
    area_moment[2] = area_moment[2] + center.z * normal;
    const auto middle = [](const Vector& p, const Double& height) -> Vector { return {p.x, p.y, p.z - 0.5 * height}; };
    const Vector middle_a = middle(a, heights.x);
    const Vector middle_b = middle(b, heights.y);
    const Vector middle_c = middle(c, heights.z);
    const Double height = heights.x + heights.y + heights.z;
    const Vector products = heights.x * middle_a + heights.y * middle_b + heights.z * middle_c;
    volume += normal.z * height * (1.0 / 3.0);
    volume_moment = volume_moment + (normal.z * (1.0 / 12.0)) * (height * (middle_a + middle_b + middle_c) + products);
  }
  sums.volume += sumOf(volume);
  addTo(sums.volume_moment, volume_moment);
  addTo(sums.area, area);
  for (std::size_t axis = 0; axis < 3; ++axis) addTo(sums.area_moment[axis], area_moment[axis]);
}

void separate(const TriangleBatch& triangles, const Directions& directions, BatchGaps& gaps) {
  for (std::size_t first = 0; first < kBatch; first += kDoubles) {
    Double most = broadcast(-__builtin_inf());
    Double best = {};
    for (std::size_t i = 0; i < directions.count; ++i) {
      const auto along = [&](std::size_t corner) {
        const auto& position = triangles.position[corner];
        return dot(directions.normal[0][i], directions.normal[1][i], directions.normal[2][i], load(&position[0][first]),
                   load(&position[1][first]), load(&position[2][first]));
      };
      Double reach = along(0);
      for (std::size_t corner = 1; corner < triangles.corners; ++corner) reach = max(reach, along(corner));
      const Double gap = directions.least[i] - reach;
      best = gap <= most ? best : broadcast(static_cast<double>(i));
      most = max(gap, most);
    }
    store(most, &gaps.gap[first]);
    store(best, &gaps.direction[first]);
  }
}

}  // namespace

namespace SWEEP_GUARD_ISA {
extern const Kernels kKernels;
const Kernels kKernels = {nullptr,           bound,   classifyBoxes, scoreBoxes, nearestBox, scoreBlock, classifyBlock,
                          classifyTriangles, largest, separate,      addPrisms};
}  // namespace SWEEP_GUARD_ISA

}  // namespace sweep_guard_core::simd
