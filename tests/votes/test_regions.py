"""The exact parts that votes rest on: polynomials, formulas, algebraic signs, scales, bounds and
reductions.
"""

from fractions import Fraction
from random import Random

import pytest
from flint import arb, fmpz_mpoly

from juggleproof.algebra.intervals import (
    Enclosed,
    Placed,
    ball,
    ball_ends,
    ends,
    split,
    surely,
)
from juggleproof.algebra.number_field import sign_at
from juggleproof.algebra.numbers import root_number
from juggleproof.algebra.polynomials import factorization, value_at, with_value
from juggleproof.algebra.trees import truth
from juggleproof.votes.branches import (
    BranchRegion,
    reduce_factors,
    regions,
    solve_equations,
)
from juggleproof.votes.questions import (
    Atom,
    VoteQuestion,
    branches,
    questions,
    read_statement,
    scale_variables,
    with_scales_one,
)
from juggleproof.votes.spans import (
    ZERO,
    Expanded,
    bounding_box,
    dyadic,
    intervals,
    span,
)
from tests.rows import each_row

F = Fraction


def goal(*rows: str) -> VoteQuestion:
    return questions(read_statement("\n".join(("statement t/t", *rows))))[-1]


def facts(*rows: str) -> list[Atom]:
    return [part for part in goal(*rows, "show 0 = 1").assumed if isinstance(part, Atom)]


def polynomial(text: str, names: str = "x y") -> fmpz_mpoly:
    return facts(f"forall {names}", f"given {text} > 0")[0].poly


# ---------------------------------------------------------------- algebraic numbers


def test_roots_are_isolated_by_number() -> None:
    cubic = [0, -2, 0, 1]  # x^3 - 2 x
    first, middle, last = (root_number(cubic, k) for k in (1, 2, 3))
    assert not first.is_rational and first < 0 and not last.is_rational and last > 0
    assert middle == 0
    assert sign_at(polynomial("2*x - 1", "x"), [root_number([-1, 0, 4], 2)]) == 0
    with pytest.raises(ValueError, match="no such real root"):
        root_number([1, 0, 1], 1)
    assert root_number([1, -2, 1], 1) == 1
    with pytest.raises(ValueError, match="no such real root"):
        root_number([1, -2, 1], 2)


def test_close_roots_and_rational_roots_between_are_told_apart() -> None:
    # (x - 1)(1000 x^2 - 2001 x + 1000): its roots 0.9689.., 1 and 1.0321..
    mixed = [-1000, 3001, -3001, 1000]
    low, one, high = (root_number(mixed, k) for k in (1, 2, 3))
    assert one == 1 and not low.is_rational and not high.is_rational
    assert low.enclosure(40)[1] < 1 < high.enclosure(40)[0]


def test_signs_at_algebraic_points_are_exact() -> None:
    root2, root3 = root_number([-2, 0, 1], 2), root_number([-3, 0, 1], 2)
    assert sign_at(polynomial("x^2*y^2 - 6"), [root2, root3]) == 0
    assert sign_at(polynomial("(x + y)^2 - 5 - 2*x*y"), [root2, root3]) == 0
    assert sign_at(polynomial("10^12*x*y - 2449489742784"), [root2, root3]) == -1
    assert sign_at(polynomial("10^12*x*y - 2449489742783"), [root2, root3]) == 1
    assert sign_at(polynomial("x^4 - 2*y"), [root2, F(2)]) == 0


def test_a_rational_root_that_looks_algebraic_is_zero() -> None:
    root = root_number([-2, -1, 1], 2)  # (x - 2)(x + 1)
    assert sign_at(polynomial("x - 2", "x"), [root]) == 0


# ---------------------------------------------------------------- formulas


def test_three_valued_truth() -> None:
    a, b = facts("forall x y", "given x > 0", "given y > 0")
    known = {a: True, b: None}
    assert truth(("or", (a, b)), known.__getitem__) is True
    assert truth(("and", (a, b)), known.__getitem__) is None
    assert truth(("and", (b, a)), {a: False, b: None}.__getitem__) is False


