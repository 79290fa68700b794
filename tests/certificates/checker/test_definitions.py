"""Definitions say what their bodies say: against the same written out by hand, and against a second
reading that takes them as functions of values.
"""

from __future__ import annotations

import ast
import re
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from juggleproof.certificates import checker
from juggleproof.certificates.checker import Kind, Rejected
from juggleproof.certificates.checker.algebra import LEAST_KEPT
from tests.certificates.checker.evaluator import formula_at, term_at
from tests.certificates.checker.harness import CLOSE, lines, proof, refused, refuted, verdict
from tests.certificates.checker.maps import DOUBLE, NEST, PUSH, SUBTRACT, checked, edited, searched
from tests.certificates.checker.rules import sharp
from tests.statements.drawn import fractions

MANY = settings(max_examples=60, deadline=None, derandomize=True)
small = fractions(-3, 3, 4)
points = st.fixed_dictionaries(dict.fromkeys("xyz", small))


def terms(names: str, more: tuple[str, ...] = ()) -> st.SearchStrategy[str]:
    """Terms in these names, in which each of `more` takes two terms."""
    shapes = [
        "{} + {}",
        "({}) - ({})",
        "({})*({})",
        "-({}) + {}",
        *(f"{one}({{}}, {{}})" for one in more),
    ]
    atoms = st.one_of(st.sampled_from(names), st.integers(0, 3).map(str))
    return st.recursive(
        atoms,
        lambda inner: st.tuples(inner, inner, st.sampled_from(shapes)).map(
            lambda p: p[2].format(p[0], p[1])
        ),
        max_leaves=5,
    )


# the bodies of f and g in p and q, and h, which uses them; `0*` because each uses what it names
bodies = st.tuples(terms("pq"), terms("pqz", ("f",)), terms("pq", ("f", "g")))
used = st.tuples(
    terms("xyz", ("f", "g", "h")), st.sampled_from(["<", "<=", "=", "!="]), terms("xyz", ("h",))
).map(" ".join)


def definitions(parts: tuple[str, str, str]) -> list[tuple[str, str, str]]:
    """(name, what stands between name and body, body)."""
    f, g, h = (part + " + 0*p + 0*q" for part in parts)
    return [
        ("f", "(p, q)", f),
        ("g", "(p, q) over z", g + " + 0*z"),
        ("h", "(p, q) over z", h + " + 0*g(p, q)"),
    ]


def out(text: str, defined: list[tuple[str, str, str]]) -> str:
    """The text with applications written out, innermost first: a reader of its own."""
    by_name = {name: body for name, _, body in defined}
    while found := re.search(r"\b([fgh])\(", text):
        start, depth, comma = found.end(), 1, -1
        for place in range(start, len(text)):
            depth += {"(": 1, ")": -1}.get(text[place], 0)
            comma = place if text[place] == "," and depth == 1 else comma
            if depth == 0:
                break
        first, second = f"({text[start:comma]})", f"({text[comma + 1 : place]})"
        parts = re.split(r"\b([pq])\b", by_name[found[1]])
        body = "".join({"p": first, "q": second}.get(part, part) for part in parts)
        text = f"{text[: found.start()]}({body}){text[place + 1 :]}"
    return text


def unfolded(text: str) -> tuple[object, ...]:
    """What a statement comes to: its variables, premises and goals, as data."""
    (statement,) = checker.read_statements(text).values()
    story = checker.Unfolding(statement, checker.Context())

    def data(formula: object) -> object:
        if isinstance(formula, bool):
            return formula
        if formula[0] == "atom":
            return formula[1].terms, formula[1].den, formula[2]
        return formula[0], [data(part) for part in formula[1]]

    return story.universal, [*map(data, story.premises)], [*map(data, story.goals)]


