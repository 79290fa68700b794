"""The work of a check is its own: no other check can spend it, put it back, or see it."""

from __future__ import annotations

import json
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from juggleproof.certificates import checker
from juggleproof.certificates.checker import Context, Kind, Rejected, Work, settling
from juggleproof.certificates.checker.algebra import (
    LEAST_KEPT,
    MAX_KEPT,
    MAX_TERMS,
    sum_of_monomials,
)
from juggleproof.certificates.checker.rules import State, parts_of_box, prove
from tests.certificates.checker.harness import CLOSE, lines, proof, refused
from tests.certificates.checker.maps import ASKED, read

POWER = lines("forall x", "given x + 1 > 0", "show (x + 1)^60 - (x + 1)^60 = 0", "")
(STATEMENT,) = checker.read_statements(POWER.rstrip() + "\n").values()
CERTIFICATE = proof(CLOSE, at={"x": "0"})


def outcome(limit: int) -> tuple[str, Kind | None]:
    found, reason = checker.check_one(STATEMENT, CERTIFICATE, {}, {}, Work(limit))
    return found, reason.kind if reason else None


def least() -> int:
    """The least limit within which the certificate is accepted."""
    low, high = 0, checker.MAX_WORK
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if outcome(middle)[0] == "certified" else (middle, high)
    return high


def test_a_check_ends_where_its_own_work_does() -> None:
    needed = least()
    assert 1000 < needed < checker.MAX_WORK
    assert outcome(needed) == ("certified", None)
    assert outcome(needed - 1) == ("rejected", Kind.WORK)


def test_checks_at_once_do_not_disturb_each_other() -> None:
    needed = least()
    limits = [needed, needed - 1] * 40
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(outcome, limits))
    assert found == [("certified", None), ("rejected", Kind.WORK)] * 40


def test_a_check_inside_another_spends_nothing_of_it() -> None:
    outer = Work(10**6)
    context = checker.Context(work=outer)
    context.declare("x")
    before = outer.left
    assert outcome(checker.MAX_WORK) == ("certified", None)
    assert outer.left == before
    context.polynomial("(x + 1)^9")
    assert outer.left < before


def test_what_is_made_in_a_check_holds_its_meter() -> None:
    work = Work(500)
    context = checker.Context(work=work)
    context.declare("x")
    inner = checker.Context(context)
    poly = inner.polynomial("x^2 + 3*x - 1/2")
    results = [poly + poly, poly - poly, poly * poly, -poly, poly**3, poly**0, poly.primitive()[1]]
    assert all(one.work is work for one in results)
    state = State(inner)
    assert all(one.context.work is work for one in (state.branch(), *state.by_sign("x")))
    with pytest.raises(Rejected) as info:
        inner.polynomial("(x + 1)^100")
    assert refused(info.value, Kind.WORK)


def long(work: Work) -> checker.Poly:
    """A polynomial of 100 terms."""
    return checker.Poly(dict.fromkeys(range(100), 1), 1, 99, 7, work)


def quotient(work: Work) -> checker.Poly:
    """1 over 50 polynomials."""
    under = {(checker.variable(k, work), True): 1 for k in range(50)}
    return checker.Poly({0: 1}, 1, 0, 0, work, under)


def context_of_40(work: Work) -> checker.Context:
    context = checker.Context(work=work)
    for k in range(40):
        context.declare(f"x{k}")
    return context


def product_of_300(work: Work) -> checker.Poly:
    """A product of 300 variables, plus 99 powers of the last: monomials that are long numbers."""
    for k in range(300):
        checker.variable(k, work)
    ones = sum(1 << checker.BITS * k for k in range(300))
    powers = {(k << checker.BITS * 299): 1 for k in range(1, 100)}
    return checker.Poly({ones: 1, **powers}, 1, 300, 7, work)


def licences_of(line: checker.Atom) -> object:
    """What a strict line licenses."""
    context = checker.Context(work=line[1].work)
    context.license(line)
    return context.licensed


def state_of_40(work: Work) -> State:
    """A state with 40 facts."""
    context = checker.Context(work=work)
    context.declare("x")
    state = State(context)
    for _ in range(40):
        state.facts.append((context.values["x"], ">"))
    return state


