#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sound/earcon.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kRate = 44100;

MergedWarning at(WarningLevel level, std::optional<double> seconds = {}, bool acknowledged = false) {
  MergedWarning warning;
  warning.level = level;
  if (seconds) warning.time_to_collision = fromSeconds(*seconds);
  warning.acknowledged = acknowledged;
  return warning;
}

MergedWarning considered(double seconds) { return at(WarningLevel::kConsidered, seconds); }

std::vector<std::int16_t> render(const Earcon& earcon, double seconds) {
  std::vector<std::int16_t> samples;
  Synthesizer(kRate).render(earcon, static_cast<size_t>(seconds * kRate), samples);
  return samples;
}

double loudest(const std::vector<std::int16_t>& samples) {
  const auto louder = [](int a, int b) { return std::abs(a) < std::abs(b); };
  return std::abs(*std::max_element(samples.begin(), samples.end(), louder)) / 32767.0;
}

// Number of beeps: begins of sound after at least 20 ms of silence.
int beeps(const std::vector<std::int16_t>& samples) {
  int count = 0;
  size_t silent = kRate;
  for (const std::int16_t sample : samples) {
    if (sample == 0) {
      ++silent;
      continue;
    }
    count += silent >= kRate / 50 ? 1 : 0;
    silent = 0;
  }
  return count;
}

// How many waves a second, from the rising zero crossings of a stretch.
double frequency(const std::vector<std::int16_t>& samples, double begin, double end) {
  int crossings = 0;
  for (auto i = static_cast<size_t>(begin * kRate) + 1; i < static_cast<size_t>(end * kRate); ++i) {
    crossings += samples[i - 1] < 0 && samples[i] >= 0 ? 1 : 0;
  }
  return crossings / (end - begin);
}

TEST(EarconTest, BeepsFollowFasterTheSoonerTheCollisionIs) {
  int before = 0;
  for (const double seconds : {1.0, 0.7, 0.4, 0.1}) {
    const int heard = beeps(render(earconOf(considered(seconds), true), 6.0));
    EXPECT_GT(heard, before) << seconds << " s";
    before = heard;
  }
  EXPECT_EQ(beeps(render(earconOf(considered(1.0), true), 6.0)), 10);
  EXPECT_EQ(beeps(render(earconOf(at(WarningLevel::kReflex, 0.05), true), 6.0)), 60);
}

TEST(EarconTest, ContactIsASteadyToneWithoutAGap) {
  const auto samples = render(earconOf(at(WarningLevel::kContact), true), 3.0);
  EXPECT_EQ(beeps(samples), 1);
  EXPECT_NEAR(frequency(samples, 0.1, 2.9), 1000.0, 1.0);
  for (size_t i = 1; i < samples.size(); ++i) EXPECT_LT(std::abs(samples[i] - samples[i - 1]), 5000) << i;
}

TEST(EarconTest, UnknownIsTwoLowTones) {
  const auto samples = render(earconOf(at(WarningLevel::kUnknown), true), 1.0);
  EXPECT_EQ(beeps(samples), 1);
  EXPECT_NEAR(frequency(samples, 0.01, 0.11), 300.0, 15.0);
  EXPECT_NEAR(frequency(samples, 0.13, 0.23), 225.0, 15.0);
}

TEST(EarconTest, ClearTicksSoftlyEveryTwoSecondsOrIsSilent) {
  const auto ticks = render(earconOf(at(WarningLevel::kClear), true), 10.0);
  EXPECT_EQ(beeps(ticks), 5);
  EXPECT_LT(loudest(ticks), 0.2);
  EXPECT_EQ(loudest(render(earconOf(at(WarningLevel::kClear), false), 10.0)), 0.0);
}

TEST(EarconTest, WhatIsAcknowledgedIsQuieter) {
  const double loud = loudest(render(earconOf(at(WarningLevel::kConsidered, 0.5), true), 1.0));
  const double quiet = loudest(render(earconOf(at(WarningLevel::kConsidered, 0.5, true), true), 1.0));
  EXPECT_NEAR(quiet, 0.25 * loud, 0.01);
  EXPECT_GT(quiet, 0.0);
}

TEST(HeldEarconTest, IsATwoToneWarbleWithoutAGap) {
  const auto samples = render(heldEarcon(1.0), 3.0);
  EXPECT_EQ(beeps(samples), 1);
  EXPECT_NEAR(frequency(samples, 0.1, 0.15), 480.0, 25.0);
  EXPECT_NEAR(frequency(samples, 0.15, 0.2), 640.0, 25.0);
  EXPECT_NEAR(frequency(samples, 0.1, 2.9), 560.0, 2.0);
}

TEST(HeldEarconTest, IsTheLouderTheMoreIsHeldBack) {
  EXPECT_EQ(loudest(render(heldEarcon(0.0), 1.0)), 0.0);
  double before = 0.1;
  for (const double share : {0.01, 0.3, 0.6, 1.0}) {
    const double loud = loudest(render(heldEarcon(share), 1.0));
    EXPECT_GT(loud, before + 1e-3) << share;
    before = loud;
  }
  EXPECT_NEAR(before, 0.5, 0.01);
}

// One that was begun anew every 10 ms would never come to its second tone.
TEST(HeldEarconTest, WarblesOnWhileItsLoudnessChanges) {
  Synthesizer synthesizer(kRate);
  std::vector<std::int16_t> samples;
  for (int i = 0; i < 200; ++i) synthesizer.render(Earcon(), kRate / 100, samples, heldEarcon(0.5 + 0.002 * i));
  EXPECT_NEAR(frequency(samples, 0.1, 1.9), 560.0, 5.0);
}

