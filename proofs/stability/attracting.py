"""That a point is stable and attracts every state: the candidates, those that fit samples best
first, until one is certified.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import islice

from juggleproof.certificates import checker
from juggleproof.certificates.language import MapRule
from juggleproof.proofs.stability.certifying import (
    BUDGET,
    EFFORTS,
    Proof,
    Report,
    Search,
    function_of,
    signs_of,
    tried,
)
from juggleproof.proofs.stability.entering import (
    boxes_of,
    entering_rules,
    inner,
    rules_into,
    spaces_entered,
    within,
)
from juggleproof.proofs.stability.functions.contracting_boxes import contracting_box_rules
from juggleproof.proofs.stability.functions.energies import energy_rules
from juggleproof.proofs.stability.functions.envelopes import envelope_rules
from juggleproof.proofs.stability.functions.norms import is_affine, norm_rules
from juggleproof.proofs.stability.functions.part_metric import part_metric_rules
from juggleproof.proofs.stability.functions.ratios import (
    ratio_rules,
    weighted_distance_rules,
)
from juggleproof.proofs.stability.functions.saturated import saturated_rules
from juggleproof.proofs.stability.functions.second_iterate import (
    licensed_space,
    second_iterate_rules,
)
from juggleproof.proofs.stability.functions.templates import (
    Function,
    lyapunov_functions,
    quadratic_templates,
    sum_of_quotients,
)
from juggleproof.proofs.stability.functions.two_sided import two_sided_rules
from juggleproof.proofs.stability.functions.values import (
    Setting,
    equation_rules,
    lyapunov_rules,
)
from juggleproof.proofs.stability.functions.weighted_sums import weighted_sum_rules
from juggleproof.proofs.stability.given import (
    as_factor,
    atoms,
    renamed,
    written,
)
from juggleproof.proofs.stability.samples import (
    around,
    region,
)
from juggleproof.proofs.stability.settings import known_of

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
NO_SEARCH: dict[str, Search] = {}


def attracted(proof: Proof, setting: Setting, log: Report) -> bool:
    """Whether the point is certified to be stable and to attract every state, of the space or of a
    box that all orbits enter.
    """
    boxes, count = boxes_of(setting.system), len(proof.rules)
    part = within(setting, boxes[-1]) if boxes else setting
    if not by_shape(proof, part, log):
        if not boxes and any(in_entered(proof, setting, far, log) for far in (False, True)):
            return True
        if not by_samples(proof, part, log):
            return False
    if boxes:
        setting = replace(setting, domain=proof.domain())
        if not proof.add_all(entering_rules(setting, boxes, setting.system.name), EFFORTS, log):
            proof.keep(count)
            return False
    return True


def in_entered(proof: Proof, setting: Setting, far: bool, log: Report) -> bool:
    """The same for a part of the space that every orbit enters, as the space of a map."""
    spaces = spaces_entered(setting, far)
    if not spaces:
        return False
    count, part = len(proof.rules), inner(setting, spaces[-1])
    part = replace(part, have=known_of(part))
    if not proof.add(part.system.rule(f"{setting.system.name}/{part.map}")):
        if by_shape(proof, part, log):
            inside = replace(setting, domain=proof.domain())
            if proof.add_all(rules_into(inside, spaces), EFFORTS, log):
                return True
    proof.keep(count)
    return False


def by_shape(proof: Proof, setting: Setting, log: Report) -> bool:
    """The same by functions that the shape of the map suggests: for pieces that are affine, and for
    sublevel sets that are boxes.
    """
    name, space = f"{setting.system.name}/lyapunov", setting.system.space
    if is_affine(setting.system):
        for rule in norm_rules(setting, name):
            if not tried(proof, rule, EFFORTS, BUDGET, log):
                return True
        for rule, signs, searches in weighted_sum_rules(setting, space, name):
            if not tried(proof, rule, (1, 2), SIGNS_BUDGET, log, signs, searches):
                return True
        for rule, signs in saturated_rules(setting, space, name):
            if not tried(proof, rule, (1, 2), SIGNS_BUDGET, log, signs):
                return True
        for rule, searches in energy_rules(setting, space, name):
            if not tried(proof, rule, EFFORTS, BOX_BUDGET, log, searches=searches):
                return True
        before = proof.work
        for rule in equation_rules(setting, space, name):
            if proof.work - before >= MOST_WORK:
                break
            if not tried(proof, rule, EFFORTS, BUDGET, log, signs_of(rule)):
                return True
    if in_boxes(proof, setting, log):
        return True
    if len(setting.system.state) == 1:
        return by_second_iterate(proof, setting, log)
    for rule, searches in (*ratio_rules(setting, name), *weighted_distance_rules(setting, name)):
        if certified_on(proof, setting, rule, searches, log):
            return True
    chains = contracting_box_rules(setting, setting.system.name)
    return any(proof.add_all(chain, (1, 2), log, None, searches) for chain, searches in chains)


def by_second_iterate(proof: Proof, setting: Setting, log: Report) -> bool:
    """The same for a map of one variable that decreases, on the space where its images divide by
    nothing that is 0.
    """
    space, name = licensed_space(setting), f"{setting.system.name}/lyapunov"
    part = setting if space == setting.system.space else inner(setting, space)
    return any(
        certified_on(proof, setting, rule, searches, log)
        for rule, searches in second_iterate_rules(part, space, name)
    )


def certified_on(
    proof: Proof,
    setting: Setting,
    rule: MapRule,
    searches: Mapping[str, Search],
    log: Report,
) -> bool:
    """Whether a statement is certified; where V divides by what only its set says to be positive,
    for the map on this set, with the statements that this is the whole space.
    """
    whole = replace(rule, rows=(("map", f"{setting.system.name}/{setting.map}"), *rule.rows[1:]))
    fault = tried(proof, whole, (1, 2), BOX_BUDGET, log, searches=searches)
    if not fault.startswith(checker.Kind.DIVISION.value):
        return not fault
    space, count = dict(rule.rows)["on"], len(proof.rules)
    part = inner(setting, space)
    name = f"{setting.system.name}/{part.map}"
    inside = replace(rule, rows=(("map", name), *rule.rows[1:]))
    if not setting.outer and not proof.add(part.system.rule(name)):
        if not tried(proof, inside, (1, 2), BOX_BUDGET, log, searches=searches):
            licensed = replace(setting, domain=proof.domain())
            if proof.add_all(rules_into(licensed, [space]), EFFORTS, log):
                return True
    proof.keep(count)
    return False


def by_samples(proof: Proof, setting: Setting, log: Report) -> bool:
    """The same by functions that fit samples, those that are simple and fit well first."""
    name, space = f"{setting.system.name}/lyapunov", setting.system.space
    every = {rule: rank for rank, rule in candidates(setting, space, name)}  # each once
    found = sorted(((rank, rule) for rule, rank in every.items()), key=lambda one: one[0])
    before = proof.work
    for count, (efforts, budget, most) in enumerate(ROUNDS):
        for _, rule in found[:most]:
            if proof.work - before >= MOST_WORK:
                break
            if not tried(proof, rule, efforts, budget, log):
                return True
        if count == 1 and (
            len(setting.system.state) == 1
            and in_boxes(proof, setting, log, INTERVAL_BUDGET)
            or any(enveloped(proof, setting, log, closed) for closed in (False, True))
        ):
            return True
    if not found:
        log("no quadratic function, by pieces or over bounds of the space, falls at all samples")
        return False
    best = found[0][1]
    fault = proof.add(best, *ROUNDS[0][:2])
    log(f"{function_of(best)}: {proof.why() or fault}")
    return not fault


def enveloped(proof: Proof, setting: Setting, log: Report, closed: bool) -> bool:
    """Whether the point of a map of one variable is certified, by an envelope, to be stable and to
    attract every state; `closed`: with the loss of a multiplier that may be -1.
    """
    rules = islice(envelope_rules(setting, setting.system.name, closed), ENVELOPES)
    signs = {"bounded": [f"{name}_gap" for name in setting.system.state]}
    return any(proof.add_all(one, (1, 2), log, signs) for one in rules)


def in_boxes(proof: Proof, setting: Setting, log: Report, budget: int = 0) -> bool:
    """The same, by functions whose sublevel sets are boxes; of one variable, intervals."""
    name, space = f"{setting.system.name}/lyapunov", setting.system.space
    again = bool(budget)  # what searches of their own come to does not depend on it
    budget = budget or (BOX_BUDGET if len(setting.system.state) > 1 else FIRST_BUDGET)
    every = [(rank, rule, NO_SEARCH) for rank, rule in part_metric_rules(setting, space, name)]
    every += two_sided_rules(setting, space, name)
    return any(
        not tried(proof, rule, (1, 2), budget, log, searches=NO_SEARCH if again else searches)
        for _, rule, searches in sorted(every, key=lambda one: one[0])[:MOST_BOXES]
    )


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


def candidates(setting: Setting, on: str, name: str) -> Iterator[tuple[float, MapRule]]:
    """Statements `lyapunov` that samples do not refute, each with a number that is small where it
    is simple and fits well.
    """
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
            for rank, rule in lyapunov_rules(setting, function, on, name):
                yield rank + kind + len(" ".join(terms)) / 100, rule
