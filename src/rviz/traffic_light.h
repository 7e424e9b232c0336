#pragma once

#include <QWidget>

#include "rviz/panel_state.h"

namespace sweep_guard_rviz {

/// Shows the level by a lamp of its own place and shape, by name and, except for CLEAR, by a color that fills the
/// widget. Shows the time to collision beside it.
///
/// Lamps: CONTACT is a cross in a square and REFLEX a bar in an octagon, both at the top; CONSIDERED is a triangle in
/// the middle; CLEAR is a tick in a small disc at the bottom, on a dark ground. UNKNOWN is a question mark instead of a
/// lamp.
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
