"""The record, what is due, what CI refuses, and how stages are run."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests.exhaust import record
from tests.exhaust.__main__ import chosen, due, refused, run
from tests.exhaust.lanes import jobs
from tests.exhaust.record import FAILED, PASSED, Line
from tests.exhaust.stages import FRESH, MUTANTS, Stage

OLD, NEW = "old", "new"


def stage(name: str, code: str = "", bound: int | None = None) -> Stage:
    return Stage(name, ("python", "-c", code), (), bound=bound)


def test_the_committed_record_can_be_read_holds() -> None:
    record.read()


def test_a_record_is_read_as_it_was_written_and_sorted_holds(tmp_path: Path) -> None:
    path = tmp_path / "record.tsv"
    lines = {"b": Line(NEW, 3, PASSED), "a/x": Line(OLD, 0, FAILED)}
    record.write(lines, path)
    assert record.read(path) == lines and record.read(tmp_path / "none") == {}
    assert path.read_text().splitlines()[1:] == ["a/x\told\t0\tfailed", "b\tnew\t3\tpassed"]
    assert [one.name for one in tmp_path.iterdir()] == ["record.tsv"]


@pytest.mark.parametrize("row", ["a\tx\t1", "a\tx\t-1\tpassed", "a\tx\t1\tmaybe", "\n"])
def test_rejects_a_line_that_is_none(row: str, tmp_path: Path) -> None:
    path = tmp_path / "record.tsv"
    path.write_text(f"{record.HEAD}\n{row}\n")
    with pytest.raises(ValueError, match="no line of a record"):
        record.read(path)


def test_rejects_two_lines_of_a_stage_and_another_head(tmp_path: Path) -> None:
    path = tmp_path / "record.tsv"
    path.write_text(f"{record.HEAD}\na\tx\t1\tpassed\na\ty\t1\tpassed\n")
    with pytest.raises(ValueError, match="a has two lines"):
        record.read(path)
    path.write_text("a\tx\t1\tpassed\n")
    with pytest.raises(ValueError, match="begins with"):
        record.read(path)


def test_what_is_missing_changed_or_failed_is_due_holds() -> None:
    stages = {name: stage(name) for name in ("missing", "changed", "failed", "same")}
    lines = {
        "changed": Line(OLD, 1, PASSED),
        "failed": Line(NEW, 1, FAILED),
        "same": Line(NEW, 1, PASSED),
        "gone": Line(NEW, 1, PASSED),
    }
    waiting = due(stages, dict.fromkeys(stages, NEW), lines)
    assert [one.name for one in waiting] == ["missing", "changed", "failed"]


@pytest.mark.parametrize(
    ("line", "bound", "why"),
    [
        (Line(OLD, 119, PASSED), None, ""),
        (Line(OLD, 119, FAILED), None, ""),  # what it depends on has changed since
        (None, 20, ""),
        (None, None, "has never been run"),
        (Line(OLD, 120, PASSED), 20, "takes 120 CPU s, and what it depends on has changed"),
        (Line(NEW, 1, FAILED), None, "failed when it was last run"),
    ],
)
def test_ci_runs_what_is_short_and_names_the_rest_holds(
    line: Line | None, bound: int | None, why: str
) -> None:
    lines = {"a/b": line} if line else {}
    said = refused([stage("a/b", bound=bound)], {"a/b": NEW}, lines)
    command = "run `make exhaust STAGE=a/b`, and commit tests/exhaust/record.tsv"
    assert said == ([f"a/b {why}: {command}"] if why else [])


def test_ci_refuses_many_short_stages_in_one_line_holds() -> None:
    names = [f"a/{number}" for number in range(7)]
    lines = {name: Line(OLD, 100, PASSED) for name in names}
    digests = dict.fromkeys(names, NEW)
    assert not refused([stage(name) for name in names[:6]], digests, lines)
    (said,) = refused([stage(name) for name in names], digests, lines)
    assert said.startswith("7 stages take 700 CPU s, a/0 most")


def test_stages_are_chosen_by_name_and_by_beginning_holds() -> None:
    stages = {name: stage(name) for name in ("a/b", "a/c", "ab")}
    assert [one.name for one in chosen(stages, ["a/"]).values()] == ["a/b", "a/c"]
    assert [*chosen(stages, ["ab", "a/"])] == ["ab", "a/b", "a/c"]
    assert chosen(stages, []) == stages
    with pytest.raises(ValueError, match="no stage is called so"):
        chosen(stages, ["ab", "a"])


def test_a_run_leaves_a_line_for_each_stage_holds(tmp_path: Path) -> None:
    path = tmp_path / "record.tsv"
    both = [stage("good", "print('well')"), stage("bad", "import sys; sys.exit('ill')")]
    lines = {"kept": Line(OLD, 7, PASSED)}
    assert run(both, tmp_path, lines, {"good": NEW, "bad": NEW}, path) == 1
    found = record.read(path)
    assert {name: (one.digest, one.result) for name, one in found.items()} == {
        "good": (NEW, PASSED),
        "bad": (NEW, FAILED),
        "kept": (OLD, PASSED),
    }
    assert (tmp_path / "build/exhaust/bad.log").read_text() == "ill\n"


TELLS = """
import sys
print("fresh/a\\t1.2\\tpassed\\nfresh/other\\t1\\tpassed\\nfresh/b\\t0\\tfailed", flush=True)
sys.exit(1)
"""


def test_claims_have_the_results_that_their_process_tells_holds(tmp_path: Path) -> None:
    several = [stage(f"{FRESH}{name}", TELLS) for name in ("a", "b", "c")]
    lines: dict[str, Line] = {}
    digests = {one.name: NEW for one in several}
    assert run(several, tmp_path, lines, digests, tmp_path / "record.tsv") == 2
    assert lines[f"{FRESH}a"] == Line(NEW, 1, PASSED)
    assert lines[f"{FRESH}b"].result == lines[f"{FRESH}c"].result == FAILED  # c is not told of
    assert set(lines) == set(digests)


def test_what_was_ended_leaves_no_line_holds(tmp_path: Path) -> None:
    path = tmp_path / "record.tsv"
    sleeping = [stage("long", "import time; time.sleep(600)"), stage("short")]
    lines: dict[str, Line] = {}

    class Stopped(Exception):
        pass

    class Stopping(dict[str, str]):
        def __getitem__(self, name: str) -> str:  # asked for the digest of what is done
            raise Stopped

    with pytest.raises(Stopped):
        run(sleeping, tmp_path, lines, Stopping(), path)
    assert lines == {} and not path.exists()


def test_claims_and_mutants_run_together_holds() -> None:
    names = [f"{MUTANTS}a", f"{MUTANTS}b", "other", *(f"{FRESH}{k}" for k in range(200))]
    made = jobs([stage(name, name) for name in names])
    assert [len(job.stages) for job in made] == [2, 67, 67, 66, 1]
    assert made[0].command == [sys.executable, "-c", f"{MUTANTS}a", f"{MUTANTS}b"]
    assert sorted(one.name for job in made for one in job.stages) == sorted(names)
