#pragma once

#include <QWidget>
#include <deque>
#include <optional>

#include "rviz/panel_state.h"

namespace sweep_guard_rviz {

/// The time span of the strip chart.
constexpr auto kHistory = std::chrono::seconds(20);

/// Keeps the levels and times to collision of the last kHistory.
class LevelHistory {
 public:
  struct Sample {
    SteadyTime since;  ///< start; the sample holds until the next one
    WarningLevel level;
    std::optional<double> time;  ///< time to collision [s], >= 0; empty: none or not known
  };

  /// Adds a sample; one that is earlier than the newest gets the time of the newest. Drops samples that ended more than
  /// kHistory ago.
  void add(Sample sample);
  void clear() { samples_.clear(); }

  const std::deque<Sample>& samples() const { return samples_; }  ///< ascending in time

  /// Returns the largest time to collision kept [s], or 0 if there is none.
  double longestTime() const;

 private:
  std::deque<Sample> samples_;
};

/// Draws the last 20 s, with the present at the right: above, the time to collision as a line; below, the level as
/// steps that differ by height and color.
class StripChart : public QWidget {
 public:
  explicit StripChart(QWidget* parent = nullptr);

  void show(const LevelHistory& history, SteadyTime now);

  QSize sizeHint() const override { return {300, 130}; }
  QSize minimumSizeHint() const override { return {180, 120}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  LevelHistory history_;
  SteadyTime now_;
};

}  // namespace sweep_guard_rviz
