#include "sweep_guard/guard/verdict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <tuple>

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
  evidence.covered_until = kNow.stamp + 1s;
  return evidence;
}

Verdict assessNow(const Evidence& evidence) { return assess(evidence, kNow, kLimits); }

// Told by a prediction from a pose of 10 ms ago, that reaches 1.1 s beyond it.
Evidence::Expectation expectedIn(Duration time) {
  return {{kNow.stamp + time, /*met=*/kNow.stamp + time, /*probability=*/0.75, "spleen", {8}}, seen(10ms), 1100ms};
}

Evidence::Alarm alarmOf(Duration ago, const std::string& mesh_id = "kidney") {
  return {{kNow.stamp, /*met=*/kNow.stamp, /*probability=*/1.0, mesh_id, {9}}, kNow.steady - ago};
}

enum class Pose { kNone, kFresh, kStale };
enum class Object { kNone, kFresh, kStale, kUnswept };
enum class Contact { kNone, kLasting, kHeld, kOver };
enum class Prediction { kNone, kTooShort, kCovering };
enum class Expected { kNone, kReflex, kConsidered, kBeyond, kOver };
enum class Alarm { kNone, kReflexHeld, kConsideredHeld, kOver };

struct Row {
  Pose pose;
  Object object;
  bool fault;
  Contact contact;
  Prediction prediction;
  Expected expected;
  Alarm alarm;
};

std::vector<Row> allRows() {
  std::vector<Row> rows;
  for (int i = 0; i < 3 * 4 * 2 * 4 * 3 * 5 * 4; ++i) {
    int rest = i;
    const auto digit = [&](int base) {
      const int value = rest % base;
      rest /= base;
      return value;
    };
    const auto pose = static_cast<Pose>(digit(3));
    const auto workpiece = static_cast<Object>(digit(4));
    const bool fault = digit(2) == 1;
    const auto contact = static_cast<Contact>(digit(4));
    const auto prediction = static_cast<Prediction>(digit(3));
    const auto expected = static_cast<Expected>(digit(5));
    rows.push_back({pose, workpiece, fault, contact, prediction, expected, static_cast<Alarm>(digit(4))});
  }
  return rows;
}

Evidence evidenceOf(const Row& row) {
  Evidence evidence;
  if (row.pose != Pose::kNone) evidence.pose = seen(row.pose == Pose::kFresh ? 10ms : 101ms);
  if (row.object != Object::kNone) {
    evidence.objects = {object(row.object == Object::kStale ? 501ms : 20ms, row.object != Object::kUnswept)};
  }
  if (row.fault) evidence.faults[kDetectorFault] = "no canary";
  if (row.contact != Contact::kNone) {
    const SteadyTime found = kNow.steady - (row.contact == Contact::kHeld ? 150ms : 201ms);
    evidence.contact = {"liver", {3, 4}, found, /*lasting=*/row.contact == Contact::kLasting};
  }
  if (row.prediction == Prediction::kTooShort) evidence.covered_until = kNow.stamp + 999ms;
  if (row.prediction == Prediction::kCovering) evidence.covered_until = kNow.stamp + 1100ms;
  if (row.expected == Expected::kReflex) evidence.expected = expectedIn(50ms);
  if (row.expected == Expected::kConsidered) evidence.expected = expectedIn(500ms);
  if (row.expected == Expected::kBeyond) evidence.expected = expectedIn(1050ms);
  if (row.expected == Expected::kOver) {
    evidence.expected = expectedIn(50ms);
    evidence.expected->pose = seen(1100ms + 201ms);
  }
  if (row.alarm == Alarm::kReflexHeld) evidence.reflex = alarmOf(150ms);
  if (row.alarm == Alarm::kConsideredHeld) evidence.considered = alarmOf(150ms);
  if (row.alarm == Alarm::kOver) evidence.reflex = evidence.considered = alarmOf(201ms);
  return evidence;
}

std::uint32_t reasonsOf(const Row& row) {
  std::uint32_t reasons = row.fault ? kDetectorFault : 0U;
  if (row.pose == Pose::kNone) reasons |= kNoPose;
  if (row.pose == Pose::kStale) reasons |= kPoseStale;
  if (row.object == Object::kNone) reasons |= kNoMesh;
  if (row.object == Object::kStale) reasons |= kMeshStale;
  if (row.object == Object::kUnswept && row.pose != Pose::kNone) reasons |= kNotSwept;
  const bool something_to_cover = row.pose == Pose::kFresh && row.object != Object::kNone;
  if (something_to_cover && row.prediction != Prediction::kCovering) reasons |= kNotCovered;
  return reasons;
}

