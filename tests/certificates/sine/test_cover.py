"""Covering a rectangle by boxes, and the command `certify sine`."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Executor, Future
from fractions import Fraction
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from juggleproof.certificates.sine.cells import Attraction
from juggleproof.certificates.sine.checker import (
    Rectangle,
    check_folder,
    check_line,
    outcome,
    read_line,
    read_statement,
)
from juggleproof.command.main import run
from juggleproof.sine import cover as covering
from juggleproof.sine.cover import Covered, cover, first_boxes, halves, kept
from juggleproof.sine.search import find_certificate, line_of
from juggleproof.sine.stored import STATEMENT, STORE, WIDE, boxes_in
from juggleproof.statements.language import ClaimError

WORDS = "the period-one bounce is stable and every motion tends to it for all alpha in"


@pytest.fixture(scope="module", autouse=True)
def _searched_once() -> Iterator[None]:
    """A box that several tests ask for is searched once, and its line is checked once."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(covering, "find_certificate", cache(find_certificate))
        patch.setattr(covering, "check_line", cache(check_line))
        yield


def rectangle(alpha: str, gamma: str) -> Rectangle:
    """alpha and Gamma between ends that are written A, B."""
    return read_statement(f"{WORDS} [{alpha}] and Gamma in [{gamma}]")


def cover_it(whole: Rectangle, *options: Any, **named: Any) -> Covered:
    """The cover of one rectangle."""
    (found,) = cover([whole], *options, **named)
    return found


def at(alpha: str, gamma: str) -> Rectangle:
    return rectangle(f"{alpha}, {alpha}", f"{gamma}, {gamma}")


def test_the_stored_certificate_holds_and_is_what_the_search_finds(tmp_path: Path) -> None:
    cover_it(read_statement(STATEMENT), tmp_path)
    for name in ("statements.txt", "certificates.jsonl"):
        assert (tmp_path / name).read_bytes() == (STORE / name).read_bytes()


def test_a_point_is_certified_and_found_again_in_the_folder(tmp_path: Path) -> None:
    found = cover_it(at("1/20", "31/10"), tmp_path)
    assert (found.outcome, len(found.boxes), found.left, found.cells) == ("certified", 1, [], 5376)
    again = cover_it(at("1/20", "31/10"), tmp_path)
    assert (again.outcome, again.cells) == ("certified", 0)
    assert [word for _, word, _ in check_folder(str(tmp_path))] == ["certified"]


@pytest.mark.parametrize(
    ("alpha", "gamma", "why"),
    [
        ("1/20", "14381/5000", "saddle"),
        ("1/20", "57/20", "saddle"),
        ("1/5", "49/20", "saddle"),
        ("3/10", "3757/2000", "saddle"),
        ("1/20", "7/2", "multiplier"),
        ("1/4", "28/10", "multiplier"),
    ],
)
def test_where_the_theorem_fails_it_is_refuted(
    alpha: str, gamma: str, why: str, tmp_path: Path
) -> None:
    found = cover_it(at(alpha, gamma), tmp_path)
    assert found.outcome == "refuted" and found.counterexample is not None
    assert found.counterexample.refutes == why
    assert [word for _, word, _ in check_folder(str(tmp_path))] == ["refuted"]
    # nor does a larger rectangle with this pair in it become certified by it
    (proved,) = kept(tmp_path, None)[0].values()
    assert outcome(rectangle("0, 1/2", "11/10, 4"), [proved])[0] == "refuted"
    assert outcome(at("1/20", "31/10"), [proved])[0] == "unknown"


@pytest.mark.parametrize(
    "g", ["39/500", *(pytest.param(g, marks=pytest.mark.exhaust) for g in ("7/100", "29/100"))]
)
def test_no_certificate_is_found_where_the_theorem_fails(g: str) -> None:
    pair = (Fraction(1, 20), Fraction(1, 20)), (Fraction(g), Fraction(g))
    assert find_certificate(*pair, 256, 16).certificate is None


def test_boxes_cover_and_their_halves_do(tmp_path: Path) -> None:
    whole = rectangle("1/25, 3/50", "149/50, 79/25")
    boxes = first_boxes(whole)
    names = [name_of(box) for box in boxes]
    assert outcome(whole, names)[0] == "certified"
    assert outcome(whole, names[1:])[0] == outcome(whole, names[:-1])[0] == "unknown"
    for box in boxes:
        others = [name_of(one) for one in boxes if one != box]
        assert outcome(whole, others)[0] == "unknown"
        assert outcome(whole, others + [name_of(one) for one in halves(whole, box)])[0] == (
            "certified"
        )


def name_of(box: covering.Box) -> Attraction:
    """What a certificate for the box would prove: that there is one is not asked here."""
    return Attraction(*box, 1, (Fraction(1),))


