#!/usr/bin/env python3
"""The judge of the soak: finds what is planted, and nothing in the warnings of a guard that is right."""
import unittest
import unittest.mock

import availability
import judge
import trend
import world

BEGIN = 1600.0  # [s] of the monotonic clock, a multiple of world.CYCLE
LEAPS = world.TOOL_LEAP + world.PLATE_LEAP
HOLD = 0.5  # [s]


def nanoseconds(t):
    return int(round(1e9 * t))


def in_plate(t):
    tip, top = world.ends_in_world(*world.tool_in_tracker(t))
    height = world.plate_heights(t, tip[0])
    return tip[2] < height < top[2]


def in_contact(t):
    """Whether the tool was in contact within HOLD before t."""
    if any(leap <= t - BEGIN <= leap + HOLD for leap in LEAPS):
        return True
    return any(in_plate(t - HOLD * share / 20.0) for share in range(21))


def spoken(t, level=None, pose_at=None, published=None, run='first', reasons=0):
    if level is None:
        level = judge.CONTACT if in_contact(t) else judge.CLEAR
    stamp = nanoseconds(round(t, 3) if pose_at is None else pose_at)
    published = nanoseconds(t if published is None else published)
    return judge.Spoken(t, stamp, published, level, level == judge.CLEAR, reasons, 0, run, 'text')


class Soak:
    """Sends the whole cycle to a judge, and what a guard says to it."""

    def __init__(self, lost=lambda kind, t: False, stalled=None, lag=0.0):
        """lost: what never departs. stalled: from when to when [s] meshes are kept back, which then depart at once. lag: from the
        stamp of a mesh to its departure [s]"""
        self.judge = judge.Judge()
        self.lost = lost
        self.stalled = stalled
        self.lag = lag
        self.kept = []
        self.x = world.plate_corners()[0]

    def run(self, says=spoken, until=world.CYCLE):
        for millisecond in range(int(1000 * until)):
            t = BEGIN + 0.001 * millisecond
            if millisecond % 20 == 0 and not self.lost('tf', t - BEGIN):
                self.judge.transform(t, nanoseconds(t + 0.1))
            if millisecond % 16 == 0 and not self.lost('mesh', t - BEGIN):
                self.send_mesh(t)
            if not self.lost('pose', t - BEGIN):
                self.judge.pose(t, nanoseconds(t), *world.ends_in_world(*world.tool_in_tracker(t)))
            if millisecond % 50 == 0 and millisecond > 0:
                said = says(t)
                if said is not None:
                    self.judge.warning(said, nanoseconds(t))
            if millisecond % 500 == 0:
                self.judge.judge_contacts(t - 1.0)
        self.judge.judge_contacts(BEGIN + until)
        return self.judge

    def send_mesh(self, t):
        self.kept.append((nanoseconds(t), world.plate_heights(t, self.x)))
        if self.stalled and self.stalled[0] <= t - BEGIN < self.stalled[1]:
            return
        for stamp, heights in self.kept:
            self.judge.mesh(t + self.lag, stamp, heights, late=nanoseconds(t) - stamp > 1e9 * judge.MAX_LAG)
        self.kept = []

    def kinds(self, says=spoken, until=world.CYCLE):
        return {finding.kind for finding in self.run(says, until).findings}


def levels_but(begin, end, level):
    """A guard that is right, but between two times of the cycle."""
    return lambda t: spoken(t, level) if begin <= t - BEGIN < end else spoken(t)


