#include "camera/self_pixels.h"

#include <array>

namespace sweep_guard_core {
namespace {

simd::Planes planesOf(const SweptVolume& volume_F) {
  const Eigen::Isometry3d& X_FB = volume_F.box.X_MB;
  simd::Planes planes;
  volume_F.forEachHalfSpace([&](const Eigen::Vector3d& normal_B, double offset) {
    const Eigen::Vector3d normal_F = X_FB.linear() * normal_B;
    const size_t i = planes.count++;
    for (size_t axis = 0; axis < 3; ++axis)
      planes.normal[axis][i] = static_cast<float>(normal_F[static_cast<Eigen::Index>(axis)]);
    planes.outside[i] = planes.inside[i] = static_cast<float>(normal_F.dot(X_FB.translation()) + offset);
  });
  return planes;
}

}  // namespace

void SelfPixels::find(const std::vector<float>& places_F, const std::vector<SweptVolume>& bodies_F) {
  blocks_.measure(places_F);
  tiles_.assign(blocks_.count(), 0);
  beyond_.resize(simd::padded(blocks_.count()));
  for (const SweptVolume& body_F : bodies_F) add(places_F, planesOf(body_F));
}

void SelfPixels::add(const std::vector<float>& places_F, const simd::Planes& planes) {
  simd::kernels().classifyBoxes(blocks_.arrays(), blocks_.count(), planes, beyond_.data());
  std::array<std::uint16_t, simd::kBlock> bits;
  for (size_t tile = 0; tile < blocks_.count(); ++tile) {
    if (beyond_[tile] != 0) continue;
    withBlock(places_F, tile,
              [&](const float* vertices) { simd::kernels().classifyBlock(vertices, planes, bits.data()); });
    for (size_t i = 0; i < simd::kBlock; ++i)
      tiles_[tile] |= static_cast<std::uint32_t>(bits[i] == simd::kInsideAll) << i;
  }
}

}  // namespace sweep_guard_core
