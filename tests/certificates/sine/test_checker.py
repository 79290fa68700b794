"""The second checker accepts what proves its statement, and rejects everything else by its name."""

from __future__ import annotations

import re
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest

from juggleproof.certificates.checker import Work
from juggleproof.certificates.sine import checker, flights
from juggleproof.certificates.sine.checker import check_folder, check_line, main
from tests.certificates.sine import worlds
from tests.certificates.sine.lines import (
    ACCEPTED,
    REJECTED,
    cut_once,
    line,
    packed,
    ranked,
    refuting,
)
from tests.certificates.sine.mutants import NO_STATEMENTS, work_is_bounded
from tests.certificates.sine.states import CODE
from tests.rows import each_row

ROOT = Path(__file__).resolve().parents[3]
BEGINS = worlds.BEGINS


@each_row("name, make", ACCEPTED)
def test_a_line_that_proves_something_is_accepted_holds(name: str, make: object) -> None:
    assert callable(make)
    proves, why = check_line(make())
    assert proves is not None and not why


@each_row("defect, make, why", REJECTED)
def test_rejects_a_line_with(defect: str, make: object, why: str) -> None:
    assert callable(make)
    proves, reason = check_line(make())
    assert proves is None and reason.startswith(why) and reason


@each_row("world", worlds.WORLDS)
def test_rejects_cells_that_go(world: worlds.World) -> None:
    assert worlds.seen(CODE, world) == world.reason


@each_row("name, rectangle, boxes, why", worlds.COVERS)
def test_rejects_a_cover_with(name: str, rectangle: str, boxes: tuple[str, ...], why: str) -> None:
    assert worlds.covered(CODE, rectangle, boxes) == why


@each_row("name, text, expected", worlds.MEETS)
def test_a_statement_is_refuted_where_it_meets_what_refutes_holds(
    name: str, text: str, expected: bool
) -> None:
    assert worlds.refuted(CODE, text) == expected


def test_traps_contract_where_arb_says_so_holds() -> None:
    contract, wrong = worlds.wrong_traps(CODE, 20, seed=1)
    assert contract > 10 and not wrong


def test_strips_absorb_from_the_row_of_their_formula_on_holds() -> None:
    assert not worlds.wrong_strips(CODE)


def test_shares_are_those_of_ranked_cells_holds() -> None:
    assert not worlds.wrong_shares(CODE)


def test_a_basin_is_refuted_by_an_unstable_bounce_alone_holds() -> None:
    assert worlds.basins_in_order(CODE)


def test_drives_are_between_their_bounds_holds() -> None:
    assert not worlds.wrong_drives(CODE, 60, seed=1)


# ------------------------------------------------------------ false theorems


@each_row(
    "alpha, g",
    [("1/20", "7/100"), ("1/20", "78/1000"), ("1/10", "15/100"), ("3/10", "13/100")],
)
def test_rejects_a_true_certificate_moved_to_a_false_theorem(alpha: str, g: str) -> None:
    moved = line(alpha=[alpha, alpha], g=[g, g], grid=[256, 8, 22], trap=[6, 4, 8, "3/2"])
    assert check_line(moved)[0] is None
    assert check_line(line(alpha=[alpha, alpha], g=[g, g]))[0] is None


def folder(path: Path, statements: list[str], lines: list[str]) -> str:
    (path / "statements.txt").write_text("".join(f"{BEGINS} {one}\n" for one in statements))
    (path / "certificates.jsonl").write_text("".join(f"{one}\n" for one in lines))
    return str(path)


TRUE = "alpha in [1/20, 1/20] and g in [197/1000, 197/1000]"
PLASTIC = "alpha in [0, 1/1000] and g in [21/100, 21/100]"
SADDLES = [
    refuting("saddle", "1/20", "7/100", 256, 16),
    refuting("saddle", "1/10", "3/20", 256, 16),
    refuting("saddle", "1/5", ["2023/10000", "2024/10000"], 256, 16),  # Gamma 2.45 is among these
]
FALSE = [
    "alpha in [1/25, 1/20] and g in [3/50, 1/5]",
    "alpha in [1/10, 1/10] and g in [3/20, 3/20]",
    "alpha in [1/5, 1/5] and Gamma in [245/100, 245/100]",
]
DOUBLED = refuting("multiplier", "1/5", "2/7", 16, 16)