# (what it takes, what is done with it, what is spent at least): with nothing counted for one of
# these, a list of them would cost nothing
COUNTED: dict[str, tuple[Callable[[Work], Any], Callable[[Any], object], int]] = {
    "a long summand first": (long, lambda p: p.plus(checker.variable(0, p.work)), 100),
    "a long summand last": (long, lambda p: checker.variable(0, p.work).plus(p), 100),
    "a common denominator": (
        lambda work: checker.number(Fraction(1, 2**20000), work),
        lambda p: p.plus(checker.number(Fraction(1, 3**12000), p.work)),
        12_000,
    ),
    "a negative": (long, lambda p: -p, 100),
    "a product with a number": (long, lambda p: p * checker.number(2, p.work), 100),
    "a primitive part": (long, lambda p: p.primitive(), 100),
    "a sum of quotients": (quotient, lambda p: p.plus(p), 100),
    "a product of quotients": (quotient, lambda p: p * p, 100),
    "Bernstein coefficients": (
        long,
        lambda p: checker.bernstein(p, [(0, Fraction(0), Fraction(1))]),
        8 * 100**3,
    ),
    "halves": (lambda work: work, lambda work: parts_of_box([100], [1] * 100, "a", work), 10**4),
    "a formula": (
        long,
        lambda p: checker.join("and", [("atom", p, ">")] * 40),
        800,
    ),
    "a product of long monomials": (product_of_300, lambda p: p * p, 100 * 100 * 7),
    "a negative of long monomials": (product_of_300, lambda p: -p, 100 * 7),
    "a primitive part of long monomials": (product_of_300, lambda p: p.primitive(), 100 * 7),
    "a licence of long monomials": (
        product_of_300,
        lambda p: licences_of(("atom", p, ">")),
        2 * 100 * 7,
    ),
    "a quotient of long numbers": (
        lambda work: checker.Context(work=work),
        lambda context: context.value(checker.parse(f"3/{10**3999 + 1}")),
        13284**2 >> 16,
    ),
    "which variables occur": (product_of_300, lambda p: p.places(), 100 + 299),
    "a product of constants": (
        lambda work: checker.number(-1, work),
        lambda p: p**1000,
        999 * 8,
    ),
    "a polynomial as text": (
        context_of_40,
        lambda context: context.show(long(context.work)),
        100 * 40,
    ),
    "a long product of variables": (
        context_of_40,
        lambda context: context.value(checker.parse("*".join(["x0"] * 200))),
        200 * 4,
    ),
    "a text": (
        context_of_40,
        lambda context: context.polynomial("+".join(["x0"] * 50)),
        20 + 149 + 50 * 9,
    ),
    "a name": (context_of_40, lambda context: context.define("y", context.values["x0"]), 8),
    "values of a context": (
        context_of_40,
        lambda context: checker.Context(values=context.values, work=context.work),
        40,
    ),
    "a copy of a context": (context_of_40, lambda context: checker.Context(context), 80),
    "a branch": (state_of_40, lambda state: state.branch(), 40),
}


@pytest.mark.parametrize("name", COUNTED)
def test_every_operation_is_counted(name: str) -> None:
    prepare, operate, least = COUNTED[name]
    work = Work(10**8)
    operand = prepare(work)
    before = work.left
    operate(operand)
    assert before - work.left >= least


def test_a_unit_is_a_product_of_short_numbers_holds() -> None:
    """And of monomials in more than 32 variables as many units as they are times 32 long."""

    def spent(operate: Callable[[Work], object]) -> int:
        work = Work(10**8)
        operate(work)
        return 10**8 - work.left

    context = context_of_40(Work())
    x = checker.parse("*".join(["x0"] * 200))
    assert spent(lambda work: long(work) * long(work)) == 8 + 100 * 100
    before = context.work.left
    context.value(x)
    assert before - context.work.left == 4 * (200 + 199)  # factors, and signs between them
    before = (p := product_of_300(Work())).work.left
    assert p.places() == {*range(300)} and before - p.work.left == 100 + 299
    for place, units in ((31, 1), (32, 2), (63, 2), (64, 3), (399, 13)):
        work = Work()
        checker.variable(place, work)
        checker.variable(0, work)
        assert work.dear == units


