"""The world of the soak: a tool that moves above, into and below a plate that deforms."""
import math
import os
import struct
import time

import numpy

LENGTH = 0.15  # [m] tool/length
CELLS = 100  # along each side of the plate, two triangles each
HALF_WIDTH = 0.3  # [m] of the plate
CYCLE = 16.0  # [s] after which dips and leaps repeat
CLEARANCE = 0.1  # [m] of the tip above the mean height of the plate
DIPS = (3.0, 9.0)  # [s] in the cycle: for a second the tool dips into the plate
TOOL_LEAP = (6.0, 7.2)  # [s] in the cycle: from one pose to the next the tool is below the plate, and later back
PLATE_LEAP = (11.0, 12.5)  # [s] in the cycle: from one message to the next the plate is above the tool, and later back
LEAP_TO = -0.4  # [m] height of the tip below the plate
PLATE_LEAP_BY = 0.5  # [m]
MAX_TILT = 0.25  # [rad]
TRACKER_YAW = 0.5 * math.pi  # poses are in frame 'tracker', which stands so in 'world'
TRACKER_AT = (0.2, -0.1, 0.3)  # [m]


def multiply(p, q):
    """Product of two quaternions (x, y, z, w)."""
    (a, b, c, d), (e, f, g, h) = p, q
    return (d * e + a * h + b * g - c * f, d * f - a * g + b * h + c * e, d * g + a * f - b * e + c * h,
            d * h - a * e - b * f - c * g)


def tip_height(t):
    """Height [m] of the tip at time t [s] of the monotonic clock."""
    phase = t % CYCLE
    if TOOL_LEAP[0] <= phase < TOOL_LEAP[1]:
        return LEAP_TO
    for begin in DIPS:
        if begin <= phase < begin + 1.0:
            return 0.02 + (CLEARANCE - 0.02) * math.cos(2.0 * math.pi * (phase - begin))
    return CLEARANCE


def tool_in_world(t):
    """Position [m] of the tip and orientation (x, y, z, w) of the tool, whose z axis points out of the tip."""
    position = (0.08 * math.cos(0.7 * t), 0.08 * math.sin(0.9 * t), tip_height(t))
    half, about = 0.5 * MAX_TILT * math.sin(0.5 * t), 0.3 * t
    tilt = (math.sin(half) * math.cos(about), math.sin(half) * math.sin(about), 0.0, math.cos(half))
    spin = (0.0, 0.0, math.sin(0.4 * t), math.cos(0.4 * t))
    return position, multiply(tilt, multiply((1.0, 0.0, 0.0, 0.0), spin))


def tool_in_tracker(t):
    """The same in the frame 'tracker'."""
    (x, y, z), orientation = tool_in_world(t)
    x, y, z = x - TRACKER_AT[0], y - TRACKER_AT[1], z - TRACKER_AT[2]
    c, s = math.cos(TRACKER_YAW), math.sin(TRACKER_YAW)
    back = (0.0, 0.0, -math.sin(0.5 * TRACKER_YAW), math.cos(0.5 * TRACKER_YAW))
    return (c * x + s * y, -s * x + c * y, z), multiply(back, orientation)


def ends_in_world(position, orientation):
    """Tip and top of the tool's axis in 'world' [m], from its pose in 'tracker'."""
    x, y, z = position
    c, s = math.cos(TRACKER_YAW), math.sin(TRACKER_YAW)
    tip = (TRACKER_AT[0] + c * x - s * y, TRACKER_AT[1] + s * x + c * y, TRACKER_AT[2] + z)
    turn = (0.0, 0.0, math.sin(0.5 * TRACKER_YAW), math.cos(0.5 * TRACKER_YAW))
    a, b, c, d = multiply(turn, orientation)
    axis = (2.0 * (a * c + b * d), 2.0 * (b * c - a * d), 1.0 - 2.0 * (a * a + b * b))
    return tip, tuple(p - LENGTH * n for p, n in zip(tip, axis))


def plate_corners():
    """x and y [m] of every vertex, in two arrays of shape (CELLS + 1, CELLS + 1)."""
    line = numpy.linspace(-HALF_WIDTH, HALF_WIDTH, CELLS + 1)
    return numpy.meshgrid(line, line, indexing='ij')


def plate_faces():
    corner = numpy.arange((CELLS + 1) ** 2).reshape(CELLS + 1, CELLS + 1)
    a, b, c, d = (part.ravel() for part in (corner[:-1, :-1], corner[1:, :-1], corner[:-1, 1:], corner[1:, 1:]))
    return numpy.concatenate([numpy.stack([a, b, c], axis=1), numpy.stack([b, d, c], axis=1)])


def plate_heights(t, x):
    """Heights [m] of the vertices at time t [s] of the monotonic clock."""
    leap = PLATE_LEAP_BY if PLATE_LEAP[0] <= t % CYCLE < PLATE_LEAP[1] else 0.0
    return 0.02 * math.sin(0.6 * t) + leap + 0.005 * numpy.sin(20.0 * x + 2.0 * t)


class StampClock:
    """The clock of the stamps, which all processes of the soak share: the system's, or a simulated one with an offset."""
    _OFFSET = struct.Struct('<q')

    def __init__(self, path):
        self.path = path
        self.simulated = bool(path)
        self._file = os.open(path, os.O_RDWR | os.O_CREAT) if path else None

    def now(self):
        """Nanoseconds."""
        if not self.simulated:
            return time.time_ns()
        return time.monotonic_ns() + self._OFFSET.unpack(os.pread(self._file, 8, 0))[0]

    def set(self, nanoseconds):
        os.pwrite(self._file, self._OFFSET.pack(nanoseconds - time.monotonic_ns()), 0)

    def step(self, seconds):
        offset, = self._OFFSET.unpack(os.pread(self._file, 8, 0))
        os.pwrite(self._file, self._OFFSET.pack(offset + int(1e9 * seconds)), 0)