@MANY
@given(bodies, used, used, points)
def test_a_definition_says_what_its_body_says(
    parts: tuple[str, str, str], assumed: str, shown: str, point: dict[str, Fraction]
) -> None:
    defined = definitions(parts)
    above = "".join(f"define {name}{head} := {body}\n" for name, head, body in defined)
    rows = ["forall x y z", f"given {assumed}", "let s = h(x, y)", f"show {shown} or s = x"]
    by_hand = lines(*(out(row, defined) for row in rows))
    text = above + lines(*rows)
    assert "define" not in by_hand and not re.search(r"\b[fgh]\(", by_hand)
    assert unfolded(text) == unfolded(by_hand)
    at = {name: str(value) for name, value in point.items()}
    for certificate in (refuted(at), proof(CLOSE, at=at)):
        one, two = (
            verdict(said, {"rule/case": certificate})["rule/case"] for said in (text, by_hand)
        )
        assert (one[0], str(one[1])) == (two[0], str(two[1]))
    # the second reading evaluates what was written out by hand
    fails = formula_at(out(assumed, defined), point) and not formula_at(out(shown, defined), point)
    fails = fails and term_at(out("h(x, y)", defined), point) != point["x"]
    outcome = verdict(text, {"rule/case": refuted(at)})["rule/case"][0]
    assert outcome == ("refuted" if fails else "rejected")


def test_the_text_of_a_statement_stays_what_the_file_says() -> None:
    own = "statement a/b\nforall x\nlet y = half(x)\nshow positive(y) or not positive(y)"
    text = f"define half(x) := x/2\n\ndefine positive(x) := x > 0\n{own}\n"
    with pytest.raises(
        Rejected
    ) as info:  # y is a parameter of none, x of both: neither is a definition
        checker.read_statements(text.replace("let y", "let half"))
    assert refused(info.value, (Kind.SHADOWS, "half", "statements, line 6"))
    statement = checker.read_statements(text)["a/b"]
    assert statement.text() == own
    assert statement.rows("let") == ["y = x / 2"]


MAP = SUBTRACT.replace("piece x >= 1 ->", "piece large(x) ->").replace("x - 1\n", "less(x)\n")


def test_definitions_in_a_map_say_the_same() -> None:
    above = "define large(y) := y >= 1\ndefine less(y) := y - 1\n"
    above += "define lossy over a := a > 0 and a < 1\n\n"
    text = above + MAP.replace("domain a > 0 and a < 1\n", "domain lossy\n")
    assert text.count("lossy") > 2 and text.count("large(x)") == text.count("less(x)") == 1
    results = checked(text, searched(SUBTRACT))
    assert {outcome for outcome, _ in results.values()} == {"certified"}, results


@pytest.mark.parametrize(
    ("body", "kind", "place"),
    [
        ("small := 1/2*x_next", Kind.LOOSE, "statements, line 1"),
        ("small over x_next := x_next", Kind.OVER, ""),
        ("small(y) := y", Kind.ARGUMENTS, ""),
        ("x := 1", Kind.SHADOWS, ""),
        ("small := 1/0", Kind.ZERO_DIVISION, "premise constants of demo/contracts"),
        ("small := 1/2 > 0", Kind.TERM, "premise constants of demo/contracts"),
    ],
)
def test_rejects_a_definition_that_a_map_cannot_use(body: str, kind: Kind, place: str) -> None:
    text = f"define {body}\n" + SUBTRACT.replace("radius 1/2", "radius small")
    try:
        _, reason = checked(text, searched(SUBTRACT))["demo/contracts"]
    except Rejected as unreadable:
        reason = unreadable
    assert reason is not None
    assert reason.kind is kind and place in reason.place


def test_names_of_premises_are_no_definitions() -> None:
    """A definition cannot change what a rule writes: x_next and distance are names of premises."""
    above = "define x_next := 0\ndefine distance := 0\ndefine x_0 := 0\n\n"
    results = checked(above + NEST, searched(NEST))
    assert {outcome for outcome, _ in results.values()} == {"certified"}


