#pragma once

#include <QColor>

#include "rviz/panel_state.h"

namespace sweep_guard_rviz {

/// Returns the color of a level (kLevelStyles).
QColor colorOf(WarningLevel level);

/// Returns the color of text that is easiest to read on the color of a level.
QColor inkOn(WarningLevel level);

QColor heldColor(bool stopped);  ///< behind the reason why a motion guard holds the robot back
QColor backdrop();               ///< behind the lamps
QColor unlit();                  ///< of a lamp that is off

}  // namespace sweep_guard_rviz
