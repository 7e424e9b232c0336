"""Judges every warning of the guard by what the guard was sent. Shares no code with the guard.

The axis of the tool is a line from tip to top, the plate a height field whose triangles lie, within a cell, between its lowest
and its highest corner. Where one end of the axis is below the plate and the other above it, the tool is in contact. Where the
axis is above the plate at one pose and below it at the next, the tool has met it in between, however both moved. All that is
nearer than BAND stays undecided; so does what depends on which of several meshes the guard uses, because each that may be the
newest it has must give the same answer.
"""
import collections

import numpy

import world

BAND = 0.002  # [m] undecided on both sides of the plate
MESH_TIMEOUT = 0.5  # [s] as documented: an older workpiece makes the warning UNKNOWN
VALID = 0.2  # [s] of a warning
ROUNDING = 0.002  # [s]
SLACK = 0.25  # [s] that the guard and the network may take beyond a timeout where only receipt can be measured
KEPT = 30.0  # [s] of inputs
MAX_LAG = 0.25  # [s] from stamp to departure; the guard may treat what is later as too old
MESH_LEAD = 0.6  # [s] of a stamp before the clock at departure: the guard refuses what is further ahead
TRANSFORM_LEAD = 10.1  # [s] the same
ABOVE, CROSSING, BELOW, UNDECIDED = 1, 2, 3, 0
CLEAR, CONTACT, UNKNOWN = 1, 4, 0  # as in Warning
# Reasons that say that an input was refused, or forgotten, or that nothing was tested: NO_POSE, POSE_INVALID, OUT_OF_ORDER,
# FUTURE_STAMP, NO_MESH, TF_FAIL, TIME_JUMP, DISABLED.
NOT_TAKEN = 1 | 4 | 8 | 16 | 32 | 256 | 512 | 16384

Pose = collections.namedtuple('Pose', 'at stamp tip top sure')  # at: departure [s] of the monotonic clock; stamp [ns]
Mesh = collections.namedtuple('Mesh', 'at stamp heights renewed late ahead')  # heights: None if the vertices are on no grid
Transform = collections.namedtuple('Transform', 'at stamp ahead')
Spoken = collections.namedtuple('Spoken', 'at stamp published level clear reasons held_since run text')
Finding = collections.namedtuple('Finding', 'kind at text')
Excuse = collections.namedtuple('Excuse', 'begin end why')
Span = collections.namedtuple('Span', 'begin end what')  # two poses between which, or at which, there was contact


def seconds(nanoseconds):
    return 1e-9 * nanoseconds


def cells_below(points):
    """Indices of the cell of the plate that each point is above or below, and whether there is one."""
    place = (points[:, :2] + world.HALF_WIDTH) * (world.CELLS / (2.0 * world.HALF_WIDTH))
    inside = ((place > 1.0) & (place < world.CELLS - 1.0)).all(axis=1)
    cell = numpy.clip(numpy.nan_to_num(place), 0, world.CELLS - 1).astype(int)
    return cell[:, 0], cell[:, 1], inside


def heights_over(points, meshes):
    """Lowest and highest corner of the cell of each point, in arrays of shape (meshes, points), and which points have one."""
    i, j, inside = cells_below(points)
    rows, columns = numpy.stack([i, i + 1, i, i + 1]), numpy.stack([j, j, j + 1, j + 1])
    corners = numpy.stack([mesh.heights[rows, columns] for mesh in meshes])
    return corners.min(axis=1), corners.max(axis=1), inside


def sides(poses, meshes, used):
    """Which side of the plate the tool is on at each pose, whichever of the meshes counts.

    used: array of shape (meshes, poses): whether the guard may have used the mesh for the pose
    """
    tips = numpy.array([pose.tip for pose in poses])
    tops = numpy.array([pose.top for pose in poses])
    tip_low, tip_high, tip_inside = heights_over(tips, meshes)
    top_low, top_high, top_inside = heights_over(tops, meshes)
    each = numpy.zeros(used.shape, dtype=int)
    tip_above, tip_below = tips[:, 2] > tip_high + BAND, tips[:, 2] < tip_low - BAND
    top_above, top_below = tops[:, 2] > top_high + BAND, tops[:, 2] < top_low - BAND
    each[tip_above & top_above] = ABOVE
    each[tip_below & top_above] = CROSSING
    each[tip_below & top_below] = BELOW
    answer = numpy.full(len(poses), UNDECIDED)
    for side in (ABOVE, CROSSING, BELOW):
        answer[used.any(axis=0) & (~used | (each == side)).all(axis=0) & tip_inside & top_inside] = side
    return answer