def test_branches_drop_contradictions_and_stop_at_the_limit() -> None:
    question = goal(
        "forall x y", "given x > 0 or y > 0", "given not (x > 0) or y > 1", "show x + y > 5"
    )
    parts = branches(question.matrix(), 8)
    assert parts is not None and len(parts) == 3
    assert branches(question.matrix(), 1) is None


def test_values_agree_with_text() -> None:
    poly, random = polynomial("3*x^2*y - x/2 + 1/3"), Random(1)
    for _ in range(20):
        x, y = (F(random.randint(-9, 9), random.randint(1, 9)) for _ in range(2))
        value = 3 * x**2 * y - x / 2 + F(1, 3)
        assert value_at(poly, [x, y]) == 6 * value  # atoms carry coprime integers
        scaled = value_at(poly, [x, y]) * x.denominator**2
        assert value_at(with_value(poly, 0, x), [F(0), y]) in (scaled, scaled / x.denominator**2)


# ---------------------------------------------------------------- scales


def test_scales_are_found_only_where_everything_is_homogeneous() -> None:
    physical = ("forall b v r g", "given r > 0 and g > 0 and b >= 0")
    assert scale_variables(goal(*physical, "show g*b/2 + r*v < r^2")) == ("r", "g")
    assert scale_variables(goal(*physical, "show g*b/2 + r*v < r^2 + 1")) == ("g",)
    assert scale_variables(goal(*physical, "show g*b/2 + r*v < r^2 + g")) == ("r",)
    assert scale_variables(goal(*physical, "show g*b/2 + r*v < r^2 + b + v + g + r")) == ()
    assert (
        scale_variables(goal("forall b v r g", "given r >= 0 and g != 0", "show g*b/2 + r*v < r^2"))
        == ()
    )
    assert scale_variables(
        goal("forall K r x", "integer K", "given r > 0 and K > 0", "show K*x < K*r")
    ) == ("r",)


def test_scales_do_not_change_the_truth() -> None:
    question = goal("forall b v r g", "given r > 0 and g > 0 and b >= 0", "show g*b/2 + r*v < r^2")
    smaller, random = with_scales_one(question, ("r", "g")), Random(2)
    for _ in range(50):
        b, v, r, g = (F(random.randint(-6, 6), random.randint(1, 5)) for _ in range(4))
        if r > 0 and g > 0:
            scaled = [b * g / r**2, v / r, F(1), F(1)]
            one, two = (
                truth(q.matrix(), lambda fact, at=at: fact.holds_at(at))  # type: ignore[misc]
                for q, at in ((question, [b, v, r, g]), (smaller, scaled))
            )
            assert one == two


# ---------------------------------------------------------------- bounds


def test_energy_bounds_both_variables() -> None:
    box = bounding_box(facts("forall x w", "given x >= 0 and 2*x + (1 - w)^2/2 <= 3"), 2)
    assert box is not None and all(end[0] == 0 for side in box for end in side)
    (_, (_, x_high)), ((_, w_low), (_, w_high)) = box
    assert x_high >= F(3, 2) and w_low <= F(-144, 100) and w_high >= F(344, 100) and w_high < 10


@each_row(
    "rows, point",
    [
        (("forall x y", "given x*y >= 1 and y <= 0 and x >= -2"), (F(-1), F(-1))),
        (("forall x y", "given y - x*y^2 + 3 >= 0 and x >= 0 and x <= 1"), (F(0), F(50))),
        (("forall x y", "given 5 - x - y >= 0 and x >= 3 and y >= -4"), (F(9), F(-4))),
        (
            ("forall x y", "given x + x^2*y >= 0 and y <= 0 and x >= -3 and y >= -1"),
            (F(1, 2), F(-1)),
        ),
    ],
)
def test_bounds_keep_every_solution(rows: tuple[str, ...], point: tuple[Fraction, ...]) -> None:
    found, random = facts(*rows), Random(3)
    box = bounding_box(found, 2)
    assert box is not None
    points = [
        point,
        *(
            tuple(F(random.randint(-80, 80), random.randint(1, 8)) for _ in range(2))
            for _ in range(400)
        ),
    ]
    met = [p for p in points if all(fact.holds_at(p) for fact in found)]
    assert point in met
    for p in met:
        assert all(low <= (0, value) <= high for value, (low, high) in zip(p, box))


