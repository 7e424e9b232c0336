// Compiled once for every instruction set. So nothing that another file might define too may come out of it: an inline
// function compiled for AVX-512 could be linked into code that runs everywhere.
#include <experimental/simd>
#include <utility>

#include "sweep_guard/simd/kernels.h"

namespace sweep_guard::simd {
namespace {

namespace stdx = std::experimental;
using Float = stdx::native_simd<float>;
using Int = stdx::rebind_simd_t<std::int32_t, Float>;
using Vector [[gnu::vector_size(sizeof(Float))]] = float;
constexpr std::size_t kWidth = Float::size();
constexpr std::size_t kFloats = 3 * kBlock;
constexpr std::size_t kInPhase = kWidth / 3 * 3;  // lanes of whole vertices: a load of these begins with an x
constexpr std::size_t kAhead = 8;  // blocks; what the hardware fetches alone does not fill the memory's time

static_assert(kWidth == 4 || kWidth == 8 || kWidth == 16);

// A load that stays one: GCC repeats it as an operand of each use, and these cross cache lines.
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

// Lane i becomes what lane i + by was.
template <std::size_t by>
[[gnu::always_inline]] inline Float turned(const Float& lanes) {
  return turned<by>(lanes, std::make_index_sequence<kWidth>());
}

// The best of all x, all y, all z among the lanes in phase.
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
  Float sums[4] = {};  // NaN and infinity stay in a sum; four, so that none waits for the one before
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

// Of each box, the corner that lies least far beyond each plane.
struct NearestCorners {
  NearestCorners(const BoxArrays<const float>& boxes, const Planes& planes) {
    for (std::size_t i = 0; i < planes.count; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        from[i][axis] = planes.normal[axis][i] < 0.0F ? boxes.upper[axis] : boxes.lower[axis];
      }
    }
  }

  const float* from[kMostPlanes][3];
};

// So many registers of boxes at a time: none need wait for another.
template <std::size_t registers>
void classifyBoxesFrom(std::size_t first, const NearestCorners& nearest, const Planes& planes, std::int32_t* bits) {
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
    stdx::static_simd_cast<Int>(found[k]).copy_to(bits + first + k * kWidth, stdx::element_aligned);
  }
}

void classifyBoxes(const BoxArrays<const float>& boxes, std::size_t count, const Planes& planes, std::int32_t* bits) {
  const NearestCorners nearest(boxes, planes);
  std::size_t first = 0;
  for (; first + 4 * kWidth <= count; first += 4 * kWidth) classifyBoxesFrom<4>(first, nearest, planes, bits);
  for (; first < count; first += kWidth) classifyBoxesFrom<1>(first, nearest, planes, bits);
}

// Two registers of vertices at a time: the next plane need not wait for the one before.
void classifyBlock(const float* vertices, const Planes& planes, std::uint16_t* bits) {
  alignas(sizeof(Float)) float p[3][kBlock];
  for (std::size_t i = 0; i < kBlock; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis][i] = vertices[3 * i + axis];
  }
  alignas(sizeof(Float)) std::int32_t wide[kBlock];
  for (std::size_t first = 0; first < kBlock; first += 2 * kWidth) {
    Float at[2][3];
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        at[k][axis] = Float(p[axis] + first + k * kWidth, stdx::vector_aligned);
      }
    }
    Float found[2] = {0.0F, 0.0F};
    Float closest[2] = {-1.0F, -1.0F};  // to being not certainly inside
    float bit = 1.0F;
    for (std::size_t i = 0; i < planes.count; ++i, bit *= 2.0F) {
      for (std::size_t k = 0; k < 2; ++k) {
        const Float out =
            planes.normal[0][i] * at[k][0] + planes.normal[1][i] * at[k][1] + planes.normal[2][i] * at[k][2];
        stdx::where(out > planes.outside[i], found[k]) += bit;
        closest[k] = stdx::max(closest[k], out - planes.inside[i]);
      }
    }
    for (std::size_t k = 0; k < 2; ++k) {
      stdx::where(closest[k] < 0.0F, found[k]) = static_cast<float>(kInsideAll);
      stdx::static_simd_cast<Int>(found[k]).copy_to(wide + first + k * kWidth, stdx::vector_aligned);
    }
  }
  for (std::size_t i = 0; i < kBlock; ++i) bits[i] = static_cast<std::uint16_t>(wide[i]);
}

}  // namespace

namespace SWEEP_GUARD_ISA {
extern const Kernels kKernels;
const Kernels kKernels = {nullptr, bound, classifyBoxes, classifyBlock};
}  // namespace SWEEP_GUARD_ISA

}  // namespace sweep_guard::simd
