#include "session/session_log.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "timeline.h"

namespace sweep_guard_session {
namespace {

using namespace sweep_guard_core::timeline;

constexpr int kRate = 8000;

// Number of samples that are not 0, from one time [ms] to another.
long sounding(const std::vector<std::int16_t>& samples, int begin, int end) {
  const auto at = [&](int ms) { return samples.begin() + ms * kRate / 1000; };
  return std::count_if(at(begin), at(end), [](int sample) { return sample != 0; });
}

TEST(SessionSoundTest, LastsAsLongAsTheSessionAndSoundsAsItsLevels) {
  SessionLog log;
  log.add({at(1000), kClear, {}});
  log.add({at(1500), kContact, {}});
  log.add({at(2500), kClear, {}});
  log.end(at(4000));
  const auto samples = soundOf(log, kRate);
  EXPECT_EQ(samples.size(), 3U * kRate);
  EXPECT_EQ(sounding(samples, 100, 500), 0);
  EXPECT_EQ(sounding(samples, 510, 1500), 5940);  // a tone of 1 kHz is 0 at two of its eight samples
  EXPECT_LT(sounding(samples, 1510, 3000), 200);
}

TEST(SessionSoundTest, IsEmptyWithoutWarnings) { EXPECT_TRUE(soundOf(SessionLog(), kRate).empty()); }

}  // namespace
}  // namespace sweep_guard_session
