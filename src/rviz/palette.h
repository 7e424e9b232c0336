#pragma once

#include <QColor>

#include "rviz/panel_state.h"

namespace sweep_guard_rviz {

/// Grey, green, amber, red, red.
QColor colorOf(Light light);

/// What is read best on that colour.
QColor inkOn(Light light);

/// Behind everything that is not lit.
QColor backdrop();

/// What is there, but not lit.
QColor unlit();

}  // namespace sweep_guard_rviz