std::vector<std::int16_t> renderBoth(const Earcon& warning, const Earcon& held, double seconds) {
  std::vector<std::int16_t> samples;
  Synthesizer(kRate).render(warning, static_cast<size_t>(seconds * kRate), samples, held);
  return samples;
}

// Whether two sounds are the same from one time to another.
bool same(const std::vector<std::int16_t>& a, const std::vector<std::int16_t>& b, double begin, double end) {
  const auto at = [](const auto& samples, double time) { return samples.begin() + std::lround(time * kRate); };
  return std::equal(at(a, begin), at(a, end), at(b, begin));
}

// Up to the 5 ms in which a sound begins or fades.
TEST(HeldEarconTest, LeavesTheLoudestWarningsAsTheyAreAndFillsTheirGaps) {
  const Earcon contact = earconOf(at(WarningLevel::kContact), true);
  EXPECT_TRUE(same(renderBoth(contact, heldEarcon(1.0), 1.0), render(contact, 1.0), 0.006, 1.0));
  const Earcon reflex = earconOf(at(WarningLevel::kReflex), true);
  const auto alone = render(reflex, 1.0);
  const auto both = renderBoth(reflex, heldEarcon(1.0), 1.0);
  for (double begin = 0.0; begin < 0.95; begin += 0.1) {
    EXPECT_TRUE(same(both, alone, begin + 0.006, begin + 0.055)) << begin;
    EXPECT_FALSE(same(both, alone, begin + 0.07, begin + 0.09)) << begin;
  }
}

TEST(HeldEarconTest, IsHeardBesideEachWarningButContact) {
  for (const auto level :
       {WarningLevel::kUnknown, WarningLevel::kClear, WarningLevel::kConsidered, WarningLevel::kReflex}) {
    const Earcon warning = earconOf(at(level), false);
    const auto alone = render(warning, 1.0);
    const auto both = renderBoth(warning, heldEarcon(1.0), 1.0);
    std::vector<std::int16_t> rest(alone.size());
    for (size_t i = 0; i < alone.size(); ++i) rest[i] = static_cast<std::int16_t>(both[i] - alone[i]);
    EXPECT_GT(loudest(rest), 0.4) << styleOf(level).name;
    EXPECT_LE(loudest(both), 1.0) << styleOf(level).name;
  }
}

// Silence must not mean anything but a clear level that is told not to tick.
TEST(EarconTest, EveryOtherLevelSounds) {
  for (const auto level :
       {WarningLevel::kUnknown, WarningLevel::kConsidered, WarningLevel::kReflex, WarningLevel::kContact}) {
    for (const bool acknowledged : {false, true}) {
      EXPECT_GT(loudest(render(earconOf(at(level, {}, acknowledged), false), 1.0)), 0.1) << styleOf(level).name;
    }
  }
}

// The largest step of a tone of 1 kHz at full amplitude is 0.14 of it; a click is a larger one.
TEST(SynthesizerTest, NeverClicks) {
  Synthesizer synthesizer(kRate);
  std::vector<std::int16_t> samples;
  std::uint32_t random = 1;
  for (int i = 0; i < 3000; ++i) {
    random = random * 1664525U + 1013904223U;
    MergedWarning cue = at(static_cast<WarningLevel>((random >> 16U) % 5), (random >> 8U) % 1000 / 1000.0);
    cue.acknowledged = (random >> 24U) % 2 == 0;
    const double held = std::max(0.0, (random >> 12U) % 200 / 100.0 - 1.0);  // half of the time none
    synthesizer.render(earconOf(cue, true), (random >> 20U) % 1500, samples, heldEarcon(held));
  }
  int largest = 0;
  for (size_t i = 1; i < samples.size(); ++i) largest = std::max(largest, std::abs(samples[i] - samples[i - 1]));
  EXPECT_LT(largest, 0.25 * 32767);
  EXPECT_GT(largest, 0.1 * 32767);
}

TEST(SynthesizerTest, BeepsThatComeFasterAreNotBegunAnew) {
  Synthesizer synthesizer(kRate);
  std::vector<std::int16_t> samples;
  for (int i = 0; i < 50; ++i) synthesizer.render(earconOf(considered(1.0 - 0.01 * i), true), kRate / 50, samples);
  EXPECT_GE(beeps(samples), 2);
  EXPECT_LE(beeps(samples), 4);
}

TEST(SynthesizerTest, AnotherLevelIsHeardAtOnce) {
  Synthesizer synthesizer(kRate);
  std::vector<std::int16_t> samples;
  synthesizer.render(earconOf(at(WarningLevel::kClear), false), kRate, samples);
  samples.clear();
  synthesizer.render(earconOf(at(WarningLevel::kContact), false), kRate / 50, samples);
  EXPECT_GT(loudest(samples), 0.9);
}

TEST(WavFileTest, HasTheHeaderAndTheBytesOfItsSamples) {
  const std::string bytes = wavFile({1, -2, 256}, kRate);
  ASSERT_EQ(bytes.size(), 44U + 6U);
  EXPECT_EQ(bytes.substr(0, 4), "RIFF");
  EXPECT_EQ(bytes.substr(8, 8), "WAVEfmt ");
  EXPECT_EQ(bytes.substr(24, 4), std::string("\x44\xAC\0\0", 4));  // 44100
  EXPECT_EQ(bytes.substr(40, 4), std::string("\6\0\0\0", 4));
  EXPECT_EQ(bytes.substr(44), std::string("\1\0\xFE\xFF\0\1", 6));
}

}  // namespace
}  // namespace sweep_guard_core