// What stands first in this list is the level.
Level levelOf(const Row& row) {
  const std::pair<bool, Level> precedence[] = {
      {row.contact == Contact::kLasting || row.contact == Contact::kHeld, Level::kContact},
      {row.expected == Expected::kReflex || row.alarm == Alarm::kReflexHeld, Level::kReflex},
      {row.expected == Expected::kConsidered || row.alarm == Alarm::kConsideredHeld, Level::kConsidered},
      {reasonsOf(row) != 0, Level::kUnknown},
      {true, Level::kClear},
  };
  for (const auto& [holds, level] : precedence) {
    if (holds) return level;
  }
  return Level::kUnknown;
}

std::string meshOf(const Row& row) {
  switch (levelOf(row)) {
    case Level::kContact:
      return "liver";
    case Level::kReflex:
      return row.expected == Expected::kReflex ? "spleen" : "kidney";
    case Level::kConsidered:
      return row.expected == Expected::kConsidered ? "spleen" : "kidney";
    default:
      return "";
  }
}

// The alarm held is stronger than what is expected now, and of another workpiece.
bool heldForAnother(const Row& row) {
  if (row.alarm == Alarm::kReflexHeld) return row.expected != Expected::kReflex;
  return row.alarm == Alarm::kConsideredHeld && row.expected == Expected::kBeyond;
}

TEST(VerdictTest, FollowsItsTruthTable) {
  for (const Row& row : allRows()) {
    const Evidence evidence = evidenceOf(row);
    const Verdict verdict = assessNow(evidence);
    SCOPED_TRACE(verdict.text);
    EXPECT_EQ(verdict.reasons, reasonsOf(row));
    EXPECT_EQ(verdict.level, levelOf(row));
    EXPECT_EQ(verdict.mesh_id, meshOf(row));
    EXPECT_EQ(verdict.triangles.empty(), meshOf(row).empty());
    const bool expected = row.expected != Expected::kNone && row.expected != Expected::kOver && !heldForAnother(row);
    EXPECT_EQ(verdict.time_to_collision.has_value(), expected);
    EXPECT_EQ(verdict.probability, expected ? 0.75 : 0.0);
    EXPECT_EQ(verdict.pose_stamp, evidence.pose ? evidence.pose->stamp : Time{});
    EXPECT_EQ(verdict.covered_until, evidence.covered_until);
    EXPECT_EQ(verdict.text.find(nameOf(verdict.level)), 0U);
  }
}

Level levelWhen(Duration collision_in) {
  Evidence evidence = allGood();
  evidence.expected = expectedIn(collision_in);
  return assessNow(evidence).level;
}

TEST(VerdictTest, TellsTheTimeAndProbabilityOfTheCollisionThatItNames) {
  Evidence evidence = allGood();
  evidence.expected = expectedIn(500ms);
  evidence.reflex = alarmOf(150ms, "kidney");
  const Verdict another = assessNow(evidence);
  EXPECT_EQ(another.text, "REFLEX: collision with 'kidney' was expected");
  EXPECT_FALSE(another.time_to_collision);
  EXPECT_EQ(another.probability, 0.0);
  evidence.reflex = alarmOf(150ms, "spleen");
  const Verdict same = assessNow(evidence);
  EXPECT_EQ(same.text, "REFLEX: collision with 'spleen' expected in 0.50 s");
  EXPECT_EQ(same.time_to_collision, 500ms);
  EXPECT_EQ(same.probability, 0.75);
}

TEST(VerdictTest, NamesThePartOfTheToolThatItWarnsOf) {
  Evidence evidence = allGood();
  evidence.expected = expectedIn(500ms);
  evidence.expected->contact.tool_part = 1;
  EXPECT_EQ(assessNow(evidence).tool_part, 1U);
  evidence.reflex = alarmOf(150ms);
  evidence.reflex->contact.tool_part = 2;
  EXPECT_EQ(assessNow(evidence).tool_part, 2U);
  evidence.contact = {"liver", {7}, kNow.steady, /*lasting=*/true, /*inside=*/false, /*tool_part=*/3};
  EXPECT_EQ(assessNow(evidence).tool_part, 3U);
  evidence.contact->tool_part.reset();  // that of another object would be wrong
  EXPECT_FALSE(assessNow(evidence).tool_part);
  EXPECT_FALSE(assessNow(allGood()).tool_part);
}

// The verdict is asked for again in 15 ms: what would be due by then is told now.
TEST(VerdictTest, WarnsOfWhatComesWithinAnIntervalAndATick) {
  EXPECT_EQ(levelWhen(115ms - 1ns), Level::kReflex);
  EXPECT_EQ(levelWhen(115ms), Level::kReflex);
  EXPECT_EQ(levelWhen(115ms + 1ns), Level::kConsidered);
  EXPECT_EQ(levelWhen(1015ms - 1ns), Level::kConsidered);
  EXPECT_EQ(levelWhen(1015ms), Level::kConsidered);
  EXPECT_EQ(levelWhen(1015ms + 1ns), Level::kClear);
  EXPECT_EQ(levelWhen(-3s), Level::kReflex);
}

