"""One method on one piece of work, in a process of its own:
`python -m juggleproof.benchmarks.bench.child METHOD SIZE SECONDS`, the work pickled on stdin.

Prints one JSON object.  `cold` is the first answer, with everything that the method has to load;
`warm` the least of what follows, if time is left.
"""

from __future__ import annotations

import json
import pickle
import signal
import sys
import time
from fractions import Fraction

from juggleproof.benchmarks.bench.answers import GaveUp
from juggleproof.benchmarks.bench.methods import ENSEMBLE, METHODS, ORBITS

# more than so many repeats only while they take less than so many seconds: answers of a millisecond
# vary most
REPEATS, LONG = 3, 0.3


class Over(BaseException):
    """The seconds are over, or the parent wants an end: raised wherever the method is, so that it
    ends its own programs.
    """


def _over(*_: object) -> None:
    raise Over


def main() -> int:
    """Answers, times, prints."""
    name, size, seconds = sys.argv[1], Fraction(sys.argv[2]), float(sys.argv[3])
    work, method = pickle.load(sys.stdin.buffer), (METHODS | ORBITS | ENSEMBLE)[name]
    signal.signal(signal.SIGTERM, _over)
    signal.signal(signal.SIGALRM, _over)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    began = time.perf_counter()
    took: list[float] = []
    try:
        while (
            not took
            or (len(took) <= REPEATS or sum(took[1:]) < LONG)
            and time.perf_counter() - began + min(took) < seconds
        ):
            start = time.perf_counter()
            answer = method.solve(work, size)
            took.append(time.perf_counter() - start)
    except GaveUp as reason:
        print(json.dumps({"gave_up": str(reason)}))
        return 0
    except Over:
        if not took:
            print(json.dumps({"gave_up": f"{seconds:g} s"}))
            return 0
    signal.setitimer(signal.ITIMER_REAL, seconds)  # as much to compare an orbit with the exact one
    try:
        data = (answer() if callable(answer) else answer).as_json()
    except (Over, GaveUp):
        data = None
    print(
        json.dumps(
            {"gave_up": "no exact orbit to compare with"}
            if data is None
            else {"cold": took[0], "warm": min(took[1:], default=None), "answer": data}
        )
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