def test_a_division_is_licensed_at_the_place_of_use_alone() -> None:
    above = "define inverse(p) := 1/p\n"
    good = above + lines("forall x y", "given x > 0", "show x*inverse(x) = 1")
    bad = above + lines("forall x y", "given x > 0", "show x*inverse(y) = x*inverse(y)")
    certificate = {"rule/case": proof(CLOSE, at={"x": "1", "y": "0"})}
    assert verdict(good, certificate)["rule/case"] == ("certified", None)
    assert refused(verdict(bad, certificate)["rule/case"][1], (Kind.DIVISION, "y"))


@pytest.mark.parametrize(
    ("text", "name"), [(SUBTRACT, "value"), (SUBTRACT, "level"), (DOUBLE, "distance")]
)
def test_rejects_a_definition_of_what_a_line_names(text: str, name: str) -> None:
    above = (f"define {name} := 1\n{text}", Kind.SHADOWS)
    for whole, kind in (above, (f"{text}\ndefine {name} := 1\n", Kind.REDEFINED)):
        with pytest.raises(Rejected) as info:
            checker.read_statements(whole)
        assert refused(info.value, (kind, name))


def test_a_definition_is_written_out_in_what_is_known_of_a_point_holds() -> None:
    text = edited(SUBTRACT, "lyapunov", "value x\n", "have x_point = 0\nvalue x\n")
    defined = "define zero(z) := z = 0\n\n" + text.replace("x_point = 0", "zero(x_point)")
    assert checked(defined, searched(text)) == checked(text, searched(text))
    assert checked(defined, searched(text))["demo/lyapunov"] == ("certified", None)


def test_a_definition_may_be_over_what_a_relation_declares() -> None:
    above = "define times(z) over u := u*z\ndefine inside over x := x >= -2 and x <= 2\n\n"
    text = edited(PUSH, "relation", "-> u*x\n", "-> times(x)\n")
    text = above + edited(text, "contracts", "x >= -2 and x <= 2", "inside")
    results = checked(text, searched(PUSH))
    assert {outcome for outcome, _ in results.values()} == {"certified"}


# what a definition could hide from a rule that looks for names: the state, the number of iterations
HIDING = [
    ("map", "piece x >= 1 ->", "x >= 1", "piece {} ->"),
    ("map", "piece x >= 1 ->", "x > 1", "piece {} ->"),
    ("map", "-> x - 1", "x - 2", "-> {}"),
    ("map", "space x >= 0", "x >= 1", "space {}"),
    ("descends", "rank x", "x/2", "rank {}"),
    ("descends", "rank x\n", "4*x^2", "root c = sqrt({})\nrank c/2\n"),
    ("descends", "stage x < 1", "x < 1/2", "stage {}"),
    ("contracts", "on x < 1", "x < 1 or x = 3", "on {}"),
    ("contracts", "point 0", "x", "point {}"),
    ("contracts", "weights 1", "1 + x", "weights {}"),
    ("contracts", "rate a", "a*x", "rate {}"),
    ("escapes", "start 1/2", "x", "start {}"),
]


@pytest.mark.parametrize(
    ("kind", "old", "body", "line"), HIDING, ids=[f"{row[0]}: {row[2]}" for row in HIDING]
)
def test_a_definition_hides_no_state_from_a_rule(kind: str, old: str, body: str, line: str) -> None:
    by_hand = edited(SUBTRACT, kind, old, line.format(f"({body})" if "->" in line else body))
    over = " ".join(sorted(checker.names_in(body)))
    defined = f"define hidden over {over} := {body}\n"
    defined += edited(SUBTRACT, kind, old, line.format("hidden"))
    one, two = (checked(text, searched(SUBTRACT)) for text in (by_hand, defined))
    assert [(name, outcome) for name, (outcome, _) in one.items()] == [
        (name, outcome) for name, (outcome, _) in two.items()
    ]
    for (_, first), (_, second) in zip(one.values(), two.values(), strict=True):
        assert (first and (first.kind, first.place)) == (second and (second.kind, second.place))


