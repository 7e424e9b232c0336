"""When what is done to the processes around the guard: a function of the seed, so that a failure can be repeated."""
import collections
import random

Event = collections.namedtuple('Event', 'at what target duration detail')

QUIET = 0.3  # share of each period at whose end nothing happens: availability and latency are measured there
PUBLISHERS = ('poses', 'mesh', 'tf')
CHANGES = (('detector', 'halfspace'), ('detector', 'select'), ('volume', 'obb'), ('volume', 'hull'),
           ('prediction/predictor', 'polynomial'), ('prediction/predictor', 'hold'), ('horizon/considered', 2.0),
           ('horizon/reflex', 0.2), ('tool/padding', 0.001), ('timing/pose_timeout', 0.2), ('warning/considered_on', 0.5))
DEFAULTS = {'detector': 'select', 'volume': 'obb_planes', 'prediction/predictor': 'direct', 'horizon/considered': 1.0,
            'horizon/reflex': 0.1, 'tool/padding': 0.0, 'timing/pose_timeout': 0.1, 'warning/considered_on': 0.065}
# Weights, targets and shortest and longest duration [s] of what may happen. A restarted process is gone for the duration.
KINDS = {
    'kill': (3, PUBLISHERS, 0.2, 3.0),
    'end': (3, PUBLISHERS, 0.2, 3.0),
    'freeze': (4, PUBLISHERS + ('roscore',), 0.05, 3.0),
    'freeze guard': (2, ('guard',), 0.05, 2.0),
    'kill guard': (0.15, ('guard',), 8.0, 8.0),
    'end guard': (0.15, ('guard',), 8.0, 8.0),
    'kill roscore': (0.5, ('roscore',), 0.5, 3.0),
    'end roscore': (0.5, ('roscore',), 0.5, 3.0),
    'delay': (4, PUBLISHERS, 0.5, 5.0),
    'stall': (4, PUBLISHERS, 0.05, 2.0),
    'cut': (4, PUBLISHERS, 0.0, 1.0),
    'flip bits': (3, PUBLISHERS, 0.05, 0.5),
    'noise': (2, PUBLISHERS, 0.05, 0.5),
    'shorten': (2, PUBLISHERS, 0.02, 0.5),
    'check_sweep': (4, ('caller',), 0.0, 0.0),
    'predict': (3, ('caller',), 0.0, 0.0),
    'disable': (1, ('guard',), 0.5, 3.0),
    'reset': (1, ('caller',), 0.0, 0.0),
    'acknowledge': (1, ('caller',), 0.0, 0.0),
    'intend': (1, ('guard',), 2.0, 5.0),
    'parameter': (4, ('caller',), 0.0, 0.0),
}
ENDS_OF_THE_GUARD = {'kill guard', 'end guard'}
SIMULATED = {
    'step clock': (6, ('clock',), 0.0, 0.0),
    'freeze': (4, PUBLISHERS + ('roscore', 'clock'), 0.05, 3.0),
    'kill': (3, PUBLISHERS + ('clock',), 0.2, 3.0),
}


def detail_of(what, choose):
    if what == 'parameter':
        return choose.choice(CHANGES)
    if what == 'delay':
        return round(choose.uniform(0.005, 0.4), 3)
    if what == 'step clock':
        return round(choose.choice((-1.0, 1.0)) * choose.uniform(0.2, 6.0), 3)
    return None


def make(seed, seconds, period=60.0, gap=2.5, simulated=False, one_guard=False):
    """Events within so many seconds, in their order. gap: mean time [s] from one to the next. one_guard: it is never ended"""
    choose = random.Random(f'{seed} {simulated}')
    kinds = dict(KINDS, **SIMULATED) if simulated else KINDS
    names = sorted(kinds.keys() - ENDS_OF_THE_GUARD if one_guard else kinds)
    busy = collections.Counter()
    events, at = [], choose.expovariate(1.0 / gap)
    while at < seconds:
        what = choose.choices(names, [kinds[name][0] for name in names])[0]
        _, targets, shortest, longest = kinds[what]
        target = choose.choice(targets)
        duration = round(choose.uniform(shortest, longest), 3)
        detail = detail_of(what, choose)
        end = at + duration + (5.0 if what.endswith('roscore') else 0.5)
        if at % period + duration < (1.0 - QUIET) * period and end < seconds and busy[target] <= at:
            events.append(Event(round(at, 3), what, target, duration, detail))
            taken = PUBLISHERS + ('roscore', 'clock', 'guard') if what.endswith('roscore') else (target,)
            busy.update({name: end - busy[name] for name in taken})
        at += choose.expovariate(1.0 / gap)
    return events


def text(event):
    parts = [f'{event.at:.1f} s: {event.what}', event.target, f'for {event.duration:g} s' if event.duration else '',
             '' if event.detail is None else str(event.detail)]
    return ' '.join(part for part in parts if part)