def test_contradictory_bounds_are_seen() -> None:
    assert bounding_box(facts("forall x", "given x >= 2 and 3*x <= 5"), 1) is None


def test_spans_hold_all_values() -> None:
    poly, random = polynomial("8*x*y - 4*y - 4*x^2*y - x^3"), Random(4)
    box = [((0, F(0)), (0, F(1, 3))), ((0, F(0)), (1, F(0)))]
    low, high = span(Expanded(poly), intervals(box))
    assert low[0] == -1 and high == ZERO
    for _ in range(50):
        value = value_at(poly, [F(random.randint(0, 100), 300), F(random.randint(0, 10**6))])
        assert value <= 0


@each_row(
    "low, high",
    [(F(0), F(1, 3)), (F(-7, 3), F(1000001, 7)), (F(1, 3), F(1, 3)), (F(10**20), F(10**20 + 1))],
)
def test_dyadic_sides_hold_the_interval(low: Fraction, high: Fraction) -> None:
    side = dyadic(low, high)
    assert ends(side)[0] <= low <= high <= ends(side)[1]


def test_halves_cover_the_box() -> None:
    box = (dyadic(F(0), F(1, 3)), dyadic(F(-1), F(5)))
    first, second = split(box, 0)
    assert (ends(first[0])[0], ends(second[0])[1]) == ends(box[0]) and ends(first[0])[1] == ends(
        second[0]
    )[0]
    assert first[1] == second[1] == box[1]


# ---------------------------------------------------------------- reductions


def test_factors_of_known_sign_go() -> None:
    found = reduce_factors(
        facts("forall a x", "given a > 0 and 1 - a > 0", "given a^2*(1 - a)*(x - 1) >= 0")
    )
    assert found is not None and str(found[-1]) == "x - 1 >= 0"
    assert (
        reduce_factors(facts("forall a x", "given a > 0", "given x >= 0", "given -a*x > 0")) is None
    )
    assert [str(f) for f in reduce_factors(facts("forall x y", "given -(x - y)^2 >= 0")) or []] == [
        "x - y = 0"
    ]


def test_a_square_factor_is_not_dropped_from_a_weak_fact() -> None:
    (fact,) = reduce_factors(facts("forall x y", "given x^2*(y - 1) >= 0")) or []
    assert fact.holds_at([F(0), F(0)])


def test_equations_are_solved_and_points_completed() -> None:
    given = ("forall s a x", "given s^2 = 2*(1 + a)", "given a*x > 1")
    solution = solve_equations(("s", "a", "x"), facts(*given))
    assert solution is not None
    left, (step,) = solution
    assert [str(fact) for fact in left] == ["s^2*x - 2*x - 2 > 0"]
    assert (str(step.lead), str(step.rest), step.variable) == ("2", "s^2 - 2", 1)
    assert solve_equations(("x",), facts("forall x", "given x = 3", "given x^2 < 4")) is None


def region(names: str, *rows: str) -> BranchRegion:
    found = goal(f"forall {names}", *rows, "show 0 = 1")
    (one,) = regions(found.names, found.matrix()) or []
    return one


def test_a_lead_that_other_facts_make_positive_is_divided_by() -> None:
    one = region(
        "t v a", "given t > 0 and t*v = 1 - a^2", "given v >= 2", "given 0 < a and a < 1/2"
    )
    assert not {one.names.index("v")} & set(one.used())
    assert one.complete([F(1, 4), F(0), F(1, 4)]) == [F(1, 4), F(15, 4), F(1, 4)]
    assert one.reduced(polynomial("v + a", "t v a")) is None  # no polynomial in t and a


def test_a_lead_that_is_positive_on_the_box_is_divided_by() -> None:
    one = region("a b", "given 0 < a and a < 1/3 and b*(a + 1)^2 = 4*a", "given b > 1/2")
    assert one.used() == [0]
    assert one.complete([F(1, 4), F(0)]) == [F(1, 4), F(16, 25)]


