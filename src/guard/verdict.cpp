#include "sweep_guard/guard/verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sweep_guard {
namespace {

std::string inSeconds(Duration duration) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", toSeconds(duration));
  return text;
}

class Findings {
 public:
  void add(Reason reason, const std::string& story) {
    reasons_ |= reason;
    text_ += (text_.empty() ? "" : "; ") + story;
  }
  std::uint32_t reasons() const { return reasons_; }
  const std::string& text() const { return text_; }

 private:
  std::uint32_t reasons_ = 0;
  std::string text_;
};

void assessPose(const Evidence& evidence, const Instant& now, const VerdictLimits& limits, Findings& findings) {
  if (!evidence.pose) {
    findings.add(kNoPose, "no tool pose yet");
  } else if (stale(*evidence.pose, now, limits.pose_timeout)) {
    findings.add(kPoseStale, "newest tool pose tested is " + inSeconds(age(*evidence.pose, now)) + " old");
  }
}

void assessCoverage(const Evidence& evidence, const Instant& now, const VerdictLimits& limits, Findings& findings) {
  if (evidence.objects.empty() || !evidence.pose || stale(*evidence.pose, now, limits.pose_timeout)) return;
  const Duration ahead = evidence.covered_until - evidence.pose->stamp - age(*evidence.pose, now);
  if (ahead >= limits.considered) return;
  findings.add(kNotCovered, ahead <= Duration::zero() ? "what comes has not been tested"
                                                      : "only the next " + inSeconds(ahead) + " have been tested");
}

void assessObjects(const Evidence& evidence, const Instant& now, const VerdictLimits& limits, Findings& findings) {
  if (evidence.objects.empty()) findings.add(kNoMesh, "no workpiece yet");
  for (const Evidence::Object& object : evidence.objects) {
    if (stale(object.seen, now, limits.mesh_timeout)) {
      findings.add(kMeshStale, "workpiece '" + object.id + "' is " + inSeconds(age(object.seen, now)) + " old");
    }
    if (evidence.pose && !object.swept) findings.add(kNotSwept, "workpiece '" + object.id + "' has not been swept yet");
  }
}

void assessLoad(const Evidence& evidence, const Instant& now, const VerdictLimits& limits, Findings& findings) {
  if (!evidence.overload || now.steady - evidence.overload->found > limits.hold_time) return;
  findings.add(kOverload, "overload: poses of " + inSeconds(evidence.overload->span) + " were swept at once");
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

std::string counted(const std::vector<std::uint32_t>& triangles) {
  return std::to_string(triangles.size()) + (triangles.size() == 1 ? " triangle" : " triangles");
}

void tell(Verdict& verdict, const std::string& story) {
  verdict.text = story + (verdict.text.empty() ? "" : "; ") + verdict.text;
}

Duration timeTo(Time moment, const Seen& pose, const Instant& now) { return moment - pose.stamp - age(pose, now); }

std::string prospect(const Verdict& verdict) {
  if (verdict.time_to_collision) return "expected in " + inSeconds(*verdict.time_to_collision);
  if (verdict.probability == 0.0) return "was expected";
  return std::to_string(std::lround(100.0 * verdict.probability)) + " % probable";
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
  verdict.triangles = strongest.contact->triangles;
  tell(verdict, "collision with '" + verdict.mesh_id + "' " + prospect(verdict));
}

Verdict unwatched(const std::string& asked_by) {
  Verdict verdict;
  verdict.reasons = kDisabled;
  verdict.text = std::string(nameOf(verdict.level)) + ": disabled by " + asked_by + ": nothing is tested";
  return verdict;
}

}  // namespace

Duration age(const Seen& seen, const Instant& now) {
  return std::max(now.stamp - seen.stamp, now.steady - seen.received);
}

bool stale(const Seen& seen, const Instant& now, Duration timeout) {
  return timeout != Duration::max() && age(seen, now) > timeout;
}

Verdict assess(const Evidence& evidence, const Instant& now, const VerdictLimits& limits) {
  if (evidence.disabled) return unwatched(*evidence.disabled);
  Findings findings;
  assessPose(evidence, now, limits, findings);
  assessObjects(evidence, now, limits, findings);
  assessCoverage(evidence, now, limits, findings);
  assessLoad(evidence, now, limits, findings);
  for (const auto& [reason, story] : evidence.faults) findings.add(reason, story);

  Verdict verdict;
  verdict.reasons = findings.reasons();
  verdict.level = (verdict.reasons & ~kDegraded) == 0 ? Level::kClear : Level::kUnknown;
  verdict.text = findings.text();
  if (evidence.pose) verdict.pose_stamp = evidence.pose->stamp;
  verdict.covered_until = evidence.covered_until;
  warn(evidence, now, limits, verdict);
  if (evidence.contact && (evidence.contact->lasting || now.steady - evidence.contact->found <= limits.hold_time)) {
    verdict.level = Level::kContact;
    verdict.mesh_id = evidence.contact->id;
    verdict.triangles = evidence.contact->triangles;
    verdict.tool_part = evidence.contact->tool_part;
    verdict.text = findings.text();  // what was expected has come
    const std::string how = evidence.contact->inside ? "tool is inside of '" : "tool meets '";
    tell(verdict, how + verdict.mesh_id + "'" + (verdict.triangles.empty() ? "" : ", " + counted(verdict.triangles)));
  }
  verdict.text = std::string(nameOf(verdict.level)) + (verdict.text.empty() ? "" : ": ") + verdict.text;
  return verdict;
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
