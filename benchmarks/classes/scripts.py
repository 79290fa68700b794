"""Large random problems, and random problems with divisions, clauses and commands.  Each is made to
be solvable, or not.
"""

from __future__ import annotations

from itertools import product as choices
from random import Random

from flint import fmpq, fmpq_mpoly

from juggleproof.benchmarks.classes.polynomials import MARGINS
from juggleproof.benchmarks.classes.writing import (
    applied,
    atom,
    denied,
    every,
    implied,
    number,
    point,
    polynomial,
    rational,
    script,
    some,
    variables,
    written,
)

# -------------------------------------------------------------------------------------------------
# Divisions under a negated implication.


def _over(above: str, below: str) -> str:
    return f"(/ {above} {below})"


def _positive_form(random: Random, names: list[fmpq_mpoly]) -> fmpq_mpoly:
    return sum((random.randint(1, 3) * x for x in names), 0 * names[0])


def ratio_and_inverse(random: Random, solvable: bool) -> str:
    """p/q + q/p >= 2 where p and q are positive, with equality where they are equal."""
    names = variables(random.randint(2, 3))
    p, q = (_positive_form(random, names) for _ in range(2))
    there = [random.randint(1, 3) for _ in names]
    q *= fmpq(p(*there)) / fmpq(q(*there))
    more = random.choice(MARGINS) if solvable else fmpq(0)
    total = applied("+", [_over(written(p), written(q)), _over(written(q), written(p))])
    given = every([atom(x, ">") for x in names])
    return script(names, [denied(implied(given, f"(>= {total} {number(2 + more)})"))])


def sum_of_ratios(random: Random, solvable: bool) -> str:
    """x^2/a + y^2/b >= (x + y)^2/(a + b) for a, b > 0, with equality at (x, y) = (a, b).  Source:
    Engel, Problem-Solving Strategies (1998), after Sedrakyan.
    """
    x, y, a, b = names = variables(4)
    first, second = (random.randint(1, 3) * one for one in (a, b))
    left = [_over(written(x**2), written(first)), _over(written(y**2), written(second))]
    right = [_over(written((x + y) ** 2), written(first + second))]
    if solvable:
        right.append(number(random.choice(MARGINS)))
    asked = f"(>= {applied('+', left)} {applied('+', right)})"
    given = every([atom(a, ">"), atom(b, ">")])
    return script(names, [denied(implied(given, asked))])


def mediant(random: Random, solvable: bool) -> str:
    """a/b < c/d with b, d > 0: (m a + n c)/(m b + n d) lies between them; it need not if b and d
    may be negative.
    """
    a, b, c, d = names = variables(4)
    m, n = random.randint(1, 4), random.randint(1, 4)
    middle = _over(written(m * a + n * c), written(m * b + n * d))
    low, high = _over(written(a), written(b)), _over(written(c), written(d))
    given = [f"(< {low} {high})", atom(b, ">")]
    given.append(atom(d, "<") if solvable else atom(d, ">"))
    if solvable:
        given.append(atom(m * b + n * d, ">"))
    asked = every([f"(< {low} {middle})", f"(< {middle} {high})"])
    return script(names, [denied(implied(every(given), asked))])


def divisor_that_vanishes(random: Random, solvable: bool) -> str:
    """t/d is the same number for equal d, even if d is 0; but then it may be any number."""
    x, y = variables(2)
    wave = polynomial(random, [x], 2, 3)
    top = random.randint(1, 5)
    first, second = (_over(number(top), written(one)) for one in (wave, wave.compose(y, y)))
    if solvable:
        root = rational(random, -3, 3)
        wave = wave - wave(root, root)
        asked = implied(atom(x, "=", root), f"(< {_over(number(top), written(wave))} 0.0)")
    else:
        asked = implied(atom(x, "=", y), f"(= {first} {second})")
    return script([x, y], [denied(asked)])


# -------------------------------------------------------------------------------------------------
# Size.


def nested(random: Random, solvable: bool) -> str:
    """A sum of a x + b y, nested term by term, equals c, for x, y between bounds."""
    x, y = variables(2)
    depth, total, text = random.randint(150, 900), 0 * x, "0.0"
    for _ in range(depth):
        one = random.choice((x, y, x + 1, y - 1))
        text = applied("+" if random.random() < 0.9 else "-", [written(one), text])
        total = one + total if text.startswith("(+") else one - total
    there = point(random, 2, 2)
    # both at their lower ends, or the total more than at any corner
    ends = [total(*(a + s for a, s in zip(there, step))) for step in choices((0, 1), repeat=2)]
    value = ends[0] if solvable else max(ends) + 1
    bounds = [
        part for v, a in zip((x, y), there) for part in (atom(v, ">=", a), atom(v, "<=", a + 1))
    ]
    return script([x, y], [*bounds, f"(= {text} {number(value)})"])


