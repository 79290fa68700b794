"""What `juggleproof simulate part` takes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from proofs.command.numbers import whole


def add_part(scenes: Any) -> None:
    """Adds the scene of the part."""
    part = scenes.add_parser(
        "part",
        help=(
            "the part-orienting scene of section 2.1: table I, figure 2, the still table"
            " (simulated, not proved)"
        ),
    )
    wish = part.add_argument_group("what is computed (default: table I, beside the paper's)")
    wish.add_argument(
        "--sweep", metavar="G", help="table I over a grid: e=FROM:TO:COUNT,mu=FROM:TO:COUNT"
    )
    wish.add_argument(
        "--still",
        action="store_true",
        help="where each block ends on a still table, and the angle that parts them",
    )
    wish.add_argument(
        "--figure", type=Path, metavar="F", help="F.svg: figure 2, the blocks at 0, 0.8 and 3 s"
    )
    wish.add_argument(
        "--animation", type=Path, metavar="F", help="F.html: the same in motion, one file"
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
        default="2x4",
        metavar="F",
        help="centimetres in the plane: 2x4, 1x2 or 1x4 (default: 2x4, inferred)",
    )
    how.add_argument(
        "--amplitudes",
        default="peak",
        metavar="A",
        help="peak or peak-to-peak (default: peak, inferred)",
    )
    how.add_argument(
        "--phase",
        default="0",
        metavar="D",
        help="degrees by which the table's motion along itself leads (default: 0, given)",
    )
    how.add_argument(
        "--launch",
        default="rest",
        metavar="L",
        help="rest or table: how fast blocks start (default: rest, inferred)",
    )
    how.add_argument(
        "--vibration",
        default="30:1",
        metavar="V",
        help="HERTZ:MILLIMETRES along the table, for --figure and --animation (default: 30:1)",
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
        help="tell how often an impact broke a guarantee of the impact law; exit code 1 if any did",
    )
    part.add_argument(
        "-o", "--output", type=Path, metavar="F", help="F.csv or F.npz: table I; F.json: a sweep"
    )
