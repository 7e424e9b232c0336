#include "sweep_guard/monitor/warning.h"
#include "monitor/warnings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "refusal.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

const Instant kNow{Time(1000s), SteadyTime(50s)};
const WarningLimits kShortLimits{/*pose_timeout=*/100ms, /*mesh_timeout=*/500ms, /*hold_time=*/200ms};

// Made and received so long ago.
Timestamps aged(Duration age) { return {kNow.stamp - age, kNow.steady - age}; }

WarningInputs::Object object(Duration age, bool swept = true) { return {"liver", aged(age), swept}; }

WarningInputs allGood() {
  WarningInputs inputs;
  inputs.pose = aged(10ms);
  inputs.objects = {object(20ms)};
  inputs.covered_until = kNow.stamp + 1s;
  return inputs;
}

Warning warningNow(const WarningInputs& inputs) { return warningOf(inputs, kNow, kShortLimits); }

// From a prediction that began at a pose 10 ms ago and lasts 1.1 s.
PredictedContact predictedIn(Duration time) {
  const Time start = kNow.stamp + time;
  return {start,
          start,
          /*contact=*/start,
          /*reflex_probability=*/0.5,
          /*considered_probability=*/0.75,
          "spleen",
          {8},
          {},
          aged(10ms),
          1100ms};
}

WarningInputs::Alarm alarmOf(Duration ago, const std::string& mesh_id = "kidney") {
  return {{kNow.stamp, kNow.stamp, /*contact=*/kNow.stamp, 1.0, 1.0, mesh_id, {9}}, kNow.steady - ago};
}

WarningInputs::WorkpieceWarning& entryOf(const std::string& id, WarningInputs& inputs) {
  for (WarningInputs::WorkpieceWarning& warning : inputs.warnings) {
    if (warning.id == id) return warning;
  }
  return inputs.warnings.emplace_back(WarningInputs::WorkpieceWarning{id});
}

PredictedContact& predict(Duration time, WarningInputs& inputs) {
  return entryOf("spleen", inputs).predicted.emplace(predictedIn(time));
}

const std::map<std::string, std::vector<std::uint32_t>> kTriangles = {
    {"", {}}, {"liver", {3, 4}}, {"spleen", {8}}, {"kidney", {9}}};

enum class Pose { kNone, kFresh, kStale };
enum class Object { kNone, kFresh, kStale, kUnswept };
enum class Contact { kNone, kLasting, kHeld, kOver };
enum class Predicted { kNone, kReflex, kConsidered, kBeyond, kOver };
enum class Alarm { kNone, kReflexHeld, kConsideredHeld, kOver };

void setContact(Contact contact, WarningInputs& inputs) {
  if (contact == Contact::kNone) return;
  const SteadyTime found = kNow.steady - (contact == Contact::kHeld ? 150ms : 201ms);
  inputs.contact = {"liver", {3, 4}, found, /*lasting=*/contact == Contact::kLasting};
}

void setPredicted(Predicted predicted, WarningInputs& inputs) {
  if (predicted == Predicted::kReflex) predict(50ms, inputs);
  if (predicted == Predicted::kConsidered) predict(500ms, inputs);
  if (predicted == Predicted::kBeyond) predict(1050ms, inputs);
  if (predicted != Predicted::kOver) return;
  predict(50ms, inputs);
  entryOf("spleen", inputs).predicted->pose = aged(1100ms + 201ms);
}

