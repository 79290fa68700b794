"""A proof checker for one dynamical-systems paper, and for inequalities and maps of one's own.

This package is the tool.  `symbolic` derives what the paper defines, `proofs` states what it says,
`certificates` checks certificates, `benchmarks` measures; these folders stand beside it in the
checkout, and setup.py maps them to one import name.

The public names can be imported from here; a name loads its file when first used (PEP 562), so that
neither `import juggleproof` nor the checker loads any of these files.

>>> from juggleproof import always, claim, enclose_minimum, reals
>>> enclose_minimum("x^2 - x*y + y^2/2", {"x": (-1, 1), "y": (0, 1)}, width=0).low
Fraction(0, 1)
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from juggleproof.api import Result as Result
    from juggleproof.api import certify as certify
    from juggleproof.judging.bounds import enclose_minimum as enclose_minimum
    from juggleproof.judging.claims import Argument as Argument
    from juggleproof.judging.claims import Assertion as Assertion
    from juggleproof.judging.claims import Claim as Claim
    from juggleproof.judging.claims import Following as Following
    from juggleproof.judging.claims import NotFormalised as NotFormalised
    from juggleproof.judging.claims import Reading as Reading
    from juggleproof.judging.claims import Readings as Readings
    from juggleproof.judging.claims import Remark as Remark
    from juggleproof.judging.claims import Simulated as Simulated
    from juggleproof.judging.claims import claim as claim
    from juggleproof.judging.claims import claims_of as claims_of
    from juggleproof.judging.forms import always as always
    from juggleproof.judging.forms import exists_some as exists_some
    from juggleproof.map_stability.claiming import stability as stability
    from juggleproof.scenes.errors import SceneError as SceneError
    from juggleproof.scenes.juggler.orbits import orbit as orbit
    from juggleproof.scenes.juggler.starts import point as point
    from juggleproof.scenes.juggler.starts import scene as scene
    from juggleproof.scenes.part import ensemble, setting
    from juggleproof.scenes.part.setting import standing as standing
    from juggleproof.statements.language import ClaimError as ClaimError
    from juggleproof.statements.language import Formula as Formula
    from juggleproof.statements.language import Iterates as Iterates
    from juggleproof.statements.language import MapRule as MapRule
    from juggleproof.statements.language import Statement as Statement
    from juggleproof.statements.language import Term as Term
    from juggleproof.statements.language import conjunction as conjunction
    from juggleproof.statements.language import different as different
    from juggleproof.statements.language import disjunction as disjunction
    from juggleproof.statements.language import equal as equal
    from juggleproof.statements.language import iff as iff
    from juggleproof.statements.language import implies as implies
    from juggleproof.statements.language import real as real
    from juggleproof.statements.language import reals as reals
    from juggleproof.statements.language import term as term

    run_part, part_scene = ensemble.run, setting.scene

else:
    PLACES = {  # the same names again, for run time: those above are for type checkers
        "statements.language": (
            "ClaimError Formula Iterates MapRule Statement Term conjunction different disjunction"
            " equal iff implies real reals term"
        ),
        "api": "Result certify",
        "judging.bounds": "enclose_minimum",
        "judging.claims": (
            "Argument Assertion Claim Following NotFormalised Reading Readings Remark Simulated"
            " claim claims_of"
        ),
        "judging.forms": "always exists_some",
        "map_stability.claiming": "stability",
        "scenes.errors": "SceneError",
        "scenes.juggler.orbits": "orbit",
        "scenes.juggler.starts": "point scene",
        "scenes.part.ensemble": "run_part=run",
        "scenes.part.setting": "part_scene=scene standing",
    }
    FILES = {
        name: (file, place or name)
        for file, names in PLACES.items()
        for name, _, place in (one.partition("=") for one in names.split())
    }
    __all__ = sorted(FILES)

    def __getattr__(name):
        if name not in FILES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        file, place = FILES[name]
        return getattr(import_module(f"{__name__}.{file}"), place)

    def __dir__():
        return sorted({*globals(), *FILES})
