"""What is said of a map is what the checker takes: nothing false is proved, not even at an end
point of the domain that samples miss; what is written can be read again, and not be forged.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from juggleproof import MapRule, stability
from juggleproof.certificates import checker
from juggleproof.command.check import check
from juggleproof.statements.language import ClaimError
from juggleproof.statements.store import CERTIFICATES, STATEMENTS
from tests.command import running
from tests.map_stability.maps import assert_settled, marked, name_of

STABLE, AWAY = "is stable and attracts every state", "does not attract"
SETTLED = {  # the first line of what is printed: the map
    f"proved   halving: 0 {STABLE}": "state x\npiece x/2",
    f"proved   tent: 0 {STABLE}": (
        "over a\ndomain 0 < a and a < 1\nstate x\nspace 0 <= x and x <= 1\npiece a*min(x, 1 - x)"
    ),
    f"in part  cobweb: (1/(s + 1)) {STABLE} if and only if s < 1": (
        "over s\ndomain 0 < s and s < 2\nstate p\nspace p >= 0\npiece max(0, 1 - s*p)"
    ),
    # no map at b = 0
    f"in part  share: (b/(b + 1)) {STABLE} if and only if b > 1, of all parameters with b > 0": (
        "over b\ndomain 0 <= b < 2\nstate p\nspace p >= 0\npiece max(0, 1 - p/b)"
    ),
    f"in part  half-share: at least where b > 0, (b/(b + 1)) {AWAY} 1, which is periodic": (
        "over b\ndomain 0 <= b < 1\nstate p\nspace p >= 0\npiece max(0, 1 - p/b)"
    ),
    # the identity at a = 0
    f"in part  at-rest: 0 {STABLE} if and only if a > 0": (
        "over a\ndomain 0 <= a and a < 1\nstate x\npiece (1 - a)*x"
    ),
    # the first piece has the point beside its guard
    f"proved   side: 0 {STABLE}": "state x\npiece x < 0 -> x/2\npiece x >= 0 -> x/3",
    # of the three, one has no square roots
    f"proved   named: 0 {STABLE}": (
        "state x\nspace -1 <= x <= 1\npiece x/2 + (x^3 - x^2)/8\npoint 0"
    ),
    "unknown  not-fixed: 1 is no fixed point in the space": "state x\npiece x/2\npoint 1",
    # one refutation for each of a > 1, a = 1, a = -1, a < -1
    f"in part  scaling: 0 {STABLE} if and only if -1 < a < 1": (
        "over a\ndomain -3 < a and a < 3\nstate x\npiece a*x"
    ),
    # x + 1 at a = 0
    (
        f"in part  drift: 1/a {STABLE} where a > 0; elsewhere no state of the space is a fixed"
        " point"
    ): "over a\ndomain 0 <= a and a <= 1\nstate x\npiece (1 - a)*x + 1",
    (
        f"refuted  two-points: 0 {AWAY} 6, which is a fixed point; 0 is stable, and attracts every"
        " state with |x| <= 1"
    ): "state x\npiece x <= 1 -> x/2\npiece x > 1 -> x/3 + 4",
    (
        f"refuted  two-cycle: ((a - 1)/a) {AWAY} ((a - sqrt(a^2 - 2*a - 3) + 1)/(2*a)), which is"
        " periodic"
    ): "over a\ndomain 3 < a and a < 7/2\nstate x\nspace 0 < x and x < 1\npiece a*x*(1 - x)",
    "refuted  doubling: 0 is not stable": "state x\npiece 2*x",
    "proved   quotient: (2, 2) is stable and attracts every state": (
        "state x y\nspace x > 0 and y > 0\npiece 1 + x/y, x"
    ),
    "unknown  circle: no fixed point was certified to be stable, or not to be": (
        "over c s\ndomain c^2 + s^2 = 1\nstate x y\npiece c*x - s*y, s*x + c*y"
    ),
    (
        "unknown  two-equations: no parameters were found in the domain a^2 + b^2 = 1 and"
        " 4*a*b = 1; put in what an equation fixes"
    ): "over a b\ndomain a^2 + b^2 = 1 and 4*a*b = 1\nstate x\npiece a*x",
    f"refuted  identity: 0 {AWAY} 1/2, which is a fixed point": "state x\npiece x",
    "refuted  shift: no state of the space is a fixed point": "state x\npiece x + 1",
    "unknown  gap: the map, lines 2, 3: ": "state x\npiece x < 0 -> x/2\npiece x > 0 -> x/3",
    "unknown  overlap: the map, lines 2, 3: ": "state x\npiece x <= 0 -> x/2\npiece x >= 0 -> x/3",
    "unknown  leaving: the map, line 3: ": "state x\nspace 0 <= x and x <= 1\npiece x/2 + 1",
    "unknown  empty: the domain a > 1 and a < 0 is empty": (
        "over a\ndomain a > 1 and a < 0\nstate x\npiece x/2"
    ),
}


MAPS = {name_of(line): text for line, text in SETTLED.items()}


def map_file(folder: Path, name: str) -> Path:
    path = folder / f"{name}.map"
    path.write_text(MAPS[name] + "\n")
    return path


LONG = {"circle", "scaling", "share", "drift", "two-equations", "quotient"}


@pytest.mark.parametrize("line", marked(SETTLED, LONG, pytest.mark.exhaust), ids=name_of)
def test_a_map_is_settled_as_it_behaves_holds(line: str, tmp_path: Path) -> None:
    assert_settled(line, SETTLED[line], tmp_path)


@pytest.mark.exhaust
def test_two_runs_are_the_same_to_the_byte_holds(tmp_path: Path) -> None:
    """In two processes, whose hashes differ."""
    path, results = map_file(tmp_path, "tent"), []
    command = [sys.executable, "-m", "juggleproof.command.main", "stability", str(path)]
    for seed in ("1", "2"):
        folder = tmp_path / seed
        folder.mkdir()
        done = subprocess.run(
            [*command, "--tried", "-o", "."],
            cwd=folder,
            capture_output=True,
            env={**os.environ, "PYTHONPATH": str(running.ROOT), "PYTHONHASHSEED": seed},
            timeout=240,
            check=False,
        )
        assert done.returncode == 0
        files = {one.name: one.read_bytes() for one in folder.rglob("*") if one.is_file()}
        results.append((done.stdout, files))
    assert results[0] == results[1] and len(results[0][1]) == 3


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("written")
    done = running.run("stability", str(map_file(folder, "tent")), "-o", str(folder))
    assert done.returncode == 0
    assert check(folder / "tent.certificates") == 0
    return folder / "tent.certificates"


CHANGED = {
    "a map with a larger slope": (
        STATEMENTS,
        "domain 0 < a and a < 1\n",
        "domain 0 < a and a < 2\n",
    ),
    "a function that falls by more": (STATEMENTS, "loss ", "loss 2 + "),
    "another point": (STATEMENTS, "\npoint 0\n", "\npoint 1/2\n"),
    "a premise without proof": (
        CERTIFICATES,
        '"certified":{',
        '"certified":{"more":["proof",[],[]],',
    ),
}


@pytest.mark.parametrize("change", CHANGED)
def test_rejects_a_written_folder_that_is_changed(
    change: str, store: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, before, after = CHANGED[change]
    for name in (STATEMENTS, CERTIFICATES):
        text = (store / name).read_text()
        assert name != file or before in text
        (tmp_path / name).write_text(text.replace(before, after) if name == file else text)
    assert check(tmp_path) == 1
    assert not capsys.readouterr().out.endswith(" 0 rejected\n")


def test_rejects_every_certificate_of_another_premise(store: Path, tmp_path: Path) -> None:
    """Of the Lyapunov function: each in turn has the proof of the next."""
    lines = [json.loads(line) for line in (store / CERTIFICATES).read_text().splitlines()]
    ((name, certificate),) = [line for line in lines if line[0].endswith("/lyapunov")]
    proofs = certificate["certified"]
    names = list(proofs)
    swapped = 0
    for one, other in zip(names, names[1:]):
        if proofs[one] == proofs[other]:
            continue
        forged = {"certified": {**proofs, one: proofs[other]}}
        rows = [[n, forged if n == name else c] for n, c in lines]
        (tmp_path / STATEMENTS).write_text((store / STATEMENTS).read_text())
        (tmp_path / CERTIFICATES).write_text("".join(json.dumps(row) + "\n" for row in rows))
        assert "rejected" in {word for _, word, _ in checker.check_folder(str(tmp_path))}, one
        swapped += 1
    assert swapped > 5


OWN = """from juggleproof import MapRule, claim, stability