class JudgeTest(unittest.TestCase):
    def test_finds_nothing_in_the_warnings_of_a_guard_that_is_right(self):
        judged = Soak().run()
        self.assertEqual(judged.findings, [])
        self.assertEqual(judged.counts['contacts judged'], 6)  # two dips, four leaps
        self.assertGreater(judged.counts['CLEAR with a decided place'], 100)
        self.assertGreater(judged.counts['poses with a decided side'], 0.8 * judged.counts['poses'])

    def test_finds_clear_in_the_plate(self):
        self.assertIn('false CLEAR', Soak().kinds(levels_but(3.4, 3.5, judge.CLEAR)))

    def test_finds_a_dip_that_was_not_warned_of(self):
        unknown = levels_but(2.0, 5.0, judge.UNKNOWN)
        self.assertEqual(Soak().kinds(unknown), {'missed contact'})

    def test_finds_a_leap_of_the_tool_through_the_plate_that_was_not_warned_of(self):
        self.assertEqual(Soak().kinds(levels_but(5.9, 6.9, judge.CLEAR)), {'missed contact'})

    def test_finds_a_leap_of_the_plate_over_the_tool_that_was_not_warned_of(self):
        self.assertEqual(Soak().kinds(levels_but(10.9, 11.9, judge.CLEAR)), {'missed contact'})

    def test_finds_a_contact_across_a_gap_of_the_poses(self):
        gap = lambda kind, t: kind == 'pose' and 5.5 <= t < 6.3
        says = lambda t: spoken(t, judge.UNKNOWN, pose_at=BEGIN + 5.499 if t - BEGIN < 6.3 else None) \
            if 5.5 <= t - BEGIN < 7.15 else spoken(t)
        self.assertEqual(Soak(gap).kinds(says), {'missed contact'})

    def test_finds_clear_on_a_stale_pose(self):
        says = lambda t: spoken(t, pose_at=round(t - 0.11, 3)) if 1.0 <= t - BEGIN < 1.1 else spoken(t)
        self.assertEqual(Soak().kinds(says), {'false CLEAR'})
        says = lambda t: spoken(t, pose_at=round(t - 0.09, 3)) if 1.0 <= t - BEGIN < 1.1 else spoken(t)
        self.assertEqual(Soak().kinds(says), set())

    def test_finds_clear_without_fresh_meshes(self):
        silent = lambda kind, t: kind == 'mesh' and 0.5 <= t < 2.5
        self.assertEqual(Soak(silent).kinds(), {'false CLEAR'})
        brief = lambda kind, t: kind == 'mesh' and 0.5 <= t < 0.98
        self.assertEqual(Soak(brief).kinds(), set())

    def test_takes_no_mesh_and_no_transform_from_far_ahead_for_a_fresh_one(self):
        for kind in ('mesh', 'tf'):
            soak = Soak(lambda lost, t, kind=kind: lost == kind and 0.5 <= t < 2.0)
            soak.judge.mesh(BEGIN + 0.5, nanoseconds(BEGIN + 3.0), world.plate_heights(BEGIN, soak.x), ahead=True)
            soak.judge.transform(BEGIN + 0.5, nanoseconds(BEGIN + 20.0), ahead=True)
            self.assertEqual(soak.kinds(until=2.0), {'false CLEAR'})

    def test_finds_clear_without_a_transform(self):
        silent = lambda kind, t: kind == 'tf' and 0.5 <= t < 2.0
        self.assertEqual(Soak(silent).kinds(), {'false CLEAR'})

    def test_finds_clear_on_a_pose_that_was_not_sent(self):
        says = lambda t: spoken(t, pose_at=round(t, 3) - 0.0005) if 1.0 <= t - BEGIN < 1.1 else spoken(t)
        self.assertEqual(Soak().kinds(says), {'false CLEAR'})

    def test_finds_clear_that_is_valid_for_too_long(self):
        says = lambda t: spoken(t, published=t + 0.05) if 1.0 <= t - BEGIN < 1.1 else spoken(t)
        self.assertEqual(Soak().kinds(says), {'false CLEAR'})

    def test_takes_no_unknown_for_one_of_the_wrong_time_while_the_guard_hears_no_clock(self):
        def kinds(level, heard_after):
            soak = Soak()
            soak.run(until=2.0)
            soak.judge.clock(BEGIN + 1.0, nanoseconds(BEGIN + 1.0))
            soak.judge.clock_step(BEGIN + 1.001, BEGIN + 1.002)
            if heard_after is not None:
                soak.judge.clock(BEGIN + heard_after, nanoseconds(BEGIN - 3.0))
            said = spoken(BEGIN + 2.0, level, BEGIN + 0.9, BEGIN + 1.0)
            soak.judge.warning(said, nanoseconds(BEGIN - 2.0))
            return {finding.kind for finding in soak.judge.findings}
        self.assertEqual(kinds(judge.UNKNOWN, None), set())
        self.assertEqual(kinds(judge.UNKNOWN, 1.6), set())
        self.assertEqual(kinds(judge.UNKNOWN, 1.3), {'wrong time'})
        self.assertIn('false CLEAR', kinds(judge.CLEAR, None))

    def test_finds_clear_while_the_clock_stands_still_and_nothing_is_sent(self):
        silent = lambda kind, t: t >= 1.0
        soak = Soak(silent)
        soak.run(until=1.0)
        stands = nanoseconds(BEGIN + 0.999)
        for t, kinds in ((1.2, set()), (1.5, {'false CLEAR'})):
            said = judge.Spoken(BEGIN + t, stands, stands, judge.CLEAR, True, 0, 0, 'first', 'text')
            soak.judge.warning(said, stands)
            self.assertEqual({finding.kind for finding in soak.judge.findings}, kinds)

    def test_finds_clear_of_a_disabled_guard(self):
        soak = Soak()
        soak.judge.disabled.append((BEGIN + 0.5, BEGIN + 1.5))
        self.assertEqual(soak.kinds(until=2.0), {'false CLEAR'})

    def test_finds_contact_that_is_said_only_once_the_tool_has_left(self):
        late = lambda t: spoken(t, judge.CLEAR if t - BEGIN < 6.2 else judge.CONTACT) if 5.9 <= t - BEGIN < 6.9 else spoken(t)
        self.assertEqual(Soak().kinds(late), {'missed contact'})

    def test_excuses_no_contact_by_what_is_refused_only_afterwards(self):
        refused = lambda t: spoken(t, judge.UNKNOWN, reasons=256) if 6.3 <= t - BEGIN < 6.9 else \
            spoken(t, judge.CLEAR) if 5.9 <= t - BEGIN < 6.3 else spoken(t)
        self.assertEqual(Soak().kinds(refused), {'missed contact'})

    def test_excuses_a_pose_that_was_not_sent_by_garbled_poses_alone(self):
        says = lambda t: spoken(t, pose_at=round(t, 3) - 0.0005) if 1.0 <= t - BEGIN < 1.1 else spoken(t)
        for target, kinds in (('poses', set()), ('tf', {'false CLEAR'})):
            soak = Soak()
            soak.judge.excuse(BEGIN, BEGIN + 2.0, 'garbled ' + target)
            self.assertEqual(soak.kinds(says, until=2.0), kinds)

    def test_takes_a_level_that_is_only_held_for_no_warning(self):
        held = lambda t: spoken(t, judge.CONTACT)._replace(held_since=nanoseconds(BEGIN + 2.0)) \
            if 2.0 <= t - BEGIN < 5.0 else spoken(t)
        self.assertEqual(Soak().kinds(held), {'missed contact'})

    def test_judges_no_contact_that_is_intended_or_between_two_guards(self):
        soak = Soak()
        soak.judge.intended.append((BEGIN + 2.5, BEGIN + 5.0))
        self.assertEqual(soak.kinds(levels_but(2.6, 4.9, judge.CLEAR)), set())
        restarted = lambda t: spoken(t, judge.UNKNOWN, run='second') if t - BEGIN > 3.5 else spoken(t)
        self.assertEqual(Soak().kinds(restarted, until=5.0), set())

    def test_judges_no_contact_with_a_plate_of_which_the_guard_heard_late(self):
        says = lambda t: spoken(t, judge.UNKNOWN) if 10.8 <= t - BEGIN < 12.4 else spoken(t)
        self.assertEqual(Soak(stalled=(10.7, 12.4)).kinds(says), set())
        self.assertEqual(Soak().kinds(says), {'missed contact'})

    def test_judges_no_contact_with_a_plate_that_leaps_while_it_is_silent_for_longer_than_the_guard_sweeps(self):
        leap = world.PLATE_LEAP[0]
        silent = lambda kind, t: kind == 'mesh' and leap - 0.2 <= t < leap + 1.3
        for lag in (0.0, 0.02):
            judged = Soak(silent, lag=lag).run(levels_but(leap - 0.2, leap + 1.3, judge.UNKNOWN))
            self.assertEqual(judged.findings, [])
            self.assertEqual(judged.counts['contacts not judged: mesh silent'], 1)

    def test_takes_poses_before_and_after_a_step_of_the_clock_for_no_leap(self):
        stamped = nanoseconds
        stepped = lambda t: stamped(t if t < BEGIN + 6.2 else t - 3.0)
        soak = Soak(lost=lambda kind, t: kind == 'pose' and 5.5 <= t < 6.3)
        soak.judge.clock_step(BEGIN + 6.2, BEGIN + 6.201)
        with unittest.mock.patch(f'{__name__}.nanoseconds', stepped):
            says = lambda t: spoken(t, judge.UNKNOWN) if 5.5 <= t - BEGIN < 7.15 else spoken(t)
            self.assertNotIn('missed contact', soak.kinds(says))

    def judged_late(self, stepped_at, own_delay):
        """Judges a CLEAR of the second 1, which waited while the clock stepped back."""
        judged = Soak().run(until=1.0)
        judged.clock_step(BEGIN + stepped_at, BEGIN + stepped_at + 0.001)
        judged.warning(spoken(BEGIN + 0.999), nanoseconds(BEGIN - 3.0), own_delay)
        return [finding.kind for finding in judged.findings]

    def test_a_warning_that_waited_while_the_clock_stepped_is_not_of_the_wrong_time(self):
        self.assertEqual(self.judged_late(stepped_at=1.002, own_delay=0.01), [])
        self.assertEqual(self.judged_late(stepped_at=1.1, own_delay=0.01), ['false CLEAR'])

    def test_decides_nothing_near_the_plate(self):
        soak = Soak().run(until=1.0)
        height = float(world.plate_heights(BEGIN + 0.9, 0.0))
        for z, side in ((0.02, judge.ABOVE), (-0.03, judge.CROSSING), (-0.2, judge.BELOW), (0.001, judge.UNDECIDED)):
            pose = judge.Pose(BEGIN + 0.9, nanoseconds(BEGIN + 0.9), (0.0, 0.0, height + z), (0.0, 0.0, height + z + 0.15), True)
            self.assertEqual(soak._side_of([pose])[0], side)