TEST(WarningTest, NamesWhatIsMissing) {
  struct Row {
    Pose pose;
    Object object;
    std::uint32_t covered;      // the reasons if the prediction covers the considered interval
    std::uint32_t not_covered;  // and if it does not
  };
  const Row rows[] = {
      {Pose::kNone, Object::kNone, kNoPose | kNoMesh, kNoPose | kNoMesh},
      {Pose::kNone, Object::kFresh, kNoPose, kNoPose},
      {Pose::kNone, Object::kStale, kNoPose | kMeshStale, kNoPose | kMeshStale},
      {Pose::kNone, Object::kUnswept, kNoPose, kNoPose},
      {Pose::kFresh, Object::kNone, kNoMesh, kNoMesh},
      {Pose::kFresh, Object::kFresh, 0, kNotCovered},
      {Pose::kFresh, Object::kStale, kMeshStale, kMeshStale | kNotCovered},
      {Pose::kFresh, Object::kUnswept, kNotSwept, kNotSwept | kNotCovered},
      {Pose::kStale, Object::kNone, kPoseStale | kNoMesh, kPoseStale | kNoMesh},
      {Pose::kStale, Object::kFresh, kPoseStale, kPoseStale},
      {Pose::kStale, Object::kStale, kPoseStale | kMeshStale, kPoseStale | kMeshStale},
      {Pose::kStale, Object::kUnswept, kPoseStale | kNotSwept, kPoseStale | kNotSwept},
  };
  for (const Row& row : rows) {
    for (const auto& [until, reasons] :
         {std::pair(Time{}, row.not_covered), std::pair(kNow.stamp + 999ms, row.not_covered),
          std::pair(kNow.stamp + 1100ms, row.covered)}) {
      WarningInputs inputs;
      if (row.pose != Pose::kNone) inputs.pose = aged(row.pose == Pose::kFresh ? 10ms : 101ms);
      if (row.object != Object::kNone) {
        inputs.objects = {object(row.object == Object::kStale ? 501ms : 20ms, row.object != Object::kUnswept)};
      }
      inputs.covered_until = until;
      const Warning warning = warningNow(inputs);
      SCOPED_TRACE(warning.text);
      EXPECT_EQ(warning.reasons, reasons);
      EXPECT_EQ(warning.level, reasons == 0 ? WarningLevel::kClear : WarningLevel::kUnknown);
      EXPECT_EQ(warning.pose_stamp, inputs.pose ? inputs.pose->stamp : Time{});
      EXPECT_EQ(warning.covered_until, until);
      inputs.faults[kDetectorFault] = "no canary";
      EXPECT_EQ(warningNow(inputs).reasons, reasons | kDetectorFault);
    }
  }
}

// Inputs that lack at most one thing, and the reason to be reported for it.
std::vector<std::pair<WarningInputs, std::uint32_t>> inputsAndReasons() {
  std::vector<std::pair<WarningInputs, std::uint32_t>> all = {{allGood(), 0}};
  const auto add = [&](std::uint32_t reason, auto spoil) {
    all.emplace_back(allGood(), reason);
    spoil(all.back().first);
  };
  add(kNoPose, [](WarningInputs& inputs) { inputs.pose.reset(); });
  add(kPoseStale, [](WarningInputs& inputs) { inputs.pose = aged(101ms); });
  add(kNoMesh, [](WarningInputs& inputs) { inputs.objects.clear(); });
  add(kMeshStale, [](WarningInputs& inputs) { inputs.objects = {object(501ms)}; });
  add(kNotSwept, [](WarningInputs& inputs) { inputs.objects = {object(20ms, /*swept=*/false)}; });
  add(kNotCovered, [](WarningInputs& inputs) { inputs.covered_until = kNow.stamp + 999ms; });
  add(kDetectorFault, [](WarningInputs& inputs) { inputs.faults[kDetectorFault] = "no canary"; });
  add(kOverload, [](WarningInputs& inputs) {
    inputs.overload = kNow.steady;
    inputs.backlog = 50ms;
  });
  return all;
}

