"""Strategies for the proof that a point is stable and attracts every state: families of functions,
which are tried in order until a candidate is certified.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice

from juggleproof.certificates import checker
from juggleproof.map_stability import limits
from juggleproof.map_stability.certifying import (
    EFFORTS,
    CandidateProof,
    ProvedStatements,
    Report,
    function_of,
)
from juggleproof.map_stability.entering import (
    boxes_of,
    entering_rules,
    rules_into,
    spaces_entered,
    within,
)
from juggleproof.map_stability.functions.candidates import (
    Setting,
    equation_candidates,
    lyapunov_candidates,
)
from juggleproof.map_stability.functions.contracting_boxes import contracting_box_candidates
from juggleproof.map_stability.functions.energies import energy_candidates
from juggleproof.map_stability.functions.envelopes import envelope_candidates
from juggleproof.map_stability.functions.norms import (
    local_norm_candidates,
    norm_candidates,
)
from juggleproof.map_stability.functions.ratios import (
    ratio_candidates,
    weighted_distance_candidates,
)
from juggleproof.map_stability.functions.saturated import saturated_candidates
from juggleproof.map_stability.functions.second_iterate import second_iterate_candidates
from juggleproof.map_stability.functions.templates import (
    Function,
    lyapunov_functions,
    quadratic_templates,
    sum_of_quotients,
)
from juggleproof.map_stability.functions.two_sided import two_sided_candidates
from juggleproof.map_stability.functions.weighted_terms import (
    part_metric_candidates,
    weighted_sum_candidates,
)
from juggleproof.map_stability.settings import known_of
from juggleproof.map_stability.terms import as_factor, atoms, renamed, written


@dataclass(frozen=True)
class Strategy:
    """A family of functions, with the counted work for a premise of a candidate.

    affine: the family is for maps whose pieces are all affine; best: the number of candidates that
    are tried, those of least rank, or 0 for all in their order; first: the number of candidates
    that are tried in that order; licensed: V may divide by a term that only the candidate's set
    says to be positive.
    """

    candidates: Callable[[Setting], Iterable[CandidateProof]]
    efforts: Sequence[int] = (1, 2)
    budget: int = limits.PREMISE_WORK
    affine: bool = False
    best: int = 0
    first: int | None = None
    licensed: bool = False

    def settles(self, proof: ProvedStatements, setting: Setting, log: Report) -> bool:
        """Return whether a candidate is certified."""
        if self.affine and not setting.system.is_affine:
            return False
        every = self.candidates(setting)
        if self.best:
            every = sorted(every, key=lambda one: one.rank)[: self.best]
        return any(self.takes(proof, setting, one, log) for one in islice(every, self.first))

    def takes(
        self, proof: ProvedStatements, setting: Setting, one: CandidateProof, log: Report
    ) -> bool:
        """Return whether one candidate is certified: for the map, or for the map on the candidate's
        set, which every orbit enters.
        """
        if not self.licensed:
            return proof.takes(one, self.efforts, self.budget, log)
        if proof.takes(of_map(one, setting), self.efforts, self.budget, log):
            return True
        if setting.outer or not proof.fault.startswith(checker.Kind.DIVISION.value):
            return False
        space, count = dict(one.rule.rows)["on"], len(proof.rules)
        part = setting.inside(space)
        if proof.add(part.system.rule(f"{part.system.name}/{part.map}")):
            if proof.takes(of_map(one, part), self.efforts, self.budget, log):
                if proof.add_all(rules_into(replace(setting, domain=proof.domain()), [space])):
                    return True
        proof.keep(count)
        return False


def of_map(one: CandidateProof, setting: Setting) -> CandidateProof:
    """Return the candidate with a statement about the map of this setting."""
    rows = (("map", f"{setting.system.name}/{setting.map}"), *one.rule.rows[1:])
    return replace(one, rules=(replace(one.rule, rows=rows),))


def two_sided_without_searches(setting: Setting) -> Iterator[CandidateProof]:
    """Yield the two-sided candidates for a second try, without their own searches: these do not
    depend on the budget, and would fail again.
    """
    return (replace(one, searches={}) for one in two_sided_candidates(setting))


BY_SHAPE = (  # functions that the shape of the map suggests, in order
    Strategy(norm_candidates, EFFORTS, affine=True),
    Strategy(weighted_sum_candidates, budget=limits.BOX_WORK, affine=True),
    Strategy(saturated_candidates, budget=limits.BOX_WORK, affine=True),
    Strategy(energy_candidates, EFFORTS, limits.BOX_WORK, affine=True),
    Strategy(equation_candidates, EFFORTS, affine=True),
    Strategy(part_metric_candidates, budget=limits.BOX_WORK, best=limits.TRIED_OF_FAMILY),
    Strategy(two_sided_candidates, budget=limits.TWO_SIDED_WORK, best=limits.TRIED_OF_FAMILY),
    Strategy(second_iterate_candidates, budget=limits.BOX_WORK, licensed=True),
    Strategy(ratio_candidates, budget=limits.BOX_WORK, licensed=True),
    Strategy(weighted_distance_candidates, budget=limits.BOX_WORK, licensed=True),
    Strategy(contracting_box_candidates, budget=limits.ENVELOPE_WORK),
)
ENVELOPE = Strategy(envelope_candidates, budget=limits.ENVELOPE_WORK, first=limits.ENVELOPES)
CLOSED = replace(ENVELOPE, candidates=partial(envelope_candidates, closed=True))
IN_BETWEEN = (  # between the rounds of functions that fit samples
    Strategy(
        two_sided_without_searches, budget=limits.TWO_SIDED_AGAIN_WORK, best=limits.TRIED_OF_FAMILY
    ),
    ENVELOPE,
    CLOSED,
)
CLOSE_BY = Strategy(local_norm_candidates, budget=limits.LOCAL_WORK, first=limits.TRIED_OF_FAMILY)


def settled_by(
    strategies: Iterable[Strategy], proof: ProvedStatements, setting: Setting, log: Report
) -> bool:
    """Return whether a candidate of one of these strategies is certified."""
    return any(one.settles(proof, setting, log) for one in strategies)


def attracted(proof: ProvedStatements, setting: Setting, log: Report) -> bool:
    """Return whether the point is certified to be stable and to attract every state of the space.
    The proof may be one for a box that every orbit enters.
    """
    boxes, count = boxes_of(setting.system), len(proof.rules)
    part = within(setting, boxes[-1]) if boxes else setting
    if not settled_by(BY_SHAPE, proof, part, log):
        if not boxes and any(in_entered(proof, setting, far, log) for far in (False, True)):
            return True
        if not by_samples(proof, part, log):
            return False
    if boxes and not proof.add_all(entering_rules(replace(setting, domain=proof.domain()), boxes)):
        proof.keep(count)
        return False
    return True


def in_entered(proof: ProvedStatements, setting: Setting, far: bool, log: Report) -> bool:
    """Return whether it is certified that the point is stable and attracts every state, because
    every orbit enters a part of the space.  This part is the space of a map of its own.
    """
    spaces = spaces_entered(setting, far)
    if not spaces:
        return False
    count, part = len(proof.rules), setting.inside(spaces[-1])
    part = replace(part, have=known_of(part))
    if proof.add(part.system.rule(f"{setting.system.name}/{part.map}")):
        if settled_by(BY_SHAPE, proof, part, log):
            if proof.add_all(rules_into(replace(setting, domain=proof.domain()), spaces)):
                return True
    proof.keep(count)
    return False


def by_samples(proof: ProvedStatements, setting: Setting, log: Report) -> bool:
    """Return whether a function that fits samples certifies that the point is stable and attracts
    every state.  Simple functions that fit well come first.
    """
    every = {one.rule: one for one in fitting_candidates(setting)}  # each once
    found = sorted(every.values(), key=lambda one: one.rank)
    before = proof.work
    for count, (efforts, budget, most) in enumerate(limits.ROUNDS):
        for one in found[:most]:
            if proof.work - before >= limits.FAMILY_WORK:
                break
            if proof.takes(one, efforts, budget, log):
                return True
        if count == 1 and settled_by(IN_BETWEEN, proof, setting, log):
            return True
    if not found:
        log("no quadratic function, by pieces or over bounds of the space, falls at all samples")
        return False
    taken = proof.add(found[0].rule, *limits.ROUNDS[0][:2])
    log(f"{function_of(found[0].rule)}: {proof.why() or proof.fault}")
    return taken


def divisors(setting: Setting) -> list[str]:
    """Return terms that are positive inside the space, for functions that grow without bound at its
    ends: the strict bounds and their product, then each bound times its value at the point, which
    makes V free of units.
    """
    system = setting.system
    put = {name: f"{name}_point" for name in system.state}
    found = []
    for poly, strict in atoms(system.space):
        text = written(poly)
        if strict and poly.is_polynomial() and checker.names_in(text) & set(system.state):
            found.append(as_factor(text))
    several = ["*".join(found)] if len(found) > 1 else []
    both = [f"{one}*{renamed(one, put)}" for one in found if setting.have]
    return several + found + both


def fitting_candidates(setting: Setting) -> Iterator[CandidateProof]:
    """The candidates for sums of terms that samples do not refute."""
    system = setting.system
    positive = divisors(setting)
    templates = [
        *enumerate(quadratic_templates(system, setting.piece, positive)),
        *((0.0, template) for template in sum_of_quotients(system)),
    ]
    for kind, template in templates:
        for numbers in lyapunov_functions(template, system, setting.states.points, setting.tests):
            terms = template.terms(numbers)
            function = Function(tuple(terms), template.parts, template.divisor)
            for one in lyapunov_candidates(setting, function):
                yield replace(one, rank=one.rank + kind + len(" ".join(terms)) / 100)
