#pragma once

#include <cstddef>
#include <cstdint>

/// Vectors of numbers as wide as the registers of the instruction set that the including source is compiled for. Everything
/// has internal linkage or is inlined, since it differs between the sources.
namespace sweep_guard_core::simd {
namespace {

#if defined(__AVX512F__)
constexpr std::size_t kRegister = 64;  // bytes
#elif defined(__AVX2__)
constexpr std::size_t kRegister = 32;
#else
constexpr std::size_t kRegister = 16;
#endif

using Float [[gnu::vector_size(kRegister)]] = float;
using Ints [[gnu::vector_size(kRegister)]] = std::int32_t;
using Words [[gnu::vector_size(kRegister / 2)]] = std::uint16_t;
using Double [[gnu::vector_size(kRegister)]] = double;
constexpr std::size_t kWidth = kRegister / sizeof(float);
constexpr std::size_t kDoubles = kRegister / sizeof(double);

[[gnu::always_inline]] inline Float broadcast(float value) { return value - Float{}; }
[[gnu::always_inline]] inline Double broadcast(double value) { return value - Double{}; }

[[gnu::always_inline]] inline Float load(const float* from) {
  Float lanes;
  __builtin_memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}

[[gnu::always_inline]] inline Double load(const double* from) {
  Double lanes;
  __builtin_memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}

// Loads once: otherwise GCC repeats the load for each use, across cache lines.
[[gnu::always_inline]] inline Float loadOnce(const float* from) {
  Float lanes = load(from);
#ifdef __x86_64__
  asm("" : "+v"(lanes));
#endif
  return lanes;
}

[[gnu::always_inline]] inline void store(const Double& lanes, double* to) {
  __builtin_memcpy(to, &lanes, sizeof(lanes));
}

[[gnu::always_inline]] inline Float min(const Float& a, const Float& b) { return a < b ? a : b; }
[[gnu::always_inline]] inline Float max(const Float& a, const Float& b) { return a > b ? a : b; }
[[gnu::always_inline]] inline Double max(const Double& a, const Double& b) { return a > b ? a : b; }

// The scalar products of vectors (x, y, z) with one normal.
template <typename Lanes, typename Number>
[[gnu::always_inline]] inline Lanes dot(Number nx, Number ny, Number nz, const Lanes& x, const Lanes& y,
                                        const Lanes& z) {
  const Lanes along_y = ny * y;
  return nx * x + along_y + nz * z;
}

[[gnu::always_inline]] inline bool finite(const Float& lanes) {
  const Ints yes = lanes * 0.0F == 0.0F;
  std::uint64_t words[kRegister / sizeof(std::uint64_t)];
  __builtin_memcpy(words, &yes, sizeof(yes));
  std::uint64_t all = words[0];
  for (const std::uint64_t word : words) all &= word;
  return all == ~std::uint64_t{0};
}

// The lanes of two vectors, by number: those of `b` follow those of `a`.
template <std::size_t... lane>
[[gnu::always_inline]] inline Float shuffle(const Float& a, const Float& b) {
  static_assert(sizeof...(lane) == kWidth);
#ifdef __clang__
  return __builtin_shufflevector(a, b, static_cast<int>(lane)...);
#else
  return __builtin_shuffle(a, b, Ints{static_cast<std::int32_t>(lane)...});
#endif
}

}  // namespace
}  // namespace sweep_guard_core::simd
