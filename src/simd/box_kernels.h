#pragma once

#include <algorithm>
#include <utility>

#include "simd/lanes.h"
#include "sweep_guard/simd/kernels.h"

/// The loops over boxes. For kernels.cpp alone, as the headers beside it.
namespace sweep_guard_core::simd {
namespace {

constexpr std::size_t kFloats = 3 * kBlock;
constexpr std::size_t kInPhase = kWidth / 3 * 3;  // lanes of whole vertices: each load begins with an x
constexpr std::size_t kLoads = (kFloats + kInPhase - 1) / kInPhase;
constexpr std::size_t kAhead = 32;  // blocks, 12 KB: the hardware's prefetching alone does not saturate the memory

static_assert(kWidth == 4 || kWidth == 8 || kWidth == 16);

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

constexpr auto kLower = [](const Float& a, const Float& b) __attribute__((always_inline)) { return min(a, b); };
constexpr auto kUpper = [](const Float& a, const Float& b) __attribute__((always_inline)) { return max(a, b); };

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
    one = {perAxis(one.lower, kLower), perAxis(one.upper, kUpper)};
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
using NearestCorners = const float* [kMaxPlanes][3];

void findNearestCorners(const BoxArrays<const float>& boxes, const Planes& planes, NearestCorners& nearest) {
  for (std::size_t i = 0; i < planes.count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      nearest[i][axis] = planes.normal[axis][i] < 0.0F ? boxes.upper[axis] : boxes.lower[axis];
    }
  }
}

// Handles several independent registers of boxes at a time.
template <std::size_t registers>
void classifyBoxesFrom(std::size_t first, const NearestCorners& nearest, const Planes& planes, std::uint16_t* bits) {
  Float found[registers];  // sums of powers of two: lanes of float select faster than those of int
  for (std::size_t k = 0; k < registers; ++k) found[k] = Float{};
  float bit = 1.0F;
  for (std::size_t i = 0; i < planes.count; ++i, bit *= 2.0F) {
    for (std::size_t k = 0; k < registers; ++k) {
      const auto corner = [&](std::size_t axis) { return load(nearest[i][axis] + first + k * kWidth); };
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
  NearestCorners nearest;
  findNearestCorners(boxes, planes, nearest);
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
      const auto corner = [&](std::size_t axis) { return load(nearest[i][axis] + first + k * kWidth); };
      const Float out =
          dot(planes.normal[0][i], planes.normal[1][i], planes.normal[2][i], corner(0), corner(1), corner(2));
      most[k] = max(most[k], (out - planes.outside[i]) * inverse[i]);
    }
  }
  for (std::size_t k = 0; k < registers; ++k) __builtin_memcpy(scores + first + k * kWidth, &most[k], sizeof(Float));
}

void scoreBoxes(const BoxArrays<const float>& boxes, std::size_t count, const Planes& planes, const PerPlane& inverse,
                float* scores) {
  NearestCorners nearest;
  findNearestCorners(boxes, planes, nearest);
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

}  // namespace
}  // namespace sweep_guard_core::simd