def doubled(random: Random, solvable: bool) -> str:
    """Definitions that each use the one before twice: the last is 2^n x."""
    (x,) = variables(1)
    count = random.randint(10, 40)
    rows = [f"(define-fun t0 () Real {x})"]
    for k in range(1, count + 1):
        body = f"(+ t{k - 1} t{k - 1})"
        if random.random() < 0.3:
            body = f"(let ((s t{k - 1})) (+ s s))"
        rows.append(f"(define-fun t{k} () Real {body})")
    there = rational(random, 1, 5)
    facts = [f"(= t{count} {number(2**count * there)})"]
    facts.append(atom(x, "=" if solvable else "<", there))
    head, rest = script([x], facts).split("(assert", 1)
    return head + "\n".join(rows) + "\n(assert" + rest


def linear_system(random: Random, solvable: bool) -> str:
    """Sparse linear inequalities in many variables that hold at a planted point, and one more: the
    opposite of a combination of some of them, at its value there or above it.  Source: Farkas 1902.
    """
    count = random.choice((12, 20, 40, 60, 90))
    names, there = variables(count), [random.randint(-5, 5) for _ in range(count)]
    rows = list[tuple[dict[int, int], int]]()
    for _ in range(count + 5):
        places = random.sample(range(count), 3)
        row = {k: random.choice((-3, -2, -1, 1, 2, 3)) for k in places}
        slack = random.choice((0, 0, 1, 4))
        rows.append((row, sum(f * there[k] for k, f in row.items()) - slack))
    chosen = [(random.randint(1, 3), row) for row in random.sample(rows, random.randint(3, 8))]
    total = dict[int, int]()
    for weight, (factors, _) in chosen:
        for k in factors:
            total[k] = total.get(k, 0) - weight * factors[k]
    least = sum(weight * value for weight, (_, value) in chosen)
    bound = sum(f * there[k] for k, f in total.items()) if solvable else 1 - least
    facts = [
        atom(sum((f * names[k] for k, f in factors.items()), 0 * names[0]), ">=", value)
        for factors, value in [*rows, (total, bound)]
    ]
    return script(names, facts, "QF_LRA")


