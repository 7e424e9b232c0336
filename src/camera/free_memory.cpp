#include "camera/free_memory.h"

#include <cmath>
#include <limits>

namespace sweep_guard_core {
namespace {

constexpr size_t kRemembered = 64;  // images: those that none of them needed are given back

}  // namespace

FreeMemory::FreeMemory(const Grid& grid, const Pinhole& camera, size_t stride, double remember)
    : grid_(grid),
      camera_(camera),
      stride_(stride),
      remember_(remember),
      hidden_for_(stride * grid.height(), 0.0F),
      self_before_(grid.tiles(), 0) {}

void FreeMemory::begin(const Eigen::Isometry3d& X_FC, bool rests, double since) {
  since_ = since;
  before_ = rests ? newest_ : nullptr;
  newest_ = spaces_.take();
  spaces_.forgetUnneeded(kRemembered);
  newest_->X_CF = X_FC.inverse();
  newest_->camera = camera_;
  newest_->width = grid_.width();
  newest_->height = grid_.height();
  newest_->stride = stride_;
  newest_->depths.resize(hidden_for_.size(), std::numeric_limits<float>::quiet_NaN());
}

void FreeMemory::keep(std::uint32_t place, size_t pixel) {
  const std::uint32_t tile = self_before_[place / Grid::kTilePixels];
  const bool again = (tile >> place % Grid::kTilePixels & 1U) != 0;
  hidden_for_[pixel] = (again ? hidden_for_[pixel] : 0.0F) + static_cast<float>(since_);
  if (!before_ || hidden_for_[pixel] > static_cast<float>(remember_)) return;
  newest_->depths[pixel] = std::fmax(newest_->depths[pixel], before_->depths[pixel]);
}

}  // namespace sweep_guard_core