// The time is that of the predicted contact, unless a held warning of another workpiece is stronger.
TEST(WarningTest, ContactGoesBeforeReflexBeforeConsideredBeforeUnknownBeforeClear) {
  struct Row {
    Predicted predicted;  // to meet the spleen
    Alarm alarm;          // of the kidney
    WarningLevel level;
    std::string mesh_id;
    bool reported;  // the time and the probability
  };
  const Row rows[] = {
      {Predicted::kNone, Alarm::kNone, WarningLevel::kClear, "", false},
      {Predicted::kNone, Alarm::kReflexHeld, WarningLevel::kReflex, "kidney", false},
      {Predicted::kNone, Alarm::kConsideredHeld, WarningLevel::kConsidered, "kidney", false},
      {Predicted::kNone, Alarm::kOver, WarningLevel::kClear, "", false},
      {Predicted::kReflex, Alarm::kNone, WarningLevel::kReflex, "spleen", true},
      {Predicted::kReflex, Alarm::kReflexHeld, WarningLevel::kReflex, "spleen", true},
      {Predicted::kReflex, Alarm::kConsideredHeld, WarningLevel::kReflex, "spleen", true},
      {Predicted::kReflex, Alarm::kOver, WarningLevel::kReflex, "spleen", true},
      {Predicted::kConsidered, Alarm::kNone, WarningLevel::kConsidered, "spleen", true},
      {Predicted::kConsidered, Alarm::kReflexHeld, WarningLevel::kReflex, "kidney", false},
      {Predicted::kConsidered, Alarm::kConsideredHeld, WarningLevel::kConsidered, "spleen", true},
      {Predicted::kConsidered, Alarm::kOver, WarningLevel::kConsidered, "spleen", true},
      {Predicted::kBeyond, Alarm::kNone, WarningLevel::kClear, "", true},
      {Predicted::kBeyond, Alarm::kReflexHeld, WarningLevel::kReflex, "kidney", false},
      {Predicted::kBeyond, Alarm::kConsideredHeld, WarningLevel::kConsidered, "kidney", false},
      {Predicted::kBeyond, Alarm::kOver, WarningLevel::kClear, "", true},
      {Predicted::kOver, Alarm::kNone, WarningLevel::kClear, "", false},
      {Predicted::kOver, Alarm::kReflexHeld, WarningLevel::kReflex, "kidney", false},
      {Predicted::kOver, Alarm::kConsideredHeld, WarningLevel::kConsidered, "kidney", false},
      {Predicted::kOver, Alarm::kOver, WarningLevel::kClear, "", false},
  };
  const auto check = [](const Row& row, Contact contact, WarningInputs inputs, std::uint32_t reasons) {
    setContact(contact, inputs);
    setPredicted(row.predicted, inputs);
    WarningInputs::WorkpieceWarning& kidney = entryOf("kidney", inputs);
    if (row.alarm == Alarm::kReflexHeld) kidney.reflex = alarmOf(150ms);
    if (row.alarm == Alarm::kConsideredHeld) kidney.considered = alarmOf(150ms);
    if (row.alarm == Alarm::kOver) kidney.reflex = kidney.considered = alarmOf(201ms);
    const Warning warning = warningNow(inputs);
    SCOPED_TRACE(warning.text);
    const bool touches = contact == Contact::kLasting || contact == Contact::kHeld;
    const bool unknown = row.level == WarningLevel::kClear && (reasons & ~kOverload) != 0;
    const std::string mesh_id = touches ? "liver" : row.mesh_id;
    EXPECT_EQ(warning.level, touches ? WarningLevel::kContact : unknown ? WarningLevel::kUnknown : row.level);
    EXPECT_EQ(warning.reasons, reasons);
    EXPECT_EQ(warning.text.find(styleOf(warning.level).name), 0U);
    EXPECT_EQ(warning.mesh_id, mesh_id);
    EXPECT_EQ(warning.triangles, kTriangles.at(mesh_id));
    EXPECT_EQ(warning.time_to_collision.has_value(), row.reported);
    const double probability = row.predicted == Predicted::kReflex ? 0.5 : 0.75;
    EXPECT_EQ(warning.probability, row.reported ? probability : 0.0);
  };
  for (const Row& row : rows) {
    for (const Contact contact : {Contact::kNone, Contact::kLasting, Contact::kHeld, Contact::kOver}) {
      for (const auto& [inputs, reasons] : inputsAndReasons()) check(row, contact, inputs, reasons);
    }
  }
}

WarningLevel levelWhen(Duration collision_in) {
  WarningInputs inputs = allGood();
  predict(collision_in, inputs);
  return warningNow(inputs).level;
}

TEST(WarningTest, ReportsTimeAndProbabilityOfTheCollisionThatItNames) {
  WarningInputs inputs = allGood();
  predict(500ms, inputs);
  entryOf("kidney", inputs).reflex = alarmOf(150ms, "kidney");
  const Warning another = warningNow(inputs);
  EXPECT_EQ(another.text, "REFLEX: collision with 'kidney' was expected");
  EXPECT_FALSE(another.time_to_collision);
  EXPECT_EQ(another.probability, 0.0);
  entryOf("spleen", inputs).reflex = alarmOf(150ms, "spleen");
  const Warning same = warningNow(inputs);
  EXPECT_EQ(same.text, "REFLEX: collision with 'spleen' was near 0.15 s ago, expected in 0.50 s");
  EXPECT_EQ(same.time_to_collision, 500ms);
  EXPECT_EQ(same.probability, 0.75);
}

