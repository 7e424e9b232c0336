// Random episodes of a simulated hand that presses a device into planes, and turns it by choice, with delays of 0 to 50 ms and
// losses. The energy is counted at the device, apart from the controller.
#include "haptics/episode.h"

#include <gtest/gtest.h>

#include <iostream>

#include "motion/random_scenes.h"

namespace sweep_guard_core {
namespace {

constexpr Place kPlaces[] = {Place::kAtTheDevice, Place::kByTheTool, Place::kFarAway};

struct Count {
  std::uint64_t active = 0;
  double largest = 0.0;  // energy / tolerance
  double mean = 0.0;     // of the same
  double impulse = 0.0;  // [N s] or [N m s]

  void add(const EpisodeEnergy& energy, std::uint64_t episodes) {
    const double share = energy.given / energy.tolerance;
    active += share > 1.0 + 1e-9 ? 1 : 0;
    largest = std::max(largest, share);
    mean += share / static_cast<double>(episodes);
    impulse += energy.impulse;
  }
};

// Counts the axes of translation where the hand does not turn, and else those of rotation.
Count runEpisodes(std::uint64_t episodes, EpisodeOptions options, std::optional<Place> place = {}) {
  Count count;
  for (std::uint64_t i = 0; i < episodes; ++i) {
    options.seed = i;
    options.place = place.value_or(kPlaces[i % 3]);
    const EpisodeResult result = runEpisode(options);
    count.add(options.turns ? result.rotation : result.translation, episodes);
    const EpisodeEnergy& other = options.turns ? result.translation : result.rotation;
    EXPECT_TRUE(!options.controlled || other.given <= (1.0 + 1e-9) * other.tolerance) << other.given;
  }
  return count;
}

Count runEpisodes(std::uint64_t episodes, bool controlled, bool bounded, std::optional<Place> place = {}) {
  EpisodeOptions options;
  options.controlled = controlled;
  options.bounded = bounded;
  return runEpisodes(episodes, options, place);
}

Count runTurningEpisodes(std::uint64_t episodes, bool controlled, std::optional<Place> place = {}) {
  EpisodeOptions options;
  options.controlled = controlled;
  options.turns = true;
  return runEpisodes(episodes, options, place);
}

TEST(EpisodeTest, EachOfAThousandRandomEpisodesIsPassive) {
  const Count count = runEpisodes(caseCount(1000), /*controlled=*/true, /*bounded=*/true);
  EXPECT_EQ(count.active, 0U);
  EXPECT_LE(count.largest, 1.0 + 1e-9);
  EXPECT_GT(count.impulse, 0.0);
  std::cout << "largest energy / tolerance: " << count.largest << "\n";
}

TEST(EpisodeTest, TheControllerAloneKeepsThemPassiveWithAnyStiffness) {
  EXPECT_EQ(runEpisodes(caseCount(300), /*controlled=*/true, /*bounded=*/false).active, 0U);
}

TEST(EpisodeTest, WithoutTheControllerEpisodesAreActive) {
  const std::uint64_t episodes = 300;
  const Count neither = runEpisodes(episodes, /*controlled=*/false, /*bounded=*/false);
  EXPECT_GT(neither.active, episodes / 2);
  const Count bounded = runEpisodes(episodes, /*controlled=*/false, /*bounded=*/true);
  EXPECT_GT(bounded.active, episodes / 2)
      << "the bound counts on the damping of the device, which is no part of this energy";
  EXPECT_LT(bounded.mean, neither.mean) << "the bound helps";
  std::cout << "active of " << episodes << ": " << neither.active << ", with the bound alone " << bounded.active
            << "; mean energy / tolerance " << neither.mean << " and " << bounded.mean << "\n";
}

TEST(EpisodeTest, EachOfAThousandEpisodesWithTurnsAndTorquesIsPassiveAboutEachAxis) {
  const Count count = runTurningEpisodes(caseCount(1000), /*controlled=*/true);
  EXPECT_EQ(count.active, 0U);
  EXPECT_LE(count.largest, 1.0 + 1e-9);
  EXPECT_GT(count.impulse, 0.0);
  std::cout << "largest energy / tolerance: " << count.largest << "\n";
}

TEST(EpisodeTest, WithoutTheControllerEpisodesWithTurnsAreActive) {
  const std::uint64_t episodes = 100;
  const Count count = runTurningEpisodes(episodes, /*controlled=*/false);
  EXPECT_GT(count.active, episodes / 2);
  std::cout << "active of " << episodes << ": " << count.active << ", mean energy / tolerance " << count.mean << "\n";
}

TEST(EpisodeTest, AtTheDeviceTheControllerLeavesMostOfTheTorque) {
  for (const Place place : kPlaces) {
    const double controlled = runTurningEpisodes(50, /*controlled=*/true, place).impulse;
    const double free = runTurningEpisodes(50, /*controlled=*/false, place).impulse;
    if (place == Place::kAtTheDevice) {
      EXPECT_GT(controlled, 0.7 * free);
    }
    std::cout << "impulse of the torque in 50 episodes: " << controlled << " N m s of " << free << "\n";
  }
}

// A controller that is too strict would be passive and useless.
TEST(EpisodeTest, AtTheDeviceTheControllerLeavesMostOfTheForce) {
  const Count controlled = runEpisodes(100, true, true, Place::kAtTheDevice);
  const Count free = runEpisodes(100, false, true, Place::kAtTheDevice);
  EXPECT_GT(controlled.impulse, 0.8 * free.impulse);
  EXPECT_GT(free.impulse, 5.0);
  for (const Place place : kPlaces) {
    std::cout << "impulse in 100 episodes: " << runEpisodes(100, true, true, place).impulse << " N s of "
              << runEpisodes(100, false, true, place).impulse << "\n";
  }
}

}  // namespace
}  // namespace sweep_guard_core
