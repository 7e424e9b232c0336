#include "interaction/prism_accumulator.h"

namespace sweep_guard_core {
namespace {

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

}  // namespace

void PrismAccumulator::begin() {
  batch_.count = 0;
  sums_ = simd::PrismSums();
}

void PrismAccumulator::addBatch() {
  simd::kernels().addPrisms(batch_, sums_);
  batch_.count = 0;
}

SurfaceSums PrismAccumulator::sums() {
  addBatch();
  SurfaceSums sums;
  sums.volume = sums_.volume;
  sums.volume_moment = Eigen::Map<const Eigen::Vector3d>(sums_.volume_moment.data());
  sums.area = Eigen::Map<const Eigen::Vector3d>(sums_.area.data());
  sums.area_moment = Eigen::Map<const RowMajor>(sums_.area_moment[0].data());
  return sums;
}

}  // namespace sweep_guard_core