TEST(WarningTest, NamesTheToolPieceThatItWarnsOf) {
  WarningInputs inputs = allGood();
  predict(500ms, inputs);
  entryOf("spleen", inputs).predicted->tool_piece = 1;
  EXPECT_EQ(warningNow(inputs).tool_piece, 1U);
  entryOf("kidney", inputs).reflex = alarmOf(150ms);
  entryOf("kidney", inputs).reflex->contact.tool_piece = 2;
  EXPECT_EQ(warningNow(inputs).tool_piece, 2U);
  inputs.contact = {"liver", {7}, kNow.steady, /*lasting=*/true, /*inside=*/false, /*tool_piece=*/3};
  EXPECT_EQ(warningNow(inputs).tool_piece, 3U);
  inputs.contact->tool_piece.reset();  // that of another object would be wrong
  EXPECT_FALSE(warningNow(inputs).tool_piece);
  EXPECT_FALSE(warningNow(allGood()).tool_piece);
}

// The warning is asked for again in 15 ms: what would be due by then is reported now.
TEST(WarningTest, WarnsOfWhatComesWithinAnIntervalAndATick) {
  EXPECT_EQ(levelWhen(115ms), WarningLevel::kReflex);
  EXPECT_EQ(levelWhen(115ms + 1ns), WarningLevel::kConsidered);
  EXPECT_EQ(levelWhen(1015ms), WarningLevel::kConsidered);
  EXPECT_EQ(levelWhen(1015ms + 1ns), WarningLevel::kClear);
  EXPECT_EQ(levelWhen(-3s), WarningLevel::kReflex);
}

TEST(WarningTest, TimeToCollisionRunsDownOnEitherClockAndNotBelowZero) {
  WarningInputs inputs = allGood();
  predict(300ms, inputs);
  for (const Duration passed : {0ms, 100ms, 200ms, 300ms, 400ms}) {
    const Duration left = std::max<Duration>(300ms - passed, 0ms);
    EXPECT_EQ(warningOf(inputs, {kNow.stamp + passed, kNow.steady}, kShortLimits).time_to_collision, left);
    EXPECT_EQ(warningOf(inputs, {kNow.stamp, kNow.steady + passed}, kShortLimits).time_to_collision, left);
  }
  EXPECT_EQ(warningOf(inputs, {kNow.stamp + 185ms - 1ns, kNow.steady}, kShortLimits).level, WarningLevel::kConsidered);
  EXPECT_EQ(warningOf(inputs, {kNow.stamp + 185ms, kNow.steady}, kShortLimits).level, WarningLevel::kReflex);
}

// The operator is warned of it, but no one can say when it comes.
TEST(WarningTest, WhatIsMerelyProbableHasNoTime) {
  WarningInputs inputs = allGood();
  predict(50ms, inputs);
  entryOf("spleen", inputs).predicted->contact.reset();
  const Warning warning = warningNow(inputs);
  EXPECT_EQ(warning.level, WarningLevel::kReflex);
  EXPECT_FALSE(warning.time_to_collision);
  EXPECT_EQ(warning.probability, 0.5);
  EXPECT_EQ(warning.probability_interval, 100ms);
  EXPECT_EQ(warning.text, "REFLEX: collision with 'spleen' 50 % probable within 0.10 s");
}

