"""The command line: the options of each command, and one clear line for each error."""

from __future__ import annotations

import argparse
import errno
import gc
import os
import re
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, NoReturn

from juggleproof.command.outputs import clear
from juggleproof.command.simulate_options import add_simulate
from juggleproof.scenes.errors import SceneError
from juggleproof.statements.language import ClaimError
from juggleproof.statements.vote import Disagreement

MODULES = {
    "certify": "juggleproof.command.certify",
    "check": "juggleproof.command.check",
    "list": "juggleproof.command.listing",
    "explain": "juggleproof.command.explain",
    "errata": "juggleproof.command.show",
    "bound": "juggleproof.command.bound",
    "stability": "juggleproof.command.stability",
    "export": "juggleproof.command.show",
    "report": "juggleproof.command.report",
    "bench": "juggleproof.command.bound",
}
SCENES = {
    "juggler": "juggleproof.command.juggler.command",
    "part": "juggleproof.command.simulate_part",
    "table": "juggleproof.command.simulate_table",
}
DERIVED = "juggleproof.papers.derived"
SINE = "juggleproof.command.sine"  # runs `certify sine`
OF_SINE = "executor", "picture", "basin"
SINE_OPTIONS = {
    "alpha": "restitution",
    "gamma": "peak acceleration of the table, in g",
    "frequency": "of the table in Hz, with --amplitude instead of --gamma",
    "amplitude": "of the table in mm, from its middle",
}
PROBLEMS = "juggleproof.command.problems"  # runs `certify` for scripts of SMT-LIB
SUFFIX = ".smt2"
FORMATS = "html, latex, pdf, markdown, json, badge or figures"


class _Parser(argparse.ArgumentParser):
    """A parser that reports a wrong argument in one line, and takes an argument that begins like a
    negative number, such as -1/3 or -1:2:5, for a value.
    """

    def __init__(self, *given: Any, **named: Any) -> None:
        super().__init__(*given, **named)  # argparse makes the commands' parsers by this
        self._negative_number_matcher = re.compile(r"-(\d|\.\d|inf)")

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message}; `{self.prog} --help` tells what it takes\n")


