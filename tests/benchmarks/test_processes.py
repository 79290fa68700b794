"""Work ends when its CPU seconds are used up."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import pytest

from juggleproof.benchmarks import processes
from juggleproof.benchmarks.processes import children_seconds, each, output_of


def squares() -> Callable[[int], Callable[[], int]]:
    def square(number: int) -> int:
        while number == 2:
            pass
        return number**2

    return lambda number: lambda: square(number)


def test_work_that_uses_up_its_cpu_seconds_is_given_up_and_the_next_is_done_holds() -> None:
    before = children_seconds()
    done = list(each(squares, [1, 2, 3], 0.1))
    assert [one.answer for one in done] == [1, None, 9]
    spent = sum(one.seconds for one in done)
    assert 0.1 < spent <= children_seconds() - before < 10


def test_rejects_work_that_fails() -> None:
    with pytest.raises(ChildProcessError):
        list(each(lambda: lambda number: lambda: 1 // number, [1, 0], 1.0))


@pytest.mark.exhaust
def test_a_program_that_uses_up_its_cpu_seconds_is_ended() -> None:
    before = children_seconds()
    assert output_of([sys.executable, "-c", "while True: pass"], "", 0.1) is None
    assert 0.1 < children_seconds() - before < 10
    assert output_of([sys.executable, "-c", "print(input())"], "text", 5.0) == "text\n"


def test_a_program_that_stands_still_is_ended_with_its_children(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(processes, "STALLED", 0.3)
    began = time.monotonic()
    program = "import subprocess, sys; subprocess.run(['sleep', '600'])"
    assert output_of([sys.executable, "-c", program], "", 0.3) is None
    assert time.monotonic() - began < 300