def test_rejects_a_number_of_iterations_that_a_definition_hides() -> None:
    rows = (
        "forall x K",
        "integer K",
        "let s = hidden",
        "iterates x -> x + s",
        "after K -> x + K*s",
    )
    done = {"certified": {name: ["proof", [], CLOSE] for name in ("start", "step")}}
    text = "define hidden over K := K\n" + lines(*rows)
    assert refused(verdict(text, {"rule/case": done})["rule/case"][1], Kind.ITERATES_COUNT)
    text = "define hidden over K := K\n" + lines(*rows).replace("let s = hidden\n", "").replace(
        "x + s", "x + hidden"
    ).replace("K*s", "K*K")
    assert refused(verdict(text, {"rule/case": done})["rule/case"][1], Kind.ITERATES_COUNT)


def test_a_sharp_range_may_use_definitions() -> None:
    (case,) = [one for one in sharp.ACCEPTED if one.defect == sharp.ACCEPTED[0].defect]
    row = next(row for row in case.text.splitlines() if row.startswith("holds "))
    parameter = next(r for r in case.text.splitlines() if r.startswith("over ")).split()[1]
    text = f"define inside over {parameter} := {row[6:]}\n" + case.text.replace(row, "holds inside")
    certificates = {**case.earlier, "rule/case": case.certificate}
    assert verdict(text, certificates)["rule/case"] == ("certified", None)
    loose = text.replace(f"over {parameter} :=", "over x :=").replace(row[6:] + "\n", "x <= 1\n", 1)
    with pytest.raises(Rejected) as info:
        verdict(loose, certificates)
    assert refused(info.value, (Kind.OVER, "inside: x"))


def test_a_line_is_written_out_anew_where_it_uses_more_definitions_holds() -> None:
    definitions = checker.Definitions(checker.Work())

    def read() -> str:
        return ast.unparse(definitions.read("f(x) + g(x)", {"x"}))

    assert read() == "f(x) + g(x)"
    definitions.define("f(a) := a + 1")
    assert read() == "x + 1 + g(x)"
    definitions.define("g(b) := 2*b")
    assert read() == "x + 1 + 2 * x"


def test_rejects_a_line_read_before_where_its_definition_is_over_what_is_not_declared() -> None:
    definitions = checker.Definitions(checker.Work())
    definitions.define("h over r := r + 1")
    tree = definitions.read("2*h", {"r"})
    assert definitions.read("2*h", {"r"}) is tree
    with pytest.raises(Rejected) as info:
        definitions.read("2*h", {"s"})
    assert refused(info.value, Kind.OVER)


def test_a_line_that_is_written_out_again_is_counted_as_before() -> None:
    work = checker.Work()
    definitions = checker.Definitions(work)
    definitions.define("f(a) := a + 1")
    spent = []
    for _ in range(2):
        before, room = work.left, work.room
        definitions.read("f(x) > 0", {"x"})
        spent.append((before - work.left, room - work.room))
    # nodes: the comparison, the call, x and 0; then the sum, x, which is copied, and 1
    assert spent == [(40 * 8, 5 * 8 + 40 * 8 + LEAST_KEPT), (40 * 8, 0)]
    assert definitions.read("x + 1", {"x"}) is definitions.read("x + 1", {"y"})


def test_a_line_is_written_out_once_whatever_else_is_declared_holds() -> None:
    work = checker.Work()
    definitions = checker.Definitions(work)
    definitions.define("d over x := x + 1")
    definitions.define("e over y := y + 1")
    tree = definitions.read("d < e", {"x", "y"})
    kept, many = len(work.kept), {"x", "y", *(f"z{n}" for n in range(1000))}
    assert definitions.read("d < e", many) is tree and len(work.kept) == kept
    for missing in ("x", "y"):
        with pytest.raises(checker.Rejected) as refusal:
            definitions.read("d < e", many - {missing})
        assert refusal.value.kind == checker.Kind.OVER
