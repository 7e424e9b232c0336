#include "sweep_guard/haptics/passivity_controller.h"

#include <gtest/gtest.h>

#include <deque>

#include "motion/random_scenes.h"

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

const PassivityController::Options kAtTheDevice{/*max_effort=*/4.0, /*max_speed=*/0.5, /*max_acceleration=*/50.0,
                                                milliseconds(1), Duration{}};

SteadyTime at(double ms) { return SteadyTime(fromSeconds(1.0 + 1e-3 * ms)); }

TEST(PassivityControllerTest, TheEnergyIsTheSumOfTheForceBeforeTimesTheWay) {
  PassivityController axis(kAtTheDevice);
  axis.moved(0.0, at(0));
  EXPECT_EQ(axis.limit(1.0, at(0)), 1.0);
  axis.moved(-2e-4, at(1));
  EXPECT_EQ(axis.limit(2.0, at(1)), 2.0);
  axis.moved(3e-4, at(2));
  EXPECT_NEAR(axis.energy(), 1.0 * -2e-4 + 2.0 * 3e-4, 1e-15);
  EXPECT_DOUBLE_EQ(axis.tolerance(), 4.0 * 0.5 * 1e-3);
}

TEST(PassivityControllerTest, SendsNothingBeforeThePositionOfTheDeviceIsKnown) {
  PassivityController axis(kAtTheDevice);
  EXPECT_EQ(axis.limit(2.0, at(0)), 0.0);
  axis.moved(0.0, at(0));
  EXPECT_EQ(axis.limit(2.0, at(0)), 2.0);
}

// As a force that follows a hand wherever it goes.
TEST(PassivityControllerTest, AForceThatAlwaysPushesAlongRunsOutOfEnergy) {
  PassivityController axis(kAtTheDevice);
  axis.moved(0.0, at(0));
  double sent = axis.limit(4.0, at(0));
  for (int i = 1; i <= 50; ++i) {
    axis.moved(2e-4, at(i));
    sent = axis.limit(4.0, at(i));
    ASSERT_LE(axis.energy(), axis.tolerance());
  }
  EXPECT_LT(sent, 1e-4);
}

TEST(PassivityControllerTest, AnAxisWithoutEnergyRecoversWhenTheHandPushesAgainstIt) {
  PassivityController axis(kAtTheDevice);
  axis.moved(0.0, at(0));
  axis.limit(4.0, at(0));
  for (int i = 1; i <= 20; ++i) {
    axis.moved(2e-4, at(i));
    axis.limit(4.0, at(i));
  }
  double sent = 0.0;
  for (int i = 21; i <= 200; ++i) {
    axis.moved(-5e-5, at(i));
    sent = axis.limit(4.0, at(i));
  }
  EXPECT_EQ(sent, 4.0);
}

TEST(PassivityControllerTest, EnergyThatWasTakenIsForgottenWithTheContact) {
  PassivityController axis(kAtTheDevice);
  axis.moved(0.0, at(0));
  axis.limit(4.0, at(0));
  axis.moved(-5e-4, at(1));
  EXPECT_LT(axis.energy(), 0.0);
  axis.limit(0.0, at(1));
  EXPECT_EQ(axis.energy(), 0.0);
}

// The hand may have gone all its way before the force began.
TEST(PassivityControllerTest, AWayThatBeganBeforeTheForceIsNoEnergyIn) {
  PassivityController axis(kAtTheDevice);
  axis.moved(0.0, at(0));
  EXPECT_EQ(axis.limit(2.0, at(1)), 2.0);
  axis.moved(-1e-3, at(2));
  EXPECT_GE(axis.energy(), -1e-15);
}

TEST(PassivityControllerTest, WhatIsForgottenBeforeThePositionIsKnownCountsAsTheWorst) {
  PassivityController axis(kAtTheDevice);
  axis.moved(0.0, at(0));
  EXPECT_EQ(axis.limit(4.0, at(0)), 4.0);
  for (int ms = 1; ms <= 3000; ++ms) EXPECT_EQ(axis.limit(4.0, at(ms)), 0.0) << "nothing is left";
  axis.moved(5e-4, at(3000));
  EXPECT_DOUBLE_EQ(axis.energy(), axis.tolerance());
}

// A force that shrank while a position is awaited would be charged for its change, and die out at rest.
TEST(PassivityControllerTest, WithSeldomPositionsTheForceStaysWhileTheHandRests) {
  PassivityController::Options options = kAtTheDevice;
  options.output_delay = milliseconds(2);
  PassivityController axis(options);
  double sent = 0.0;
  double least = 1.0;
  for (int ms = 0; ms < 3000; ++ms) {
    if (ms % 10 == 0) axis.moved(0.0, at(ms - 1));
    sent = axis.limit(2.0, at(ms));
    if (ms > 1000) least = std::min(least, sent);
  }
  EXPECT_GT(least, 0.1);
  EXPECT_LT(sent, 1.0) << "less than of a hand that is known";
}

