#include "rviz/panel_sound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "rviz/panel_state.h"

namespace sweep_guard_rviz {
namespace {

using std::chrono::milliseconds;
using sweep_guard::Warning;

const ros::Time kStamp(1000.0);
const Instant kNow{toTime(kStamp), SteadyTime(std::chrono::hours(1))};

sweep_guard_core::SoundCue cueOf(std::uint8_t level, milliseconds age = milliseconds(10)) {
  Warning warning;
  warning.level = level;
  warning.clear = level == Warning::CLEAR;
  warning.acknowledged = level == Warning::CONSIDERED;
  warning.time_to_collision = ros::Duration(level == Warning::CONSIDERED ? 0.5 : -1.0);
  warning.valid_until = kStamp + ros::Duration(0.2);
  const ReceivedWarning received{warning, {kNow.stamp, kNow.steady - age}};
  return soundCue(received, panelState(received, kNow, "/guard/warning"));
}

std::vector<std::int16_t> readFrom(Samples& device, int count) {
  std::vector<std::int16_t> samples(static_cast<size_t>(count));
  const qint64 size = 2 * count;
  EXPECT_EQ(device.read(reinterpret_cast<char*>(samples.data()), size), size);
  return samples;
}

TEST(PanelSoundTest, TheDeviceReadsWhatThePanelShows) {
  Samples device;
  device.set(cueOf(Warning::CLEAR));
  readFrom(device, Samples::kRate);
  const auto clear = readFrom(device, Samples::kRate / 2);
  EXPECT_EQ(std::count(clear.begin(), clear.end(), 0), Samples::kRate / 2);
  device.set(cueOf(Warning::CONTACT));
  const auto contact = readFrom(device, Samples::kRate / 2);
  EXPECT_LT(std::count(contact.begin(), contact.end(), 0), Samples::kRate / 20);
}

TEST(PanelSoundTest, IsQuieterOnceAcknowledgedAndKnowsTheTime) {
  const auto cue = cueOf(Warning::CONSIDERED);
  EXPECT_TRUE(cue.acknowledged);
  ASSERT_TRUE(cue.time_to_collision);
  EXPECT_EQ(*cue.time_to_collision, milliseconds(500));
}

TEST(PanelSoundTest, ASilentGuardSoundsAsUnknown) {
  const auto cue = cueOf(Warning::CLEAR, milliseconds(500));
  EXPECT_EQ(cue.level, WarningLevel::kUnknown);
  EXPECT_FALSE(cue.time_to_collision);
}

}  // namespace
}  // namespace sweep_guard_rviz