class Judge:
    def __init__(self):
        self.poses, self.meshes, self.transforms = collections.deque(), collections.deque(), collections.deque()
        self.by_stamp = {}  # poses
        self.spoken = collections.deque()
        self.excuses, self.disabled, self.intended = [], [], []
        self.clock_steps = []  # not before and not after when [s]
        self.clocks = collections.deque()  # of each /clock: departure [s], what it says [ns]; none: stamps are of the wall clock
        self.pose_timeouts = [(0.0, 0.1)]  # from when on [s] which [s]
        self.findings = []
        self.counts = collections.Counter()
        self.open_spans = []
        self.last = None  # newest decided pose and its side
        self.crossing = None  # first pose of a contact that lasts
        self.judged_until = 0.0

    # What was sent: call these before it can arrive.

    def pose(self, at, stamp, tip, top, sure=True):
        late = self.transforms and self.transforms[-1].stamp < stamp
        pose = Pose(at, stamp, tip, top, bool(sure and self.transforms and not late))
        self.poses.append(pose)
        self.by_stamp.setdefault(stamp, []).append(pose)

    def mesh(self, at, stamp, heights, renewed=False, late=False, ahead=False):
        """late: departed more than MAX_LAG after its stamp; ahead: more than MESH_LEAD before it"""
        self.meshes.append(Mesh(at, stamp, heights, renewed, late, ahead))

    def transform(self, at, stamp, ahead=False):
        """ahead: departed more than TRANSFORM_LEAD before its stamp"""
        self.transforms.append(Transform(at, stamp, ahead))

    def clock(self, at, stamp):
        self.clocks.append((at, stamp))

    def clock_step(self, begin, end):
        """The clock of the stamps has stepped between these times: what was sent before does not count any more."""
        self.clock_steps.append((begin, end))
        self.excuse(begin - 0.5, end + 1.0, 'the clock stepped')

    def excuse(self, begin, end, why):
        """Contacts of this time are not judged. CLEAR still is."""
        self.excuses.append(Excuse(begin, end, why))

    # What was heard.

    def warning(self, spoken, stamp_clock, own_delay=0.0):
        """spoken.at: receipt; stamp_clock: [ns] now; own_delay: how late [s] that is, and the receipt may have been noted"""
        self.spoken.append(spoken)
        self.counts['warnings'] += 1
        latest = stamp_clock if spoken.clear else self._latest_heard(spoken.at - 0.5 - own_delay, stamp_clock)
        if spoken.published > latest + 1e9 * ROUNDING and not self._just_stepped(spoken.at, own_delay):
            self._find('false CLEAR' if spoken.clear else 'wrong time', spoken, 'is valid for longer than 0.2 s')
        if spoken.clear != (spoken.level == CLEAR):
            self._find('false CLEAR', spoken, 'clear contradicts the level')
        if spoken.level == CLEAR or spoken.clear:
            self.counts['CLEAR judged'] += 1
            self._judge_clear(spoken, stamp_clock, own_delay)

    def _latest_heard(self, since, stamp_clock):
        """The latest that the guard's clock may say [ns]: what it was sent last, which may be long ago."""
        latest = stamp_clock
        for at, stamp in reversed(self.clocks):
            latest = max(latest, stamp)
            if at < since:
                break
        return latest

    def _just_stepped(self, at, own_delay):
        """The guard's clock comes by a connection of its own, and what it says may wait for the judge."""
        return any(begin <= at + own_delay and at - 0.5 - own_delay <= end for begin, end in self.clock_steps)

    def _stepped_between(self, first, second):
        return any(begin <= second and first <= end for begin, end in self.clock_steps)

    def _find(self, kind, spoken, why):
        self.findings.append(Finding(kind, spoken.at, f'{why}: "{spoken.text}", pose {seconds(spoken.stamp):.4f}, '
                                     f'published {seconds(spoken.published):.4f}'))

    def _pose_timeout(self, at):
        recent = [timeout for begin, timeout in self.pose_timeouts if begin > at - 2.0]
        return max(recent + [[timeout for begin, timeout in self.pose_timeouts if begin <= at - 2.0][-1]])

    def _judge_clear(self, spoken, stamp_clock, own_delay):
        timeout = self._pose_timeout(spoken.at)
        find = lambda why: self._find('false CLEAR', spoken, why)
        if any(begin < spoken.at - own_delay - SLACK and spoken.at < end for begin, end in self.disabled):
            find('the guard is disabled')
        if self._just_stepped(spoken.at, own_delay):
            self.counts['CLEAR just after a step of the clock'] += 1
        else:
            self._judge_ages(spoken, timeout, find)
            if spoken.published + 1e9 * VALID >= stamp_clock:
                self._judge_silence(spoken, own_delay, timeout, find)
        self._judge_place(spoken, find)

    def _judge_ages(self, spoken, timeout, find):
        """By the stamps, which no delay of the judge's own changes."""
        if seconds(spoken.published - spoken.stamp) > timeout + ROUNDING:
            find(f'the pose is older than {timeout:g} s')
        since = max((begin for begin, _ in self.clock_steps if begin <= spoken.at), default=0.0)
        newest = lambda inputs: max((one.stamp for one in inputs if since <= one.at <= spoken.at and not one.ahead), default=0)
        if seconds(spoken.published - newest(self.meshes)) > MESH_TIMEOUT + ROUNDING:
            find('no mesh of the last 0.5 s was sent')
        if newest(self.transforms) < spoken.stamp:
            find('no transform for the pose was sent')

    def _judge_silence(self, spoken, own_delay, timeout, find):
        """By receipt, for clocks that stand still."""
        for inputs, limit, what in ((self.poses, timeout, 'pose'), (self.meshes, MESH_TIMEOUT, 'mesh')):
            newest = next((one.at for one in reversed(inputs) if one.at <= spoken.at), 0.0)
            if spoken.at - own_delay - newest > limit + SLACK:
                find(f'no {what} has been sent for {spoken.at - newest:.2f} s')

    def _judge_place(self, spoken, find):
        rests_on = self.by_stamp.get(spoken.stamp, [])
        if not rests_on:
            if not self._excused(spoken.at - 2.0, spoken.at, 'garbled poses'):
                find('rests on a pose that was not sent')
            return
        if self._intended(spoken.at):
            return
        side = self._side_of([rests_on[-1]], spoken.at)[0]
        self.counts['CLEAR with a decided place'] += side != UNDECIDED
        if side == CROSSING:
            find('the tool is in the plate')

    def _intended(self, at):
        return any(begin <= at <= end for begin, end in self.intended)

    def _excused(self, begin, end, why=None):
        return [excuse.why for excuse in self.excuses
                if excuse.begin <= end and begin <= excuse.end and why in (None, excuse.why)]

    def _side_of(self, poses, heard=None):
        """Sides of the tool at these poses. heard: when the guard spoke; None: any time after."""
        meshes = [mesh for mesh in self.meshes if heard is None or mesh.at <= heard]
        if not meshes:
            return numpy.full(len(poses), UNDECIDED)
        first = min(pose.stamp for pose in poses) - 1e9 * (MESH_TIMEOUT + 0.05)
        last = max(pose.stamp for pose in poses) + 1e9 * 0.3
        meshes = [mesh for mesh in meshes if first <= mesh.stamp <= last]
        if not meshes or any(mesh.heights is None for mesh in meshes):
            return numpy.full(len(poses), UNDECIDED)
        ages = numpy.array([pose.stamp for pose in poses])[None, :] - numpy.array([m.stamp for m in meshes])[:, None]
        return sides(poses, meshes, (ages <= 1e9 * (MESH_TIMEOUT + 0.05)) & (ages >= -1e9 * 0.3))

    # Contacts: what was certain a while ago has to have been warned of.

    def judge_contacts(self, until):
        """Judges the poses that departed before `until` [s]; all that the guard may have used for them has to be known."""
        departed = [pose for pose in self.poses if self.judged_until <= pose.at < until]
        ready = [pose for pose in departed if pose.sure]
        self.counts['poses'] += len(departed)
        self.judged_until = max(until, self.judged_until)
        for begin in range(0, len(ready), 256):
            batch = ready[begin:begin + 256]
            for pose, side in zip(batch, self._side_of(batch)):
                if side != UNDECIDED:
                    self.counts['poses with a decided side'] += 1
                    self._follow(pose, side)
        self._settle(until)
        self._forget(until - KEPT)

    def _follow(self, pose, side):
        before, self.last = self.last, (pose, side)
        if before and self._stepped_between(before[0].at, pose.at):
            before, self.crossing = None, None
        if side == CROSSING:
            self.crossing = self.crossing or pose
            return
        if self.crossing:
            self.open_spans.append(Span(self.crossing, before[0], 'the tool was in the plate'))
            self.crossing = None
        elif before and before[1] != side:
            self.open_spans.append(Span(before[0], pose, 'the tool and the plate passed through each other'))

    def _settle(self, now):
        waiting = []
        for span in self.open_spans:
            heard = [one for one in self.spoken if one.at >= span.begin.at]
            beyond = [one for one in heard if one.stamp >= span.end.stamp and one.at <= now]
            if beyond and beyond[0].at + 0.5 <= now:
                self._judge_span(span, heard, beyond[0])
            elif span.end.at + 20.0 > now:
                waiting.append(span)
            else:
                self.counts['contacts that the guard never came to'] += 1
        self.open_spans = waiting

    def _judge_span(self, span, heard, beyond):
        """beyond: first warning that rests on a pose after the span, by which CONTACT has to have been said"""
        before = [one for one in self.spoken if one.at < span.begin.at][-1:]
        until = beyond.at
        said = [one for one in heard if one.at <= until]
        why = self._excused(span.begin.at - 0.3, until) or [
            'not taken' for one in said if one.reasons & NOT_TAKEN] or self._mesh_excuse(span)
        if why or self._intended(span.begin.at) or self._intended(until):
            self.counts['contacts not judged: ' + (why[0] if why else 'intended')] += 1
        elif not before or before[0].run != beyond.run:
            self.counts['contacts not judged: another guard'] += 1
        else:
            self.counts['contacts judged'] += 1
            if not any(one.level == CONTACT and (one.held_since == 0 or one.held_since >= span.begin.stamp - 1e6)
                       for one in said):
                levels = ' '.join(f'{one.at - span.begin.at:.2f}:{one.level}' for one in said[-8:])
                self._find('missed contact', beyond, f'{span.what} from {seconds(span.begin.stamp):.4f} to '
                           f'{seconds(span.end.stamp):.4f} and the levels were {levels}')

    def _mesh_excuse(self, span):
        first, last = span.begin.stamp - 1e9 * (MESH_TIMEOUT + 0.05), span.end.stamp + 1e9 * 0.3
        # With all by which the sides were decided: the first one after a silence departs later than its stamp.
        near = [mesh for mesh in self.meshes
                if span.begin.at - 0.8 <= mesh.at and (mesh.at <= span.end.at + 0.3 or mesh.stamp <= last)]
        if any(mesh.late for mesh in self.meshes if first <= mesh.stamp <= last):
            return ['mesh late']
        gaps = [b.at - a.at for a, b in zip(near, near[1:])]
        if any(mesh.renewed for mesh in near):
            return ['mesh renewed']
        return ['mesh silent'] if len(near) < 2 or max(gaps) > 0.4 else []

    def _forget(self, before):
        for kept in (self.poses, self.meshes, self.transforms, self.spoken):
            while kept and kept[0].at < before:
                gone = kept.popleft()
                if kept is self.poses:
                    self.by_stamp.pop(gone.stamp, None)
        while len(self.clocks) > 1 and self.clocks[1][0] < before:
            self.clocks.popleft()
