#include "sweep_guard/guard/verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string_view>

namespace sweep_guard {
namespace {

std::string inSeconds(Duration duration) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", toSeconds(duration));
  return text;
}

// Pieces are put together where the text is kept, so that telling the same again and again allocates nothing.
using Pieces = std::initializer_list<std::string_view>;

void insert(std::string& text, size_t place, Pieces pieces) {
  for (const std::string_view piece : pieces) {
    text.insert(place, piece);
    place += piece.size();
  }
}

void add(Verdict& verdict, Reason reason, Pieces story) {
  verdict.reasons |= reason;
  if (!verdict.text.empty()) verdict.text += "; ";
  insert(verdict.text, verdict.text.size(), story);
}

void assessPose(const Evidence& evidence, const Instant& now, const VerdictLimits& limits, Verdict& verdict) {
  if (!evidence.pose) {
    add(verdict, kNoPose, {"no tool pose yet"});
  } else if (stale(*evidence.pose, now, limits.pose_timeout)) {
    add(verdict, kPoseStale, {"newest tool pose tested is ", inSeconds(age(*evidence.pose, now)), " old"});
  }
}

void assessCoverage(const Evidence& evidence, const Instant& now, const VerdictLimits& limits, Verdict& verdict) {
  if (evidence.objects.empty() || !evidence.pose || stale(*evidence.pose, now, limits.pose_timeout)) return;
  const Duration ahead = evidence.covered_until - evidence.pose->stamp - age(*evidence.pose, now);
  if (ahead >= limits.considered) return;
  if (ahead <= Duration::zero()) return add(verdict, kNotCovered, {"what comes has not been tested"});
  add(verdict, kNotCovered, {"only the next ", inSeconds(ahead), " have been tested"});
}

void assessObjects(const Evidence& evidence, const Instant& now, const VerdictLimits& limits, Verdict& verdict) {
  if (evidence.objects.empty()) add(verdict, kNoMesh, {"no workpiece yet"});
  for (const Evidence::Object& object : evidence.objects) {
    if (stale(object.seen, now, limits.mesh_timeout)) {
      add(verdict, kMeshStale, {"workpiece '", object.id, "' is ", inSeconds(age(object.seen, now)), " old"});
    }
    if (evidence.pose && !object.swept) {
      add(verdict, kNotSwept, {"workpiece '", object.id, "' has not been swept yet"});
    }
  }
}

void assessLoad(const Evidence& evidence, const Instant& now, const VerdictLimits& limits, Verdict& verdict) {
  if (!evidence.overload || now.steady - evidence.overload->found > limits.hold_time) return;
  add(verdict, kOverload, {"overload: poses of ", inSeconds(evidence.overload->span), " were swept at once"});
}

// The strongest warning in force or held, and the collision that it is about.
struct Warned {
  Level level = Level::kClear;
  const ExpectedContact* contact = nullptr;

  void raise(Level to, const ExpectedContact& about) {
    if (to > level) *this = {to, &about};
  }
};

Warned warned(const Evidence& evidence, const Instant& now, const VerdictLimits& limits) {
  Warned warned;
  if (evidence.expected && overSince(*evidence.expected, now) <= limits.hold_time) {
    warned.raise(warningOf(*evidence.expected, now, limits), evidence.expected->contact);
  }
  const auto held = [&](const auto& alarm) { return alarm && now.steady - alarm->ended <= limits.hold_time; };
  if (held(evidence.reflex)) warned.raise(Level::kReflex, evidence.reflex->contact);
  if (held(evidence.considered)) warned.raise(Level::kConsidered, evidence.considered->contact);
  return warned;
}

void tell(Verdict& verdict, Pieces story) {
  if (!verdict.text.empty()) verdict.text.insert(0, "; ");
  insert(verdict.text, 0, story);
}

Duration timeTo(Time moment, const Seen& pose, const Instant& now) { return moment - pose.stamp - age(pose, now); }

void tellProspect(Verdict& verdict) {
  const auto tellIt = [&](std::string_view how, const std::string& much, std::string_view more = {}) {
    tell(verdict, {"collision with '", verdict.mesh_id, "' ", how, much, more});
  };
  if (verdict.time_to_collision) return tellIt("expected in ", inSeconds(*verdict.time_to_collision));
  if (verdict.probability == 0.0) return tellIt("was expected", "");
  tellIt("", std::to_string(std::lround(100.0 * verdict.probability)), " % probable");
}

void tellContact(Verdict& verdict, bool inside) {
  const size_t count = verdict.triangles.size();
  const std::string_view how = inside ? "tool is inside of '" : "tool meets '";
  if (count == 0) return tell(verdict, {how, verdict.mesh_id, "'"});
  tell(verdict, {how, verdict.mesh_id, "', ", std::to_string(count), count == 1 ? " triangle" : " triangles"});
}

void tellExpected(const Evidence::Expectation& expectation, const Instant& now, Verdict& verdict) {
  const auto& [contact, pose, reach] = expectation;
  if (contact.met) verdict.time_to_collision = std::max(Duration::zero(), timeTo(*contact.met, pose, now));
  verdict.probability = contact.probability;
}

void warn(const Evidence& evidence, const Instant& now, const VerdictLimits& limits, Verdict& verdict) {
  const auto& expected = evidence.expected;
  const bool in_force = expected && overSince(*expected, now) == Duration::zero();
  const Warned strongest = warned(evidence, now, limits);
  if (in_force && (!strongest.contact || strongest.contact->mesh_id == expected->contact.mesh_id)) {
    tellExpected(*expected, now, verdict);
  }
  if (!strongest.contact) return;
  verdict.level = strongest.level;
  verdict.mesh_id = strongest.contact->mesh_id;
  verdict.tool_part = strongest.contact->tool_part;
  verdict.triangles = strongest.contact->triangles;
  tellProspect(verdict);
}

void assessNothing(const std::string& disabled_by, Verdict& verdict) {
  add(verdict, kDisabled, {nameOf(verdict.level), ": disabled by ", disabled_by, ": nothing is tested"});
}

}  // namespace

