"""Strategies for the proof that a point is stable and attracts every state: families of functions,
which are tried in order until a candidate is certified.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice

from juggleproof.certificates import checker
from juggleproof.proofs.stability.certifying import (
    BUDGET,
    EFFORTS,
    ENVELOPE_BUDGET,
    LOCAL_BUDGET,
    Candidate,
    Proof,
    Report,
    function_of,
)
from juggleproof.proofs.stability.entering import (
    boxes_of,
    entering_rules,
    rules_into,
    spaces_entered,
    within,
)
from juggleproof.proofs.stability.functions.candidates import (
    Setting,
    equation_candidates,
    lyapunov_candidates,
)
from juggleproof.proofs.stability.functions.contracting_boxes import contracting_box_candidates
from juggleproof.proofs.stability.functions.energies import energy_candidates
from juggleproof.proofs.stability.functions.envelopes import envelope_candidates
from juggleproof.proofs.stability.functions.norms import (
    is_affine,
    local_norm_candidates,
    norm_candidates,
)
from juggleproof.proofs.stability.functions.part_metric import part_metric_candidates
from juggleproof.proofs.stability.functions.ratios import (
    ratio_candidates,
    weighted_distance_candidates,
)
from juggleproof.proofs.stability.functions.saturated import saturated_candidates
from juggleproof.proofs.stability.functions.second_iterate import second_iterate_candidates
from juggleproof.proofs.stability.functions.templates import (
    Function,
    lyapunov_functions,
    quadratic_templates,
    sum_of_quotients,
)
from juggleproof.proofs.stability.functions.two_sided import two_sided_candidates
from juggleproof.proofs.stability.functions.weighted_sums import weighted_sum_candidates
from juggleproof.proofs.stability.samples import around, region
from juggleproof.proofs.stability.settings import known_of
from juggleproof.proofs.stability.terms import as_factor, atoms, renamed, written

SIGNS_BUDGET = 1_000_000
MOST_WORK = 4_000_000  # on all candidates of a kind
ENVELOPES = 4  # that are tried
ROUNDS = (  # efforts, budget, and how many of the candidates get it
    ((1,), 20_000, 24),
    ((1, 2), 50_000, 12),
    (EFFORTS, 100_000, 6),
    (EFFORTS, 400_000, 4),
)
MOST_BOXES, BOX_BUDGET = 3, 300_000
FIRST_BUDGET, INTERVAL_BUDGET = 40_000, 600_000
LOCAL_TRIED = 3  # statements of states close to a point


@dataclass(frozen=True)
class Strategy:
    """A family of functions, with the counted work for a premise of a candidate.

    affine: whether it is for maps alone all of whose pieces are affine; best: how many candidates
    are tried, those of least rank, where it is not 0; first: how many, as they come; licensed:
    whether V may divide by what its set alone says to be positive.
    """

    candidates: Callable[[Setting], Iterable[Candidate]]
    efforts: Sequence[int] = (1, 2)
    budget: int = BUDGET
    affine: bool = False
    best: int = 0
    first: int | None = None
    licensed: bool = False

    def settles(self, proof: Proof, setting: Setting, log: Report) -> bool:
        """Whether a candidate is certified."""
        if self.affine and not is_affine(setting.system):
            return False
        every = self.candidates(setting)
        if self.best:
            every = sorted(every, key=lambda one: one.rank)[: self.best]
        return any(self.takes(proof, setting, one, log) for one in islice(every, self.first))

    def takes(self, proof: Proof, setting: Setting, one: Candidate, log: Report) -> bool:
        """Whether one candidate is certified: for the map, or for the map on the candidate's set,
        which every orbit enters.
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


def of_map(one: Candidate, setting: Setting) -> Candidate:
    """The candidate whose statement is about the map of this setting."""
    rows = (("map", f"{setting.system.name}/{setting.map}"), *one.rule.rows[1:])
    return replace(one, rules=(replace(one.rule, rows=rows),))


def two_sided_without_searches(setting: Setting) -> Iterator[Candidate]:
    """Two-sided candidates for a second time: what their own searches find does not depend on the
    budget.
    """
    return (replace(one, searches={}) for one in two_sided_candidates(setting))


