#pragma once

#include <QWidget>

#include "rviz/panel_state.h"

namespace sweep_guard_rviz {

/// The level as a colour that fills the widget, a lamp of its own place and shape, and a word, with the time to the
/// collision beside it. Clear is a small green lamp on a dark ground: what fills the widget asks for attention.
///
/// Lamps from above: contact a cross in a square, reflex a bar in an octagon, both on top; considered a triangle in the
/// middle; clear a tick in a small disc below. Unknown lights none of them: a question mark stands across.
class TrafficLight : public QWidget {
 public:
  explicit TrafficLight(QWidget* parent = nullptr);

  void show(const PanelState& state);

  QSize sizeHint() const override { return {300, 170}; }
  QSize minimumSizeHint() const override { return {220, 150}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  PanelState state_;
};

}  // namespace sweep_guard_rviz