TEST(VerdictTest, TimeToCollisionRunsDownOnEitherClockAndNotBelowZero) {
  Evidence evidence = allGood();
  evidence.expected = expectedIn(300ms);
  for (const Duration passed : {0ms, 100ms, 200ms, 300ms, 400ms}) {
    const Duration left = std::max<Duration>(300ms - passed, 0ms);
    EXPECT_EQ(assess(evidence, {kNow.stamp + passed, kNow.steady}, kLimits).time_to_collision, left);
    EXPECT_EQ(assess(evidence, {kNow.stamp, kNow.steady + passed}, kLimits).time_to_collision, left);
  }
  EXPECT_EQ(assess(evidence, {kNow.stamp + 185ms - 1ns, kNow.steady}, kLimits).level, Level::kConsidered);
  EXPECT_EQ(assess(evidence, {kNow.stamp + 185ms, kNow.steady}, kLimits).level, Level::kReflex);
}

// The operator is warned of it, but no one can say when it comes.
TEST(VerdictTest, WhatIsMerelyProbableHasNoTime) {
  Evidence evidence = allGood();
  evidence.expected = expectedIn(50ms);
  evidence.expected->contact.met.reset();
  const Verdict verdict = assessNow(evidence);
  EXPECT_EQ(verdict.level, Level::kReflex);
  EXPECT_FALSE(verdict.time_to_collision);
  EXPECT_EQ(verdict.probability, 0.75);
  EXPECT_EQ(verdict.text, "REFLEX: collision with 'spleen' 75 % probable");
}

// A prediction says nothing of what comes after its end: what it warned of is over then, and held.
TEST(VerdictTest, AnExpectationEndsWithItsPrediction) {
  for (const auto& [age, level, told] :
       {std::tuple(1100ms - 1ns, Level::kReflex, true), std::tuple(1100ms + 0ns, Level::kReflex, true),
        std::tuple(1100ms + 1ns, Level::kReflex, false), std::tuple(1300ms - 1ns, Level::kReflex, false),
        std::tuple(1300ms + 0ns, Level::kReflex, false), std::tuple(1300ms + 1ns, Level::kClear, false)}) {
    Evidence evidence = allGood();
    evidence.expected = expectedIn(-1s);
    evidence.expected->pose = seen(age);
    EXPECT_EQ(assessNow(evidence).level, level) << age.count() << " ns";
    EXPECT_EQ(assessNow(evidence).time_to_collision.has_value(), told) << age.count() << " ns";
  }
}

TEST(VerdictTest, HoldsAWarningForItsHoldTime) {
  for (const auto& [ago, held] :
       {std::pair(200ms - 1ns, true), std::pair(200ms + 0ns, true), std::pair(200ms + 1ns, false)}) {
    Evidence evidence = allGood();
    evidence.considered = alarmOf(ago);
    EXPECT_EQ(assessNow(evidence).level, held ? Level::kConsidered : Level::kClear) << ago.count() << " ns";
    evidence.reflex = alarmOf(ago);
    EXPECT_EQ(assessNow(evidence).level, held ? Level::kReflex : Level::kClear) << ago.count() << " ns";
    EXPECT_FALSE(assessNow(evidence).time_to_collision);
  }
}

TEST(VerdictTest, NeedsCoverageToTheEndOfTheConsideredInterval) {
  for (const auto& [reach, reasons] :
       {std::pair(1s - 1ns, kNotCovered), std::pair(1s + 0ns, Reason{}), std::pair(1s + 1ns, Reason{})}) {
    Evidence evidence = allGood();
    evidence.covered_until = kNow.stamp + reach;
    EXPECT_EQ(assessNow(evidence).reasons, reasons) << reach.count() << " ns";
    EXPECT_EQ(assessNow(evidence).level, reasons == 0 ? Level::kClear : Level::kUnknown);
  }
}

// Stamps whose clock has stopped: time goes on.
TEST(VerdictTest, CoverageRunsOutOnEitherClock) {
  const Evidence evidence = allGood();
  EXPECT_EQ(assess(evidence, {kNow.stamp + 1ns, kNow.steady}, kLimits).reasons, kNotCovered);
  EXPECT_EQ(assess(evidence, {kNow.stamp, kNow.steady + 1ns}, kLimits).reasons, kNotCovered);
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
  for (std::uint32_t bit = 1; bit <= kNotCovered; bit <<= 1) {
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
