#pragma once

#include <utility>
#ifdef __AVX512BW__
#include <immintrin.h>
#endif

#include "simd/box_kernels.h"

/// The loops over the vertices and triangles of blocks and clusters.
namespace sweep_guard_core::simd {
namespace {

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
TriangleBits classifyTriangles(const ClusterCorners& corners,
                               const std::array<const std::uint16_t*, kClusterBlocks>& bits) {
  static_assert(kClusterBlocks == 4 && kBlock == 32 && sizeof(__m512i) == kBlock * sizeof(std::uint16_t));
  const __m512i of[] = {_mm512_loadu_si512(bits[0]), _mm512_loadu_si512(bits[1]), _mm512_loadu_si512(bits[2]),
                        _mm512_loadu_si512(bits[3])};
  const auto bits_at = [&of](const std::uint8_t* places) {
    const __m512i at = _mm512_cvtepu8_epi16(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(places)));
    const __mmask32 in_last_two = _mm512_test_epi16_mask(at, _mm512_set1_epi16(2 * kBlock));
    return _mm512_mask_blend_epi16(in_last_two, _mm512_permutex2var_epi16(of[0], at, of[1]),
                                   _mm512_permutex2var_epi16(of[2], at, of[3]));
  };
  TriangleBits found = {0, 0};
  for (std::size_t first = 0; first < kCluster; first += kBlock) {
    const __m512i a = bits_at(&corners[0][first]);
    const __m512i b = bits_at(&corners[1][first]);
    const __m512i c = bits_at(&corners[2][first]);
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
    const unsigned a = of[corners[0][i]];
    const unsigned b = of[corners[1][i]];
    const unsigned c = of[corners[2][i]];
    found.not_beyond |= std::uint64_t{(a & b & c & kBeyondAny) == 0} << i;
    found.corner_inside |= std::uint64_t{((a | b | c) & kInsideAll) != 0} << i;
  }
  return found;
}

#endif

}  // namespace
}  // namespace sweep_guard_core::simd
