"""The options of `juggleproof simulate`; this file loads no scene."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TypeAlias

from juggleproof.reports.tables import whole

Commands: TypeAlias = "argparse._SubParsersAction[argparse.ArgumentParser]"

# -------------------------------------------------------------------------------------------------
# The options of `juggleproof simulate`: each scene is a sub-command.


def add_simulate(commands: Commands) -> None:
    """Adds the command with its scenes."""
    scenes = commands.add_parser(
        "simulate", help="orbits of a scene, with their error"
    ).add_subparsers(dest="scene", required=True, metavar="SCENE")
    _add_juggler(scenes)
    add_part(scenes)
    _add_table(scenes)


def _add_table(scenes: Commands) -> None:
    table = scenes.add_parser(
        "table", help="a ball on a table that moves as a sine, or another wave (simulated)"
    )
    table.add_argument(
        "--alpha", metavar="A", help="the restitution, below 1; with attractors FROM:TO"
    )
    table.add_argument(
        "--gamma", metavar="G", help="peak acceleration of the table, in gravity; or FROM:TO"
    )
    table.add_argument(
        "--wave",
        default="sine",
        metavar="W",
        help="sine, or weights of the harmonics such as 1,0,0.2 (default: sine)",
    )
    table.add_argument(
        "--state",
        action="append",
        metavar="S",
        help="phase=..,speed=.. of the impact that an orbit starts with (default: 0 and 0)",
    )
    table.add_argument(
        "--periods", type=whole, default=12, metavar="N", help="of the table (default: 12)"
    )
    table.add_argument(
        "--picture",
        metavar="P",
        help=(
            "orbit (ball and table over time), basin (flights to the bounce, and ranks) or"
            " attractors (what balls come to over --alpha 0:0.3 and --gamma 1.8:4.2, or others:"
            " 19,200 points, 33 starts each; some 15 s, a minute at large alpha)"
        ),
    )
    table.add_argument("-o", "--output", type=Path, metavar="F", help="with --picture F.svg")


def _add_juggler(scenes: Commands) -> None:
    juggler = scenes.add_parser(
        "juggler", help="the ball on the bouncing table: orbits of the paper's map f"
    )
    juggler.add_argument("--alpha", metavar="A", help="the restitution, such as 3/10")
    juggler.add_argument(
        "--r", default="1", metavar="R", help="launch speed of the table (default: 1)"
    )
    juggler.add_argument("--g", default="1", metavar="G", help="gravity (default: 1)")
    start = juggler.add_argument_group("where orbits start (one of them)")
    start.add_argument(
        "--state",
        action="append",
        metavar="S",
        help="x=..,w=.. or beta=..,v=..; may be given several times",
    )
    start.add_argument("--grid", metavar="G", help="x=FROM:TO:COUNT,w=FROM:TO:COUNT, or beta and v")
    start.add_argument("--boundary", type=whole, metavar="N", help="N states on the boundary of R")
    start.add_argument(
        "--random", type=whole, metavar="N", help="N states of a box, drawn by --seed"
    )
    start.add_argument(
        "--seed", type=whole, default=0, metavar="N", help="with --random (default: 0)"
    )
    start.add_argument(
        "--box",
        default="x=0:10,w=-5:5",
        metavar="B",
        help="with --random: x=FROM:TO,w=FROM:TO, or beta and v (default: x=0:10,w=-5:5)",
    )
    how = juggler.add_argument_group("how they are followed")
    how.add_argument(
        "--arithmetic",
        default="exact",
        metavar="A",
        help=(
            "exact, enclosed (balls), mp (mpmath) or fast (float64 with error bounds); default:"
            " exact"
        ),
    )
    how.add_argument(
        "--precision", type=whole, metavar="N", help="bits to begin with (enclosed) or digits (mp)"
    )
    how.add_argument(
        "--steps",
        type=whole,
        metavar="N",
        help="periods, or impacts with --impacts (default: 20; with --until-trap 1000 impacts)",
    )
    how.add_argument(
        "--impacts",
        action="store_true",
        help="count and tell impacts only; flights are taken whole",
    )
    how.add_argument(
        "--until-trap", action="store_true", help="stop where only impacts follow for ever"
    )
    how.add_argument(
        "--keep", action="store_true", help="tell every state, not only where orbits end"
    )
    how.add_argument(
        "--times",
        metavar="T",
        help="FROM:TO:COUNT: heights of ball and table at these times, from one start, instead",
    )
    out = juggler.add_argument_group("what is printed")
    out.add_argument(
        "--units",
        default="normal",
        metavar="U",
        help="normal (x, w) or physical (beta, v); default: normal",
    )
    out.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="F",
        help="F.csv or F.npz; with --picture F.svg",
    )
    out.add_argument(
        "--picture",
        metavar="P",
        help=(
            "orbit (ball and table against time), basin (what each state of a grid tends to) or"
            " bifurcation (what orbits tend to as alpha grows, --alpha FROM:TO:COUNT)"
        ),
    )
    words = juggler.add_argument_group("periodic orbits and hard cases")
    words.add_argument(
        "--words",
        action="store_true",
        help="all periodic orbits at this alpha with at most --longest impacts",
    )
    words.add_argument(
        "--longest", type=whole, default=4, metavar="N", help="impacts of a word (default: 4)"
    )
    words.add_argument(
        "--flight", type=whole, metavar="N", help="periods of a flight (default: as many as can be)"
    )
    words.add_argument(
        "--word",
        metavar="W",
        help="flights such as 1,2: the periodic orbit, and for which alpha it exists",
    )
    words.add_argument(
        "--hard-cases", action="store_true", help="the cases at which floats go wrong or might"
    )


# -------------------------------------------------------------------------------------------------
# The options of `juggleproof simulate part`.


def add_part(scenes: Commands) -> None:
    """Adds the scene of the part."""
    part = scenes.add_parser(
        "part",
        help=(
            "the part-orienting scene of section 2.1: table I, figure 2, the still table"
            " (simulated)"
        ),
    )
    wish = part.add_argument_group("what is computed (default: table I, beside the paper's)")
    wish.add_argument(
        "--sweep",
        metavar="G",
        help=(
            "table I over a grid: e=FROM:TO:COUNT,mu=FROM:TO:COUNT, or over all that it leaves"
            " open: readings"
        ),
    )
    wish.add_argument(
        "--orientation",
        action="store_true",
        help="how often parts come to rest on each face, with intervals (default: 1000 --parts)",
    )
    wish.add_argument(
        "--clear",
        metavar="FACES",
        help=(
            "faces such as 0,2: with --sweep amplitude=FROM:TO:COUNT (mm), or e, mu, frequency"
            " (Hz), phase (degrees), frequency-up or amplitude-up, the least value from which on no"
            " part is left on them (default: 200 --parts)"
        ),
    )
    wish.add_argument(
        "--still",
        action="store_true",
        help="where each block ends on a still table, and the angle that parts them",
    )
    wish.add_argument(
        "--figure", type=Path, metavar="F", help="F.svg: figure 2, the blocks at 0, 0.8 and 3 s"
    )
    start = part.add_argument_group("which parts, for --orientation and --clear")
    start.add_argument("--parts", type=whole, metavar="N", help="N parts, drawn by --seed")
    start.add_argument(
        "--angles",
        metavar="A",
        help="from which starting angles: FROM:TO degrees, or a list (default: 0:360)",
    )
    how = part.add_argument_group("what the paper leaves open")
    how.add_argument(
        "--e", metavar="E", help="restitution, 0 to 1 (default: inferred by the stored sweep)"
    )
    how.add_argument(
        "--mu", metavar="M", help="friction, 0 to below 4/3 (default: inferred by the stored sweep)"
    )
    how.add_argument(
        "--face",
        metavar="F",
        help="centimetres in the plane: 2x4, 1x2 or 1x4 (default: inferred by the stored sweep)",
    )
    how.add_argument(
        "--amplitudes",
        metavar="A",
        help="peak or peak-to-peak (default: inferred by the stored sweep)",
    )
    how.add_argument(
        "--phase",
        metavar="D",
        help=(
            "degrees at which the table's sines start, on both axes; or X,Y: along and up (default:"
            " inferred by the stored sweep)"
        ),
    )
    how.add_argument(
        "--launch",
        default="rest",
        metavar="L",
        help="rest or table: how fast blocks start (default: rest, inferred)",
    )
    how.add_argument(
        "--vibration",
        metavar="V",
        help="HERTZ:MILLIMETRES along the table, where it is not table I's (default: 30:1)",
    )
    other = part.add_argument_group(
        "other parts and tables, not those of the paper: all but table I, its sweeps and --still"
    )
    other.add_argument(
        "--shape",
        metavar="S",
        help=(
            "corners of a convex polygon in order, in cm, such as '0,0 4,0 4,2 0,2', or a file of"
            " them"
        ),
    )
    other.add_argument(
        "--along",
        metavar="H",
        help=(
            "how the table moves along itself: HERTZ:MILLIMETRES[:DEGREES], several parted by"
            " commas; instead of --vibration"
        ),
    )
    other.add_argument(
        "--away", metavar="H", help="the same away from itself (default: 60:0.2, given)"
    )
    run = part.add_argument_group("how it is computed")
    run.add_argument(
        "--ensembles",
        type=whole,
        default=24,
        metavar="N",
        help="of 91 blocks, each jittered (default: 24)",
    )
    run.add_argument(
        "--horizon", default="12", metavar="S", help="seconds that a run is long (default: 12)"
    )
    run.add_argument(
        "--seed", type=whole, default=1, metavar="N", help="of the jitter (default: 1)"
    )
    run.add_argument(
        "--tolerance",
        default="1e-12",
        metavar="T",
        help="metres to which corner and table meet (default: 1e-12)",
    )
    run.add_argument(
        "--rest-speed",
        default="1e-3",
        metavar="V",
        help="metres a second; a corner that is slower comes to rest (default: 1e-3)",
    )
    run.add_argument(
        "--jobs",
        type=whole,
        metavar="N",
        help="threads (default: one a core); results do not depend on it",
    )
    run.add_argument(
        "--check",
        action="store_true",
        help="tell how often an impact or a depth broke a guarantee; exit code 1 if any did",
    )
    run.add_argument(
        "--keep",
        type=Path,
        metavar="DIR",
        help="keep ensembles of table I that are done there; the same run goes on from them",
    )
    part.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="F",
        help=(
            "F.csv or F.npz: table I; F.json: its sweep; F.csv or the picture F.svg: --orientation"
            " and --clear"
        ),
    )
