// What comes out of the node earcon: its player hands the samples to the test.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <ros/ros.h>
#include <sensor_msgs/JoyFeedbackArray.h>
#include <signal.h>
#include <sweep_guard/MotionStatus.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <tuple>

#include "child_process.h"
#include "fake_guard.h"
#include "guard_process.h"
#include "listener.h"
#include "repeater.h"

namespace sweep_guard_ros {
namespace {

using sensor_msgs::JoyFeedback;
using sensor_msgs::JoyFeedbackArray;
using sweep_guard::MotionStatus;
using sweep_guard::Warning;

constexpr size_t kRate = 48000;
constexpr size_t kWindow = kRate / 10;
constexpr int kMaxSeconds = 20;  // of sound until a test fails

double frequency(const std::vector<std::int16_t>& samples) {
  int crossings = 0;
  for (size_t i = 1; i < samples.size(); ++i) crossings += samples[i - 1] < 0 && samples[i] >= 0 ? 1 : 0;
  return static_cast<double>(crossings) * kRate / static_cast<double>(samples.size());
}

size_t sounding(const std::vector<std::int16_t>& samples) {
  return static_cast<size_t>(std::count_if(samples.begin(), samples.end(), [](int sample) { return sample != 0; }));
}

/// Hears the samples by a pipe in a file.
class Ear {
 public:
  Ear() : path_(std::filesystem::temp_directory_path() / ("earcon_test_" + std::to_string(getpid()))) {
    std::filesystem::remove(path_);
    if (mkfifo(path_.c_str(), 0600) != 0) throw std::runtime_error("no pipe");
    end_ = open(path_.c_str(), O_RDWR | O_CLOEXEC);  // never at its end
  }
  ~Ear() {
    close(end_);
    std::filesystem::remove(path_);
  }
  Ear(const Ear&) = delete;
  Ear& operator=(const Ear&) = delete;

  std::string path() const { return path_.string(); }
  std::string player() const { return "[dd, of=" + path() + ", bs=512, status=none]"; }

  /// Hears until a tenth of a second sounds like this.
  template <typename Fits>
  void await(const std::string& what, const Fits& fits) {
    for (int window = 0; window < 10 * kMaxSeconds; ++window) {
      if (fits(next())) return;
    }
    throw std::runtime_error("does not sound like " + what);
  }

 private:
  std::vector<std::int16_t> next() {
    std::vector<std::int16_t> samples(kWindow);
    auto* const bytes = reinterpret_cast<char*>(samples.data());
    for (size_t got = 0; got < 2 * kWindow;) {
      pollfd events{end_, POLLIN, 0};
      if (poll(&events, 1, 1000 * kMaxSeconds) != 1) throw std::runtime_error("no sound");
      const ssize_t count = read(end_, bytes + got, 2 * kWindow - got);
      if (count > 0) got += static_cast<size_t>(count);
    }
    return samples;
  }

  std::filesystem::path path_;
  int end_ = -1;
};

bool isContact(const std::vector<std::int16_t>& samples) {
  return sounding(samples) > kWindow * 9 / 10 && std::abs(frequency(samples) - 1000.0) < 20.0;
}

bool isUnknown(const std::vector<std::int16_t>& samples) {
  return sounding(samples) > kWindow * 9 / 10 && frequency(samples) > 200.0 && frequency(samples) < 350.0;
}

bool isSilent(const std::vector<std::int16_t>& samples) { return sounding(samples) == 0; }

bool isHeld(const std::vector<std::int16_t>& samples) {
  return sounding(samples) > kWindow * 9 / 10 && std::abs(frequency(samples) - 560.0) < 20.0;
}

/// A motion guard that publishes its status every 20 ms, unless it is silent.
class FakeMotionGuard {
 public:
  void say(std::int8_t code, double scale) {
    code_ = code;
    scale_ = scale;
    speaks_ = true;
  }
  void fallSilent() { speaks_ = false; }

 private:
  void publish() {
    if (!speaks_) return;
    MotionStatus status;
    status.code = code_;
    status.scale = scale_;
    publisher_.publish(status);
  }

  ros::NodeHandle node_;
  ros::Publisher publisher_ = node_.advertise<MotionStatus>("/held/status", 10);
  std::atomic<std::int8_t> code_ = 0;
  std::atomic<double> scale_ = 1.0;
  std::atomic<bool> speaks_ = false;
  const Repeater repeater_{std::chrono::milliseconds(20), [this] { publish(); }};  // ends before what it publishes
};

std::function<bool(const JoyFeedbackArray&)> rumbles(float intensity, int id = 0) {
  return [=](const JoyFeedbackArray& feedback) {
    return feedback.array.size() == 1 && feedback.array[0].type == JoyFeedback::TYPE_RUMBLE &&
           feedback.array[0].id == id && std::abs(feedback.array[0].intensity - intensity) < 1e-6F;
  };
}

class EarconNodeTest : public testing::Test {
 protected:
  EarconNodeTest() { spinner_.start(); }
  ~EarconNodeTest() override { spinner_.stop(); }

  static std::vector<std::string> earcon(const std::string& player) {
    return program("earcon", {"warning:=/heard/warning", "motion_status:=/held/status", "~feedback:=/joy/set_feedback",
                              "_player:=" + player});
  }

