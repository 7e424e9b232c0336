#include "ros/black_box/recorder.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sweep_guard/MeshVertices.h>
#include <sweep_guard/Warning.h>
#include <unistd.h>

#include <boost/make_shared.hpp>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "raw_message.h"

namespace sweep_guard_ros {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using sweep_guard::Warning;

constexpr std::uintmax_t kMebibyte = 1U << 20U;
const RecordedTopic kWarnings{"/sweep_guard/warning", kRecordedWarning};
const RecordedTopic kVertices{"/vertices", "/mesh_vertices", KeptMessages::kEachVertices};

class RecorderTest : public ::testing::Test {
 protected:
  RecorderTest() {
    fs::remove_all(folder_);
    parameters_.guard = "/sweep_guard";
    parameters_.folder = folder_;
    parameters_.trigger.after = 0s;
    parameters_.window = 30s;
    parameters_.memory = 64 * kMebibyte;
    parameters_.quota = 64 * kMebibyte;
    parameters_.min_free = 0;
  }
  ~RecorderTest() override {
    recorder_.reset();  // it looks into the folder
    fs::remove_all(folder_);
  }

  void start() {
    recorder_.emplace(parameters_);
    recorder_->start(supervisor_);
  }

  template <typename Msg>
  void hear(const RecordedTopic& topic, const Msg& msg) {
    namespace traits = ros::message_traits;
    Raw<Msg> raw = serialized(msg);
    const auto message = boost::make_shared<topic_tools::ShapeShifter>();
    message->morph(traits::md5sum(msg), traits::datatype(msg), traits::definition(msg), "0");
    ros::serialization::IStream stream(raw.bytes.data(), static_cast<std::uint32_t>(raw.bytes.size()));
    message->read(stream);
    const auto header =
        boost::make_shared<ros::M_string>(ros::M_string{{"callerid", "/guard"}, {"topic", topic.topic}});
    recorder_->hear(topic, {message, header, ros::Time(now_)});
    newest_ = message;
    now_ += 0.01;
  }

  void hearWarning(std::uint8_t level) {
    Warning warning;
    warning.level = level;
    hear(kWarnings, warning);
  }

  // The tool touches something for the n-th time.
  void touch() {
    sweep_guard::MeshVertices vertices;
    vertices.id = "liver";
    vertices.positions.assign(3000, 0.5F);
    hear(kVertices, vertices);
    hearWarning(Warning::CLEAR);
    hearWarning(Warning::CONTACT);
  }

  Recorder::Summary awaitRecordings(std::size_t count) {
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    while (std::chrono::steady_clock::now() < deadline) {
      recorder_->tick();
      Recorder::Summary summary = recorder_->summary();
      if (summary.written + summary.failed >= count && !summary.writing) return summary;
      std::this_thread::sleep_for(1ms);  // the recorder tells nobody when a recording is whole
    }
    throw std::runtime_error("timeout: waited for " + std::to_string(count) + " recordings");
  }

  std::vector<fs::path> bags() const {
    std::vector<fs::path> bags;
    std::error_code none;
    for (const auto& file : fs::directory_iterator(folder_, none)) {
      if (file.path().extension() == ".bag") bags.push_back(file.path());
    }
    return bags;
  }

  std::uintmax_t sizeOnDisk() const {
    std::uintmax_t size = 0;
    for (const auto& file : fs::directory_iterator(folder_)) size += file.file_size();
    return size;
  }