// The path meets it later, but it may leave the path.
TEST(WarningTest, ATimeBeyondTheIntervalIsSaidWithTheProbabilityWithinIt) {
  const auto textOf = [](Duration contact, Duration reflex, double probability) {
    WarningInputs inputs = allGood();
    PredictedContact& predicted = predict(contact, inputs);
    predicted.reflex = kNow.stamp + reflex;
    predicted.reflex_probability = probability;
    return warningNow(inputs).text;
  };
  EXPECT_EQ(textOf(450ms, 80ms, 0.12),
            "REFLEX: collision with 'spleen' 12 % probable within 0.10 s, expected in 0.45 s");
  EXPECT_EQ(textOf(120ms, 0ms, 0.004),
            "REFLEX: collision with 'spleen' < 1 % probable within 0.10 s, expected in 0.12 s");
  EXPECT_EQ(textOf(90ms, 80ms, 0.5), "REFLEX: collision with 'spleen' expected in 0.09 s");
  EXPECT_EQ(textOf(450ms, 450ms, 0.12), "CONSIDERED: collision with 'spleen' expected in 0.45 s");
}

TEST(WarningTest, AContactIsSaidWithTheLinkThatMeetsIt) {
  WarningInputs inputs = allGood();
  inputs.links = {"palm", "left", "payload"};
  const auto textOf = [&](const WarningInputs::Contact& contact) {
    inputs.contact = contact;
    return warningNow(inputs).text;
  };
  const bool lasting = true;
  EXPECT_EQ(textOf({"table", {7, 8}, kNow.steady, lasting, /*inside=*/false, /*tool_piece=*/2}),
            "CONTACT: tool meets 'table', 2 triangles, by link 'payload'");
  EXPECT_EQ(textOf({"table", {}, kNow.steady, lasting, /*inside=*/true, /*tool_piece=*/0}),
            "CONTACT: tool is inside 'table', by link 'palm'");
  EXPECT_EQ(textOf({"table", {7}, kNow.steady - 100ms, /*lasting=*/false, /*inside=*/false, /*tool_piece=*/1}),
            "CONTACT: tool touched 'table' 0.10 s ago, 1 triangle, by link 'left'");
  EXPECT_EQ(textOf({"table", {7}, kNow.steady, lasting, /*inside=*/false, /*tool_piece=*/3}),
            "CONTACT: tool meets 'table', 1 triangle");
  EXPECT_EQ(textOf({"table", {7}, kNow.steady, lasting}), "CONTACT: tool meets 'table', 1 triangle");
}

TEST(WarningTest, TheProbabilityIsThatOfTheIntervalOfThePredictedContact) {
  WarningInputs inputs = allGood();
  predict(500ms, inputs).contact.reset();
  const Warning warning = warningNow(inputs);
  EXPECT_EQ(warning.probability, 0.75);
  EXPECT_EQ(warning.probability_interval, 1s);
  EXPECT_EQ(warning.text, "CONSIDERED: collision with 'spleen' 75 % probable within 1.00 s");
  entryOf("spleen", inputs).predicted->considered_probability = 0.004;
  EXPECT_EQ(warningNow(inputs).text, "CONSIDERED: collision with 'spleen' < 1 % probable within 1.00 s");
}

// A prediction says nothing of what comes after its end: what it warned of is over then, and held.
TEST(WarningTest, APredictedContactEndsWithItsPrediction) {
  for (const auto& [age, level, reported] :
       {std::tuple(1100ms + 0ns, WarningLevel::kReflex, true), std::tuple(1100ms + 1ns, WarningLevel::kReflex, false),
        std::tuple(1300ms + 0ns, WarningLevel::kReflex, false),
        std::tuple(1300ms + 1ns, WarningLevel::kClear, false)}) {
    WarningInputs inputs = allGood();
    predict(-1s, inputs);
    entryOf("spleen", inputs).predicted->pose = aged(age);
    EXPECT_EQ(warningNow(inputs).level, level) << age.count() << " ns";
    EXPECT_EQ(warningNow(inputs).time_to_collision.has_value(), reported) << age.count() << " ns";
  }
}

TEST(WarningTest, HoldsAWarningForItsHoldTime) {
  for (const auto& [ago, held] : {std::pair(200ms + 0ns, true), std::pair(200ms + 1ns, false)}) {
    WarningInputs inputs = allGood();
    entryOf("kidney", inputs).considered = alarmOf(ago);
    EXPECT_EQ(warningNow(inputs).level, held ? WarningLevel::kConsidered : WarningLevel::kClear)
        << ago.count() << " ns";
    entryOf("kidney", inputs).reflex = alarmOf(ago);
    EXPECT_EQ(warningNow(inputs).level, held ? WarningLevel::kReflex : WarningLevel::kClear) << ago.count() << " ns";
    EXPECT_FALSE(warningNow(inputs).time_to_collision);
  }
}

