"""What a user can get wrong is answered by one clear line that names file, claim and mend; nothing
is left half-written.
"""

from __future__ import annotations

import os
import shlex
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.command.running import Done, run, run_anew

ROOT = Path(__file__).resolve().parents[2]
HEAD = (
    "from fractions import Fraction\n"
    "from juggleproof import always, claim, equal, reals\n"
    "x, y = reals('x y')\n"
)


def claim_file(folder: Path, body: str, name: str = "mine", more: str = "") -> Path:
    path = folder / "mine.py"
    path.write_text(
        f"{HEAD}{more}\n@claim({name!r})\ndef one():\n    '''It says so.'''\n    return {body}\n",
        encoding="utf-8",
    )
    return path


def certify(path: Path, *more: str, run: Callable[..., Done] = run) -> Done:
    return run("certify", str(path), "--routes", "exact", "--jobs", "1", *more)


def test_true_claim_is_certified_holds(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x * y <= (x**2 + y**2) / 2)")
    done = certify(path, run=run_anew)
    assert done.returncode == 0, done.stderr
    assert "1 holds" in done.stdout
    bare = subprocess.run(
        [
            sys.executable,
            "-I",
            "-S",
            str(ROOT / "certificates/checker"),
            str(tmp_path / "mine.certificates"),
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    assert bare.returncode == 0 and "1 certified" in bare.stdout


def test_false_claim_is_refuted_with_an_exact_state_holds(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x**2 > x, given=[x > 0])")
    done = certify(path)
    assert done.returncode == 1 and "1 false" in done.stdout
    assert '"refuted"' in (tmp_path / "mine.certificates" / "certificates.jsonl").read_text(
        encoding="utf-8"
    )


BAD = {
    "float": ("always(x < 0.5)", "0.5 is not exact"),
    "division": ("always(y / x < 3, given=[y < 1])", "division by what may vanish"),
    "contradiction": ("always(x > 3, given=[x > 1, x < 0])", "hypotheses contradict"),
    "no statement": ("x", "return always"),
    "truth value": ("always(1 < x < 2)", "no truth value"),
    "not exact": ("always(x < float('nan'))", "not exact"),
}


@pytest.mark.parametrize("defect", sorted(BAD))
def test_rejects_claim_with(defect: str, tmp_path: Path) -> None:
    body, reason = BAD[defect]
    done = certify(claim_file(tmp_path, body))
    assert done.returncode == 2, (done.stdout, done.stderr)
    assert reason in done.stderr and "mine.py:" in done.stderr and "mine" in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1 and "Traceback" not in done.stderr
    assert not (tmp_path / "mine.certificates").exists()


def test_rejects_undeclared_symbol(tmp_path: Path) -> None:
    body = "Statement('', ('x',), (), x < y)"
    done = certify(claim_file(tmp_path, body, more="from juggleproof import Statement\n"))
    assert done.returncode == 2 and "undeclared symbol y" in done.stderr


def test_rejects_duplicate_name(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x < x + 1)")
    path.write_text(
        path.read_text(encoding="utf-8")
        + "\n@claim('mine')\ndef two():\n    '''Again.'''\n    return always(x < x + 2)\n",
        encoding="utf-8",
    )
    done = certify(path)
    assert done.returncode == 2 and "two claims" in done.stderr


def test_rejects_file_that_does_not_parse(tmp_path: Path) -> None:
    path = tmp_path / "mine.py"
    path.write_text("def (:\n", encoding="utf-8")
    done = certify(path)
    assert done.returncode == 2 and "mine.py:1: does not parse" in done.stderr


def test_rejects_absent_file(tmp_path: Path) -> None:
    done = certify(tmp_path / "absent.py")
    assert done.returncode == 2 and "no such file" in done.stderr


def test_rejects_unknown_claim_and_route(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x < x + 1)")
    assert (
        "--only other: no such claim; `juggleproof list`" in certify(path, "--only", "other").stderr
    )
    assert "did you mean mine?" in certify(path, "--only", "mien").stderr
    done = run("certify", str(path), "--routes", "magic")
    assert done.returncode == 2 and "choose from" in done.stderr


def test_rejects_a_file_in_a_folder_that_is_not_there(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x < x + 1)")
    done = certify(path, "--json", str(tmp_path / "absent" / "out.json"))
    assert done.returncode == 2 and "absent is no folder; make it first" in done.stderr
    assert [one.name for one in tmp_path.iterdir()] == ["mine.py"]


def test_what_was_unknown_is_searched_again_holds(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x * y <= (x**2 + y**2) / 2)")
    assert certify(path, "--budget", "10").returncode == 1
    assert certify(path).returncode == 0


def test_counterexample_is_shown_with_both_sides_evaluated_holds(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x * y <= (x**2 + y**2) / 4, given=[x > 0, y > 0])")
    words = "x*y is 1, more than (x^2 + y^2)/4, 1/2."
    done = certify(path)
    assert done.returncode == 1 and f"fails at x = 1, y = 1: {words}" in done.stdout
    assert f"`juggleproof explain ID {path}` shows a claim whole" in done.stdout
    one = run("explain", "mine", str(path))
    assert one.returncode == 0 and words in one.stdout and "mine.py:" in one.stdout


def test_names_of_the_paper_mean_nothing_in_claims_of_ones_own_holds(tmp_path: Path) -> None:
    more = "beta, v, r, g = reals('beta v r g')\n"
    body = "always(beta * g + v**2 / 2 <= r, given=[r > 0, beta >= 0, g > 0])"
    done = certify(claim_file(tmp_path, body, more=more))
    assert done.returncode == 1 and "beta*g + v^2/2 is" in done.stdout
    assert not any(noun in done.stdout for noun in ("ball", "energy", "height"))


def test_certificate_of_a_claim_of_ones_own_is_shown_whole_holds(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x**2 + 1 >= 2 * x)")
    for _ in range(2):  # before and after there is a store
        done = run("explain", "mine", str(path))
        assert done.returncode == 0 and '-> certified by ["proof",[],["' in done.stdout
        assert "verdict     holds" in done.stdout
        certify(path)


def test_why_a_claim_is_open_is_shown_holds(tmp_path: Path) -> None:
    done = certify(claim_file(tmp_path, "always(x * y <= x**2 + y**2)"), "--budget", "10")
    assert done.returncode == 1 and "mine/main is open: the budget" in done.stdout


def test_progress_without_a_terminal_is_lines_on_standard_error_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = claim_file(tmp_path, "always(x < x + 1)")
    assert certify(path).stderr == ""
    monkeypatch.setattr("juggleproof.command.outputs.PAUSE", 0.0)
    done = certify(path)
    assert done.stderr == "1 of 1 claims judged\n" and "judged" not in done.stdout


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        (("--report", "html", "FILE"), "leave out FILE and --only"),
        (("--report", "html", "--only", "eq-1"), "leave out FILE and --only"),
        (("-o", "reports"), "name one with --report"),
        (("--report", "docx"), "choose from html"),
        (("--report", "html", "-o", "FILE"), "not a folder"),
    ],
)
def test_rejects_reports_that_cannot_be_made(
    given: tuple[str, ...], reason: str, tmp_path: Path
) -> None:
    path = claim_file(tmp_path, "always(x < x + 1)")
    done = run("certify", *(str(path) if one == "FILE" else one for one in given))
    assert done.returncode == 2 and not done.stdout and reason in done.stderr
    assert len(done.stderr.splitlines()) == 1 and [*tmp_path.iterdir()] == [path]


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser can write everywhere")
def test_rejects_folder_that_cannot_be_written(tmp_path: Path) -> None:
    folder = tmp_path / "closed"
    folder.mkdir(mode=0o500)
    done = certify(claim_file(tmp_path, "always(x < x + 1)"), "--store", str(folder / "store"))
    assert done.returncode == 2 and "cannot be written" in done.stderr


