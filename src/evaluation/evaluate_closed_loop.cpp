#include <iostream>
#include <fmt/format.h>
#include "common/run_program.h"
#include "evaluation/closed_loop_episode.h"
#include "evaluation/parallel.h"
#include "recording/recording.h"
#include "sweep_guard/common/quantile.h"
using namespace sweep_guard_evaluation;
int main(int argc, char** argv) {
  size_t placements_count = std::stoul(argv[1]); std::uint64_t seed = std::stoul(argv[2]);
  for (int f = 3; f < argc; ++f) {
    auto recording = sweep_guard_recording::readRecording(argv[f], "");
    ClosedLoopOptions options; if (getenv("SLICE")) options.guard.slice = atof(getenv("SLICE"));
    options.guard.braking = {1.0, 0.01 + 0.02 + 0.02 + 0.03, 0.002, options.guard.tool.boundingRadius()};
    options.guard.in_flight = std::chrono::milliseconds(10 + 20 + 60);
    const auto driven = drive(RecordedMotion(recording.poses), options.robot, options.delays);
    const auto placements = placeObstacles(RecordedMotion(driven.path), options.guard.tool, {placements_count, seed});
    std::vector<ClosedLoopEpisode> unguarded(placements.size()), guarded(placements.size());
    inParallel(placements.size(), [&](size_t i) {
      unguarded[i] = runEpisode(driven, placements[i], options, false, i);
      guarded[i] = runEpisode(driven, placements[i], options, true, i);
    });
    size_t contacts = 0, gcontacts = 0, expected = 0; double standoff = 0, freec = 0, changed = 0, least[4] = {1,1,1,1}, near[4] = {1,1,1,1}; size_t count[4] = {}, bad[4]={}; std::vector<double> speeds, times;
    for (size_t i = 0; i < placements.size(); ++i) {
      expected += placements[i].contact.has_value();
      if (unguarded[i].contact_speed) { ++contacts; speeds.push_back(*unguarded[i].contact_speed); }
      gcontacts += guarded[i].contact_speed.has_value();
      if (guarded[i].contact_speed) std::cout << "CONTACT " << i << " began " << guarded[i].gap_at_begin << " speed " << *guarded[i].contact_speed << "\n";
      standoff = std::max(standoff, guarded[i].fastest_at_standoff);
      freec += double(guarded[i].free_cycles); changed += double(guarded[i].free_changed);
      for (auto& r : guarded[i].retreats) { int k = (int)r.kind; ++count[k]; bad[k] += r.kept < 0.99; least[k] = std::min(least[k], r.kept); near[k] = std::min(near[k], r.kept_near); if (r.kind == Retreat::Kind::kAway && r.time_until_free) times.push_back(*r.time_until_free); }
    }
    std::cout << fmt::format("{}: {} placements ({} contacts expected), {} contacts unguarded p95 {:.3f}, {} guarded, standoff {:.5f}, free {} changed {}\n", recording.name, placements.size(), expected, contacts, sweep_guard_core::quantile(speeds, .95), gcontacts, standoff, freec, changed);
    for (int k = 0; k < 4; ++k) std::cout << fmt::format("   kind {} count {} bad {} least {:.4f} least near {:.4f}\n", k, count[k], bad[k], least[k], near[k]);
    std::cout << fmt::format("   time until free {:.3f}\n", sweep_guard_core::quantile(times, .5));
  }
}
