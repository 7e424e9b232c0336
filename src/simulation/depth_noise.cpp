#include "simulation/depth_noise.h"

#include <cmath>

namespace sweep_guard_simulation {
namespace {

constexpr size_t kNoises = size_t{1} << 16U;
constexpr size_t kRun = 512;    // pixels that take consecutive ones
constexpr float kMost = 65.0F;  // [m]

}  // namespace

DepthNoise::DepthNoise() : noise_(kNoises) {
  std::normal_distribution<float> normal(0.0F, kDeviation);
  for (float& noise : noise_) noise = normal(random_);
}

const std::vector<std::uint16_t>& DepthNoise::seen(const std::vector<float>& depths) {
  image_.resize(depths.size());
  const float* noise = nullptr;
  for (size_t i = 0; i < depths.size(); ++i, ++noise) {
    if (i % kRun == 0) noise = &noise_[random_() % (kNoises - kRun)];
    const float z = depths[i] + *noise * depths[i] * depths[i];
    const float stepped = 1.0F / (kStep * std::round(1.0F / (kStep * z)));
    image_[i] = stepped > 0.0F && stepped < kMost ? static_cast<std::uint16_t>(std::lround(1e3F * stepped)) : 0;
  }
  return image_;
}

}  // namespace sweep_guard_simulation