TEST(PassivityControllerTest, APauseBetweenPositionsIsNoReasonForALittleForce) {
  PassivityController axis(kAtTheDevice);
  double sent = 0.0;
  for (const int begin : {0, 1000}) {
    for (int ms = begin; ms < begin + 100; ++ms) {
      axis.moved(0.0, at(ms));
      sent = axis.limit(1.0, at(ms));
    }
    EXPECT_EQ(sent, 1.0);
  }
}

TEST(PassivityControllerTest, APositionNeverCostsMoreThanWasAssumedWithoutIt) {
  PassivityController axis(kAtTheDevice);
  axis.moved(0.0, at(0));
  for (int ms = 0; ms < 300; ++ms) axis.limit(ms < 20 ? 4.0 : 1e-9, at(ms));
  axis.moved(0.0, at(300));
  EXPECT_GT(axis.energy(), 0.0);
  EXPECT_LE(axis.energy(), axis.tolerance());
}

TEST(PassivityControllerTest, ASecondWithoutForceForgetsTheEnergyThatWasGiven) {
  PassivityController axis(kAtTheDevice);
  axis.moved(0.0, at(0));
  for (int ms = 0; ms < 30; ++ms) {
    axis.moved(4e-4, at(ms));
    axis.limit(4.0, at(ms));
  }
  EXPECT_GT(axis.energy(), 0.5 * axis.tolerance());
  const auto rest = [&](int ms) {
    axis.moved(0.0, at(ms));
    axis.limit(0.0, at(ms));
  };
  for (int ms = 30; ms < 1030; ++ms) rest(ms);
  EXPECT_GT(axis.energy(), 0.5 * axis.tolerance());
  rest(1030);
  EXPECT_EQ(axis.energy(), 0.0);
  EXPECT_GT(axis.limit(4.0, at(1031)), 1.0);
}

// The hand does its worst within its limits: it goes with the force that acts, and turns back at random. Positions come late
// or not at all, what is sent acts late.
double largestEnergy(RandomScenes& random, const PassivityController::Options& options, double position_delay,
                     bool passive) {
  struct Late {
    double value;
    double time;  // [ms]
  };
  PassivityController axis(options);
  std::deque<Late> positions;
  std::deque<Late> efforts;
  double position = 0.0, known = 0.0, acting = 0.0, energy = 0.0, largest = 0.0, arrived = 0.0;
  const double output_delay = 1e3 * toSeconds(options.output_delay);
  const double keeps = random.uniform(0.5, 1.0);
  double speed = 0.0;
  bool along = true;
  for (int ms = 0; ms < 400; ++ms) {
    if (!random.chance(0.2)) positions.push_back({position, static_cast<double>(ms)});
    while (!positions.empty() && positions.front().time + position_delay <= ms) {
      axis.moved(positions.front().value - known, at(positions.front().time));
      known = positions.front().value;
      positions.pop_front();
    }
    const double wanted = random.chance(0.1) ? 0.0 : random.uniform(-1.0, 1.0) * options.max_effort;
    const double sent = passive ? axis.limit(wanted, at(ms)) : wanted;
    arrived =
        std::max(arrived, ms + std::floor(10.0 * random.uniform(0.0, output_delay)) / 10.0);  // a step of the hand
    efforts.push_back({sent, arrived});
    for (int step = 0; step < 10; ++step) {
      while (!efforts.empty() && efforts.front().time <= ms + 0.1 * step) {
        acting = efforts.front().value;
        efforts.pop_front();
      }
      if (random.chance(0.05)) along = random.chance(keeps);
      speed += 1e-4 * options.max_acceleration * (along == (acting > 0.0) ? 1.0 : -1.0);
      speed = std::clamp(speed, -options.max_speed, options.max_speed);
      const double way = 1e-4 * speed;
      position += way;
      energy += acting * way;
      largest = std::max(largest, energy);
    }
  }
  return largest;
}

TEST(PassivityControllerTest, NoHandGetsMoreThanTheToleranceHoweverLateItIsKnownAndReached) {
  RandomScenes random(11);
  int active = 0;
  const std::uint64_t cases = caseCount(500);
  for (std::uint64_t i = 0; i < cases; ++i) {
    PassivityController::Options options = kAtTheDevice;
    const double position_delay = random.chance(0.3) ? 0.0 : random.uniform(0.0, 50.0);
    if (!random.chance(0.3)) options.output_delay = fromSeconds(random.uniform(0.0, 0.05));
    const double tolerance = PassivityController(options).tolerance();
    ASSERT_LE(largestEnergy(random, options, position_delay, /*passive=*/true), tolerance + 1e-12);
    active += largestEnergy(random, options, position_delay, /*passive=*/false) > tolerance ? 1 : 0;
  }
  EXPECT_GT(active, static_cast<int>(cases / 2)) << "the hand does its worst";
}

}  // namespace
}  // namespace sweep_guard_core
