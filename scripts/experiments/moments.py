"""Random moments of a run, by how far it is: a run that is slower than the one before it does not move them beyond its end."""

import bisect
import time

LOOK_S = 0.01


def ends_of(process, done):
    """Seconds from now until each case of a run was done, which `done` counts; waits for the run's end."""
    begin, ends = time.monotonic(), []
    while True:
        ended = process.poll() is not None
        ends += [time.monotonic() - begin] * (done() - len(ends))
        if ended:
            return ends
        time.sleep(LOOK_S)


def any_moment(chance, ends):
    """After how many cases, and how many seconds later."""
    at_s = chance.uniform(0, ends[-1])
    cases = bisect.bisect(ends, at_s)
    return cases, at_s - [0, *ends][cases]


def wait_for_moment(process, done, moment):
    """Until then, or the run's end."""
    cases, later_s = moment
    while process.poll() is None and done() < cases:
        time.sleep(LOOK_S)
    time.sleep(later_s)
