"""Maps from their lines, and what one family of functions alone proves of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from juggleproof.proofs.stability.attracting import Strategy
from juggleproof.proofs.stability.certifying import Candidate, Proof
from juggleproof.proofs.stability.functions.candidates import Setting
from juggleproof.proofs.stability.maps import Map, read_rows
from juggleproof.proofs.stability.points import PARAMETERS, fixed_points
from juggleproof.proofs.stability.samples import region, with_licences
from juggleproof.proofs.stability.settings import setting_of
from tests.proofs.command import running


def map_of(text: str, name: str = "m") -> Map:
    """The map that these lines say."""
    return read_rows(name, [(line.split()[0], line.partition(" ")[2]) for line in text.split("\n")])


def at_point(system: Map, *terms: str, inside: bool = False) -> Setting:
    """The fixed point of these terms over the whole domain, or the first; `inside`: the first
    without a coordinate 0.
    """
    system = with_licences(system)
    parameters = region(system.domain, system.parameters, PARAMETERS)
    every = [one for one in fixed_points(system) if one.exists(system, parameters).all()]
    every = [one for one in every if not terms or one.point.terms == terms]
    fixed = next(one for one in every if not inside or "0" not in one.point.terms)
    return setting_of(system, fixed, system.domain)


def of_its_map(setting: Setting) -> Proof:
    """A proof that begins with the map."""
    proof = Proof()
    assert proof.add(setting.system.rule(f"{setting.system.name}/map")), proof.fault
    return proof


def proved(
    setting: Setting,
    candidates: Callable[[Setting], Iterable[Candidate]],
    first: int | None = None,
    licensed: bool = False,
) -> list[str]:
    """The names of the statements that are certified with the first candidates."""
    proof = of_its_map(setting)
    strategy = Strategy(candidates, budget=200_000, first=first, licensed=licensed)
    strategy.settles(proof, setting, print)
    return [rule.name.rpartition("/")[2] for rule in proof.rules]


def first_line(text: str, name: str, folder: Path) -> tuple[int, str]:
    """The exit code of the command for a map, and the first line of what it prints."""
    path = folder / f"{name}.map"
    path.write_text(text + "\n")
    done = running.run("stability", str(path))
    assert not done.stderr
    return done.returncode, done.stdout.split("\n")[0]