TEST(WarningTest, NeedsCoverageToTheEndOfTheConsideredInterval) {
  for (const auto& [reach, reasons] : {std::pair(1s - 1ns, kNotCovered), std::pair(1s + 0ns, Reason{})}) {
    WarningInputs inputs = allGood();
    inputs.covered_until = kNow.stamp + reach;
    EXPECT_EQ(warningNow(inputs).reasons, reasons) << reach.count() << " ns";
    EXPECT_EQ(warningNow(inputs).level, reasons == 0 ? WarningLevel::kClear : WarningLevel::kUnknown);
  }
}

// Stamps whose clock has stopped: time goes on.
TEST(WarningTest, CoverageRunsOutOnEitherClock) {
  const WarningInputs inputs = allGood();
  EXPECT_EQ(warningOf(inputs, {kNow.stamp + 1ns, kNow.steady}, kShortLimits).reasons, kNotCovered);
  EXPECT_EQ(warningOf(inputs, {kNow.stamp, kNow.steady + 1ns}, kShortLimits).reasons, kNotCovered);
}

TEST(WarningTest, SaysNothingMoreWhereEverythingIsFreshAndSwept) { EXPECT_EQ(warningNow(allGood()).text, "CLEAR"); }

TEST(WarningTest, TakesInputsForStaleJustPastTheirTimeouts) {
  WarningInputs inputs = allGood();
  inputs.pose = aged(100ms);
  inputs.objects = {object(500ms)};
  EXPECT_EQ(warningNow(inputs).level, WarningLevel::kClear);
  inputs.pose = aged(100ms + 1ns);
  EXPECT_EQ(warningNow(inputs).reasons, kPoseStale);
  inputs.pose = aged(100ms);
  inputs.objects = {object(500ms + 1ns)};
  EXPECT_EQ(warningNow(inputs).reasons, kMeshStale);
}

TEST(WarningTest, HoldsAContactForItsHoldTime) {
  WarningInputs inputs = allGood();
  inputs.contact = {"liver", {7}, kNow.steady - 200ms};
  EXPECT_EQ(warningNow(inputs).level, WarningLevel::kContact);
  inputs.contact->found -= 1ns;
  EXPECT_EQ(warningNow(inputs).level, WarningLevel::kClear);
}

// A stamp cannot look fresh because its clock stopped or because the message came late.
TEST(WarningTest, TakesAnAgeOnEitherClock) {
  const Timestamps old_stamp{kNow.stamp - 1s, kNow.steady};
  const Timestamps received_long_ago{kNow.stamp, kNow.steady - 1s};
  for (const Timestamps& old : {old_stamp, received_long_ago}) {
    WarningInputs pose = allGood();
    pose.pose = old;
    EXPECT_EQ(warningNow(pose).reasons, kPoseStale);
    WarningInputs workpiece = allGood();
    workpiece.objects[0].timestamps = old;
    EXPECT_EQ(warningNow(workpiece).reasons, kMeshStale);
  }
}

TEST(WarningTest, NeverTakesAStaticWorkpieceForStale) {
  WarningLimits limits = kShortLimits;
  limits.mesh_timeout = Duration::max();
  WarningInputs inputs = allGood();
  inputs.objects = {{"fixture", {Time(1s), SteadyTime(1s)}, /*swept=*/true}};
  EXPECT_EQ(warningOf(inputs, kNow, limits).level, WarningLevel::kClear);
}

TEST(WarningTest, IsUnknownIfAnyOfSeveralWorkpiecesIsStaleOrUnswept) {
  WarningInputs inputs = allGood();
  inputs.objects.push_back(object(501ms));
  EXPECT_EQ(warningNow(inputs).reasons, kMeshStale);
  inputs.objects.back() = object(20ms, /*swept=*/false);
  EXPECT_EQ(warningNow(inputs).reasons, kNotSwept);
}

