#!/usr/bin/env python3
"""Runs a guard for a long time in a hostile world, and judges every warning by what the guard was sent.

Started by scripts/soak. The exit status is 0 only if no CLEAR was false, no contact was missed, the guard did not end by itself,
it was not UNKNOWN for long while all was well, and nothing grew.
"""
import argparse
import collections
import contextlib
import heapq
import os
import signal
import struct
import sys
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, '..', '..', 'scripts')]

import numpy  # noqa: E402
import rospy  # noqa: E402
from sweep_guard.msg import Contacts, DeformableMesh, MeshVertices, Warning  # noqa: E402

import calls  # noqa: E402
import judge  # noqa: E402
import process_table  # noqa: E402
import schedule  # noqa: E402
import trend  # noqa: E402
from transforms import TFMessage  # noqa: E402
import world  # noqa: E402
from availability import Availability  # noqa: E402
from guarded_world import GuardedWorld, corruption  # noqa: E402
from listener import Listener  # noqa: E402

GUARD = '/sweep_guard'
MAX_UNKNOWN = 15.0  # [s] UNKNOWN or silent, though all has been well for so long
POSE_HEADER = struct.Struct('<4xIII')  # geometry_msgs/PoseStamped: stamp, length of frame_id
POSE_VALUES = struct.Struct('<7d')
NICE = -10  # of the soak and the peers, where that is allowed, so that load delays the guard and not the judge
SETTLED = 2.5  # [s] after which contacts are judged
TREND_UNITS = {'resident memory': 'MB', 'descriptors': '', 'threads': '', 'latency p99': 'ms'}
NEGLIGIBLE = {'resident memory': 4.0, 'descriptors': 1.0, 'threads': 1.0, 'latency p99': 1.0}  # per hour


