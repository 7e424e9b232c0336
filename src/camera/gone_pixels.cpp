#include "camera/gone_pixels.h"

#include <cmath>

namespace sweep_guard_core {

template <typename Function>
void GonePixels::forEachNeighbor(const Pixel& pixel, const Function& function) const {
  const auto [u, v] = pixel;
  if (u > 0) function(Pixel{u - 1, v});
  if (v > 0) function(Pixel{u, v - 1});
  if (u + 1 < grid_.width()) function(Pixel{u + 1, v});
  if (v + 1 < grid_.height()) function(Pixel{u, v + 1});
}

const std::vector<size_t>& GonePixels::find(const SelfPixels& self, const Depths& depths) {
  gone_.clear();
  decided_.clear();
  fates_.resize(depths.now.size(), Fate::kOpen);
  if (findSeeds(self, depths)) spread(self, depths);
  for (const Pixel& pixel : decided_) {
    const size_t place = pixel.v * depths.stride + pixel.u;
    if (fates_[place] == Fate::kGone) gone_.push_back(place);
    fates_[place] = Fate::kOpen;
  }
  return gone_;
}

// Returns whether any has gone.
bool GonePixels::findSeeds(const SelfPixels& self, const Depths& depths) {
  bool any_gone = false;
  self.forEach([&](std::uint32_t u, std::uint32_t v) {
    const Fate fate = besideSeen(self, depths, {u, v});
    if (fate == Fate::kOpen) return;
    fates_[v * depths.stride + u] = fate;
    decided_.push_back({u, v});
    any_gone = any_gone || fate == Fate::kGone;
  });
  return any_gone;
}

// One neighbor that stays is enough.
GonePixels::Fate GonePixels::besideSeen(const SelfPixels& self, const Depths& depths, const Pixel& pixel) const {
  const float hidden = depths.now[pixel.v * depths.stride + pixel.u];
  Fate fate = Fate::kOpen;
  forEachNeighbor(pixel, [&](const Pixel& next) {
    const size_t place = next.v * depths.stride + next.u;
    const float before = depths.before[place];
    const float now = depths.now[place];
    const bool distant = std::isnan(now) && std::isnan(depths.remembered[place]);
    if (fate == Fate::kStays || (self.hides(next.u, next.v) && !distant)) return;
    const bool gave_way = distant || now > before + tolerance_.stepAt(before);
    if (tolerance_.joined(hidden, now)) fate = Fate::kStays;
    const bool same = std::abs(hidden - before) <= 2.0F * tolerance_.errorAt(hidden);
    if (same && gave_way) fate = Fate::kGone;
  });
  return fate;
}

void GonePixels::spread(const SelfPixels& self, const Depths& depths) {
  for (size_t i = 0; i < decided_.size(); ++i) {
    const Pixel pixel = decided_[i];
    const size_t place = pixel.v * depths.stride + pixel.u;
    forEachNeighbor(pixel, [&](const Pixel& next) {
      const size_t next_place = next.v * depths.stride + next.u;
      const bool open = fates_[next_place] == Fate::kOpen && self.hides(next.u, next.v);
      if (!open || !tolerance_.joined(depths.now[place], depths.now[next_place])) return;
      fates_[next_place] = fates_[place];
      decided_.push_back(next);
    });
  }
}

}  // namespace sweep_guard_core