@claim("linear")
def every_orbit_settles():
    \"\"\"Every orbit tends to 0.\"\"\"
    return stability(MapRule("linear", (("state", "x"), ("piece", "SLOPE*x"))))
"""


SEVERAL = """from juggleproof import MapRule, claim

@claim("two")
def every_orbit_settles():
    \"\"\"Every orbit tends to 0.\"\"\"
    state = ("state", "x")
    return [MapRule("slow", (state, ("piece", "x/2"))), MapRule("fast", (state, ("piece", "x/9")))]
"""


def test_maps_of_one_claim_are_apart_holds(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(SEVERAL)
    done = running.run("stability", str(tmp_path / "own.py"), "-o", str(tmp_path / "out"))
    assert (done.returncode, done.stderr) == (0, "")
    for name in ("two-slow", "two-fast"):
        assert f"proved   {name}: 0 {STABLE}\n" in done.stdout
        assert check(tmp_path / "out" / f"{name.replace('-', '_')}.certificates") == 0


MAP = 'MapRule("linear", (("state", "x"), ("piece", "SLOPE*x")))'
FAULTS = {  # what stands in place of the map, and what is wrong with it
    'MapRule("linear", (("state", "x"), ("piece", 0.5)))': (
        "('piece', 0.5) is no line of a rule; write a pair (keyword, text)"
    ),
    'MapRule("linear", ("state x", "piece x/2"))': (
        "'state x' is no line of a rule; write a pair (keyword, text)"
    ),
    'MapRule("linear", (("piece", "x/2"), ("state", "x")))': (
        "the line `state x`: state comes too late; write over, domain, state, space, piece, point"
    ),
    'MapRule("linear", (("state", "x"), ("piece", "sin(x)")))': (
        "the line `piece sin(x)`: sin(..) is no function here; write abs, max or min"
    ),
    'MapRule("linear", (("state", "x"), ("piece", "x/2\\npoint 1")))': (
        "the line `piece x/2 point 1`: unreadable: x/2 point 1; write names, 3/10 or 0.3,"
        " + - * / ^, abs max min, < <= = != >= >, and or not"
    ),
    f"{MAP.replace('SLOPE', '1/2')}, point=['1/']": (
        "the line `point 1/`: unreadable: 1/; write names, 3/10 or 0.3, + - * / ^, abs max min,"
        " < <= = != >= >, and or not"
    ),
    f"{MAP.replace('SLOPE', '1/2')}, point=['0', '0']": (
        "the line `point 0, 0`: 2 terms for 1 state variables; write a term for each of x"
    ),
    f"{MAP.replace('SLOPE', '1/2')}, point=['1']": (
        "unknown: 1 is no fixed point in the space; `juggleproof stability` tells what was tried"
    ),
    f"{MAP.replace('SLOPE', '1/0')}": (
        "the line `piece 1/0*x`: 1/0*x divides by 0; mend the divisor"
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_rejects_a_claim_whose_map_is_wrong_in_one_line(fault: str, tmp_path: Path) -> None:
    file = tmp_path / "own.py"
    file.write_text(OWN.replace(MAP, fault))
    line = f"juggleproof: {file}:3: linear: {FAULTS[fault]}\n"
    for command in (("stability", str(file)), ("certify", str(file), "--jobs", "1")):
        done = running.run(*command)
        assert (done.returncode, done.stdout, done.stderr) == (2, "", line)


def test_rejects_a_claim_that_fails(tmp_path: Path) -> None:
    file = tmp_path / "own.py"
    file.write_text(OWN.replace(MAP, "1/0"))
    done = running.run("stability", str(file))
    raised = f"{file}:3: linear raises ZeroDivisionError: division by zero; mend it"
    assert (done.returncode, done.stderr) == (2, f"juggleproof: {raised}\n")


@pytest.mark.parametrize("stem", ["3d", "my_map", "Hénon", "a b (2)", "class", "x.y"])
def test_what_is_written_of_a_file_with_any_name_is_certified_holds(
    stem: str, tmp_path: Path
) -> None:
    (tmp_path / f"{stem}.map").write_text(MAPS["halving"])
    done = running.run("stability", str(tmp_path / f"{stem}.map"), "-o", str(tmp_path))
    assert done.returncode == 0
    (claims,) = tmp_path.glob("*.py")
    certified = running.run("certify", str(claims), "--jobs", "1", "--routes", "exact")
    assert (certified.returncode, certified.stderr) == (0, "")


def test_what_is_unknown_says_which_premise_with_its_text_holds(tmp_path: Path) -> None:
    done = running.run("stability", str(map_file(tmp_path, "overlap")), "-o", str(tmp_path / "out"))
    assert done.stdout.splitlines() == [
        "unknown  overlap: the map, lines 2, 3: apart-2-1, the guards of pieces 1 and 2 do not"
        " overlap: false at x = 0",
        "tried",
        "  statement overlap/map.apart-2-1",
        "  forall x",
        "  range 0 < 1",
        "  given 0 < 1",
        "  given x >= 0",
        "  given x <= 0",
        "  show 0 = 1",
        "checked  0 statements, 0 bytes of certificates",
    ]
    assert not (tmp_path / "out").exists()


def test_less_work_leaves_a_premise_open_and_says_so_holds(tmp_path: Path) -> None:
    path = str(map_file(tmp_path, "halving"))
    done = running.run("stability", path, "--budget", "10")
    assert done.returncode == 1 and "try --budget 100\n" in done.stdout
    assert running.run("stability", path, "--budget", "2000000").returncode == 0


def test_a_claim_of_the_map_alone_is_certified_holds(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(OWN.replace("SLOPE", "1/2"))
    done = running.run("certify", str(tmp_path / "own.py"), "--routes", "exact")
    assert done.returncode == 0 and "2 statements: 2 certified" in done.stdout


def test_rejects_a_claim_of_a_map_that_is_not_stable(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(OWN.replace("SLOPE", "2"))
    done = running.run("certify", str(tmp_path / "own.py"), "--routes", "exact")
    assert done.returncode == 2 and "linear: refuted: 0 is not stable" in done.stderr


def test_rejects_a_point_that_is_not_fixed() -> None:
    rule = MapRule("halving", (("state", "x"), ("piece", "x/2")))
    assert [one.name for one in stability(rule, point=["0"])] == ["map", "lyapunov"]
    with pytest.raises(ClaimError, match="1 is no fixed point"):
        stability(rule, point=["1"])