def test_rejects_store_that_is_a_file(tmp_path: Path) -> None:
    (tmp_path / "store").write_text("", encoding="utf-8")
    done = certify(claim_file(tmp_path, "always(x < x + 1)"), "--store", str(tmp_path / "store"))
    assert done.returncode == 2 and len(done.stderr.strip().splitlines()) == 1, done.stderr


def test_second_run_changes_no_byte_holds(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x * y <= (x**2 + y**2) / 2)")
    certify(path)
    folder = tmp_path / "mine.certificates"
    before = {file.name: (file.read_bytes(), file.stat().st_mtime_ns) for file in folder.iterdir()}
    certify(path, run=run_anew)
    assert {
        file.name: (file.read_bytes(), file.stat().st_mtime_ns) for file in folder.iterdir()
    } == before


def test_number_of_processes_changes_no_byte_holds(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x * y <= (x**2 + y**2) / 2)")
    text = path.read_text(encoding="utf-8")
    path.write_text(
        text
        + "\n@claim('two')\ndef two():\n    '''Squares.'''\n    return always(x**2 + 1 >= 2 * x)\n",
        encoding="utf-8",
    )
    outputs = []
    for jobs in ("1", "2"):
        store = tmp_path / jobs
        more = ("--routes", "exact", "--jobs", jobs, "--store", str(store))
        done = run("certify", str(path), *more)
        assert done.returncode == 0, done.stderr
        outputs.append(({file.name: file.read_bytes() for file in store.iterdir()}, done.stdout))
    assert outputs[0] == outputs[1]


