#include "black_box/recording_files.h"

#include <gtest/gtest.h>

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

constexpr auto kTime = std::chrono::system_clock::time_point(1769846950s + 7ms);  // 2026-01-31 08:09:10.007 UTC

TEST(RecordingFilesTest, ANameHasDateTimeAndCause) {
  EXPECT_EQ(recordingName(kTime, RecordingCause::kContact), "black_box_20260131T080910.007Z_contact");
  EXPECT_EQ(recordingName(kTime, RecordingCause::kReflex), "black_box_20260131T080910.007Z_reflex");
  EXPECT_EQ(recordingName(kTime, RecordingCause::kSave), "black_box_20260131T080910.007Z_save");
}

TEST(RecordingFilesTest, ItsFilesAreKnownByTheirNames) {
  const std::string name = recordingName(kTime, RecordingCause::kContact);
  for (const char* const suffix : {".bag", ".yaml"}) {
    for (const char* const end : {"", ".active"}) {
      const auto file = parseRecordingFile(name + suffix + end);
      ASSERT_TRUE(file);
      EXPECT_EQ(file->recording, name);
      EXPECT_EQ(file->suffix, suffix);
      EXPECT_EQ(file->active, *end != '\0');
    }
  }
}

TEST(RecordingFilesTest, OtherNamesAreNotTakenForThem) {
  for (const char* const name :
       {"", ".bag", "session.bag", "black_box.bag", "black_box_20260131T080910.007Z_contact",
        "black_box_20260131T080910.007Z_contact.txt", "black_box_20260131T080910.007Z_contact.bag.old",
        "black_box_20260131T080910.007Z_contacts.bag", "black_box_20260131T080910.007Z_.bag",
        "black_box_2026013dT080910.007Z_contact.bag", "black_box_20260131T080910.007Z_contact copy.bag",
        "my_black_box_20260131T080910.007Z_contact.bag", "blackdbox_20260131T080910.007Z_contact.bag"}) {
    EXPECT_FALSE(parseRecordingFile(name)) << name;
  }
}

TEST(RecordingFilesTest, TheOldestAreDeletedAndAsFewAsSuffice) {
  const RecordingSizes stored = {{"c", 30}, {"a", 10}, {"b", 20}};
  EXPECT_EQ(recordingsToDelete(stored, 100, 40), std::vector<std::string>{});
  EXPECT_EQ(recordingsToDelete(stored, 100, 41), (std::vector<std::string>{"a"}));
  EXPECT_EQ(recordingsToDelete(stored, 100, 51), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(recordingsToDelete(stored, 100, 100), (std::vector<std::string>{"a", "b", "c"}));
}

TEST(RecordingFilesTest, NothingIsDeletedForARecordingThatIsLargerThanTheQuota) {
  EXPECT_EQ(recordingsToDelete({{"a", 10}}, 100, 101), std::nullopt);
}

}  // namespace
}  // namespace sweep_guard_core