def test_bernstein_coefficients_have_a_length_and_a_number_at_most() -> None:
    """Of degree 2 on [0, 1/2^10000], a coefficient of c bits may grow to c + 2 (3 + 10001)."""

    def kind(terms: dict[int, int], *axes: tuple[int, Fraction, Fraction]) -> Kind | None:
        try:
            checker.bernstein(checker.Poly(terms, 1, 2, 0, Work(10**12)), axes)
        except Rejected as reason:
            return reason.kind
        return None

    short = (0, Fraction(0), Fraction(1, 1 << 10000))
    assert kind({2: 1 << 19991, 0: 1}, short) is None
    assert kind({2: 1 << 19992, 0: 1}, short) is Kind.SIZE
    # the last axis comes first: of degree 1, it doubles the number of coefficients; then the work
    # on degree 49999 is too much
    unit = [(0, Fraction(0), Fraction(1)), (checker.BITS, Fraction(0), Fraction(1))]
    many = dict.fromkeys(range(50_000), 1)
    assert kind({**many, 1 << checker.BITS: 1, 0: 0}, *unit) is Kind.SIZE
    del many[0]
    assert kind({**many, 1 << checker.BITS: 1}, *unit) is Kind.WORK


def test_an_orbit_rule_has_one_meter_for_all_premises() -> None:
    shift = ("forall x K", "integer K", "iterates x -> x + 1", "after K -> x + K")
    (statement,) = checker.read_statements(lines(*shift)).values()
    done = {"certified": {name: ["proof", [], CLOSE] for name in ("start", "step")}}
    limits = [
        limit
        for limit in range(2000)
        if checker.check_one(statement, done, {}, {}, Work(limit))[0] == "certified"
    ]
    parts = []
    for premise in checker.premises_of(statement, {}).values():
        work = Work(checker.MAX_WORK)
        prove(premise, ["proof", [], CLOSE], {}, work=work)
        parts.append(checker.MAX_WORK - work.left)
    assert limits[0] == sum(parts) > max(parts)


def test_a_check_without_a_meter_has_one_for_all_its_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    needed = least()
    for limit, expected in ((needed, "certified"), (needed - 1, "rejected")):
        monkeypatch.setattr(Work.__init__, "__defaults__", (limit,))
        assert checker.check_one(STATEMENT, CERTIFICATE, {}, {})[0] == expected


def test_the_text_of_premises_is_counted() -> None:
    """By its letters, 20 for each."""
    statements = read(ASKED)
    rows = (("asked/map", 244), ("asked/escapes", 318), ("asked/ends", 890))
    for name, letters in rows:
        work = Work()
        checker.premises_of(statements[name], statements, work)
        assert checker.Work().left - work.left >= 20 * letters
        with pytest.raises(Rejected) as info:
            checker.premises_of(statements[name], statements, Work(100))
        assert refused(info.value, Kind.WORK)