def differences(random: Random, solvable: bool) -> str:
    """x_j - x_i >= c along a cycle: solvable if the sum of the c's is not positive."""
    count = random.choice((8, 15, 30, 61, 80))
    names = variables(count)
    steps = [random.randint(-9, 9) for _ in names[1:]]
    steps.append(-sum(steps) + (0 if solvable else 1))
    facts = [atom(names[(k + 1) % count] - names[k], ">=", step) for k, step in enumerate(steps)]
    for _ in range(count // 2):  # further ones, which all hold at the solution
        k, m = random.sample(range(count), 2)
        rise = sum(steps[:m]) - sum(steps[:k])
        facts.append(atom(names[m] - names[k], ">=", rise - random.randint(0, 3)))
    random.shuffle(facts)
    return script(names, facts, "QF_LRA")


# -------------------------------------------------------------------------------------------------
# Many variables: bilinear equations, clauses, choices.


def bilinear(random: Random, solvable: bool) -> str:
    """Sparse equations, bilinear in two groups of variables, that hold at a planted point; or the
    last one contradicts a combination of two others.
    """
    half = random.randint(7, 20)
    names = variables(2 * half)
    there = [rational(random, -3, 3, (1, 2)) for _ in names]
    rows = []
    for _ in range(half // 2):
        row = sum(
            (
                random.choice((-2, -1, 1, 2))
                * random.choice(names[:half])
                * random.choice(names[half:])
                for _ in range(3)
            ),
            0 * names[0],
        )
        rows.append(row + random.choice(names) - random.choice(names))
    facts = [atom(row, "=", row(*there)) for row in rows]
    if not solvable:
        a, b = rows[0], rows[1]
        facts.append(atom(2 * a - b, "=", 2 * a(*there) - b(*there) + 1))
    facts += [atom(x, ">=", value - random.randint(0, 2)) for x, value in zip(names, there)]
    return script(names, facts)


def clauses(random: Random, solvable: bool) -> str:
    """Clauses about products and sums; one part of each holds at a planted point.  Or all clauses
    that some atoms and their opposites make.
    """
    count = random.randint(4, 13)
    names = variables(count)
    there = [rational(random, -3, 3, (1, 2)) for _ in names]

    def wave() -> fmpq_mpoly:
        x, y = random.sample(names, 2)
        return random.choice((x, x * y, x - y, x * y + x, x + 2 * y))

    found = []
    for _ in range(2 * count):
        parts = []
        for _ in range(random.randint(1, 2)):
            one = wave()
            parts.append(
                atom(one, random.choice(("<", ">")), one(*there) + rational(random, -4, 4))
            )
        one = wave()
        relation, value = random.choice((("<=", 1), (">=", -1), ("=", 0)))
        parts.append(atom(one, relation, one(*there) + value * fmpq(random.randint(0, 2), 2)))
        random.shuffle(parts)
        found.append(some(parts))
    if not solvable:
        atoms = [(one := wave(), one(*there)) for _ in range(random.randint(1, 3))]
        for signs in choices((True, False), repeat=len(atoms)):
            parts = [
                atom(one, ">", value + random.randint(0, 1)) if up else atom(one, "<", value)
                for up, (one, value) in zip(signs, atoms)
            ]
            found.append(some(parts))
    random.shuffle(found)
    return script(names, found)


def zero_or_one(random: Random, solvable: bool) -> str:
    """x^2 = x for all variables, and a sum with whole weights, whose value is attained; or is odd
    although all weights are even.
    """
    count = random.randint(12, 20) if solvable else random.randint(3, 7)
    names = variables(count)
    weights = [2 * random.randint(1, 9) for _ in names]
    value = sum(w * random.randint(0, 1) for w in weights) + (0 if solvable else 1)
    total = sum((w * x for w, x in zip(weights, names)), 0 * names[0])
    return script(names, [*(atom(x**2, "=", x) for x in names), atom(total, "=", value)])


# -------------------------------------------------------------------------------------------------
# Commands and names of logics.


def _margin(random: Random, solvable: bool) -> list[str]:
    """x^2 + y^2 < 2 m x y + (1 - m^2) y^2 never holds; with more on its right side it does."""
    x, y = variables(2)
    m = rational(random, -2, 2)
    right = 2 * m * x * y - m**2 * y**2 + (random.choice(MARGINS) if solvable else 0)
    return [atom(x**2, "<", right), atom(y, ">=", random.randint(-2, 2))]


def assumed(random: Random, solvable: bool) -> str:
    """Formulas behind Bools that `check-sat-assuming` assumes; a denied Bool says nothing."""
    first, second = _margin(random, solvable)
    logic = random.choice(("QF_NRA", "QF_UFNRA", "ALL"))
    return (
        f"(set-logic {logic})\n(declare-const x1 Real)\n(declare-const x2 Real)\n"
        "(declare-const b1 Bool)\n(declare-const b2 Bool)\n(declare-const b3 Bool)\n"
        f"(assert (=> b1 {first}))\n(assert (= b2 {second}))\n(assert (=> b3 (< x1 x1)))\n"
        "(check-sat-assuming (b1 b2 (not b3)))\n"
    )


def lasting(random: Random, solvable: bool) -> str:
    """Declarations that outlive the pop of their scope, and assertions that do not."""
    first, second = _margin(random, solvable)
    logic = random.choice(("QF_NRA", "NRA", "ALL"))
    return (
        f"(set-option :global-declarations true)\n(set-logic {logic})\n(push 1)\n"
        "(declare-const x1 Real)\n(declare-fun x2 () Real)\n"
        f"(define-fun low () Bool {first})\n(assert (< x1 x1))\n(pop 1)\n"
        f"(assert low)\n(push 1)\n(assert {second})\n(check-sat)\n"
    )


def logics(random: Random, solvable: bool) -> str:
    """A problem under any name of a logic that has it, with a named assertion and a macro."""
    first, second = _margin(random, solvable)
    logic = random.choice(("ALL", "NRA", "QF_NRA", "QF_UFNRA", "QF_NIRA"))
    return (
        f"(set-logic {logic})\n(declare-fun x1 () Real)\n(declare-const x2 Real)\n"
        f"(define-fun both ((p Bool) (q Bool)) Bool (and p q))\n"
        f"(assert (! (both {first} {second}) :named both-hold))\n(check-sat)\n"
    )