class Part:
    """A master, a guard and its peers, by one kind of clock, for so many seconds."""

    def __init__(self, options, simulated, seconds, results):
        self.options, self.seconds, self.results = options, seconds, results
        self.name = 'simulated clock' if simulated else 'wall clock'
        folder = os.path.join(options.folder, self.name.replace(' ', '_'))
        os.makedirs(folder, exist_ok=True)
        self.judge = judge.Judge()
        self.availability = Availability()
        self.lock = threading.Lock()  # of both
        self.plate_x, self.plate_y = world.plate_corners()
        self.corners = numpy.stack([self.plate_x, self.plate_y], axis=-1).astype(numpy.float32)
        self.world = GuardedWorld(folder, simulated, self.note)
        self.latencies = collections.deque()
        self.lateness = 0.0
        self.calls = calls.Calls()
        self.expected_end = 0.0  # until when the guard may end
        self.pid = None
        self.run = None
        self.begin = time.monotonic()  # of the events
        self.over = False

    # What departs: called by the links just before it does.

    def note(self, topic, subscriber, at, frame, corrupted):
        if subscriber != GUARD:
            return
        topic = topic.strip('/')
        try:
            self._note(topic, at, bytes(frame), corrupted)
        except Exception as error:  # a frame of noise is no message
            if not corrupted:
                raise error
        with self.lock:
            self.availability.departed(topic, at)

    def _note(self, topic, at, data, corrupted):
        if topic == 'tool_pose':
            self._note_pose(at, data, corrupted)
        elif topic == 'mesh_vertices':
            message = MeshVertices().deserialize_numpy(data, numpy)
            self._note_mesh(at, message.header.stamp, message.positions, renewed=False)
        elif topic == 'mesh':
            message = DeformableMesh().deserialize(data)
            positions = numpy.array([(p.x, p.y, p.z) for p in message.mesh.vertices], dtype=numpy.float32)
            self._note_mesh(at, message.header.stamp, positions, renewed=True)
        elif topic == 'tf':
            stamps = [transform.header.stamp.to_nsec() for transform in TFMessage().deserialize(data).transforms]
            ahead = stamps[0] - self.world.clock.now() > 1e9 * judge.TRANSFORM_LEAD
            with self.lock:
                self.judge.transform(at, stamps[0], ahead)
        elif topic == 'clock':
            with self.lock:
                self.judge.clock(at, 10**9 * int.from_bytes(data[:4], 'little') + int.from_bytes(data[4:8], 'little'))

    def _note_pose(self, at, data, corrupted):
        seconds, nanoseconds, size = POSE_HEADER.unpack_from(data)
        values = POSE_VALUES.unpack_from(data, POSE_HEADER.size + size)
        stamp = 10**9 * seconds + nanoseconds
        tip, top = world.ends_in_world(values[:3], values[3:])
        late = self.world.clock.now() - stamp > 1e9 * judge.MAX_LAG
        with self.lock:
            self.judge.pose(at, stamp, tip, top, not corrupted and not late)
            if late:
                self.availability.disturbed(at)

    def _note_mesh(self, at, stamp, positions, renewed):
        vertices = positions.reshape(self.corners.shape[0], self.corners.shape[1], 3)
        on_grid = numpy.array_equal(vertices[:, :, :2], self.corners)
        lag = self.world.clock.now() - stamp.to_nsec()
        late, ahead = lag > 1e9 * judge.MAX_LAG, -lag > 1e9 * judge.MESH_LEAD
        with self.lock:
            self.judge.mesh(at, stamp.to_nsec(), vertices[:, :, 2].copy() if on_grid else None, renewed, late, ahead)
            if late and not renewed:
                self.availability.disturbed(at)

    # What is heard.

    def take_warning(self, at, data):
        message = Warning().deserialize(data)
        spoken = judge.Spoken(at, message.header.stamp.to_nsec(), message.valid_until.to_nsec() - int(1e9 * judge.VALID),
                              message.level, bool(message.clear), message.reasons,
                              message.held_since.to_nsec() if message.held else 0, message.run_id, message.text)
        with self.lock:
            own_delay = max(self.lateness, time.monotonic() - at)  # the lock, too, takes time
            self.judge.warning(spoken, self.world.clock.now(), own_delay)
            self.availability.heard(at, message.level == Warning.UNKNOWN, message.text)
            self.run = message.run_id

    def take_contacts(self, at, data):
        stamp = int.from_bytes(data[4:8], 'little') * 10**9 + int.from_bytes(data[8:12], 'little')
        with self.lock:
            sent = self.judge.by_stamp.get(stamp)
            if sent and at > self.availability.disturbed_until + 2.0:
                self.latencies.append((at, at - sent[-1].at))

    # The threads beside.

    def watch_itself(self):
        """How late this process gets a processor."""
        recent = collections.deque()
        while not self.over:
            begin = time.monotonic()
            time.sleep(0.01)
            recent.append((begin, time.monotonic() - begin - 0.01))
            while recent[0][0] < begin - 1.0:
                recent.popleft()
            self.lateness = max(late for _, late in recent)

    def judge_now_and_then(self):
        shown = 0
        while not self.over:
            time.sleep(0.5)
            for finding in self.judge.findings[shown:shown + 20]:
                print(f'{finding.at - self.begin:.2f} s: {finding.kind}: {finding.text}', flush=True)
            shown = len(self.judge.findings)
            now = time.monotonic()
            with self.lock:
                self.judge.judge_contacts(now - SETTLED)
                self.availability.look(now)
                if now - (self.availability.heard_at or now) > 0.5:
                    self.availability.heard(now, unknown=True)

    def sample(self):
        """Memory, descriptors and threads of the guard, once a second."""
        seen = {}
        while not self.over:
            time.sleep(1.0)
            pid, now = self.world.guard(), time.monotonic()
            if self.over:
                return
            if pid != self.pid:
                if self.pid is not None and now > self.expected_end:
                    self.results.ended_by_itself.append(now - self.results.begin)
                self.pid = pid
            if pid is None:
                continue
            seen.setdefault(pid, now)
            if now - seen[pid] < self.options.warm_up:
                continue
            try:
                figures = {'resident memory': process_table.resident(pid), 'descriptors': process_table.descriptors(pid),
                           'threads': process_table.threads(pid)}
            except (FileNotFoundError, ProcessLookupError):
                continue
            for name, value in figures.items():
                self.results.samples[name].append((str(pid), now - self.results.begin, value))

    # What is done to the processes.

    def run_all(self):
        os.environ['ROS_MASTER_URI'] = self.world.master
        try:
            self.world.start_all()
            listeners = [Listener(self.world.master, GUARD, GUARD + '/warning', Warning, self.take_warning),
                         Listener(self.world.master, GUARD, GUARD + '/contacts', Contacts, self.take_contacts)]
            for work in (self.watch_itself, self.judge_now_and_then, self.sample):
                threading.Thread(target=work, daemon=True).start()
            self.wait_until_clear()
            self.play(schedule.make(self.options.seed, self.seconds, self.options.period, self.options.gap,
                                    self.world.simulated, self.options.one_guard))
            for one in listeners:
                one.end()
        finally:
            self.over = True
            self.world.end()
            self.results.take(self)

    def wait_until_clear(self):
        deadline = time.monotonic() + 60.0
        while not self.judge.counts['CLEAR judged']:
            if time.monotonic() > deadline:
                raise TimeoutError('the guard is not CLEAR within 60 s')
            time.sleep(0.1)

    def play(self, events):
        self.begin = begin = time.monotonic()
        order = iter(range(10**9))
        waiting = [(event.at, next(order), event) for event in events]
        for period in range(int(self.seconds // self.options.period)):
            at = (period + 1.0 - schedule.QUIET) * self.options.period
            waiting.append((at, next(order), self.back_to_defaults))
        heapq.heapify(waiting)
        say(f'{self.name}: {self.seconds:.0f} s, {len(events)} events')
        while time.monotonic() < begin + self.seconds:
            left = (waiting[0][0] if waiting else self.seconds) - (time.monotonic() - begin)
            time.sleep(min(max(left, 0.0), 0.5))
            while waiting and waiting[0][0] <= time.monotonic() - begin:
                at, _, what = heapq.heappop(waiting)
                if callable(what):
                    after = what()
                else:
                    print(schedule.text(what), flush=True)
                    self.results.events[what.what] += 1
                    after = self.do(what)
                if after is not None:
                    heapq.heappush(waiting, (at + after[0], next(order), after[1]))
        self.wait_for_the_last()

    def wait_for_the_last(self):
        time.sleep(SETTLED + 1.0)
        with self.lock:
            self.judge.judge_contacts(time.monotonic() - 0.5)

    def do(self, event):
        """Begins what an event says. Returns after how many seconds which function ends it, or None."""
        with self.disturbing(event.duration):
            return getattr(self, 'do_' + event.what.replace(' ', '_'))(event)

    @contextlib.contextmanager
    def disturbing(self, seconds=0.0):
        """All is well again so many seconds after its end."""
        with self.lock:
            self.availability.acting = True
        try:
            yield
        finally:
            with self.lock:
                self.availability.acting = False
                self.availability.disturbed(time.monotonic() + seconds)

    def after(self, event, function):
        def end():
            with self.disturbing():
                function()
        return event.duration, end

    def do_kill(self, event, by=signal.SIGKILL):
        self.world.kill(event.target, by)
        return self.after(event, lambda: self.world.start_peer(event.target))

    def do_end(self, event):
        return self.do_kill(event, signal.SIGTERM)

    def do_freeze(self, event):
        self.world.freeze(event.target)
        return self.after(event, lambda: self.world.thaw(event.target))

    do_freeze_guard = do_freeze

    def do_kill_guard(self, event, by=signal.SIGKILL):
        self.expected_end = time.monotonic() + event.duration
        self.world.kill('guard', by)
        return self.after(event, lambda: None)

    def do_end_guard(self, event):
        return self.do_kill_guard(event, signal.SIGTERM)

    def do_kill_roscore(self, event, by=signal.SIGKILL):
        self.world.kill('roscore', by)

        def start():
            self.world.start_master()
            self.world.restart_publishers()
        return self.after(event, start)

    def do_end_roscore(self, event):
        return self.do_kill_roscore(event, signal.SIGINT)

    def do_delay(self, event):
        link = self.world.links[event.target]
        link.delay = event.detail
        return self.after(event, lambda: setattr(link, 'delay', 0.0))

    def do_stall(self, event):
        self.world.links[event.target].stalled_until = time.monotonic() + event.duration

    def do_cut(self, event):
        self.world.links[event.target].cut(closed_for=event.duration)

    def do_flip_bits(self, event):
        link = self.world.links[event.target]
        link.corruption = corruption(event.what, event.at)
        return self.after(event, lambda: setattr(link, 'corruption', None))

    do_noise = do_flip_bits

    def do_shorten(self, event):
        begin = time.monotonic()
        after, end = self.do_flip_bits(event)

        def end_excused():
            end()
            with self.lock:
                self.judge.excuse(begin, time.monotonic() + 3.0, 'garbled ' + event.target)
        with self.lock:
            self.judge.excuse(begin, begin + event.duration + 5.0, 'garbled ' + event.target)
        return after, end_excused

    def do_step_clock(self, event):
        with self.lock:
            begin = time.monotonic()
            self.world.clock.step(event.detail)
            self.judge.clock_step(begin, time.monotonic())

    # Services.

    def do_check_sweep(self, _event):
        def call():
            through = self.calls.call('check_sweep', calls.path_request(calls.HIGHEST, calls.LOWEST))
            if through is not None and through.success:
                self.results.counts['check_sweep through the plate'] += 1
                if not through.collision or through.clear:
                    self.find('false CLEAR', 'check_sweep: a path through the plate is ' +
                              ('clear' if through.clear else 'no collision'))
            past = self.calls.call('check_sweep', calls.path_request(calls.HIGHEST, calls.HIGH))
            if past is not None and past.success:
                self.results.counts['check_sweep above the plate'] += 1
                self.results.counts['check_sweep above the plate: collision'] += past.collision
        self.calls.later(call)

    def find(self, kind, text):
        with self.lock:
            self.judge.findings.append(judge.Finding(kind, time.monotonic(), text))

    def do_predict(self, _event):
        self.calls.later(lambda: self.calls.call('predict', calls.NAMES['predict']._request_class()))

    def do_acknowledge(self, _event):
        self.calls.later(lambda: self.calls.call('acknowledge', calls.NAMES['acknowledge']._request_class()))

    def do_reset(self, _event):
        def call():
            with self.lock:
                self.judge.excuse(time.monotonic(), time.monotonic() + 3.0, 'reset')
            self.calls.call('reset', calls.NAMES['reset']._request_class())
            with self.lock:
                self.judge.excuse(time.monotonic(), time.monotonic() + 1.0, 'reset')
        self.calls.later(call)

    def do_disable(self, event):
        enable = lambda on: calls.NAMES['enable']._request_class(on)
        interval = [0.0, float('inf')]

        def off():
            begin = time.monotonic()
            with self.lock:
                self.judge.excuse(begin, begin + event.duration + 3.0, 'disabled')
            answer = self.calls.call('enable', enable(False))
            if answer is not None and answer.success:
                interval[0] = time.monotonic()
                with self.lock:
                    self.judge.disabled.append(interval)

        def on():
            interval[1] = time.monotonic()
            self.calls.until_answered('enable', enable(True), give_up=lambda: self.over)
            with self.lock:
                self.judge.excuse(interval[1], time.monotonic() + 1.0, 'disabled')
                self.availability.disturbed(time.monotonic())
        self.calls.later(off)
        return event.duration, lambda: self.calls.later(on)

    def do_intend(self, event):
        interval = [time.monotonic(), float('inf')]
        with self.lock:
            self.judge.intended.append(interval)

        def off():
            self.calls.until_answered('intend', calls.intend_nowhere(), give_up=lambda: self.over)
            interval[1] = time.monotonic() + 1.0
        self.calls.later(lambda: self.calls.call('intend', calls.intend_everywhere()))
        return event.duration, lambda: self.calls.later(off)

    def do_parameter(self, event):
        self.calls.later(lambda: self.set_parameter(*event.detail))

    def set_parameter(self, name, value):
        if name == 'timing/pose_timeout':  # from when on it counts is not known: the longer one does
            with self.lock:
                self.judge.pose_timeouts.append((time.monotonic(), max(value, self.judge.pose_timeouts[-1][1])))
        answer = self.calls.call('set_parameters', calls.config(name, value))
        if name == 'timing/pose_timeout' and answer is not None:
            with self.lock:
                self.judge.pose_timeouts.append((time.monotonic(), value))

    def back_to_defaults(self):
        for name, value in schedule.DEFAULTS.items():
            self.calls.later(lambda name=name, value=value: self.set_parameter(name, value))


class Results:
    def __init__(self, options):
        self.options = options
        self.begin = time.monotonic()
        self.samples = collections.defaultdict(list)
        self.latencies = []
        self.events, self.counts = collections.Counter(), collections.Counter()
        self.findings, self.ended_by_itself = [], []
        self.parts = []
        self.failure = None

    def take(self, part):
        with part.lock:
            self.findings += part.judge.findings
            self.counts.update(part.judge.counts)
        self.counts.update({'calls answered': part.calls.answered, 'calls failed': part.calls.failed})
        self.latencies += [1e3 * latency for _, latency in part.latencies]
        slices = collections.defaultdict(list)
        for at, latency in part.latencies:
            slices[int((at - self.begin) / self.options.slice)].append(latency)
        for place, values in slices.items():
            if len(values) >= 100:
                p99 = 1e3 * float(numpy.quantile(values, 0.99))
                self.samples['latency p99'].append((part.name, (place + 0.5) * self.options.slice, p99))
        self.parts.append((part.name, part.seconds, part.availability))

    def problems(self):
        found = [f'{count} x {kind}' for kind, count in collections.Counter(one.kind for one in self.findings).items()]
        if self.failure:
            found.append(self.failure)
        if self.ended_by_itself:
            found.append('the guard ended by itself after ' + ', '.join(f'{at:.0f} s' for at in self.ended_by_itself))
        for name, _, available in self.parts:
            if available.longest > MAX_UNKNOWN:
                found.append(f'{name}: UNKNOWN for {available.longest:.1f} s while all was well')
        if not self.counts['contacts judged'] or not self.counts['CLEAR judged']:
            found.append('nothing was judged')
        return found + [f'{name} grows' for name, fitted in self.trends().items()
                        if fitted and not trend.is_flat(fitted, NEGLIGIBLE[name])]

    def trends(self):
        return {name: trend.fit(self.samples[name], self.options.slice) for name in TREND_UNITS}

    def write_samples(self, path):
        with open(path, 'w') as file:
            file.write('figure,process,seconds,value\n')
            for name, samples in self.samples.items():
                file.writelines(f'{name},{group},{at:.1f},{value:.3f}\n' for group, at, value in samples)

    def print_page(self):
        counts = self.counts
        seconds = sum(seconds for _, seconds, _ in self.parts)
        print(f'\nSoak of {seconds / 60.0:.1f} min, seed {self.options.seed}: ' +
              ', '.join(f'{name} {seconds / 60.0:.1f} min' for name, seconds, _ in self.parts))
        print('events: ' + ', '.join(f'{count} {what}' for what, count in sorted(self.events.items())))
        print(f'\nwarnings: {counts["warnings"]}, of which CLEAR: {counts["CLEAR judged"]} '
              f'({counts["CLEAR with a decided place"]} with a decided place of the tool)')
        kinds = collections.Counter(one.kind for one in self.findings)
        print(f'false CLEAR: {kinds["false CLEAR"]}\ncontacts judged: {counts["contacts judged"]}, '
              f'missed: {kinds["missed contact"]}')
        print(f'poses: {counts["poses"]}, of which with a decided side of the plate: {counts["poses with a decided side"]}')
        for what, count in sorted(counts.items()):
            if what.startswith(('contacts not', 'contacts that', 'check_sweep', 'calls', 'CLEAR just')):
                print(f'  {what}: {count}')
        for name, _, available in self.parts:
            share = 100.0 * available.unknown_while_well / max(available.well, 1e-9)
            print(f'{name}: well for {available.well:.0f} s in all, UNKNOWN or silent for {share:.2f} % of it; longest after '
                  f'a disturbance {available.longest:.1f} s, at {available.longest_at - self.begin:.0f} s (limit {MAX_UNKNOWN:g} s): {available.longest_text}')
        print('\n| figure | mean | per hour, 95 % interval | flat |\n|---|---|---|---|')
        for name, fitted in self.trends().items():
            if fitted is None:
                print(f'| {name} | | too few slices | |')
            else:
                print(f'| {name} [{TREND_UNITS[name] or "-"}] | {fitted.level:.2f} | {fitted.slope:+.2f} +- {fitted.error:.2f} '
                      f'({fitted.blocks} slices) | {"yes" if trend.is_flat(fitted, NEGLIGIBLE[name]) else "NO"} |')
        print('Flat: the interval holds 0 or lies below it, or the slope is at most ' +
              ', '.join(f'{value:g} {TREND_UNITS[name]} ({name})' for name, value in NEGLIGIBLE.items()) + ' per hour.')
        if self.latencies:
            print('from the departure of a pose to its contacts: p50 {:.1f} ms, p99 {:.1f} ms, {} poses'.format(
                *numpy.quantile(self.latencies, (0.5, 0.99)), len(self.latencies)))
        for finding in self.findings[:20]:
            print(f'{finding.at - self.begin:.2f} s: {finding.kind}: {finding.text}')
        problems = self.problems()
        print('\n' + ('FAILED: ' + '; '.join(problems) if problems else 'passed'))


def say(text):
    print('-- ' + text, flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--seconds', type=float, required=True)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--gap', type=float, default=2.5, help='mean time [s] from one event to the next')
    parser.add_argument('--period', type=float, default=60.0, help='the last 30 %% of each are quiet [s]')
    parser.add_argument('--warm-up', type=float, default=120.0, help='of each guard, before its memory counts [s]')
    parser.add_argument('--one-guard', action='store_true', help='the guard is never ended')
    parser.add_argument('--clock', choices=['both', 'wall', 'simulated'], default='both')
    parser.add_argument('--folder', required=True, help='for the logs')
    options = parser.parse_args()
    options.slice = max(15.0, min(60.0, options.seconds / 20.0))
    sys.setswitchinterval(0.0005)
    try:
        os.nice(NICE)
    except OSError:
        pass
    clocks = {'both': (False, True), 'wall': (False,), 'simulated': (True,)}[options.clock]
    results = Results(options)
    try:
        for simulated in clocks:
            Part(options, simulated, options.seconds / len(clocks), results).run_all()
    except (TimeoutError, KeyboardInterrupt) as error:
        results.failure = str(error) or 'interrupted'
    results.write_samples(os.path.join(options.folder, 'samples.csv'))
    results.print_page()
    return 1 if results.problems() else 0


if __name__ == '__main__':
    sys.exit(main())
