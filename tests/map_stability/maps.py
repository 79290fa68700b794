"""Maps from their lines, and what one family of functions alone proves of them."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from juggleproof.map_stability import limits
from juggleproof.map_stability.attracting import Strategy
from juggleproof.map_stability.certifying import CandidateProof, ProvedStatements
from juggleproof.map_stability.functions.candidates import Setting
from juggleproof.map_stability.maps import Map, read_rows
from juggleproof.map_stability.points import fixed_points
from juggleproof.map_stability.samples import region, with_licences
from juggleproof.map_stability.settings import setting_of
from juggleproof.map_stability.terms import holds, value
from tests.command import running


def map_of(text: str, name: str = "m") -> Map:
    """The map that these lines say."""
    return read_rows(name, [(line.split()[0], line.partition(" ")[2]) for line in text.split("\n")])


def exact_next(system: Map, point: Mapping[str, Fraction]) -> dict[str, Fraction]:
    """The point with the next state, exactly, by the one piece that applies."""
    ((_, images),) = [piece for piece in system.pieces if holds(piece[0], point)]
    return {**point, **{one: value(image, point) for one, image in zip(system.state, images)}}


def at_point(system: Map, *terms: str, inside: bool = False) -> Setting:
    """The fixed point of these terms over the whole domain, or the first; `inside`: the first
    without a coordinate 0.
    """
    system = with_licences(system)
    parameters = region(system.domain, system.parameters, limits.PARAMETERS)
    every = [one for one in fixed_points(system) if one.exists(system, parameters).all()]
    every = [one for one in every if not terms or one.point.terms == terms]
    fixed = next(one for one in every if not inside or "0" not in one.point.terms)
    return setting_of(system, fixed, system.domain)


def of_its_map(setting: Setting) -> ProvedStatements:
    """A proof that begins with the map."""
    proof = ProvedStatements()
    assert proof.add(setting.system.rule(f"{setting.system.name}/map")), proof.fault
    return proof


def proved(
    setting: Setting,
    candidates: Callable[[Setting], Iterable[CandidateProof]],
    first: int | None = None,
    licensed: bool = False,
) -> list[str]:
    """The names of the statements that are certified with the first candidates."""
    proof = of_its_map(setting)
    strategy = Strategy(candidates, budget=200_000, first=first, licensed=licensed)
    strategy.settles(proof, setting, print)
    return [rule.name.rpartition("/")[2] for rule in proof.rules]


def name_of(line: str) -> str:
    """The name of the map in the first line of what the command prints."""
    return line.partition(":")[0].rpartition(" ")[2]


def marked(lines: Iterable[str], long: Container[str], mark: pytest.MarkDecorator) -> list[Any]:
    """The lines as rows of a test, those of the maps that take long with a mark."""
    return [pytest.param(one, marks=mark) if name_of(one) in long else one for one in lines]


def assert_settled(line: str, text: str, folder: Path) -> None:
    """The command prints this line of the map first, or a line that begins so where it ends with a
    colon, and its exit code is that of the verdict.
    """
    path = folder / f"{name_of(line)}.map"
    path.write_text(text + "\n")
    done = running.run("stability", str(path))
    first = done.stdout.split("\n")[0]
    assert first == line or line.endswith(": ") and first.startswith(line)
    code = {"proved": 0, "in part": 3}.get(line[:8].strip(), 1)
    assert (done.returncode, done.stderr) == (code, "")