  ros::AsyncSpinner spinner_{1};
  FakeGuard guard_{"/heard"};
  Ear ear_;
};

TEST_F(EarconNodeTest, EachLevelSoundsAndSilenceOfTheGuardSoundsAsUnknown) {
  const ChildProcess process(earcon(ear_.player()));
  guard_.setLevel(Warning::CONTACT);
  ear_.await("contact", isContact);
  guard_.setLevel(Warning::CLEAR);
  ear_.await("clear", isSilent);
  guard_.setLevel(Warning::REFLEX);
  ear_.await("reflex", [](const auto& samples) {
    const auto count = static_cast<double>(sounding(samples));
    return count > 0.4 * kWindow && count < 0.8 * kWindow;
  });
  guard_.setSilent(true);
  ear_.await("unknown", isUnknown);
  guard_.setSilent(false);
  guard_.setLevel(Warning::CONTACT);
  ear_.await("contact again", isContact);
}

TEST_F(EarconNodeTest, APlayerThatEndsIsStartedAgain) {
  guard_.setLevel(Warning::CONTACT);
  const ChildProcess process(earcon("[dd, of=" + ear_.path() + ", bs=512, count=30, iflag=fullblock, status=none]"));
  for (int window = 0; window < 4; ++window) {  // one that has ended played for 0.16 s
    ear_.await("contact", [](const auto& samples) { return sounding(samples) > 0; });
  }
}

TEST_F(EarconNodeTest, EndsSoonAndItsPlayerWithIt) {
  ChildProcess process(earcon(ear_.player()));
  guard_.setLevel(Warning::CONTACT);
  ear_.await("contact", isContact);
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(), 0) << process.output();
}

TEST_F(EarconNodeTest, AHeldRobotIsHeardUntilItsMotionGuardLetsItGoOrIsSilent) {
  FakeMotionGuard motion_guard;
  const ChildProcess process(earcon(ear_.player()));
  guard_.setLevel(Warning::CLEAR);
  ear_.await("clear without a motion guard", isSilent);
  for (int i = 0; i < 2; ++i) {
    motion_guard.say(MotionStatus::HALT_FOR_COLLISION, 0.0);
    ear_.await("a held robot", isHeld);
    i == 0 ? motion_guard.say(MotionStatus::NO_WARNING, 1.0) : motion_guard.fallSilent();
    ear_.await("a robot that is not held", isSilent);
  }
  motion_guard.say(MotionStatus::HALT_FOR_COLLISION, 0.0);
  guard_.setLevel(Warning::CONTACT);
  ear_.await("contact alone", isContact);
}

TEST_F(EarconNodeTest, RumblesTheMoreTheMoreIsHeldBackAndEndsWithZero) {
  const Listener<JoyFeedbackArray> feedback("/joy/set_feedback");
  FakeMotionGuard motion_guard;
  ChildProcess process(earcon(ear_.player()));
  const std::tuple<std::int8_t, double, float> cases[] = {{MotionStatus::DECELERATE_FOR_COLLISION, 0.75, 0.25F},
                                                          {MotionStatus::DECELERATE_FOR_COLLISION, 0.25, 0.75F},
                                                          {MotionStatus::HALT_FOR_COLLISION, 0.0, 1.0F},
                                                          {MotionStatus::NO_WARNING, 0.0, 0.0F},
                                                          {MotionStatus::INVALID, 0.0, 1.0F},
                                                          {MotionStatus::HALT_FOR_COLLISION, 1.0, 0.0F},
                                                          {MotionStatus::HALT_FOR_COLLISION, 0.0, 1.0F}};
  for (const auto& [code, scale, intensity] : cases) {
    motion_guard.say(code, scale);
    feedback.await("intensity " + std::to_string(intensity), rumbles(intensity));
  }
  for (int i = 0; i < 3; ++i) feedback.await("the same again: a driver lets it end", rumbles(1.0F));
  motion_guard.fallSilent();
  feedback.await("the end with the motion guard", rumbles(0.0F));
  motion_guard.say(MotionStatus::HALT_FOR_COLLISION, 0.0);
  feedback.await("rumble", rumbles(1.0F));
  process.signal(SIGTERM);
  feedback.await("the end with the node", rumbles(0.0F));
  EXPECT_EQ(process.wait(), 0) << process.output();
}

TEST_F(EarconNodeTest, RumblesWithTheMotorAndTheIntensityThatAreAskedFor) {
  const Listener<JoyFeedbackArray> feedback("/joy/set_feedback");
  FakeMotionGuard motion_guard;
  std::vector<std::string> command = earcon(ear_.player());
  command.insert(command.end(), {"_rumble/id:=1", "_rumble/intensity:=0.5"});
  const ChildProcess process(command);
  motion_guard.say(MotionStatus::HALT_FOR_COLLISION, 0.0);
  feedback.await("half of it", rumbles(0.5F, 1));
}

TEST_F(EarconNodeTest, SaysWhatToInstallWhereThereIsNoPlayer) {
  const Listener<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  const ChildProcess process(earcon("[no_such_player]"));
  const std::string problem = "no sound: no_such_player cannot be run: No such file or directory; install it";
  diagnostics.await(problem, [&problem](const diagnostic_msgs::DiagnosticArray& array) {
    const auto says = [&](const auto& status) { return status.message.find(problem) != std::string::npos; };
    return std::any_of(array.status.begin(), array.status.end(), says);
  });
}

}  // namespace
}  // namespace sweep_guard_ros
