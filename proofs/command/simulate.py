"""`juggleproof simulate`: one scene, and nothing that only another one needs."""

from __future__ import annotations

import argparse
import sys
from importlib import import_module

from juggleproof.certificates.language import ClaimError
from juggleproof.proofs.command.outputs import clear
from juggleproof.scenes.errors import SceneError

SCENES = {
    "juggler": "juggler.command",
    "part": "simulate_part",
    "table": "simulate_table",
}


def command(parsed: argparse.Namespace) -> int:
    """Runs a scene; 0, or 130 where it was interrupted.  Raises ClaimError, one line, for what
    cannot be carried out.
    """
    try:
        scene_of = import_module(f"juggleproof.proofs.command.{SCENES[parsed.scene]}")
        return int(scene_of.command(parsed))
    except SceneError as problem:
        raise ClaimError(str(problem)) from None
    except KeyboardInterrupt:
        clear()
        print("juggleproof: interrupted; no file was written", file=sys.stderr)
        return 130