def test_rejects_tampered_certificate(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x * y <= (x**2 + y**2) / 2)")
    certify(path)
    stored = tmp_path / "mine.certificates" / "certificates.jsonl"
    good = stored.read_bytes()
    for bad in (
        good.replace(b'"2"', b'"3"'),
        good[:-20],
        good.replace(b'"psatz"', b'"magic"'),
        b"[1.5]",
        b"{" * 5000,
    ):
        stored.write_bytes(bad)
        done = run("check", str(stored.parent))
        assert (
            done.returncode == 1
            and "rejected" in done.stdout
            and "mine" in done.stdout
            and not done.stderr
        )


EMPTY = {
    "an empty assertion": "Assertion(())",
    "empty readings": "Readings({n: Reading(Assertion(()), n) for n in 'ab'})",
    "an argument without statements": "Argument({}, proved_by='nothing')",
    "an empty conclusion": "Argument({}, conclusion=Assertion(()))",
    "an empty step": "Argument({'s': Assertion(())}, proved_by='nothing')",
    "nothing beside": "Following(('mine/main',), Assertion(()))",
}
BODIES = (
    "from juggleproof import Argument, Assertion, Following, NotFormalised, Readings,"
    " Reading, Simulated\nfrom juggleproof.judging.claims import CheckedApart\n"
)


@pytest.mark.parametrize("defect", EMPTY)
def test_rejects_a_claim_of(defect: str, tmp_path: Path) -> None:
    done = certify(claim_file(tmp_path, EMPTY[defect], more=BODIES))
    assert done.returncode == 2 and not done.stdout
    assert done.stderr.count("\n") == 1 and "mine asserts nothing in a part" in done.stderr


def test_rejects_a_checker_of_ones_own(tmp_path: Path) -> None:
    body = "CheckedApart(('1 = 2',), 'the checker', lambda: [('1 = 2', 'certified', '')], '')"
    done = certify(claim_file(tmp_path, body, more=BODIES))
    assert done.returncode == 2 and not done.stdout
    assert done.stderr.count("\n") == 1 and "no other checker certifies" in done.stderr


def two_claims(folder: Path, first: str, second: str) -> Path:
    more = f"{BODIES}@claim('first')\ndef first():\n    'It says so.'\n    return {first}\n"
    return claim_file(folder, second, more=more)


BY = "Argument({{'s': Assertion((always(y**2 {}),))}}, proved_by={!r})"


@pytest.mark.parametrize(
    "first, second, verdict",
    [
        ("< 0", BY.format(">= 0", "first"), "unknown; conclusion open; awaits first"),
        ("< 0", BY.format("> 0", "first"), "gap; step s is false; conclusion open"),
        (">= 0", BY.format("> 0", "first"), "gap; step s is false; conclusion by first"),
        (">= 0", BY.format(">= 0", "first"), "holds"),
        (">= 0", BY.format(">= 0", "mine"), "unknown; conclusion open; awaits mine"),
        (">= 0", BY.format(">= 0", "none"), "unknown; conclusion open; awaits none"),
        (">= 0", "Following(('first/main',))", "unknown; awaits first/main"),
    ],
)
def test_a_conclusion_follows_from_claims_that_hold_and_from_rules_alone_holds(
    first: str, second: str, verdict: str, tmp_path: Path
) -> None:
    path = two_claims(tmp_path, f"always(x**2 {first})", second)
    done = certify(path)
    assert done.returncode == int(verdict != "holds")
    assert verdict == "holds" or f"\nmine: {verdict.replace('; ', ': ', 1)}\n" in done.stdout
    assert f"\nverdict     {verdict}\n" in run("explain", "mine", str(path)).stdout