BY_SHAPE = (  # functions that the shape of the map suggests, in order
    Strategy(norm_candidates, EFFORTS, affine=True),
    Strategy(weighted_sum_candidates, budget=SIGNS_BUDGET, affine=True),
    Strategy(saturated_candidates, budget=SIGNS_BUDGET, affine=True),
    Strategy(energy_candidates, EFFORTS, BOX_BUDGET, affine=True),
    Strategy(equation_candidates, EFFORTS, affine=True),
    Strategy(part_metric_candidates, budget=BOX_BUDGET, best=MOST_BOXES),
    Strategy(two_sided_candidates, budget=FIRST_BUDGET, best=MOST_BOXES),
    Strategy(second_iterate_candidates, budget=BOX_BUDGET, licensed=True),
    Strategy(ratio_candidates, budget=BOX_BUDGET, licensed=True),
    Strategy(weighted_distance_candidates, budget=BOX_BUDGET, licensed=True),
    Strategy(contracting_box_candidates, budget=ENVELOPE_BUDGET),
)
ENVELOPE = Strategy(envelope_candidates, budget=ENVELOPE_BUDGET, first=ENVELOPES)
CLOSED = replace(ENVELOPE, candidates=partial(envelope_candidates, closed=True))
IN_BETWEEN = (  # between the rounds of functions that fit samples
    Strategy(two_sided_without_searches, budget=INTERVAL_BUDGET, best=MOST_BOXES),
    ENVELOPE,
    CLOSED,
)
CLOSE_BY = Strategy(local_norm_candidates, budget=LOCAL_BUDGET, first=LOCAL_TRIED)


def settled_by(strategies: Iterable[Strategy], proof: Proof, setting: Setting, log: Report) -> bool:
    """Whether a candidate of one of these strategies is certified."""
    return any(one.settles(proof, setting, log) for one in strategies)


def attracted(proof: Proof, setting: Setting, log: Report) -> bool:
    """Whether the point is certified to be stable and to attract every state, of the space or of a
    box that all orbits enter.
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


def in_entered(proof: Proof, setting: Setting, far: bool, log: Report) -> bool:
    """The same for a part of the space that every orbit enters, as the space of a map."""
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


def by_samples(proof: Proof, setting: Setting, log: Report) -> bool:
    """The same by functions that fit samples, those that are simple and fit well first."""
    every = {one.rule: one for one in fitting_candidates(setting)}  # each once
    found = sorted(every.values(), key=lambda one: one.rank)
    before = proof.work
    for count, (efforts, budget, most) in enumerate(ROUNDS):
        for one in found[:most]:
            if proof.work - before >= MOST_WORK:
                break
            if proof.takes(one, efforts, budget, log):
                return True
        if count == 1 and settled_by(IN_BETWEEN, proof, setting, log):
            return True
    if not found:
        log("no quadratic function, by pieces or over bounds of the space, falls at all samples")
        return False
    taken = proof.add(found[0].rule, *ROUNDS[0][:2])
    log(f"{function_of(found[0].rule)}: {proof.why() or proof.fault}")
    return taken


def divisors(setting: Setting) -> list[str]:
    """What is positive inside the space, for functions that grow without bound at its ends: each
    of its strict bounds times the same at the point, which has no units, then their product.
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


def fitting_candidates(setting: Setting) -> Iterator[Candidate]:
    """The candidates for sums of terms that samples do not refute."""
    system, point = setting.system, setting.point
    tests = around(system, point, region(setting.domain, system.parameters, 500), 20)
    positive = divisors(setting)
    templates = [
        *enumerate(quadratic_templates(system, setting.piece, positive)),
        *((0.0, template) for template in sum_of_quotients(system)),
    ]
    for kind, template in templates:
        for numbers in lyapunov_functions(template, system, setting.states.points, tests.points):
            terms = template.terms(numbers)
            function = Function(tuple(terms), template.parts, template.divisor)
            for one in lyapunov_candidates(setting, function):
                yield replace(one, rank=one.rank + kind + len(" ".join(terms)) / 100)