TEST(WarningTest, NamesEveryReasonInItsText) {
  WarningInputs inputs;
  inputs.objects = {object(2s)};
  inputs.faults = {{kTfFail, "frame 'tool' is unknown"}, {kDetectorFault, "no canary"}};
  inputs.contact = {"liver", {7}, kNow.steady};
  const Warning warning = warningNow(inputs);
  EXPECT_EQ(warning.reasons, kNoPose | kMeshStale | kTfFail | kDetectorFault);
  for (const char* part : {"CONTACT", "'liver'", "pose", "2.00 s", "frame 'tool' is unknown", "no canary"}) {
    EXPECT_TRUE(has(warning.text, part)) << part << " is not in: " << warning.text;
  }
}

TEST(WarningTest, EveryFaultMakesItUnknownUnderItsOwnBit) {
  for (std::uint32_t bit = 1; bit <= kNotSeen; bit <<= 1) {
    if ((bit & kDegraded) != 0) continue;
    WarningInputs inputs = allGood();
    inputs.faults[static_cast<Reason>(bit)] = "message";
    EXPECT_EQ(warningNow(inputs).level, WarningLevel::kUnknown);
    EXPECT_EQ(warningNow(inputs).reasons, bit);
  }
}

TEST(WarningTest, IsNotClearWhileAPoseWaitsLongerThanTwentyMillisecondsAndALookAhead) {
  for (const auto& [look_ahead, longest] : {std::pair(0ms, 20ms), std::pair(15ms, 20ms), std::pair(66ms, 66ms)}) {
    WarningInputs inputs = allGood();
    inputs.look_ahead = look_ahead;
    inputs.waiting_since = kNow.steady - longest;
    EXPECT_EQ(warningNow(inputs).level, WarningLevel::kClear);
    *inputs.waiting_since -= 1ns;
    EXPECT_EQ(warningNow(inputs).level, WarningLevel::kUnknown);
    EXPECT_EQ(warningNow(inputs).reasons, kPosesUnswept);
  }
}

TEST(WarningTest, SaysThatClocksDifferWhereOldPosesArrive) {
  WarningInputs inputs = allGood();
  inputs.pose = Timestamps{kNow.stamp - 3600s, kNow.steady - 10ms};
  EXPECT_TRUE(has(warningNow(inputs).text, "newest tool pose is 3600.00 s old by its stamp: clocks differ"));
  inputs.pose = aged(3600s);  // none arrives
  EXPECT_EQ(warningNow(inputs).reasons & kPoseStale, kPoseStale);
  EXPECT_FALSE(has(warningNow(inputs).text, "clocks"));
}

TEST(WarningTest, NamesEachRequiredWorkpieceThatHasNotArrived) {
  WarningInputs inputs = allGood();
  inputs.required = {"liver"};
  EXPECT_EQ(warningNow(inputs).level, WarningLevel::kClear);
  inputs.required = {"aorta", "liver", "spleen"};
  const Warning warning = warningNow(inputs);
  EXPECT_EQ(warning.level, WarningLevel::kUnknown);
  EXPECT_EQ(warning.reasons, kNoMesh);
  EXPECT_TRUE(has(warning.text, "'aorta' has not arrived"));
  EXPECT_TRUE(has(warning.text, "'spleen' has not arrived"));
  EXPECT_FALSE(has(warning.text, "'liver'"));
  inputs.objects = {{"aorta", aged(20ms), true}, {"kidney", aged(20ms), true}, {"liver", aged(20ms), true}};
  inputs.objects.push_back({"spleen", aged(20ms), true});
  EXPECT_EQ(warningNow(inputs).level, WarningLevel::kClear);
  inputs.objects.clear();
  EXPECT_EQ(warningNow(inputs).reasons, kNoMesh);
}

TEST(WarningTest, SaysHowFarThePosesAreBehindAWorkpiece) {
  WarningInputs inputs = allGood();
  inputs.objects[0].swept = false;
  inputs.objects[0].behind = 1500ms;
  const Warning warning = warningNow(inputs);
  EXPECT_EQ(warning.reasons, kNotSwept);
  EXPECT_TRUE(has(warning.text, "tool poses are 1.50 s behind workpiece 'liver'"));
}

