#pragma once

#include <QWidget>

#include "rviz/level_history.h"

namespace sweep_guard_rviz {

/// The last 20 s: above, the time to the collision as a line that sinks towards 0; below, the level as a step whose
/// height tells it as well as its colour. Now is at the right.
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
