"""One method on one piece of work, in a process of its own:
`python -m juggleproof.benchmarks.bench.child METHOD SIZE SECONDS`, the work pickled on stdin.

Writes the measurement, pickled, in CPU seconds.  `cold` is the time of the first answer, with
everything that the method has to load, except what is kept from run to run; `warm` is the least
time of the answers that follow, if time is left.
"""

from __future__ import annotations

import pickle
import resource
import signal
import sys
from fractions import Fraction

from juggleproof.benchmarks.bench.answers import GaveUp, MeasuredAnswer
from juggleproof.benchmarks.bench.methods import BLOCKS, ENSEMBLE, METHODS, ORBITS
from juggleproof.benchmarks.processes import GRACE, allow, cpu_seconds

# more than REPEATS repeats only while they take less than LONG seconds: answers of a millisecond
# vary most
REPEATS, LONG = 3, 0.1


class Over(BaseException):
    """The seconds are over, or the parent ends the run: this is raised wherever the method is, so
    that it ends its own programs.
    """


def _over(*_: object) -> None:
    raise Over


def measured() -> MeasuredAnswer:
    """The answer with its seconds, or the reason why there is none."""
    name, size, seconds = sys.argv[1], Fraction(sys.argv[2]), float(sys.argv[3])
    work, method = pickle.load(sys.stdin.buffer), (METHODS | ORBITS | ENSEMBLE | BLOCKS)[name]
    signal.signal(signal.SIGTERM, _over)
    signal.signal(signal.SIGXCPU, _over)
    method.prepare()
    most = int(cpu_seconds() + 2 * seconds + GRACE) + 1  # then it is killed, whatever it does
    resource.setrlimit(resource.RLIMIT_CPU, (most, most))
    allow(seconds)
    began = cpu_seconds()
    took: list[float] = []
    try:
        while (
            not took
            or (len(took) <= REPEATS or sum(took[1:]) < LONG)
            and cpu_seconds() - began + min(took) < seconds
        ):
            start = cpu_seconds()
            answer = method.solve(work, size)
            took.append(cpu_seconds() - start)
    except GaveUp as reason:
        return MeasuredAnswer(name, size, reason=f"gave up: {reason}")
    except Over:
        if not took:
            return MeasuredAnswer(name, size, reason=f"gave up: {seconds:g} s")
    allow(seconds)  # as much to compare an orbit with the exact one
    try:
        answer = answer() if callable(answer) else answer
    except (Over, GaveUp):
        return MeasuredAnswer(name, size, reason="gave up: no exact orbit to compare with")
    return MeasuredAnswer(name, size, took[0], min(took[1:], default=None), answer)


if __name__ == "__main__":
    pickle.dump(measured(), sys.stdout.buffer)