void Verdict::clear() {
  level = Level::kUnknown;
  reasons = 0;
  text.clear();
  mesh_id.clear();
  tool_part.reset();
  triangles.clear();
  time_to_collision.reset();
  probability = 0.0;
  pose_stamp = {};
  covered_until = {};
}

Duration age(const Seen& seen, const Instant& now) {
  return std::max(now.stamp - seen.stamp, now.steady - seen.received);
}

bool stale(const Seen& seen, const Instant& now, Duration timeout) {
  return timeout != Duration::max() && age(seen, now) > timeout;
}

Verdict assess(const Evidence& evidence, const Instant& now, const VerdictLimits& limits) {
  Verdict verdict;
  assess(evidence, now, limits, verdict);
  return verdict;
}

void assess(const Evidence& evidence, const Instant& now, const VerdictLimits& limits, Verdict& verdict) {
  verdict.clear();
  if (evidence.disabled) return assessNothing(*evidence.disabled, verdict);
  assessPose(evidence, now, limits, verdict);
  assessObjects(evidence, now, limits, verdict);
  assessCoverage(evidence, now, limits, verdict);
  assessLoad(evidence, now, limits, verdict);
  for (const auto& [reason, story] : evidence.faults) add(verdict, reason, {story});

  verdict.level = (verdict.reasons & ~kDegraded) == 0 ? Level::kClear : Level::kUnknown;
  if (evidence.pose) verdict.pose_stamp = evidence.pose->stamp;
  verdict.covered_until = evidence.covered_until;
  const size_t length = verdict.text.size();
  warn(evidence, now, limits, verdict);
  if (evidence.contact && (evidence.contact->lasting || now.steady - evidence.contact->found <= limits.hold_time)) {
    verdict.level = Level::kContact;
    verdict.mesh_id = evidence.contact->id;
    verdict.triangles = evidence.contact->triangles;
    verdict.tool_part = evidence.contact->tool_part;
    verdict.text.erase(0, verdict.text.size() - length);  // what was expected has come
    tellContact(verdict, evidence.contact->inside);
  }
  insert(verdict.text, 0, {nameOf(verdict.level), verdict.text.empty() ? "" : ": "});
}

Level warningOf(const Evidence::Expectation& expectation, const Instant& now, const VerdictLimits& limits) {
  return warningOf(timeTo(expectation.contact.from, expectation.pose, now) + overSince(expectation, now), limits);
}

Level warningOf(Duration left, const VerdictLimits& limits) {
  if (left <= limits.reflex + limits.tick) return Level::kReflex;
  return left <= limits.considered + limits.tick ? Level::kConsidered : Level::kClear;
}

Duration overSince(const Evidence::Expectation& expectation, const Instant& now) {
  return std::max(Duration::zero(), age(expectation.pose, now) - expectation.reach);
}

const char* nameOf(Level level) {
  switch (level) {
    case Level::kUnknown:
      return "UNKNOWN";
    case Level::kClear:
      return "CLEAR";
    case Level::kConsidered:
      return "CONSIDERED";
    case Level::kReflex:
      return "REFLEX";
    case Level::kContact:
      return "CONTACT";
  }
  return "UNKNOWN";
}

}  // namespace sweep_guard