@pytest.mark.parametrize(
    "body",
    [
        "Simulated({0!r})",
        "NotFormalised({0!r})",
        "always(x**2 < 0)",
        "Argument({{'s': Assertion((always(x**2 >= 0),))}}, proved_by={0!r})",
    ],
)
def test_rejects_lines_and_signs_in_a_text_of_a_claim(body: str, tmp_path: Path) -> None:
    text = "so\ntheorem: proved\x1b[2K\u202e  holds"
    path = tmp_path / "mine\nverdict     holds.py"
    path.write_text(
        f"{HEAD}{BODIES}def one():\n    return {body.format(text)}\none.__doc__ = {text!r}\n"
        f"claim('mine', {text!r}, {text!r}, repeats={text!r})(one)\n",
        encoding="utf-8",
    )
    for done in (certify(path), run("explain", "mine", str(path))):
        lines = done.stdout.split("\n")
        assert all(line.isprintable() for line in lines)
        assert not any(line.startswith(("theorem:", "verdict     holds")) for line in lines)


SLOW = """
import os, time
from pathlib import Path

for name in ("slow", "slower"):

    @claim(name)
    def slow():
        "Slow."
        Path(__file__).with_name(f"{os.getpid()}.judges").touch()
        time.sleep(600)
        return always(x < x + 1)
"""


def at_work(path: Path) -> tuple[subprocess.Popen[str], list[int]]:
    """`certify` of a file with two slow claims added, and its two processes, when both judge one;
    Ctrl-C is heard also where the shell that started the suite ignores it.
    """
    path.write_text(path.read_text(encoding="utf-8") + SLOW, encoding="utf-8")
    heard = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
    command = "from juggleproof.command.main import run; raise SystemExit(run())"
    process = subprocess.Popen(
        [sys.executable, "-c", f"{heard}; {command}", "certify", str(path), "--jobs", "2"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        start_new_session=True,
    )
    while len(judging := list(path.parent.glob("*.judges"))) < 2:
        assert process.poll() is None, process.communicate()
        time.sleep(0.1)
    return process, [int(one.stem) for one in judging]


def is_there(process: int) -> bool:
    """Whether a process runs; one that has ended and is not yet fetched does not."""
    try:
        status = Path(f"/proc/{process}/stat").read_text(encoding="ascii")
    except (FileNotFoundError, ProcessLookupError):
        return False
    return status.rpartition(") ")[2][0] not in "ZX"


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
def test_killing_leaves_no_process_behind_holds(tmp_path: Path) -> None:
    process, judging = at_work(claim_file(tmp_path, "always(x * y <= (x**2 + y**2) / 2)"))
    assert all(map(is_there, judging))
    process.kill()
    process.wait()
    ends = time.monotonic() + 120
    while any(map(is_there, judging)) and time.monotonic() < ends:
        time.sleep(0.1)
    assert not any(map(is_there, judging))


def test_interrupt_leaves_the_store_as_it_was_holds(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x * y <= (x**2 + y**2) / 2)")
    certify(path)
    folder = tmp_path / "mine.certificates"
    before = {file.name: file.read_bytes() for file in folder.iterdir()}
    process, _ = at_work(path)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=120)
    assert process.returncode == 130 and "interrupted" in error and "Traceback" not in error
    assert {file.name: file.read_bytes() for file in folder.iterdir()} == before


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("1 // 0", "mine raises ZeroDivisionError"),
        ("MapRule(over='a')", "mine raises TypeError"),
        ("exists_some([x], equal(x * x, 2))", "is no list of names"),
        ("exists_some('x', equal(x * x, 2))", "is no list of names"),
        ("always(x == y)", "equal(a, b)"),
    ],
)
def test_rejects_claim_whose_function_fails(body: str, reason: str, tmp_path: Path) -> None:
    done = certify(claim_file(tmp_path, body, more="from juggleproof import MapRule, exists_some"))
    assert (
        done.returncode == 2
        and reason in done.stderr
        and "mine.py:" in done.stderr
        and len(done.stderr.splitlines()) == 1
    ), done.stderr


