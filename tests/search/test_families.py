"""Conditions solved for alpha: the display says what the certified condition says, and gives up
where a slope has no proved sign.
"""

from fractions import Fraction
from itertools import product

from juggleproof.certificates import checker
from juggleproof.search.certificate import search_proof
from juggleproof.search.families import implies_domain, solved
from juggleproof.statements.language import SharpRange, reals
from juggleproof.statements.states import proves
from juggleproof.statements.work import Budget
from tests.rows import each_row

alpha, K, n = reals("alpha K n")
UNIT = (alpha > 0) & (alpha < 1)
SOLVED = {
    "from on": (K >= 1, alpha * K + alpha - K + 1 >= 0, "(K - 1)/(K + 1) <= alpha < 1"),
    "between": (
        K >= 1,
        (alpha * K + alpha - K + 1 >= 0) & (K - alpha * K - 2 * alpha > 0),
        "(K - 1)/(K + 1) <= alpha < K/(K + 2)",
    ),
    "up to": (K >= 1, 1 - 2 * alpha * K >= 0, "0 < alpha <= 1/(2*K)"),
    "halves": (K >= 1, 4 * alpha * K - K - 3 > 0, "(K + 3)/(4*K) < alpha < 1"),
    "at": (K >= 1, alpha * K + alpha - K + 1 <= alpha * 0, "0 < alpha <= (K - 1)/(K + 1)"),
    "two parts": (K >= 3, (alpha * K < 1) | (2 < alpha * K), "0 < alpha < 1/K or 2/K < alpha < 1"),
}


def stated(domain, condition):
    return SharpRange("x/sharp", (), ("alpha", "K"), UNIT & domain, condition)


@each_row("case", SOLVED)
def test_display_is_the_condition(case):
    domain, condition, shown = SOLVED[case]
    assert solved(stated(domain, condition), "alpha", ["K"]) == shown
    for k, numerator in product(range(3, 8), range(1, 40)):
        values = {"K": Fraction(k), "alpha": Fraction(numerator, 40)}
        there = checker.Context(
            None, {name: checker.number(value, checker.Work()) for name, value in values.items()}
        )
        means = [
            there.formula(checker.parse(part.replace("K", f"({k})")))
            for part in shown.split(" or ")
        ]
        assert (there.formula(checker.parse(str(condition))) is True) == (True in means)


@each_row(
    "condition", [alpha * (K - 2) >= 1, alpha**2 * K >= 1, (alpha * K >= 1) & (2 * alpha * K >= 1)]
)
def test_gives_up_without_a_proved_slope(condition):
    assert solved(stated(K >= 1, condition), "alpha", ["K"]) is None


def test_a_whole_number_that_the_condition_ties():
    ceiling = (n - alpha * n >= 1 + alpha) & (1 + alpha > (n - 1) * (1 - alpha))
    tied = SharpRange("x/sharp", (), ("alpha", "n"), UNIT & ceiling, alpha * n + alpha - n + 1 >= 0)
    exact = SharpRange(
        "x/sharp",
        (),
        ("alpha", "n"),
        UNIT & ceiling,
        ~((alpha * n + alpha - n + 1 < 0) | (alpha * n + alpha - n + 1 > 0)),
    )
    assert not implies_domain(tied, ["n"])
    assert implies_domain(exact, ["n"])


ROOM = """statement demo/room
forall a k v
range a > 0 and a < 1
given (1 + a) - (1 - a)^2*v^2/2 > 0
given v > k
exists d
with d > 0
show (1 - a)^2*k*d < (1 + a) - (1 - a)^2*v^2/2"""


def test_terms_that_serve_at_the_samples_alone_are_given_up_for_others_holds():
    (statement,) = checker.read_statements(ROOM).values()
    proof = search_proof(statement, {}, Budget(300_000))
    assert proof is not None and proves(statement, proof, {})
