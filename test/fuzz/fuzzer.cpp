// libFuzzer calls this. The program has one target.
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, size_t size) {
  sweep_guard_fuzz::targets().begin()->second(sweep_guard_fuzz::Input(bytes, size));
  return 0;
}