def test_rejects_file_that_ends_the_program(tmp_path: Path) -> None:
    path = claim_file(tmp_path, "always(x * x >= 0)", more="raise SystemExit(0)")
    done = certify(path)
    assert done.returncode == 2 and "SystemExit" in done.stderr and "mine.py:4" in done.stderr, (
        done.stderr
    )


def test_rejects_wrong_arguments_in_one_line(tmp_path: Path) -> None:
    wrong = (
        ["certify", "--jobs", "-1"],
        ["certify", "--budget", "0"],
        ["export", "lean", "eq-6"],
        ["explain"],
        [],
        ["certify", str(tmp_path)],
    )
    for arguments in wrong:
        done = run(*arguments)
        assert done.returncode == 2 and not done.stdout and len(done.stderr.splitlines()) == 1, (
            arguments,
            done.stderr,
        )


RULES = '''from juggleproof import MapRule, claim


@claim("mine")
def every_orbit_tends_to_zero():
    """x -> {parameter} x on [0, 1]: 0 is stable, and every orbit tends to it."""
    domain = "{domain}"
    return [MapRule("map", (("over", "{parameter}"), ("domain", domain), ("state", "x"),
                            ("space", "0 <= x and x <= 1"),
                            ("piece", "0 <= x -> {parameter}*x"))),
            MapRule("near", (("map", "mine/map"), ("domain", domain), ("on", "0 <= x"),
                             ("point", "0"), ("weights", "1"),
                             ("rate", "{rate}"), ("radius", "1"), ("size", "1")))]
'''


@pytest.mark.parametrize(
    ("parameter", "domain", "rate", "code", "shown"),
    [
        ("alpha", "0 < alpha and 2*alpha < 1", "alpha", 0, "at least 0 < alpha < 1/2"),
        ("alpha", "0 < alpha and alpha^2 < 1/4", "1/2", 0, "at least 0 < alpha < 1/2"),
        ("a", "0 < a and 2*a < 1", "a", 0, "at least 0 < a < 1/2"),
        ("a", "0 < a and a < 1", "a", 0, "at least 0 < a < 1"),
        ("a", "0 < a and a < 1", "a/2", 1, "unknown"),
    ],
)
def test_rules_of_a_map_of_ones_own_hold(
    parameter: str, domain: str, rate: str, code: int, shown: str, tmp_path: Path
) -> None:
    path = tmp_path / "mine.py"
    path.write_text(RULES.format(parameter=parameter, domain=domain, rate=rate), encoding="utf-8")
    done = certify(path)
    assert done.returncode == code and shown in done.stdout, done.stdout + done.stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no file that is always full")
def test_rejects_standard_output_that_is_full() -> None:
    arguments = ("bound", "x", "--box", "x=0..1", "--width", "0")
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = subprocess.run(
            [sys.executable, "-m", "juggleproof.command.main", *arguments],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            cwd=ROOT,
            timeout=240,
            check=False,
        )
    assert (
        done.returncode == 2
        and "standard output cannot be written" in done.stderr
        and len(done.stderr.splitlines()) == 1
    ), done.stderr


def test_a_closed_standard_output_changes_nothing_holds(tmp_path: Path) -> None:
    command = (
        f"{shlex.quote(sys.executable)} -m juggleproof.command.main"
        " bound x --box x=0..1 --width 0 -o"
        f" {shlex.quote(str(tmp_path / 'bound'))} >&-"
    )
    done = subprocess.run(
        command, shell=True, stderr=subprocess.PIPE, text=True, cwd=ROOT, timeout=240, check=False
    )
    assert (done.returncode, done.stderr) == (0, "") and (
        tmp_path / "bound" / "certificates.jsonl"
    ).exists()
