#include "sweep_guard/guard/verdict.h"

#include <gtest/gtest.h>

#include <array>

namespace sweep_guard {
namespace {

using namespace std::chrono_literals;

const Instant kNow{Time(1000s), SteadyTime(50s)};
const VerdictLimits kLimits{/*pose_timeout=*/100ms, /*mesh_timeout=*/500ms, /*hold_time=*/200ms};

// Made and received so long ago.
Seen seen(Duration age) { return {kNow.stamp - age, kNow.steady - age}; }

Evidence::Object object(Duration age, bool swept = true) { return {"liver", seen(age), swept}; }

Evidence allGood() {
  Evidence evidence;
  evidence.pose = seen(10ms);
  evidence.objects = {object(20ms)};
  return evidence;
}

Verdict assessNow(const Evidence& evidence) { return assess(evidence, kNow, kLimits); }

enum class Pose { kNone, kFresh, kStale };
enum class Object { kNone, kFresh, kStale, kUnswept };
enum class Contact { kNone, kLasting, kHeld, kExpired };

// What is wrong is listed whatever the level; the level is contact before unknown before clear.
TEST(VerdictTest, FollowsItsTruthTable) {
  for (const Pose pose : {Pose::kNone, Pose::kFresh, Pose::kStale}) {
    for (const Object workpiece : {Object::kNone, Object::kFresh, Object::kStale, Object::kUnswept}) {
      for (const bool fault : {false, true}) {
        for (const Contact contact : {Contact::kNone, Contact::kLasting, Contact::kHeld, Contact::kExpired}) {
          Evidence evidence;
          std::uint32_t reasons = 0;
          if (pose != Pose::kNone) evidence.pose = seen(pose == Pose::kFresh ? 10ms : 101ms);
          if (pose == Pose::kNone) reasons |= kNoPose;
          if (pose == Pose::kStale) reasons |= kPoseStale;
          if (workpiece != Object::kNone) {
            evidence.objects = {object(workpiece == Object::kStale ? 501ms : 20ms, workpiece != Object::kUnswept)};
          }
          if (workpiece == Object::kNone) reasons |= kNoMesh;
          if (workpiece == Object::kStale) reasons |= kMeshStale;
          if (workpiece == Object::kUnswept && pose != Pose::kNone) reasons |= kNotSwept;
          if (fault) {
            evidence.faults[kDetectorFault] = "no canary";
            reasons |= kDetectorFault;
          }
          if (contact != Contact::kNone) {
            const SteadyTime found = kNow.steady - (contact == Contact::kHeld ? 150ms : 201ms);
            evidence.contact = {"liver", {3, 4}, found, /*lasting=*/contact == Contact::kLasting};
          }
          const bool held = contact == Contact::kHeld || contact == Contact::kLasting;

          const Verdict verdict = assessNow(evidence);
          SCOPED_TRACE(verdict.text);
          EXPECT_EQ(verdict.reasons, reasons);
          EXPECT_EQ(verdict.level, held ? Level::kContact : reasons != 0 ? Level::kUnknown : Level::kClear);
          EXPECT_EQ(verdict.triangles, held ? (std::vector<std::uint32_t>{3, 4}) : std::vector<std::uint32_t>{});
          EXPECT_EQ(verdict.mesh_id, held ? "liver" : "");
          EXPECT_EQ(verdict.pose_stamp, evidence.pose ? evidence.pose->stamp : Time{});
          EXPECT_EQ(verdict.text.find(nameOf(verdict.level)), 0U);
        }
      }
    }
  }
}

TEST(VerdictTest, IsUnknownWithoutAnyEvidence) {
  const Verdict verdict = assessNow({});
  EXPECT_EQ(verdict.level, Level::kUnknown);
  EXPECT_EQ(verdict.reasons, kNoPose | kNoMesh);
  EXPECT_EQ(Verdict{}.level, Level::kUnknown);
}

TEST(VerdictTest, IsClearWhereEverythingIsFreshAndSwept) {
  const Verdict verdict = assessNow(allGood());
  EXPECT_EQ(verdict.level, Level::kClear);
  EXPECT_EQ(verdict.text, "CLEAR");
}

TEST(VerdictTest, TakesAPoseForStaleJustPastItsTimeout) {
  for (const auto& [age, level] : {std::pair(100ms - 1ns, Level::kClear), std::pair(100ms + 0ns, Level::kClear),
                                   std::pair(100ms + 1ns, Level::kUnknown)}) {
    Evidence evidence = allGood();
    evidence.pose = seen(age);
    EXPECT_EQ(assessNow(evidence).level, level) << age.count() << " ns";
  }
}

TEST(VerdictTest, TakesAWorkpieceForStaleJustPastItsTimeout) {
  for (const auto& [age, level] : {std::pair(500ms - 1ns, Level::kClear), std::pair(500ms + 0ns, Level::kClear),
                                   std::pair(500ms + 1ns, Level::kUnknown)}) {
    Evidence evidence = allGood();
    evidence.objects = {object(age)};
    EXPECT_EQ(assessNow(evidence).level, level) << age.count() << " ns";
  }
}

TEST(VerdictTest, HoldsAContactForItsHoldTime) {
  for (const auto& [age, level] : {std::pair(200ms - 1ns, Level::kContact), std::pair(200ms + 0ns, Level::kContact),
                                   std::pair(200ms + 1ns, Level::kClear)}) {
    Evidence evidence = allGood();
    evidence.contact = {"liver", {7}, kNow.steady - age};
    EXPECT_EQ(assessNow(evidence).level, level) << age.count() << " ns";
  }
}

// A stamp cannot look fresh because its clock stopped, nor because the message came late.
TEST(VerdictTest, TakesAnAgeOnEitherClock) {
  const Seen old_stamp{kNow.stamp - 1s, kNow.steady};
  const Seen received_long_ago{kNow.stamp, kNow.steady - 1s};
  for (const Seen& old : {old_stamp, received_long_ago}) {
    Evidence pose = allGood();
    pose.pose = old;
    EXPECT_EQ(assessNow(pose).reasons, kPoseStale);
    Evidence workpiece = allGood();
    workpiece.objects[0].seen = old;
    EXPECT_EQ(assessNow(workpiece).reasons, kMeshStale);
  }
}

TEST(VerdictTest, NeverTakesAStaticWorkpieceForStale) {
  VerdictLimits limits = kLimits;
  limits.mesh_timeout = Duration::max();
  Evidence evidence = allGood();
  evidence.objects = {{"fixture", {Time(1s), SteadyTime(1s)}, /*swept=*/true}};
  EXPECT_EQ(assess(evidence, kNow, limits).level, Level::kClear);
}

TEST(VerdictTest, IsUnknownIfAnyOfSeveralWorkpiecesIsStaleOrUnswept) {
  Evidence evidence = allGood();
  evidence.objects.push_back(object(501ms));
  EXPECT_EQ(assessNow(evidence).reasons, kMeshStale);
  evidence.objects.back() = object(20ms, /*swept=*/false);
  EXPECT_EQ(assessNow(evidence).reasons, kNotSwept);
}

TEST(VerdictTest, TellsEveryReasonInItsText) {
  Evidence evidence;
  evidence.objects = {object(2s)};
  evidence.faults = {{kTfFail, "frame 'tool' is unknown"}, {kDetectorFault, "no canary"}};
  evidence.contact = {"liver", {7}, kNow.steady};
  const Verdict verdict = assessNow(evidence);
  EXPECT_EQ(verdict.reasons, kNoPose | kMeshStale | kTfFail | kDetectorFault);
  for (const char* part : {"CONTACT", "'liver'", "pose", "2.00 s", "frame 'tool' is unknown", "no canary"}) {
    EXPECT_NE(verdict.text.find(part), std::string::npos) << part << " is not in: " << verdict.text;
  }
}

TEST(VerdictTest, EveryFaultMakesItUnknownUnderItsOwnBit) {
  for (std::uint32_t bit = 1; bit <= kNotSwept; bit <<= 1) {
    Evidence evidence = allGood();
    evidence.faults[static_cast<Reason>(bit)] = "story";
    EXPECT_EQ(assessNow(evidence).level, Level::kUnknown);
    EXPECT_EQ(assessNow(evidence).reasons, bit);
  }
}

// Numbers on the wire, in Warning.msg.
TEST(VerdictTest, LevelsHaveTheNumbersAndNamesOfTheMessage) {
  constexpr std::array<const char*, 5> kNames = {"UNKNOWN", "CLEAR", "CONSIDERED", "REFLEX", "CONTACT"};
  for (size_t i = 0; i < kNames.size(); ++i) EXPECT_STREQ(nameOf(static_cast<Level>(i)), kNames[i]);
}

// The hold time is how long a contact is shown after the tool has left, not how long it may last.
TEST(VerdictTest, AContactThatLastsIsShownWhateverTheHoldTime) {
  Evidence evidence;
  evidence.contact = {"liver", {7}, kNow.steady - 1h, /*lasting=*/true};
  EXPECT_EQ(assess(evidence, kNow, {100ms, 500ms, /*hold_time=*/0ms}).level, Level::kContact);
  evidence.contact->lasting = false;
  EXPECT_EQ(assess(evidence, kNow, {100ms, 500ms, /*hold_time=*/0ms}).level, Level::kUnknown);
}

}  // namespace
}  // namespace sweep_guard
