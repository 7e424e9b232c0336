#include "black_box/recording_folder.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Paths = RecordingFolder::Paths;

constexpr std::uintmax_t kSize = 1000;  // of a recording [bytes]

std::string nameOfEvent(int number) {
  return recordingName(std::chrono::system_clock::time_point(1769846950s + number * 1s), RecordingCause::kContact);
}

void fill(const fs::path& file, std::uintmax_t size) {
  std::ofstream stream(file);
  stream << std::string(size, 'x') << std::flush;
  if (!stream) throw DeviceError(file.string() + ": cannot be written");
}

void writeFiles(const Paths& files) {
  fill(files.bag, kSize - 10);
  fill(files.config, 10);
}

class RecordingFolderTest : public ::testing::Test {
 protected:
  RecordingFolderTest() { fs::remove_all(folder_); }
  ~RecordingFolderTest() override { fs::remove_all(folder_); }

  RecordingFolder::Options options(std::uintmax_t quota = 10 * kSize) const {
    RecordingFolder::Options options{folder_, quota, /*min_free=*/500};
    options.free_space = [this](const fs::path&) { return free_; };
    return options;
  }

  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& file : fs::directory_iterator(folder_)) names.insert(file.path().filename());
    return names;
  }

  std::string refusal(RecordingFolder& folder, const std::function<void(const Paths&)>& write = writeFiles) const {
    try {
      folder.write(nameOfEvent(0), kSize, write);
    } catch (const DeviceError& error) {
      return error.what();
    }
    return "";
  }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / ("recording_folder_test_" + std::to_string(getpid())) / "deep";
  std::uintmax_t free_ = 1U << 20U;
};

TEST_F(RecordingFolderTest, ARecordingHasItsNameOnlyWhenItIsWhole) {
  RecordingFolder folder(options());
  const Paths paths = folder.write(nameOfEvent(0), kSize, [this](const Paths& active) {
    writeFiles(active);
    EXPECT_EQ(files(), (std::set<std::string>{nameOfEvent(0) + ".bag.active", nameOfEvent(0) + ".yaml.active"}));
  });
  EXPECT_EQ(files(), (std::set<std::string>{nameOfEvent(0) + ".bag", nameOfEvent(0) + ".yaml"}));
  EXPECT_EQ(fs::file_size(paths.bag) + fs::file_size(paths.config), kSize);
}

TEST_F(RecordingFolderTest, AHundredContactsInARowStayWithinTheQuotaAndTheNewestStay) {
  RecordingFolder folder(options(/*quota=*/7 * kSize + 1));
  for (int i = 0; i < 100; ++i) {
    folder.write(nameOfEvent(i), kSize, writeFiles);
    std::uintmax_t size = 0;
    for (const auto& file : fs::directory_iterator(folder_)) size += file.file_size();
    ASSERT_LE(size, 7 * kSize + 1);
  }
  std::set<std::string> names;
  for (const auto& [name, size] : folder.stored()) names.insert(name);
  EXPECT_EQ(names.size(), 7U);
  for (int i = 93; i < 100; ++i) EXPECT_EQ(names.count(nameOfEvent(i)), 1U);
}

TEST_F(RecordingFolderTest, ARecordingThatBecameLargerThanExpectedCountsAsLargeAsItIs) {
  RecordingFolder folder(options(/*quota=*/3 * kSize));
  for (int i = 0; i < 5; ++i) folder.write(nameOfEvent(i), /*size=*/10, writeFiles);
  EXPECT_EQ(folder.stored().size(), 3U);
}

TEST_F(RecordingFolderTest, FilesOfOthersAreNeverDeletedAndDoNotCount) {
  fs::create_directories(folder_);
  const std::set<std::string> others = {"session.bag", "black_box.bag", nameOfEvent(0) + ".bag.old", "notes"};
  for (const std::string& name : others) fill(folder_ / name, 100 * kSize);
  const fs::path precious = folder_.parent_path() / "precious.bag";
  fill(precious, kSize);
  fs::create_symlink(precious, folder_ / (nameOfEvent(1) + ".bag"));
  fs::create_directory(folder_ / (nameOfEvent(2) + ".bag.active"));
  RecordingFolder folder(options(/*quota=*/kSize));
  folder.write(nameOfEvent(50), kSize, writeFiles);
  folder.write(nameOfEvent(51), kSize, writeFiles);
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  EXPECT_TRUE(fs::exists(precious));
  EXPECT_TRUE(fs::is_symlink(folder_ / (nameOfEvent(1) + ".bag")));
  EXPECT_TRUE(fs::exists(folder_ / (nameOfEvent(2) + ".bag.active")));
  EXPECT_FALSE(fs::exists(folder_ / (nameOfEvent(50) + ".bag")));
}