  static std::size_t contactsIn(const fs::path& path) {
    const rosbag::Bag bag(path.string());
    std::size_t contacts = 0;
    for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
      const auto warning = message.instantiate<Warning>();
      contacts += warning && warning->level == Warning::CONTACT ? 1 : 0;
    }
    return contacts;
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("recorder_test_" + std::to_string(getpid()));
  BlackBoxParameters parameters_{};
  double now_ = 1000.0;  // [s]
  boost::weak_ptr<topic_tools::ShapeShifter> newest_;
  Supervisor supervisor_{Process::kShared};
  std::optional<Recorder> recorder_;
};

TEST_F(RecorderTest, AHundredContactsInARowAreAllRecordedAndStayWithinTheQuota) {
  parameters_.quota = 8 * kMebibyte;
  start();
  for (std::size_t i = 1; i <= 100; ++i) {
    touch();
    const Recorder::Summary summary = awaitRecordings(i);
    ASSERT_EQ(summary.written, i) << summary.problem;
    ASSERT_LE(sizeOnDisk(), parameters_.quota);
    ASSERT_EQ(contactsIn(summary.newest), i);
  }
  EXPECT_LT(bags().size(), 100U);
  EXPECT_GT(bags().size(), 1U);
}

TEST_F(RecorderTest, WhatWasWrittenTakesNoMemoryAfterwards) {
  start();
  touch();
  const boost::weak_ptr<topic_tools::ShapeShifter> written = newest_;
  awaitRecordings(1);
  EXPECT_FALSE(written.expired());
  now_ += 100.0;
  hearWarning(Warning::CONTACT);
  EXPECT_TRUE(written.expired());
}

TEST_F(RecorderTest, AContactThatGoesOnIsOneEvent) {
  start();
  touch();
  awaitRecordings(1);
  for (int i = 0; i < 10; ++i) hearWarning(Warning::CONTACT);
  recorder_->tick();
  EXPECT_FALSE(recorder_->summary().waiting);
  EXPECT_EQ(bags().size(), 1U);
}

TEST_F(RecorderTest, AnEventThatWaitsIsRecordedAtTheEnd) {
  parameters_.trigger.after = 30s;
  start();
  touch();
  recorder_->tick();
  EXPECT_TRUE(bags().empty());
  recorder_.reset();
  ASSERT_EQ(bags().size(), 1U);
  EXPECT_EQ(contactsIn(bags().front()), 1U);
}

TEST_F(RecorderTest, AnEventThatWaitsIsRecordedBeforeTheWindowBeginsAnew) {
  parameters_.trigger.after = 30s;
  start();
  touch();
  now_ -= 100.0;
  hearWarning(Warning::CLEAR);
  EXPECT_EQ(contactsIn(awaitRecordings(1).newest), 1U);
  EXPECT_EQ(recorder_->summary().messages, 1U);
}

TEST_F(RecorderTest, AnEventThatWaitsIsRecordedBeforeTheClockLeapsPastIt) {
  parameters_.trigger.after = 30s;
  start();
  touch();
  now_ += 100.0;
  hearWarning(Warning::CLEAR);
  EXPECT_EQ(contactsIn(awaitRecordings(1).newest), 1U);
  EXPECT_EQ(recorder_->summary().messages, 1U);
}

// The steady clock alone would let it wait until the contact has left the window.
TEST_F(RecorderTest, InASimulationThatRunsFastAContactIsInItsRecording) {
  parameters_.trigger.after = 5s;
  parameters_.window = 6s;
  start();
  touch();
  for (int i = 0; i < 1000; ++i) hearWarning(Warning::CLEAR);
  EXPECT_EQ(contactsIn(awaitRecordings(1).newest), 1U);
}

TEST_F(RecorderTest, AContactIsRecordedBeforeLargeMessagesReplaceIt) {
  parameters_.trigger.after = 30s;
  parameters_.memory = 2 * kMebibyte;
  start();
  touch();
  sweep_guard::MeshVertices vertices;
  vertices.positions.resize(10000);
  for (int i = 0; i < 100; ++i) hear(kVertices, vertices);
  EXPECT_EQ(contactsIn(awaitRecordings(1).newest), 1U);
}

TEST_F(RecorderTest, AMessageThatIsTooLargeIsReportedAndAllOthersStay) {
  parameters_.memory = 2 * kMebibyte;
  start();
  touch();
  const Recorder::Summary before = recorder_->summary();
  sweep_guard::MeshVertices vertices;
  vertices.positions.resize(kMebibyte / sizeof(float));
  hear(kVertices, vertices);
  EXPECT_EQ(recorder_->summary().too_large, 1U);
  EXPECT_EQ(recorder_->summary().messages, before.messages);
}

// A name takes memory as a key, too, wherever that is kept.
TEST_F(RecorderTest, LongNamesCount) {
  start();
  sweep_guard::MeshVertices vertices;
  vertices.id = std::string(kMebibyte, 'x');
  vertices.positions.resize(1);  // else it has no key
  hear(kVertices, vertices);
  EXPECT_GE(recorder_->summary().size, 3 * kMebibyte);
}

TEST_F(RecorderTest, WhatCannotBeWrittenIsReportedUntilItCan) {
  std::ofstream(folder_) << "a file where the folder should be";
  start();
  touch();
  Recorder::Summary summary = awaitRecordings(1);
  EXPECT_EQ(summary.failed, 1U);
  EXPECT_NE(summary.problem.find(folder_.string()), std::string::npos);
  EXPECT_EQ(recorder_->requestRecording(), summary.problem);
  fs::remove(folder_);
  summary = awaitRecordings(2);
  EXPECT_EQ(summary.written, 1U);
  EXPECT_EQ(summary.problem, "");
  EXPECT_EQ(recorder_->requestRecording(), "");
}

TEST_F(RecorderTest, AWarningThatCannotBeReadIsRecordedAndNoEvent) {
  start();
  hear(kWarnings, sweep_guard::MeshVertices());
  EXPECT_FALSE(recorder_->summary().waiting);
  EXPECT_EQ(recorder_->summary().messages, 1U);
}

}  // namespace
}  // namespace sweep_guard_ros
