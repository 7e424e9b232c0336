#include "evaluation/closed_loop_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "common/csv.h"
#include "evaluation/parallel.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::csvLine;
using sweep_guard_core::quantile;
using sweep_guard_recording::Recording;

namespace {

constexpr const char* kMoving = ", surface comes";
constexpr const char* kAtRest = ", surface comes to a tool at rest";
constexpr std::array<const char*, kRetreatKinds> kRetreats = {"along the normal", "as the tool came",
                                                              "in a random direction", "with a random turn"};
constexpr double kKept = 0.99;
constexpr double kMaxStandoffSpeed = 0.001;  // [m/s]

// Along the path of the robot without a guard, each from where its episode begins.
std::vector<ObstaclePlacement> placeAlong(const DrivenRobot& driven, const ClosedLoopOptions& options,
                                          size_t& left_out) {
  std::vector<ObstaclePlacement> placements;
  for (ObstaclePlacement& placement :
       placeObstacles(RecordedMotion(driven.path), options.shape, options.placements, options.seed)) {
    if (const auto begin = beginOf(driven, placement, options)) {
      placement.begin = *begin;
      placements.push_back(placement);
    } else {
      ++left_out;
    }
  }
  return placements;
}

// Where the motion runs into the surface.
std::vector<ObstaclePlacement> withContact(const std::vector<ObstaclePlacement>& placements) {
  std::vector<ObstaclePlacement> met;
  std::copy_if(placements.begin(), placements.end(), std::back_inserter(met),
               [](const ObstaclePlacement& each) { return each.contact.has_value(); });
  return met;
}

using Run = std::function<ClosedLoopEpisode(const ObstaclePlacement&, const EpisodeKind&)>;

// Counts the episodes without and with a guard.
void addCounts(const std::string& name, const std::vector<ObstaclePlacement>& placements, bool surface_comes,
               const Run& run, std::vector<ClosedLoopCount>& counts) {
  std::vector<ClosedLoopCount> arms(2);
  for (const bool guarded : {false, true}) {
    ClosedLoopCount& count = arms[guarded ? 1 : 0];
    count = {name, guarded, std::vector<ClosedLoopEpisode>(placements.size()), {}};
    inParallel(placements.size(), [&](size_t i) {
      count.episodes[i] = run(placements[i], {surface_comes, guarded, i + 1});
    });
    for (const ClosedLoopEpisode& episode : arms[0].episodes) count.near_misses.push_back(!episode.contact);
  }
  counts.insert(counts.end(), arms.begin(), arms.end());
}

bool surfaceComes(const ClosedLoopCount& count) { return count.recording.find(kMoving) != std::string::npos; }

// The figures of one line.
struct Figures {
  explicit Figures(const ClosedLoopCount& count) : placements(count.episodes.size()) {
    for (size_t i = 0; i < count.episodes.size(); ++i) add(count.episodes[i], count.near_misses[i]);
  }

  void add(const ClosedLoopEpisode& episode, bool near_miss) {
    if (episode.contact) {
      closing_speeds.push_back(episode.contact->closing_speed);
      tool_speeds.push_back(episode.contact->tool_speed);
    }
    free_commands += episode.free_commands;
    free_changed += episode.free_changed;
    standoff_speed = std::max(standoff_speed, episode.standoff_speed);
    for (const Retreat& retreat : episode.retreats) add(retreat);
    if (!near_miss) return;
    ++near_misses;
    if (episode.slowed) paths_kept.push_back(episode.path_kept);
  }
  void add(const Retreat& retreat) {
    ++retreats;
    retreat_contacts += retreat.contact ? 1 : 0;
    const size_t keeps = retreat.speed_kept >= kKept ? 1 : 0;
    kept += keeps;
    ++of_kind[static_cast<size_t>(retreat.kind)];
    kept_of_kind[static_cast<size_t>(retreat.kind)] += keeps;
    least_kept = std::min(least_kept, retreat.speed_kept);
    if (retreat.kind == RetreatKind::kNormal && retreat.time_until_free) times.push_back(*retreat.time_until_free);
  }

  static double share(size_t part, size_t all) {
    return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : std::numeric_limits<double>::quiet_NaN();
  }

  size_t placements;
  std::vector<double> closing_speeds;
  std::vector<double> tool_speeds;
  size_t free_commands = 0;
  size_t free_changed = 0;
  double standoff_speed = 0.0;
  size_t retreats = 0;
  size_t retreat_contacts = 0;
  size_t kept = 0;
  std::array<size_t, kRetreatKinds> of_kind{};
  std::array<size_t, kRetreatKinds> kept_of_kind{};
  double least_kept = 1.0;
  std::vector<double> times;
  size_t near_misses = 0;
  std::vector<double> paths_kept;
};

// In a column that says nothing about this count there is nothing.
std::string fieldOf(bool applies, double value) { return applies ? sweep_guard_core::csvNumber(value) : ""; }

std::string lineOf(const ClosedLoopCount& count) {
  const Figures figures(count);
  const bool retreated = figures.retreats > 0;
  const size_t slowed = figures.paths_kept.size();
  return csvLine({count.recording, count.guarded ? "1" : "0", std::to_string(figures.placements),
                  std::to_string(figures.closing_speeds.size()),
                  fieldOf(!figures.closing_speeds.empty(), quantile(figures.closing_speeds, 0.95)),
                  fieldOf(figures.free_commands > 0, Figures::share(figures.free_changed, figures.free_commands)),
                  fieldOf(retreated, figures.least_kept), fieldOf(retreated, quantile(figures.times, 0.5)),
                  std::to_string(figures.retreats), fieldOf(retreated, Figures::share(figures.kept, figures.retreats)),
                  fieldOf(count.guarded && !surfaceComes(count), figures.standoff_speed),
                  std::to_string(figures.near_misses),
                  fieldOf(figures.near_misses > 0, Figures::share(slowed, figures.near_misses)),
                  fieldOf(slowed > 0, quantile(figures.paths_kept, 0.5)),
                  fieldOf(!figures.tool_speeds.empty(), quantile(figures.tool_speeds, 0.95))});
}

}  // namespace

