// What comes out of the node earcon: its player hands the samples to the test.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <ros/ros.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <stdexcept>

#include "child_process.h"
#include "fake_guard.h"
#include "guard_process.h"
#include "listener.h"

namespace sweep_guard_ros {
namespace {

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

class EarconNodeTest : public testing::Test {
 protected:
  EarconNodeTest() { spinner_.start(); }
  ~EarconNodeTest() override { spinner_.stop(); }

  static std::vector<std::string> earcon(const std::string& player) {
    return program("earcon", {"warning:=/heard/warning", "_player:=" + player});
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
  ear_.await("clear", [](const auto& samples) { return sounding(samples) == 0; });
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
