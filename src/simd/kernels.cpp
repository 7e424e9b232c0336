// Compiled once for every instruction set. The object may not define anything that another file could define, too: the
// linker could use an inline function compiled for AVX-512 in code that runs everywhere.
#include "simd/box_kernels.h"
#include "simd/double_kernels.h"
#include "simd/triangle_kernels.h"

namespace sweep_guard_core::simd::SWEEP_GUARD_ISA {
extern const Kernels kKernels;
const Kernels kKernels = {nullptr,           bound,   classifyBoxes, scoreBoxes, nearestBox, scoreBlock, classifyBlock,
                          classifyTriangles, largest, separate,      addPrisms};
}  // namespace sweep_guard_core::simd::SWEEP_GUARD_ISA