class _Version(argparse.Action):
    """An option that prints the name and the installed version."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        metadata = import_module("importlib.metadata")  # loading it takes 0.01 s or more
        try:
            print("juggleproof", metadata.version("juggleproof"))
        except metadata.PackageNotFoundError:
            parser.error("not installed, so that no version is known")
        parser.exit()


def _count(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and len(text) <= 4000 and int(text)):
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is not a whole number from 1 on")
    return int(text)


def build_parser() -> argparse.ArgumentParser:
    """The parser of all commands and their options."""
    parser: argparse.ArgumentParser = _Parser(
        prog="juggleproof",
        description=("Derives, proves or refutes, and independently checks what one paper prints."),
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and exit")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    certify = commands.add_parser("certify", help="derive, prove and check every claim")
    certify.add_argument(
        "files",
        nargs="*",
        type=Path,
        metavar="FILE",
        help="claims of your own (.py) or problems in SMT-LIB (.smt2) instead of the paper's; or"
        " the word sine: the table that moves as a sine, over --alpha and --gamma",
    )
    certify.add_argument(
        "--only", action="append", metavar="ID", help="only this claim (may be given several times)"
    )
    certify.add_argument("--routes", default="exact,z3,boxes", help="exact,z3,boxes (default: all)")
    certify.add_argument(
        "--fresh",
        action="store_true",
        help="state and search again, ignoring stored certificates",
    )
    certify.add_argument(
        "--rederive",
        action="store_true",
        help="derive everything again by SymPy, and compare it with what is kept",
    )
    certify.add_argument(
        "--revote",
        action="store_true",
        help="ask Z3 and the boxes again of each statement; else a vote is quoted where statement,"
        " budget and versions are those of its record",
    )
    certify.add_argument(
        "--jobs",
        type=_count,
        default=0,
        metavar="N",
        help="processes (default: one a core); results do not depend on it",
    )
    certify.add_argument(
        "--budget",
        type=_count,
        default=0,
        metavar="N",
        help="counted work for each statement (default: enough for the paper)",
    )
    certify.add_argument(
        "--accept",
        action="store_true",
        help="write the verdicts into the register, showing before and after",
    )
    certify.add_argument(
        "--store",
        type=Path,
        metavar="DIR",
        help="where certificates are kept (default: certificates/store)",
    )
    shown = certify.add_mutually_exclusive_group()
    shown.add_argument("--all", action="store_true", help="print the table of all claims")
    shown.add_argument("-q", "--quiet", action="store_true", help="print one line")
    certify.add_argument("--json", type=Path, metavar="F", help="write the verdicts as JSON")
    certify.add_argument(
        "--junit", type=Path, metavar="F", help="write the verdicts as a JUnit report"
    )
    certify.add_argument(
        "--markdown",
        type=Path,
        metavar="F",
        help="write a summary as Markdown, such as a CI job shows",
    )
    certify.add_argument(
        "--timings",
        type=Path,
        metavar="F",
        help="write the seconds that each claim took, into the JUnit report too",
    )
    certify.add_argument(
        "--report",
        action="append",
        default=[],
        metavar="F",
        help=f"also write a report on the paper: {FORMATS} (may be given several times)",
    )
    certify.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="DIR",
        help="where reports go (default: juggleproof-report)",
    )

    for option, what in SINE_OPTIONS.items():
        certify.add_argument(f"--{option}", metavar="FROM:TO", help=f"for sine: {what}")
    certify.add_argument(
        "--executor", metavar="ADDRESS", help="for sine: a Dask cluster that shares the boxes"
    )

    certify.add_argument("--picture", type=Path, metavar="F", help="for sine: the boxes, as F.svg")
    certify.add_argument(
        "--basin",
        nargs="?",
        const="6/5",
        metavar="SPEED",
        help="for sine: which share of the impacts with closing speed below SPEED (6/5) tends to"
        " the bounce, at least",
    )

    check = commands.add_parser("check", help="the bare checker over the stored certificates")
    check.add_argument("folder", nargs="?", type=Path, metavar="DIR")
    listed = commands.add_parser("list", help="the claims, with place and registered verdict")
    explain = commands.add_parser("explain", help="one claim whole")
    explain.add_argument("id", metavar="ID")
    explain.add_argument(
        "files",
        nargs="*",
        type=Path,
        metavar="FILE",
        help="with claims of your own (.py): CLAIM is one of them, not of the paper",
    )
    explain.add_argument(
        "--premises",
        action="store_true",
        help="the texts of the premises that the checker's map rules write",
    )
    listed.add_argument("--section", metavar="S", help="only of this section, such as 4.2 or A")
    listed.add_argument("--verdict", metavar="V", help="only with this verdict, such as gap")
    listed.add_argument("--long", action="store_true", help="with the sentence of each claim")
    listed.add_argument("--json", action="store_true", help="as JSON, on standard output")
    for command in (listed, explain):
        command.add_argument(
            "--lines", action="store_true", help="places as lines of the paper's transcription"
        )
    explain.add_argument(
        "--alpha", metavar="A", help="with `theorem`: the restitution, exactly, such as 3/10"
    )
    explain.add_argument(
        "--state",
        metavar="S",
        help=(
            "with `theorem`: x=..,w=.. or beta=..,v=..,r=..,g=..: what is certified, and the orbit"
        ),
    )
    explain.add_argument(
        "--bounds",
        action="store_true",
        help="with `theorem`: the paper's bounds and ours against the worst of stated orbits",
    )
    commands.add_parser(
        "errata", help="what the paper prints wrongly, with correction and exact counterexample"
    )
    bound = commands.add_parser(
        "bound", help="a certified enclosure of the minimum of a polynomial over a box"
    )
    bound.add_argument("polynomial", metavar="POLYNOMIAL", help='such as "x^2 - x*y + 1/2*y^4"')
    bound.add_argument(
        "--box",
        required=True,
        metavar="BOX",
        help="each variable with its rational bounds, such as x=0..1,y=-1/2..3",
    )
    bound.add_argument(
        "--width",
        required=True,
        metavar="W",
        help="how wide the enclosure may be, such as 1e-9; 0 asks for the minimum itself",
    )
    bound.add_argument(
        "--budget", type=_count, default=0, metavar="N", help="boxes to look at (default: 20000)"
    )
    bound.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="DIR",
        help="write statements and certificates there, as `check` reads them",
    )
    stability = commands.add_parser(
        "stability", help="of a map that is given alone: find and prove stability, or refute it"
    )
    stability.add_argument(
        "file",
        type=Path,
        metavar="FILE",
        help="lines state, space, piece, with over and domain of its parameters; or a file of"
        " claims (.py), each of whose maps is settled",
    )
    stability.add_argument("--tried", action="store_true", help="also tell what was tried")
    stability.add_argument(
        "--budget",
        type=_count,
        default=2_000_000,
        metavar="N",
        help="counted work for a premise (default: 2000000)",
    )
    stability.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="DIR",
        help="write the statements as claims (.py), and their certificates, there",
    )
    export = commands.add_parser("export", help="statements for other tools")
    export.add_argument("format", choices=["smt2", "coq", "latex"])
    export.add_argument(
        "ids",
        nargs="*",
        metavar="ID",
        help="claims or statements (default: all); with `coq` also of your own: FILE.py, FILE.smt2,"
        " or a folder of certificates",
    )
    export.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="DIR",
        help="one file a statement there, instead of standard output",
    )
    report = commands.add_parser(
        "report", help="the regenerated appendices, the theorem, errata and figures"
    )
    report.add_argument(
        "--format",
        required=True,
        action="append",
        metavar="F",
        help=f"{FORMATS} (may be given several times)",
    )
    report.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="DIR",
        help="where to write (default: juggleproof-report)",
    )
    add_simulate(commands)
    bench = commands.add_parser(
        "bench", help="speed against error: every method on the same questions, in one run"
    )
    bench.add_argument(
        "--question",
        action="append",
        metavar="Q",
        help="only this question (may be given several times)",
    )
    bench.add_argument(
        "--quick",
        action="store_true",
        help="one question, two widths, a few methods, unless told otherwise",
    )
    bench.add_argument(
        "--widths", metavar="W", help="widths of enclosures (default: 1e-1,1e-2,...,1e-12)"
    )
    bench.add_argument("--seconds", metavar="S", help="limit for each answer (default: 10)")
    bench.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="DIR",
        help="where plots go (default: juggleproof-bench)",
    )
    return parser


def run(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit code: 0 as registered, 1 not, 2 bad input, 130
    interrupted.
    """
    given = list(sys.argv[1:] if arguments is None else arguments)
    if (
        given[:1] == ["bound"]
        and given[1:]
        and given[1][0:1] == "-"
        and given[1] not in ("-h", "-o")
        and given[1][:2] != "--"
    ):
        given[1] = " " + given[1]  # a polynomial with a leading minus, not an option
    parsed = build_parser().parse_args(given)
    gc.set_threshold(50_000)  # there are few cycles, and the search for them takes 10 % of the time
    try:
        code = _dispatch(parsed)
        print(end="", flush=True)  # there may be no standard output to flush
        return code
    except (ClaimError, Disagreement) as problem:
        print(f"juggleproof: {problem}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("juggleproof: interrupted; stored certificates are as they were", file=sys.stderr)
        return 130
    except BrokenPipeError:
        _leave_standard_output()
        return 0
    except OSError as error:
        if error.filename is not None or error.errno not in (
            errno.ENOSPC,
            errno.EIO,
            errno.EFBIG,
            errno.EDQUOT,
        ):
            raise
        _leave_standard_output()
        print(
            f"juggleproof: standard output cannot be written ({error.strerror}); send it elsewhere",
            file=sys.stderr,
        )
        return 2


def _leave_standard_output() -> None:
    """Discards the output that is still in the buffer."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _dispatch(parsed: argparse.Namespace) -> int:
    """Loads the module of the command, and no other, and runs it."""
    if parsed.command in ("bound", "stability"):
        # before numpy: the matrices are small, and sums in one order repeat
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    if parsed.command == "certify" and [str(path) for path in parsed.files] == ["sine"]:
        return int(import_module(SINE).command(parsed))
    for option in (*SINE_OPTIONS, *OF_SINE) if parsed.command == "certify" else ():
        if getattr(parsed, option) is not None:
            raise ClaimError(f"--{option}: for `certify sine` only; leave it out")
    if parsed.command == "certify" and are_scripts(parsed.files):
        return int(import_module(PROBLEMS).command(parsed))
    if parsed.command == "certify" and not parsed.files and (parsed.rederive or parsed.accept):
        import_module(DERIVED).derive_again()  # before a claim is loaded
    if parsed.command == "certify":  # loading the modules of reports takes a second
        report = import_module(MODULES["report"]) if parsed.report else None
        parsed.write_reports = report and report.writer(parsed.report, parsed.output)
    if parsed.command == "simulate":
        return simulate(parsed)
    code: int = import_module(MODULES[parsed.command]).command(parsed)
    return code


def simulate(parsed: argparse.Namespace) -> int:
    """Loads the module of one scene and runs it; returns 130 where it was interrupted.  Raises
    ClaimError, one line, for a scene that cannot be simulated.
    """
    try:
        return int(import_module(SCENES[parsed.scene]).command(parsed))
    except SceneError as problem:
        raise ClaimError(str(problem)) from None
    except KeyboardInterrupt:
        clear()
        print("juggleproof: interrupted; no file was written", file=sys.stderr)
        return 130


def are_scripts(files: Sequence[Path]) -> bool:
    """Whether the files are scripts of SMT-LIB; raises ClaimError where some are and others are
    not.
    """
    scripts = [path for path in files if path.suffix == SUFFIX]
    if scripts and len(scripts) < len(files):
        other = next(path for path in files if path.suffix != SUFFIX)
        raise ClaimError(f"{other}: beside scripts of SMT-LIB; certify files of one kind at a time")
    return bool(scripts)


if __name__ == "__main__":
    sys.exit(run())
