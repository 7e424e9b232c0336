#include <cstring>

#include "peers/peers.h"

namespace sweep_guard_benchmark {
namespace {

// No update can take less time than reading every position once. The buffer is exchanged for the previous one, as a
// mesh does: less of two alternating buffers stays in the caches than of one.
template <bool kFetchesAhead>
class MemoryRead : public Peer {
 public:
  explicit MemoryRead(Surface& surface) : surface_(surface), positions_M_(surface.positions_M) {}

  void update() override {
    positions_M_.swap(surface_.positions_M);
    const float* const positions = positions_M_.data();
    const size_t count = positions_M_.size() / kStep * kStep;
    std::array<Register, 4> sums = {};
    for (size_t i = 0; i < count; i += kStep) {
      if (kFetchesAhead) fetch(positions + i + kAhead);
      for (size_t j = 0; j < sums.size(); ++j) {
        Register values;
        std::memcpy(&values, positions + i + j * kStep / sums.size(), sizeof(values));
        sums[j] += values;
      }
    }
    const Register sum = sums[0] + sums[1] + sums[2] + sums[3];
    sum_ = sum[0];
  }

  bool answers() const override { return false; }

 private:
  using Register = std::uint32_t __attribute__((vector_size(64)));
  static constexpr size_t kStep = 4 * sizeof(Register) / sizeof(float);  // no load waits for the previous addition
  static constexpr size_t kAhead = size_t{12} * 1024 / sizeof(float);    // as far as the update of a mesh does

  static void fetch(const float* from) {
    for (size_t line = 0; line < kStep; line += sizeof(Register) / sizeof(float)) __builtin_prefetch(from + line);
  }

  Surface& surface_;
  std::vector<float> positions_M_;
  volatile std::uint32_t sum_ = 0;
};

}  // namespace

std::unique_ptr<Peer> makeMemoryRead(Surface& surface) { return std::make_unique<MemoryRead<false>>(surface); }

std::unique_ptr<Peer> makeMemoryReadAhead(Surface& surface) { return std::make_unique<MemoryRead<true>>(surface); }

}  // namespace sweep_guard_benchmark
