"""`juggleproof stability`: finds and certifies the behaviour of all orbits of a given map."""

from __future__ import annotations

import argparse
import textwrap
from collections.abc import Iterator
from pathlib import Path

from juggleproof.certificates import checker
from juggleproof.command.outputs import busy
from juggleproof.judging.conclusions import conclusion
from juggleproof.judging.run import claims_of_file
from juggleproof.map_stability.claiming import as_claims
from juggleproof.map_stability.findings import MapVerdict
from juggleproof.map_stability.maps import Map, of_rule, pairs_of, read_file
from juggleproof.map_stability.search import Outcome, search_stability
from juggleproof.statements.language import ClaimError, MapRule
from juggleproof.statements.store import certificate_lines, comment, write_file, write_store


def command(parsed: argparse.Namespace) -> int:
    """Settles every map of the file; returns the exit code of the weakest verdict: 0 where all are
    proved for the whole domain and space, 3 where all are proved at least in part, else 1.

    Raises ClaimError, one line, for a file that cannot be read or written.
    """
    codes = set()
    for count, system in enumerate(maps_of(parsed.file)):
        if count:
            print()
        with busy("searching"):
            found = search_stability(system, budget=parsed.budget)
        print("\n".join(lines_of(system, found, parsed.tried)))
        if parsed.output is not None and found.proof.rules:
            write(parsed.output, system.name, found)
        codes.add(found.finding.verdict.exit_code)
    return next(code for code in (1, 3, 0) if code in codes)


def maps_of(path: Path) -> list[Map]:
    """The maps of a text file, or of the claims of a Python file.  A map has the name of its claim;
    where a claim returns several maps, each adds its own name.
    """
    if path.suffix != ".py":
        return [read_file(path)]
    maps = []
    for claim in claims_of_file(path):
        try:
            rules = map_rules(claim.read())
            for rule in rules:
                name = f"{claim.id}-{rule.name}" if len(rules) > 1 else claim.id
                maps.append(of_rule(rule, name))
        except (ClaimError, checker.Rejected) as problem:
            text = str(problem).removeprefix(f"{claim.id}: ")
            raise ClaimError(f"{claim.where}: {claim.id}: {text}") from None
        except Exception as problem:
            raised = f"{type(problem).__name__}: {problem}"
            raise ClaimError(f"{claim.where}: {claim.id} raises {raised}; mend it") from problem
    if not maps:
        raise ClaimError(
            f"{path}: no claim returns a map; return a MapRule with `state` and `piece`"
        )
    names = [one.name for one in maps]
    for name in names:
        if names.count(name) > 1:
            raise ClaimError(f"{path}: {name} is the name of two maps; rename one")
    return maps


def map_rules(body: object) -> list[MapRule]:
    """The maps among the statements that a claim returns."""
    every = body if isinstance(body, (list, tuple)) else [body]
    rules = [one for one in every if isinstance(one, MapRule)]
    return [one for one in rules if "piece" in dict(pairs_of(one))]


def lines_of(system: Map, found: Outcome, tried: bool) -> Iterator[str]:
    """The lines that report the result for a map."""
    name = system.name
    texts = {rule.name: MapRule(rule.name, rule.rows).text() for rule in found.proof.rules}
    verdict = found.finding.verdict
    yield f"{verdict:8} {name}: {found.finding.sentence}"
    for rule in found.proof.rules:
        kind = found.proof.known[rule.name].kind
        yield f"  {rule.name.rpartition('/')[2]}: {conclusion(kind, rule.name, texts)}"
    if found.tried and (tried or verdict is MapVerdict.UNKNOWN):
        yield "tried"
        yield from (textwrap.indent(line, "  ") for line in found.tried)
    less = verdict is MapVerdict.UNKNOWN or found.finding.attracted
    if less and system.parameters and texts:
        yield f"advice   with numbers in place of {', '.join(system.parameters)} more may be found"
    size = len(certificate_lines(found.proof.certificates))
    count = f"{len(texts)} statement{'' if len(texts) == 1 else 's'}"
    yield f"checked  {count}, {size} bytes of certificates"


def write(folder: Path, name: str, found: Outcome) -> None:
    """Writes the statements as a file of claims, and the certificates beside it as `certify` does.

    Raises ClaimError where the folder cannot be written.
    """
    path = folder / f"{name.replace('-', '_')}.py"
    write_file(path, as_claims(name, found).encode())
    blocks = [comment(found.finding.sentence), *(rule.text() for rule in found.proof.rules)]
    statements = "\n\n".join(block for block in blocks if block) + "\n"
    store = path.with_suffix(".certificates")
    write_store(store, statements, {name: found.proof.certificates})
    print(f"written  {path}, {store}; `juggleproof explain {name} {path}` shows it whole")
