"""How long the guard is UNKNOWN, or silent, after all is well again."""

WELL_AFTER = 10.0  # [s] after the last disturbance the guard has to know


class Availability:
    def __init__(self):
        self.disturbed_until = 0.0
        self.unknown_since = None
        self.heard_at = None
        self.longest = 0.0  # [s] UNKNOWN or silent while all was well
        self.longest_at = 0.0
        self.longest_text = ''
        self.well = 0.0  # [s] since WELL_AFTER after the last disturbance
        self.unknown_while_well = 0.0

    def disturbed(self, at):
        self.disturbed_until = max(self.disturbed_until, at)

    def heard(self, at, unknown, text='silent'):
        """A warning was received, or, with unknown, none for a while."""
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
