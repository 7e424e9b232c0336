#pragma once

#include <QWidget>

#include "rviz/level_history.h"

namespace sweep_guard_rviz {

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