def test_all_statements_of_a_folder_have_one_meter(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What one has spent, those after it have not; a statement alone has at most MAX_WORK."""
    names = ["a/a", "a/b", "a/c"]
    texts = [POWER.replace("rule/case", name) for name in names]
    entries = [
        json.dumps([name, json.loads(json.dumps(CERTIFICATE).replace("rule/case", name))])
        for name in names
    ]
    (tmp_path / checker.STATEMENTS).write_text("\n".join(texts))
    (tmp_path / checker.CERTIFICATES).write_text("\n".join(entries) + "\n")
    for enough in range(4):
        monkeypatch.setattr(settling, "MAX_FOLDER_WORK", enough * least() + least() // 2)
        outcomes = [outcome for _, outcome, _ in checker.check_folder(str(tmp_path))]
        assert outcomes == (["certified"] * enough + ["rejected"] * 3)[:3]


def test_rejects_a_sum_of_too_many_monomials() -> None:
    monomials = [(k, 1, 1, 1) for k in range(1, MAX_TERMS + 2)]
    assert len(sum_of_monomials(monomials[1:], Work()).terms) == MAX_TERMS
    with pytest.raises(Rejected) as info:
        sum_of_monomials(monomials, Work())
    assert refused(info.value, Kind.SIZE)


def test_what_is_found_again_is_counted_as_made_holds() -> None:
    work = Work(1000)
    made = []

    def make() -> str:
        work.spend(400)
        made.append(work.left)
        return "made"

    assert [work.once("key", make) for _ in range(2)] == ["made", "made"]
    assert made == [600] and work.left == 200
    with pytest.raises(Rejected) as info:
        work.once("key", make)
    assert refused(info.value, Kind.WORK)
    with pytest.raises(Rejected):
        work.once("other", make)
    work.refill(1000)
    assert work.once("other", make) == "made" and work.left == 600 and len(made) == 2


def test_what_is_kept_has_an_end_and_begins_anew_with_a_check_alone() -> None:
    work = Work(10**9)

    def kept(key: int) -> bool:
        """Whether what took a fourth of the room, and what it is, is kept."""
        work.once(key, lambda: work.spend(MAX_KEPT // 4))
        return key in work.kept

    assert [kept(k) for k in range(6)] == [True] * 4 + [False] * 2
    work.refill(10**9)
    assert not work.kept and kept(5)
    work.refill(10**9)
    assert kept(6) and {5, 6} == work.kept.keys()


def test_a_check_spends_the_same_whatever_was_checked_before_it() -> None:
    work = Work()
    spent = []
    for _ in range(3):
        work.refill(10**6)
        assert checker.check_one(STATEMENT, CERTIFICATE, {}, {}, work)[0] == "certified"
        spent.append(10**6 - work.left)
    assert spent == [least()] * 3


def test_what_is_kept_takes_room_by_its_cost_and_a_text_by_its_letters() -> None:
    work = Work(10**6)
    work.once("key", lambda: work.spend(7))
    assert MAX_KEPT - work.room == 7 + LEAST_KEPT
    text = "x + y > 2*z"
    definitions = checker.Definitions(work)
    before = work.room
    tree = definitions.read(text, set())
    assert before - work.room == 5 * len(text) + LEAST_KEPT
    assert (
        definitions.read(text, set()) is tree
        and checker.Definitions(work).read(text, set()) is tree
    )
    x = checker.variable(0, work)
    one = x.plus(checker.number(1, work))
    before, left = work.room, work.left
    third = one**3
    assert third.terms == {0: 1, 1: 3, 2: 3, 3: 1}
    spent = left - work.left
    assert before - work.room == spent + 2 * LEAST_KEPT == 8 + 4 + 8 + 6 + 2 * LEAST_KEPT
    assert one**3 is third and left - work.left == 2 * spent


def test_what_is_read_once_is_counted_by_its_names() -> None:
    context = checker.Context(work=Work(10**6))
    for name in ("x", "y"):
        context.declare(name)
    context.license(context.formula(checker.parse("x > 0")))
    for text, names in (("x + y", 2), ("1/x", 1)):
        tree = checker.parse(text)
        costs = []
        for way in (Context.once, Context.once, lambda one, _, node: one.value(node)):
            before = context.work.left
            way(context, Context.value, tree)
            costs.append(before - context.work.left)
        assert costs[0] == costs[1] == costs[2] + names


def licensed(outer: Context, *lines: str) -> Context:
    """A context of its own, in which strict lines stand."""
    inner = Context(outer)
    for line in lines:
        inner.license(inner.formula(checker.parse(line)))
    return inner


def of_x_and_y() -> Context:
    context = Context(work=Work(10**6))
    context.declare("x")
    context.declare("y")
    return context


def test_a_quotient_is_read_again_where_its_divisor_has_another_licence_holds() -> None:
    outer, tree = of_x_and_y(), checker.parse("y/x + 1/3")
    positive = licensed(outer, "x > 0")
    first = positive.once(Context.value, tree)
    assert positive.once(Context.value, tree) is first
    # a licence that no division asks for is nothing to it
    assert licensed(outer, "y > 0", "x > 0").once(Context.value, tree) is first
    other = licensed(outer, "x != 0").once(Context.value, tree)
    assert [positive for (_, positive) in other.under] == [False]
    assert [positive for (_, positive) in first.under] == [True]
    with pytest.raises(Rejected) as info:
        outer.once(Context.value, tree)
    assert refused(info.value, Kind.DIVISION)


def test_a_quotient_is_read_again_where_one_of_several_licences_is_another_holds() -> None:
    outer, tree = of_x_and_y(), checker.parse("1/(x*y)")

    def under(context: Context) -> list[tuple[dict[int, int], bool]]:
        value = context.once(Context.value, tree)
        assert value.under == context.value(tree).under
        return [(poly.terms, positive) for poly, positive in value.under]

    x, y = {1: 1}, {1 << 16: 1}
    parts = licensed(outer, "x > 0", "y > 0")
    assert under(parts) == [(x, True), (y, True)]
    assert under(licensed(outer, "x > 0", "y != 0")) == [(x, True), (y, False)]
    assert under(licensed(outer, "x != 0", "y != 0")) == [(x, False), (y, False)]
    assert under(parts) == [(x, True), (y, True)]
    assert under(licensed(parts, "x*y > 0")) == [({1 + (1 << 16): 1}, True)]


def test_what_is_read_beside_changes_nothing_of_what_is_kept_holds() -> None:
    outer, tree = of_x_and_y(), checker.parse("1/(x*y)")
    parts = licensed(outer, "x > 0", "y > 0")
    parts.once(Context.value, tree)
    parts.license(parts.formula(checker.parse("x*y > 0")))
    whole = parts.value(tree)  # asks for the same divisor, and finds more
    assert parts.once(Context.value, tree).under == whole.under and len(whole.under) == 1


def test_lines_that_say_the_same_give_one_licence_holds() -> None:
    outer = of_x_and_y()

    def licence(line: str) -> object:
        (one,) = licensed(outer, line).licensed.values()
        return one

    first = licence("x - y > 0")
    assert licence("y < x") is first
    for line in ("x - y != 0", "y - x > 0", "y != x"):
        assert licence(line) is not first
    assert licence("y - x > 0") is licence("x < y") is not licence("x - y > 0")
    long, high = licence("x - y + 2^100 - 2^100 > 0"), licence("x - y^3 + y^3 - y > 0")
    assert len({id(one) for one in (first, long, high, licence("x - y^2 + y^2 - y > 0"))}) == 4


def test_products_and_quotients_are_counted_holds() -> None:
    context = licensed(of_x_and_y(), "x > 0")
    costs = {
        "x*y": 4 * 3,
        "2*(x + y)": 4 * 3 + 18 + 10,
        "(x + y)*(x - y)": 4 * 3 + 18 + 18 + 12,  # no product with the number 1
        "y/2": 4 * 2,
        "y/x": 4 * 2 + 1 + 1,  # the divisor is looked up, and the licence joined to what is below
        "y/x/x": 4 * 3 + 2 + 1 + 2,
        "y/x*y": 4 * 4 + 1 + 1,
        "1/(1/x)": 4 * 2 + (4 * 2 + 1 + 1) + 1 + 9 + 9,
    }
    for text, cost in costs.items():
        tree, before = checker.parse(text), context.work.left
        context.value(tree)
        assert before - context.work.left == cost


def test_the_room_for_what_is_kept_has_its_ends_holds() -> None:
    work = Work()
    for room, kept in ((0, False), (1, True)):
        work.room = room
        work.once(room, str)
        assert (room in work.kept) is kept
    for room, kept in ((MAX_KEPT // 2, True), (MAX_KEPT // 2 - 1, False)):
        work.room = room
        work.refill(10)
        assert (1 in work.kept) is kept
    assert work.room == MAX_KEPT


def test_a_sum_of_products_is_counted_by_its_letters_and_summands_holds() -> None:
    context = Context(work=Work(10**6))
    context.declare("x")
    before = context.work.left
    context.polynomial("2*x - 1")
    assert before - context.work.left == 20 + 4 * 7 + 2 * 9
    before = context.work.left
    context.polynomial("(x)")  # and by its tree
    assert before - context.work.left == 20 + 4 * 3 + 3


def test_a_node_may_be_a_tuple_as_searches_have_it_holds() -> None:
    certificate = proof(("close",), at={"x": "0"})
    assert checker.check_one(STATEMENT, certificate, {}, {})[0] == "certified"


def test_terms_of_a_point_are_not_kept_holds() -> None:
    """A long term may take no work: so nothing would bound what is kept of them."""
    work = Work()
    at = {"x": "-" * 150 + "0"}
    assert checker.check_one(STATEMENT, proof(CLOSE, at=at), {}, {}, work)[0] == "certified"
    parts = [part for key in work.kept for part in (key if isinstance(key, tuple) else (key,))]
    assert checker.parse(at["x"]) not in parts
