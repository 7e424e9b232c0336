"""How long the guard is UNKNOWN, or silent, while all is well."""

WELL_AFTER = 10.0  # [s] after the last disturbance the guard has to know
GAPS = {'tool_pose': 0.05, 'mesh_vertices': 0.2, 'tf': 0.09, 'clock': 0.1}  # [s] between inputs: a longer one is a disturbance
MAX_GAP = 20.0  # [s] an even longer one is none: the guard does not connect


class Availability:
    def __init__(self):
        self.acting = False  # what disturbs is being done: processes end and start
        self.disturbed_until = 0.0
        self.departed_at = {}  # newest of each topic
        self.unknown_since = None
        self.heard_at = None
        self.longest = 0.0  # [s] UNKNOWN or silent while all was well
        self.longest_at = 0.0
        self.longest_text = ''
        self.well = 0.0  # [s] since WELL_AFTER after the last disturbance
        self.unknown_while_well = 0.0

    def disturbed(self, at):
        self.disturbed_until = max(self.disturbed_until, at)

    def departed(self, topic, at):
        """A message is on its way to the guard."""
        self._look_for_gap(topic, at)
        self.departed_at[topic] = at

    def look(self, at):
        """Notices what disturbs at this time."""
        if self.acting:
            self.disturbed(at)
        for topic in self.departed_at:
            self._look_for_gap(topic, at)

    def _look_for_gap(self, topic, at):
        if GAPS.get(topic, MAX_GAP) < at - self.departed_at.get(topic, at) < MAX_GAP:
            self.disturbed(at)

    def heard(self, at, unknown, text='silent'):
        """A warning was received, or, with unknown, none for a while."""
        self.look(at)
        since = self.disturbed_until + WELL_AFTER
        if self.heard_at is not None and at > since:
            step = at - max(self.heard_at, since)
            self.well += step
            self.unknown_while_well += step if self.unknown_since is not None else 0.0
        if not unknown:
            self.unknown_since = None
        elif self.unknown_since is None:
            self.unknown_since = at
        if unknown:
            spell = at - max(self.unknown_since, self.disturbed_until)
            if spell > self.longest:
                self.longest, self.longest_at, self.longest_text = spell, at, text
        self.heard_at = at
