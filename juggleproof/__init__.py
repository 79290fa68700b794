"""A proof checker for one dynamical-systems paper, and for inequalities and maps of one's own.

`symbolic` derives what the paper defines, `proofs` states what it says, `certificates` finds and
checks certificates, `scenes` iterates the maps, `benchmarks` measures.  The folders stand beside
this one in the checkout; setup.py maps them to one import name.

What users need can be imported from here; a name loads its file when first used (PEP 562), so that
neither `import juggleproof` nor the checker loads any of it.

>>> from juggleproof import always, claim, enclose_minimum, reals
>>> enclose_minimum("x^2 - x*y + y^2/2", {"x": (-1, 1), "y": (0, 1)}, width=0).low
Fraction(0, 1)
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from juggleproof.certificates.language import ClaimError as ClaimError
    from juggleproof.certificates.language import Iterates as Iterates
    from juggleproof.certificates.language import MapRule as MapRule
    from juggleproof.certificates.language import conjunction as conjunction
    from juggleproof.certificates.language import different as different
    from juggleproof.certificates.language import disjunction as disjunction
    from juggleproof.certificates.language import equal as equal
    from juggleproof.certificates.language import iff as iff
    from juggleproof.certificates.language import implies as implies
    from juggleproof.certificates.language import real as real
    from juggleproof.certificates.language import reals as reals
    from juggleproof.proofs.api import Result as Result
    from juggleproof.proofs.api import certify as certify
    from juggleproof.proofs.bounds import enclose_minimum as enclose_minimum
    from juggleproof.proofs.claims import Claim as Claim
    from juggleproof.proofs.claims import claim as claim
    from juggleproof.proofs.claims import claims_of as claims_of
    from juggleproof.proofs.forms import always as always
    from juggleproof.proofs.forms import exists_some as exists_some
    from juggleproof.proofs.stability.claiming import stability as stability
    from juggleproof.scenes.errors import SceneError as SceneError
    from juggleproof.scenes.juggler.orbits import orbit as orbit
    from juggleproof.scenes.juggler.starts import point as point
    from juggleproof.scenes.juggler.starts import scene as scene
    from juggleproof.scenes.part import ensemble, setting
    from juggleproof.scenes.part.setting import standing as standing

    run_part, part_scene = ensemble.run, setting.scene

else:
    PLACES = {  # the same once more, for whoever runs
        "certificates.language": (
            "ClaimError Iterates MapRule conjunction different disjunction equal iff implies real"
            " reals"
        ),
        "proofs.api": "Result certify",
        "proofs.bounds": "enclose_minimum",
        "proofs.claims": "Claim claim claims_of",
        "proofs.forms": "always exists_some",
        "proofs.stability.claiming": "stability",
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