class AvailabilityTest(unittest.TestCase):
    def longest(self, departs, acts=lambda _: False):
        """Longest time counted in a minute of UNKNOWN. departs: whether clock and poses do so at a time"""
        available = availability.Availability()
        for step in range(6000):
            at = 0.01 * step
            if departs(at):
                available.departed('clock', at)
                available.departed('tool_pose', at)
            available.acting = acts(at)
            available.heard(at, unknown=True)
        return available.longest

    def test_counts_what_no_disturbance_explains(self):
        self.assertAlmostEqual(self.longest(lambda _: True), 60.0, delta=0.1)

    def test_counts_nothing_while_processes_end_and_start(self):
        self.assertAlmostEqual(self.longest(lambda _: True, acts=lambda at: 2.0 < at < 30.0), 30.0, delta=0.1)

    def test_a_gap_of_what_departs_is_a_disturbance(self):
        self.assertAlmostEqual(self.longest(lambda at: not 5.0 < at < 20.0), 40.0, delta=0.1)

    def test_a_guard_that_never_connects_has_no_excuse(self):
        self.assertAlmostEqual(self.longest(lambda at: at < 5.0), 60.0 - 25.0, delta=0.1)


class TrendTest(unittest.TestCase):
    def samples(self, growth, noise=1.0):
        """An hour of two processes. growth: per hour"""
        value = 0.5
        for at in range(3600):
            value = (value * 9301.0 + 0.49297) % 1.0
            group = 'first' if at < 1500 else 'second'
            yield group, float(at), (50.0 if group == 'first' else 90.0) + growth * at / 3600.0 + noise * (value - 0.5)

    def test_finds_planted_growth_and_its_size(self):
        fitted = trend.fit(self.samples(growth=5.0), 60.0)
        self.assertFalse(trend.is_flat(fitted, negligible=1.0))
        self.assertLess(abs(fitted.slope - 5.0), fitted.error)
        self.assertLess(fitted.error, 1.0)

    def test_takes_noise_and_another_process_for_no_growth(self):
        self.assertTrue(trend.is_flat(trend.fit(self.samples(growth=0.0), 60.0), negligible=0.0))
        self.assertTrue(trend.is_flat(trend.fit(self.samples(growth=0.5), 60.0), negligible=1.0))

    def test_says_nothing_about_too_few(self):
        self.assertIsNone(trend.fit(list(self.samples(growth=0.0))[:180], 60.0))

    def test_knows_the_quantiles_of_t(self):
        for freedom, quantile in ((4, 2.776), (10, 2.228), (100, 1.984)):
            self.assertAlmostEqual(trend.quantile_of_t(freedom), quantile, delta=0.01 * quantile)


if __name__ == '__main__':
    unittest.main()
