"""Fits a line to figures of a long run, and says whether they grow."""
import collections
import math

import numpy

Trend = collections.namedtuple('Trend', 'slope error blocks level')  # per hour, half of the 95 % interval
MIN_BLOCKS = 6


def quantile_of_t(freedom):
    """0.975 quantile of Student's t, to 1 % from 3 degrees of freedom on."""
    z = 1.959964
    g1, g2 = (z**3 + z) / 4.0, (5.0 * z**5 + 16.0 * z**3 + 3.0 * z) / 96.0
    g3 = (3.0 * z**7 + 19.0 * z**5 + 17.0 * z**3 - 15.0 * z) / 384.0
    return z + g1 / freedom + g2 / freedom**2 + g3 / freedom**3


def block_means(samples, period):
    """Means over `period` [s] of each group. samples: (group, time [s], value)"""
    blocks = collections.defaultdict(list)
    for group, at, value in samples:
        blocks[group, math.floor(at / period)].append((at, value))
    return [(group, *numpy.mean(values, axis=0)) for (group, _), values in sorted(blocks.items())]


def fit(samples, period):
    """Slope of the values, the same for all groups, each with a level of its own. None: there are too few.

    The groups are the processes of a guard that was restarted. Means over `period` [s] are fitted; where residuals follow
    each other, the interval is widened as for an autoregressive process of first order.
    """
    blocks = block_means(samples, period)
    sizes = collections.Counter(group for group, _, _ in blocks)
    blocks = [block for block in blocks if sizes[block[0]] > 1]
    freedom = len(blocks) - len({group for group, _, _ in blocks}) - 1
    if len(blocks) < MIN_BLOCKS or freedom < 3:
        return None
    rows = numpy.empty((0, 2))
    for name in sorted({group for group, _, _ in blocks}):
        values = numpy.array([(at / 3600.0, value) for group, at, value in blocks if group == name])
        rows = numpy.vstack([rows, values - values.mean(axis=0)])
    spread = (rows[:, 0]**2).sum()
    slope = (rows[:, 0] * rows[:, 1]).sum() / spread
    residuals = rows[:, 1] - slope * rows[:, 0]
    variance = (residuals**2).sum() / freedom
    follows = (residuals[1:] * residuals[:-1]).sum() / max((residuals**2).sum(), 1e-300)
    follows = min(max(follows, 0.0), 0.9)
    error = quantile_of_t(freedom) * math.sqrt(variance / spread * (1.0 + follows) / (1.0 - follows))
    return Trend(slope, error, len(blocks), float(numpy.mean([value for _, _, value in blocks])))


def is_flat(trend, negligible):
    """Flat: zero lies within the 95 % interval of the slope or above it, or the slope is at most `negligible` per hour."""
    return trend.slope - trend.error <= 0.0 or trend.slope <= negligible