TEST(WarningTest, WhatDegradesLeavesTheLevelAndEndsAfterTheHoldTime) {
  WarningInputs inputs = allGood();
  inputs.pose_loss = {"3 tool poses were lost on the way", kNow.steady - 200ms};
  EXPECT_EQ(warningNow(inputs).level, WarningLevel::kClear);
  EXPECT_EQ(warningNow(inputs).reasons, kPoseLoss);
  EXPECT_TRUE(has(warningNow(inputs).text, "3 tool poses were lost"));
  inputs.pose_loss->found -= 1ns;
  EXPECT_EQ(warningNow(inputs).reasons, 0U);
}

TEST(WarningTest, IsUnknownForTheHoldTimeAfterCamerasSawTooLittleOfThePath) {
  WarningInputs inputs = allGood();
  inputs.unseen = WarningInputs::Unseen{0.149, kNow.steady - kShortLimits.hold_time};
  EXPECT_EQ(warningNow(inputs).level, WarningLevel::kClear) << "there is no camera any more";
  inputs.seen = 0.7;
  EXPECT_EQ(warningNow(inputs).level, WarningLevel::kUnknown);
  EXPECT_EQ(warningNow(inputs).reasons, kNotSeen);
  EXPECT_EQ(warningNow(inputs).seen, 0.7);
  EXPECT_EQ(warningNow(inputs).text, "UNKNOWN: cameras see only 14 % of a part of the predicted path");
  inputs.unseen->found -= 1ms;
  EXPECT_EQ(warningNow(inputs).level, WarningLevel::kClear);
}

TEST(WarningTest, AJumpIsSaidForTheHoldTimeAndKeepsTheLevel) {
  WarningInputs inputs = allGood();
  inputs.jump = {"joint 'elbow' jumped: 130 rad/s", kNow.steady - 200ms};
  EXPECT_EQ(warningNow(inputs).reasons, kJump);
  EXPECT_EQ(warningNow(inputs).text, "CLEAR: joint 'elbow' jumped: 130 rad/s: what was reported may come from that");
  inputs.contact = {"liver", {7}, kNow.steady};
  EXPECT_EQ(warningNow(inputs).level, WarningLevel::kContact);
  EXPECT_TRUE(has(warningNow(inputs).text, "may come from that"));
  inputs.contact.reset();
  inputs.jump->found -= 1ns;
  EXPECT_EQ(warningNow(inputs).reasons, 0U);
}

TEST(WarningTest, AnOpenSurfaceIsSaidAndKeepsTheLevel) {
  WarningInputs inputs = allGood();
  inputs.objects[0].open_edges = 3;
  EXPECT_EQ(warningNow(inputs).level, WarningLevel::kClear);
  EXPECT_EQ(warningNow(inputs).reasons, kInsideUntested);
  EXPECT_EQ(warningNow(inputs).text,
            "CLEAR: the surface of 'liver' is open at 3 edges: the guard cannot tell whether the tool is inside");
  inputs.objects[0].swept = false;
  EXPECT_EQ(warningNow(inputs).reasons, kNotSwept | kInsideUntested);
  inputs.objects[0].open_edges = 0;
  EXPECT_EQ(warningNow(inputs).reasons, kNotSwept);
}

// Numbers on the wire, in Warning.msg.
TEST(WarningTest, LevelsHaveTheNumbersAndNamesOfTheMessage) {
  constexpr std::array<const char*, 5> kNames = {"UNKNOWN", "CLEAR", "CONSIDERED", "REFLEX", "CONTACT"};
  for (size_t i = 0; i < kNames.size(); ++i) EXPECT_STREQ(styleOf(static_cast<WarningLevel>(i)).name, kNames[i]);
}

// The hold time is how long a contact is shown after the tool has left, not how long it may last.
TEST(WarningTest, AContactThatLastsIsShownWhateverTheHoldTime) {
  WarningInputs inputs;
  inputs.contact = {"liver", {7}, kNow.steady - 1h, /*lasting=*/true};
  EXPECT_EQ(warningOf(inputs, kNow, {100ms, 500ms, /*hold_time=*/0ms}).level, WarningLevel::kContact);
  inputs.contact->lasting = false;
  EXPECT_EQ(warningOf(inputs, kNow, {100ms, 500ms, /*hold_time=*/0ms}).level, WarningLevel::kUnknown);
}

}  // namespace
}  // namespace sweep_guard_core