TEST_F(RecordingFolderTest, WithoutFreeSpaceNothingIsWrittenOrDeletedAndTheReasonIsGiven) {
  RecordingFolder folder(options());
  folder.write(nameOfEvent(1), kSize, writeFiles);
  free_ = kSize + 499;
  EXPECT_NE(refusal(folder).find("are free"), std::string::npos);
  EXPECT_EQ(folder.stored().size(), 1U);
  free_ = kSize + 500;
  EXPECT_EQ(refusal(folder), "");
}

TEST_F(RecordingFolderTest, NoRecordingIsDeletedForOneThatWouldNotHaveRoomEvenThen) {
  RecordingFolder folder(options(/*quota=*/2 * kSize));
  folder.write(nameOfEvent(1), kSize, writeFiles);
  folder.write(nameOfEvent(2), kSize, writeFiles);
  free_ = 499;  // the oldest makes room for another kSize
  EXPECT_NE(refusal(folder).find("are free"), std::string::npos);
  EXPECT_EQ(folder.stored().size(), 2U);
  free_ = 500;
  EXPECT_EQ(refusal(folder), "");
}

TEST_F(RecordingFolderTest, ThatNothingCanBeWrittenIsKnownBeforeThereIsSomethingToWrite) {
  RecordingFolder folder(options(/*quota=*/2 * kSize));
  folder.check(2 * kSize);
  EXPECT_THROW(folder.check(2 * kSize + 1), DeviceError);
  free_ = kSize + 499;
  EXPECT_THROW(folder.check(kSize), DeviceError);
}

// The process may write no more than half of a recording: as a disk that becomes full.
TEST_F(RecordingFolderTest, ADiskThatIsFullAtOnceLeavesNothingOfTheRecordingAndAllOthers) {
  RecordingFolder folder(options());
  folder.write(nameOfEvent(1), kSize, writeFiles);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit half = before;
  half.rlim_cur = kSize / 2;
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &half), 0);
  const std::string reason = refusal(folder);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  signal(SIGXFSZ, handler);
  EXPECT_NE(reason.find("cannot be written"), std::string::npos) << reason;
  EXPECT_EQ(files(), (std::set<std::string>{nameOfEvent(1) + ".bag", nameOfEvent(1) + ".yaml"}));
  EXPECT_EQ(refusal(folder), "");
}

TEST_F(RecordingFolderTest, AFolderThatCannotBeMadeIsAnError) {
  fs::create_directories(folder_.parent_path());
  fill(folder_, 1);
  RecordingFolder folder(options());
  EXPECT_NE(refusal(folder).find(folder_.string()), std::string::npos);
  fs::remove(folder_);
  EXPECT_EQ(refusal(folder), "");
}

TEST_F(RecordingFolderTest, TwoWritersDoNotShareAFolder) {
  {
    RecordingFolder first(options());
    first.open();
    first.open();
    RecordingFolder second(options());
    EXPECT_NE(refusal(second).find("another black box"), std::string::npos);
  }
  RecordingFolder third(options());
  EXPECT_EQ(refusal(third), "");
}

// The child is killed when half of the bag is on the disk.
TEST_F(RecordingFolderTest, ABagThatWasCutByAKillIsNeverTakenForAWholeOneAndIsDeletedAtTheNextStart) {
  const pid_t child = fork();
  if (child == 0) {
    RecordingFolder folder(options());
    folder.write(nameOfEvent(0), kSize, writeFiles);
    folder.write(nameOfEvent(1), kSize, [](const Paths& active) {
      writeFiles(active);
      kill(getpid(), SIGKILL);
    });
    _exit(1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_TRUE(fs::exists(folder_ / (nameOfEvent(1) + ".bag.active")));
  EXPECT_FALSE(fs::exists(folder_ / (nameOfEvent(1) + ".bag")));
  RecordingFolder next(options());
  EXPECT_EQ(next.stored().size(), 1U);
  next.open();
  EXPECT_EQ(files(), (std::set<std::string>{nameOfEvent(0) + ".bag", nameOfEvent(0) + ".yaml"}));
}

// Somebody may be moving both elsewhere.
TEST_F(RecordingFolderTest, AConfigurationWhoseBagIsMovedAwayStaysUntilTheNextStart) {
  {
    RecordingFolder folder(options());
    fs::remove(folder.write(nameOfEvent(0), kSize, writeFiles).bag);
    folder.check(kSize);
    folder.write(nameOfEvent(1), kSize, writeFiles);
    EXPECT_EQ(files().count(nameOfEvent(0) + ".yaml"), 1U);
  }
  RecordingFolder(options()).open();
  EXPECT_EQ(files().count(nameOfEvent(0) + ".yaml"), 0U);
}

TEST_F(RecordingFolderTest, AConfigurationWithoutItsBagIsDeletedAtTheNextStart) {
  fs::create_directories(folder_);
  fill(folder_ / (nameOfEvent(0) + ".yaml"), 10);
  RecordingFolder(options()).open();
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace sweep_guard_core