def test_a_budget_leaves_boxes_and_a_second_run_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = rectangle("499/10000, 501/10000", "309/100, 311/100")
    monkeypatch.setattr(covering, "START", (Fraction(1, 200), Fraction(1, 200)))
    assert len(first_boxes(whole)) == 2
    part = cover_it(whole, tmp_path, budget=8_000)
    assert (part.outcome, len(part.boxes), len(part.left)) == ("unknown", 1, 1)
    rest = cover_it(whole, tmp_path, budget=8_000)
    assert (rest.outcome, len(rest.boxes), rest.left) == ("certified", 2, [])


class Dying(Executor):
    """An executor whose processes die at the second box."""

    def __init__(self) -> None:
        self.asked = 0

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        self.asked += 1
        future: Future[Any] = Future()
        if self.asked == 2:
            future.set_exception(BrokenExecutor("gone"))
        else:
            future.set_result(fn(*args, **kwargs))
        return future


def test_boxes_are_kept_where_an_executor_dies(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = rectangle("499/10000, 501/10000", "309/100, 311/100")
    monkeypatch.setattr(covering, "START", (Fraction(1, 200), Fraction(1, 200)))
    with pytest.raises(ClaimError, match=r"^the executor failed \(BrokenExecutor: gone\)"):
        cover_it(whole, tmp_path, Dying())
    assert len(kept(tmp_path, None)[0]) == 1


class Cluster:
    """What stands for Dask: a cluster that answers, and then dies, or one that does not answer."""

    def __init__(self, address: str, timeout: int) -> None:
        if address != "there":
            raise OSError

    def __enter__(self) -> Cluster:
        return self

    def __exit__(self, *_: object) -> None:
        return None

    def get_executor(self) -> Executor:
        return Dying()


@pytest.mark.parametrize(
    ("address", "message"),
    [
        ("there", "the executor failed (BrokenExecutor: gone); certified boxes are kept"),
        ("gone", "--executor gone: no Dask cluster answers (OSError)"),
    ],
)
def test_rejects_a_cluster_that(
    address: str,
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", SimpleNamespace(Client=Cluster))
    monkeypatch.setattr(covering, "START", (Fraction(1, 200), Fraction(1, 200)))
    options = ["--alpha", "0.05", "--gamma", "3.09:3.11", "--store", str(tmp_path)]
    assert run(["certify", "sine", *options, "--executor", address]) == 2
    *_, error = capsys.readouterr().err.splitlines()
    assert error.startswith(f"juggleproof: {message}")


def test_a_dask_cluster_finds_the_same_bytes_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(covering, "find_certificate", find_certificate)  # a cache is not sent
    monkeypatch.setattr(covering, "check_line", check_line)
    options = ["certify", "sine", "--alpha", "0.0499:0.0501", "--gamma", "3.05:3.15"]
    assert run([*options, "--jobs", "1", "--store", str(tmp_path / "alone")]) == 0
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, processes=True
    ) as cluster:
        shared = ["--executor", cluster.scheduler_address, "--store", str(tmp_path / "shared")]
        assert run([*options, *shared]) == 0
    for name in ("statements.txt", "certificates.jsonl"):
        assert (tmp_path / "alone" / name).read_bytes() == (tmp_path / "shared" / name).read_bytes()


def test_rejects_a_store_whose_statements_are_not_ascii(tmp_path: Path) -> None:
    (tmp_path / covering.STATEMENTS).write_text("caf\u00e9\n", encoding="utf-8")
    with pytest.raises(ClaimError, match="statements.txt: .*; name another store"):
        covering.write(tmp_path, [STATEMENT], {})


def test_rejects_a_line_of_the_folder_that_proves_nothing(tmp_path: Path) -> None:
    found = find_certificate(
        (Fraction(1, 20), Fraction(1, 20)), (Fraction(197, 1000), Fraction(197, 1000)), 256, 16
    )
    assert found.certificate is not None
    wider = found.certificate.grid._replace(alpha=(Fraction(1, 25), Fraction(3, 50)))
    forged = line_of(found.certificate._replace(grid=wider))
    assert check_line(forged)[0] is None and read_line(forged)
    (tmp_path / "certificates.jsonl").write_text(f"{forged}\n")
    done = cover_it(at("1/20", "31/10"), tmp_path)
    assert done.outcome == "certified" and len(done.rejected) == 1
    assert forged not in (tmp_path / "certificates.jsonl").read_text()


# -------------------------------------------------------------------------------------------------
# The command


def test_the_command_says_what_is_proved(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = ["--alpha", "0.05", "--gamma", "3.1", "--jobs", "1", "--store", str(tmp_path)]
    assert run(["certify", "sine", *options]) == 0
    assert capsys.readouterr().out.splitlines()[:2] == [
        f"certified: {WORDS} [1/20, 1/20] and Gamma in [31/10, 31/10]",
        "5,376 cells were looked at; boxes with a certificate: 1",
    ]
    options[3] = "3.5"
    assert run(["certify", "sine", *options]) == 1
    assert capsys.readouterr().out.splitlines()[:2] == [
        f"refuted: {WORDS} [1/20, 1/20] and Gamma in [7/2, 7/2]",
        "at alpha = 1/20, g = 0.325034 the bounce is unstable: one of its multipliers is below -1",
    ]


def test_without_a_rectangle_those_of_the_wide_cover_are_certified(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    ends = ("[1/20, 1/20] and Gamma in [31/10, 31/10]", "[1/10, 1/10] and g in [11/50, 11/50]")
    (tmp_path / "statements.txt").write_text("".join(f"{WORDS} {one}\n" for one in ends))
    monkeypatch.setattr("juggleproof.sine.stored.WIDE", tmp_path)
    assert run(["certify", "sine", "--jobs", "1", "--store", str(tmp_path / "found")]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[::2][:2] == [f"certified: {WORDS} {one}" for one in ends]


@pytest.mark.exhaust
def test_the_wide_cover_is_of_boxes_that_the_checker_takes_holds() -> None:
    lines = (WIDE / "certificates.jsonl").read_text().splitlines()
    proved = boxes_in(WIDE)
    assert len(proved) == len(lines)
    for statement in (WIDE / "statements.txt").read_text().splitlines():
        assert outcome(read_statement(statement), proved)[0] == "certified"
    assert sum(len(line) for line in lines) < 1_000_000
    for line in lines[::120]:  # CI reads each by the checker alone
        assert check_line(line)[0] is not None


def test_frequency_and_amplitude_give_the_drive(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = ["--alpha", "0.05", "--jobs", "1", "--store", str(tmp_path)]
    # 4 pi^2 25^2 0.001232/9.80665 = 3.09977..
    assert run(["certify", "sine", *options, "--frequency", "25", "--amplitude", "1.232"]) == 0
    assert capsys.readouterr().out.splitlines()[:2] == [
        f"certified: {WORDS} [1/20, 1/20] and Gamma in [30997/10000, 15499/5000]",
        "which holds all tables of 25 Hz with an amplitude of 1.232 mm, under 9.80665 m/s^2",
    ]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--alpha", "0.05"], "needs --alpha A0:A1, and --gamma G0:G1"),
        (["--alpha", "0.05", "--frequency", "30"], "--frequency and --amplitude go together"),
        (["--alpha", "0.05", "--amplitude", "1", "--gamma", "3"], "go together, without --gamma"),
        (["--alpha", "1", "--gamma", "3"], "--alpha 1: restitution is at least 0 and below 1"),
        (["--alpha", "-1/10", "--gamma", "3"], "--alpha -1/10: no interval"),
        (["--alpha", "0.06:0.04", "--gamma", "3"], "begins above its end; write 0.04:0.06"),
        (["--alpha", "0.05", "--gamma", "3.2:3.1"], "begins above its end; write 3.1:3.2"),
        (["--alpha", "0.05", "--gamma", "2.8"], "Gamma = 14/5: below pi (1 - alpha)/(1 + alpha)"),
        (["--alpha", "0.05", "--gamma", "0"], "--gamma 0: a table at rest drives nothing"),
        (["--alpha", "nan", "--gamma", "3"], "--alpha nan: no interval"),
        (["--alpha", "1:2:3", "--gamma", "3"], "--alpha 1:2:3: no interval"),
        (["--alpha", "0.05", "--gamma", "3.1", "--only", "eq-6"], "--only: not for sine"),
        (["--alpha", "0.05", "--gamma", "2.9", "--basin", "0"], "--basin 0: give a closing speed"),
        (["--alpha", "0.05", "--gamma", "2.9", "--basin", "5"], "a closing speed up to 4"),
        (["--alpha", "0.05", "--gamma", "2.9", "--basin", "1:2"], "--basin 1:2: give a closing"),
        (["--alpha", "0.05", "--gamma", "2.9", "--basin", "x"], "--basin x: no interval"),
        (["--basin"], "needs --alpha A0:A1, and --gamma G0:G1"),
        (
            ["--alpha", "0.05", "--gamma", "2.9", "--basin", "--picture", "a.svg"],
            "not with --basin",
        ),
        (["--alpha", "0.05", "--gamma", "3.1", "--store", "/dev/null/a"], "--store /dev/null/a: "),
        (["mine.py", "--basin"], "--basin: for `certify sine` only"),
        (["mine.py", "--alpha", "0.05"], "--alpha: for `certify sine` only"),
    ],
)
def test_rejects_what_is_no_rectangle(
    options: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["certify", "sine", *options]) == 2
    error = capsys.readouterr().err
    assert message in error and error.count("\n") == 1