def test_a_factor_of_an_equation_that_may_vanish_stays() -> None:
    rows = ("forall x y", "given x >= 0", "given x^2 - 4 = 0", "given (x - 2)*y = 0")
    found = facts(*rows)
    inside = reduce_factors(found, bounding_box(found, 2))
    assert inside is not None
    assert [str(f) for f in inside] == ["x >= 0", "x - 2 = 0", "x*y - 2*y = 0"]
    assert str((reduce_factors(found) or found)[1]) == "x^2 - 4 = 0"  # no box, no sign


def test_without_its_sign_a_lead_is_not_divided_by() -> None:
    rows = ("given t*v = 1 - a^2", "given v >= 2", "given 0 < a and a < 1/2")
    found = goal("forall t v a", *rows, "given -1 <= t and t <= 1", "show 0 = 1")
    solution = solve_equations(found.names, [f for f in found.assumed if isinstance(f, Atom)])
    assert solution is not None
    assert all(str(step.lead).lstrip("-").isdigit() for step in solution[1])


def test_a_polynomial_keeps_its_value_without_the_solved_variables() -> None:
    one = region("x y", "given 2*y = x^2 + 1", "given 0 <= x and x <= 1")
    poly = polynomial("y^2 + x", "x y")
    reduced = one.reduced(poly)
    assert reduced is not None and reduced[1] > 0
    point = one.complete([F(1, 3), F(0)])
    assert value_at(reduced[0], point) / reduced[1] == value_at(poly, point)


@each_row("size", [1, 2**31, 2**80 + 1])
def test_factorizations_multiply_back(size: int) -> None:
    poly, random = polynomial(f"6*({size}^2*x^2 - y^2)^2*({size}*x + 3)*(6*x + 9)"), Random(5)
    constant, factors = factorization(poly)
    for _ in range(10):
        point = [F(random.randint(-5, 5)) for _ in range(2)]
        value = F(constant)
        for factor, exponent in factors:
            value *= value_at(factor, point) ** exponent
        assert value == value_at(poly, point)


# ---------------------------------------------------------------- interval arithmetic


def test_enclosures_hold_exact_values_and_undecided_is_no_answer() -> None:
    random = Random(6)
    poly = Enclosed(polynomial("x^4 - 3*x^2*y + y^3 - 1/3"))
    for _ in range(25):
        box = tuple((random.randint(-99, 99), random.randint(1, 64), -6) for _ in range(2))
        placed = Placed(box)
        for value in (poly.natural(placed), poly.centred(placed)[0]):
            span_of = ball_ends(value)
            assert span_of is not None
            for _ in range(6):
                point = [
                    low + (high - low) * F(random.randint(0, 8), 8) for low, high in map(ends, box)
                ]
                assert span_of[0] <= value_at(poly.poly, point) <= span_of[1]
            if span_of[0] < 0 < span_of[1]:
                assert surely(value, ">") is None
    for relation in (">", ">=", "=", "!="):
        assert surely(ball((0, 1, 0)), relation) is None


def test_a_ball_decides_a_relation_only_where_all_its_numbers_agree() -> None:
    positive, touching = ball((3, 1, 0)), ball((1, 1, 0))  # [2, 4] and [0, 2]
    said = {">": True, ">=": True, "=": False, "!=": True}
    assert {relation: surely(positive, relation) for relation in said} == said
    said = {">": False, ">=": False, "=": False, "!=": True}
    assert {relation: surely(-positive, relation) for relation in said} == said
    assert surely(touching, ">") is None and surely(-touching, ">=") is None
    assert surely(touching, "=") is None and surely(touching, "!=") is None
    assert surely(arb("nan"), ">") is None and surely(arb("nan"), "!=") is None


def test_powers_of_balls_around_zero_are_finite() -> None:
    square = Placed(((0, 1, 0),)).powers([(0, 2)], False)[0][2]
    assert square.is_finite() and ball_ends(square) is not None
