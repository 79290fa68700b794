"""`juggleproof explain ID`: all about one claim, or the theorem at one state."""

from __future__ import annotations

import argparse
import json
import textwrap
from collections.abc import Sequence
from pathlib import Path
from types import FunctionType

from juggleproof.command.outputs import busy, folding
from juggleproof.judging.claims import CheckedApart, Claim, claim_named
from juggleproof.judging.conclusions import REFUTED, RULES, conclusion
from juggleproof.judging.judgement import statements_of
from juggleproof.judging.run import by_id, claims_of_files, judge_some, lemmas, store_of
from juggleproof.papers.derivations import derivations_of
from juggleproof.papers.paper import opened
from juggleproof.papers.places import place_of
from juggleproof.reports.errata import counterexample, words_of
from juggleproof.reports.results import reading_of, sharp_range
from juggleproof.reports.tree import print_tree, rules_of
from juggleproof.statements.language import ClaimError, origins_in
from juggleproof.statements.nodes import Certificate
from juggleproof.statements.store import DEFAULT, Store
from juggleproof.statements.work import read

WIDTH = 96  # characters in a line of a rule's conclusion
OF_RULES = "docs/theorem.md says why each rule concludes so; for any map, proofs/coq/orbits"


def command(parsed: argparse.Namespace) -> int:
    """Explains a claim, or the theorem where its own options are given; returns the exit code.
    Raises ClaimError for options that do not go together.
    """
    of_theorem = [
        option
        for option in ("alpha", "state", "bounds")
        if getattr(parsed, option) not in (None, False)
    ]
    if of_theorem and (parsed.id != "theorem" or parsed.files):
        raise ClaimError(f"--{of_theorem[0]} goes with `explain theorem` only")
    if parsed.lines and parsed.files:
        raise ClaimError("--lines goes with the paper's claims only")
    if parsed.bounds:
        if len(of_theorem) > 1 or parsed.premises or parsed.lines:
            raise ClaimError("--bounds stands alone; it has its own alphas and states")
        return _of_theorem("explain-bounds")
    if of_theorem:
        if len(of_theorem) < 2 or parsed.premises or parsed.lines:
            raise ClaimError(
                "give --alpha and --state together, such as --alpha 3/10 --state x=1000,w=-41"
            )
        return _of_theorem("explain-state", parsed.alpha, parsed.state)
    with folding():
        return explain(parsed.id, parsed.files, parsed.premises, parsed.lines)


def _of_theorem(hook: str, *values: object) -> int:
    """Runs an explanation that only some papers have; returns its exit code.  This loads SymPy,
    which few explanations need.  Raises ClaimError where the paper has none.
    """
    explain_it = opened().hook(hook, FunctionType)
    if explain_it is None:
        raise ClaimError("this paper explains no theorem by values; leave out the options for it")
    explained: object = explain_it(*values)
    return explained if isinstance(explained, int) else 1


def explain(
    claim_id: str,
    files: Sequence[Path] = (),
    with_premises: bool = False,
    with_lines: bool = False,
) -> int:
    """Prints all about one claim of the paper or of the files: print, derivation, reading,
    statements, certificates or counterexamples, sharp range, verdict, and the tree of its rules.
    With lines, its place is a line of the transcription.  Raises ClaimError for an unknown name.
    """
    claims = by_id(claims_of_files(files)) if files else opened().claims_by_id
    claim = claims[claim_named(claim_id, claims)]
    store = store_of(files) if files else DEFAULT
    with busy(f"judging {claim.id}"):
        (judgement,) = judge_some([claim], claims, store)
    place = f"section {claim.section} {claim.place}" if with_lines else place_of(claim)
    print(f"{claim.id}   {claim.where if files else place}")
    print(f"  {claim.says}")
    _print_of(claim)
    stated = statements_of(claim, judgement.correction)
    for one in derivations_of(stated) if [*origins_in(stated)] else ():
        print(f"derived     {one.line}")
    print(f"reading     {reading_of(claim.body())}")
    body, verdict = claim.body(), judgement.verdict
    if isinstance(body, CheckedApart):
        print("\n" + textwrap.indent("\n".join(body.sentences), " " * 4))
        print(f"    -> {verdict.word}, {verdict.detail}")
    used = lemmas(claims, [claim])
    held = Store(store)
    below = rules_of(held, [name for name, _ in judgement.statements])
    texts = {
        **{name: held.texts[name] for name in below},
        **used,
        **dict(judgement.statements),
    }
    for name, text in judgement.statements:
        outcome, certificate = judgement.outcomes[name], judgement.certificates[name]
        kind = read(text, name).kind
        is_proved = outcome == "certified" and kind in RULES
        concluded = conclusion(kind, name, texts) if is_proved else ""
        _statement(text, outcome, certificate, not files, concluded)
        for premise in judgement.unproved.get(name, ()):
            print("\n" + textwrap.indent(premise, " " * 8))
    sharp = sharp_range(judgement, claim)
    if judgement.sharp:
        print(f"sharp range {sharp}")
    elif not files and opened().parameter:
        print(f"sharp range none: the claim has no range of {opened().parameter} to settle")
    if judgement.correction:
        print(f"correction  {judgement.correction['text']}")
    print(f"verdict     {verdict.word}" + (f"; {verdict.detail}" if verdict.detail else ""))
    print_tree(claim.id, judgement.rests_on, held, with_premises)
    if any(read(text, name).kind in RULES for name, text in judgement.statements):
        theorem = None if files else opened().theorem
        print(f"proof       {theorem.explained if theorem and theorem.explained else OF_RULES}")
    return 0


def _print_of(claim: Claim) -> None:
    printed = f"\n{'':12}".join(line.strip() for line in claim.printed.splitlines())
    if claim.as_it_stands:
        print(f"stands      {claim.as_it_stands}")
        print(f"restored    {printed}")
    elif claim.printed:
        print(f"printed     {printed}")
    if claim.repeats:
        print(f"repeats     {claim.repeats}")


def _statement(
    text: str, outcome: str, certificate: Certificate, of_paper: bool, concluded: str
) -> None:
    print()
    for line in text.splitlines():
        print(f"    {line}")
    if outcome == "refuted":
        refuted = certificate["refuted"]
        print(f"    -> {REFUTED} at {counterexample(refuted)}")
        words = words_of(text, refuted, of_paper)
        if words:
            print(f"       {words}")
    elif outcome != "certified":
        reason = certificate.get("unknown", "the checker rejects it").replace("\n", "\n    ")
        print(f"    -> {outcome}: {reason}")
    elif concluded:
        row = textwrap.wrap(f"-> certified: {concluded}", WIDTH, subsequent_indent=" " * 3)
        print(textwrap.indent("\n".join(row), " " * 4))
    else:
        shown = json.dumps(certificate["certified"], separators=(",", ":"))
        if of_paper and len(shown) >= 400:
            shown = f"{shown[:400]}... ({len(shown)} characters)"
        print(f"    -> certified by {shown}")