std::vector<ClosedLoopCount> countClosedLoops(const std::vector<Recording>& recordings,
                                              const ClosedLoopOptions& options, size_t& left_out,
                                              const Progress& progress) {
  std::vector<ClosedLoopCount> counts;
  for (const Recording& recording : recordings) {
    const DrivenRobot driven = drive(RecordedMotion(recording.poses), options.robot);
    const std::vector<ObstaclePlacement> placements = placeAlong(driven, options, left_out);
    const Run run = [&](const ObstaclePlacement& each, const EpisodeKind& kind) {
      return runEpisode(driven, each, options, kind);
    };
    const Run run_at_rest = [&](const ObstaclePlacement& each, const EpisodeKind& kind) {
      return runEpisodeAtRest(driven, each, options, kind);
    };
    const std::vector<ObstaclePlacement> met = withContact(placements);
    addCounts(recording.name, placements, /*surface_comes=*/false, run, counts);
    addCounts(recording.name + kMoving, met, /*surface_comes=*/true, run, counts);
    addCounts(recording.name + kAtRest, met, /*surface_comes=*/true, run_at_rest, counts);
    progress(recording.poses.size());
  }
  return counts;
}

std::vector<ClosedLoopCount> summed(const std::vector<ClosedLoopCount>& counts) {
  std::vector<ClosedLoopCount> sums;
  for (const ClosedLoopCount& count : counts) {
    const size_t comma = count.recording.find(kMoving);
    const std::string name = "all" + (comma == std::string::npos ? "" : count.recording.substr(comma));
    auto sum = std::find_if(sums.begin(), sums.end(), [&](const ClosedLoopCount& each) {
      return each.recording == name && each.guarded == count.guarded;
    });
    if (sum == sums.end()) sum = sums.insert(sums.end(), {name, count.guarded, {}, {}});
    sum->episodes.insert(sum->episodes.end(), count.episodes.begin(), count.episodes.end());
    sum->near_misses.insert(sum->near_misses.end(), count.near_misses.begin(), count.near_misses.end());
  }
  return sums;
}

std::string closedLoopCsv(const std::vector<ClosedLoopCount>& counts) {
  std::string csv =
      csvLine({"recording", "guarded", "placements", "contacts", "speed_at_contact_p95", "free_motion_changed",
               "retreat_speed_kept_least", "time_until_free_median", "retreats", "retreats_kept", "standoff_speed",
               "near_misses", "near_misses_slowed", "near_miss_path_kept_median", "tool_speed_at_contact_p95"});
  for (const ClosedLoopCount& count : counts) csv += lineOf(count);
  return csv;
}

bool keepsItsPromise(const std::vector<ClosedLoopCount>& counts) {
  return std::all_of(counts.begin(), counts.end(), [](const ClosedLoopCount& count) {
    if (!count.guarded || surfaceComes(count)) return true;
    const Figures figures(count);
    return figures.free_changed == 0 && figures.closing_speeds.empty() && figures.retreat_contacts == 0 &&
           figures.kept == figures.retreats && figures.standoff_speed < kMaxStandoffSpeed;
  });
}

std::string closedLoopTable(const std::vector<ClosedLoopCount>& counts) {
  std::string table =
      fmt::format("{:<50} {:>7} {:>10} {:>8} {:>9} {:>12} {:>8} {:>11} {:>12}\n", "recording", "guarded", "placements",
                  "contacts", "p95 [m/s]", "free changed", "retreats", "least kept", "standoff [m/s]");
  for (const ClosedLoopCount& count : counts) {
    const Figures figures(count);
    table += fmt::format("{:<50} {:>7} {:>10} {:>8} {:>9.3f} {:>12} {:>8} {:>11.4f} {:>12.6f}\n", count.recording,
                         count.guarded ? "yes" : "no", figures.placements, figures.closing_speeds.size(),
                         quantile(figures.closing_speeds, 0.95), figures.free_changed, figures.retreats,
                         figures.least_kept, figures.standoff_speed);
    for (size_t kind = 0; kind < kRetreatKinds; ++kind) {
      if (figures.of_kind[kind] == 0) continue;
      table += fmt::format("{:<50} {} of {} retreats {} kept 99 % of their speed\n", "", figures.kept_of_kind[kind],
                           figures.of_kind[kind], kRetreats[kind]);
    }
    if (!count.guarded || figures.near_misses == 0) continue;
    table += fmt::format("{:<50} {} of {} near misses slowed; of their path {:.1f} % was kept in the median\n", "",
                         figures.paths_kept.size(), figures.near_misses, 100.0 * quantile(figures.paths_kept, 0.5));
  }
  return table;
}

}  // namespace sweep_guard_evaluation