def test_a_folder_says_what_its_lines_prove_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    beyond = "alpha in [1/5, 1/5] and g in [2/7, 2/7]"
    statements = [TRUE, PLASTIC, FALSE[0], FALSE[1], FALSE[2], beyond]
    named = folder(tmp_path, statements, [line(), "{}", line("plastic"), *SADDLES, DOUBLED])
    assert main([named]) == 1
    first, *others = capsys.readouterr().out.splitlines()
    assert first == "rejected  certificates.jsonl, line 2: not a line of certificates"
    words = [one.split()[0] for one in others]
    assert words == ["certified", "certified", "refuted", "refuted", "refuted", "refuted"]
    assert [one[10:] for one in others] == [f"{BEGINS} {one}" for one in statements]
    assert main([folder(tmp_path, FALSE, SADDLES)]) == 0


def test_a_wider_statement_than_its_boxes_is_unknown_holds(tmp_path: Path) -> None:
    wider = [TRUE.replace("197/1000]", "198/1000]"), PLASTIC.replace("1/1000", "1/999"), "x"]
    results = check_folder(folder(tmp_path, wider[:2], [line(), line("plastic")]))
    assert [word for _, word, _ in results] == ["unknown", "unknown"]


def test_a_saddle_of_another_rectangle_refutes_nothing_holds(tmp_path: Path) -> None:
    results = check_folder(folder(tmp_path, [TRUE], [line(), *SADDLES]))
    assert [word for _, word, _ in results] == ["certified"]


@pytest.mark.parametrize("rest", NO_STATEMENTS)
def test_rejects_a_statement_that_is_none(
    rest: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([folder(tmp_path, [rest], [])]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_rejects_a_folder_that_is_none(tmp_path: Path) -> None:
    assert main([str(tmp_path)]) == 2
    assert main(["one", "two"]) == 2
    assert main([folder(tmp_path, [], [])]) == 1


def test_work_bounds_what_a_cover_may_take_holds() -> None:
    rectangle = checker.Rectangle("", (Fraction(0), Fraction(1, 2)), "g", (Fraction(), Fraction(1)))
    whole = [((Fraction(k, 160), Fraction(k + 1, 160)), rectangle.values) for k in range(80)]
    assert not worlds.reason(CODE, checker.check_cover, rectangle, whole, Work(1 << 17))
    assert worlds.reason(CODE, checker.check_cover, rectangle, whole, Work(1 << 14))


def test_work_bounds_cells_lines_and_folders_holds() -> None:
    assert work_is_bounded(CODE)


def test_the_command_runs_alone_and_says_what_it_believes_holds(tmp_path: Path) -> None:
    named = folder(tmp_path, [TRUE, FALSE[1]], [line(), SADDLES[1]])
    told = subprocess.run(
        [sys.executable, "-I", "-S", str(ROOT / "certificates" / "sine"), named],
        capture_output=True,
        text=True,
        check=False,
    )
    assert told.returncode == 0, told.stderr
    *digests, first, second = told.stdout.splitlines()
    assert len(digests) >= 2 and all("sha256" in one for one in digests)
    assert first.startswith("certified ") and second.startswith("refuted ")


@pytest.mark.exhaust
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="no process tells its memory")
def test_the_most_columns_and_the_most_cells_take_below_50_megabytes_holds(tmp_path: Path) -> None:
    ranks = bytearray([1]) * (126 << 14)
    ranks[60 * 126 + 3] = 255
    flat = line(
        grid=[1 << 14, 64, 126],
        trap=[384, 96, 128, "3/2"],
        arc=[97 << 6, 262 << 6],
        ranks=packed(bytes(ranks) + bytes([1]) * 4),
    )
    lines = [line(ranks=ranked(lambda one: cut_once(one, 7))), flat]
    assert [check_line(one)[1] for one in lines] == [
        "the bounce is not inside the trap for each alpha",
        "a cell of the trap has a rank",
    ]
    named = folder(tmp_path, [TRUE], lines)
    code = (
        "import runpy, sys; sys.argv = sys.argv[1:]\n"
        "try: runpy.run_path(sys.argv[0], run_name='__main__')\n"
        "finally: print(open('/proc/self/status').read())"
    )
    told = subprocess.run(
        [sys.executable, "-I", "-S", "-c", code, str(ROOT / "certificates" / "sine"), named],
        capture_output=True,
        text=True,
        check=False,
    )
    assert told.stdout.count("rejected") == 2
    (kilobytes,) = re.findall(r"VmHWM:\s+(\d+) kB", told.stdout)
    assert 10_000 < int(kilobytes) < 45_000  # the walks of a column take up to 6 MB more


def test_no_check_can_be_switched_off_holds() -> None:
    for module in (checker, flights):
        assert "assert " not in Path(str(module.__file__)).read_text()
