#include "sweep_guard/guard/verdict.h"

#include <algorithm>
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

void assessObjects(const Evidence& evidence, const Instant& now, const VerdictLimits& limits, Findings& findings) {
  if (evidence.objects.empty()) findings.add(kNoMesh, "no workpiece yet");
  for (const Evidence::Object& object : evidence.objects) {
    if (stale(object.seen, now, limits.mesh_timeout)) {
      findings.add(kMeshStale, "workpiece '" + object.id + "' is " + inSeconds(age(object.seen, now)) + " old");
    }
    if (evidence.pose && !object.swept) findings.add(kNotSwept, "workpiece '" + object.id + "' has not been swept yet");
  }
}

}  // namespace

Duration age(const Seen& seen, const Instant& now) {
  return std::max(now.stamp - seen.stamp, now.steady - seen.received);
}

bool stale(const Seen& seen, const Instant& now, Duration timeout) {
  return timeout != Duration::max() && age(seen, now) > timeout;
}

Verdict assess(const Evidence& evidence, const Instant& now, const VerdictLimits& limits) {
  Findings findings;
  assessPose(evidence, now, limits, findings);
  assessObjects(evidence, now, limits, findings);
  for (const auto& [reason, story] : evidence.faults) findings.add(reason, story);

  Verdict verdict;
  verdict.reasons = findings.reasons();
  verdict.level = verdict.reasons == 0 ? Level::kClear : Level::kUnknown;
  verdict.text = findings.text();
  if (evidence.pose) verdict.pose_stamp = evidence.pose->stamp;
  verdict.covered_until = evidence.covered_until;
  if (evidence.contact && (evidence.contact->lasting || now.steady - evidence.contact->found <= limits.hold_time)) {
    verdict.level = Level::kContact;
    verdict.mesh_id = evidence.contact->id;
    verdict.triangles = evidence.contact->triangles;
    const size_t count = verdict.triangles.size();
    verdict.text = "tool meets '" + verdict.mesh_id + "', " + std::to_string(count) +
                   (count == 1 ? " triangle" : " triangles") + (verdict.text.empty() ? "" : "; ") + verdict.text;
  }
  verdict.text = std::string(nameOf(verdict.level)) + (verdict.text.empty() ? "" : ": ") + verdict.text;
  return verdict;
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
