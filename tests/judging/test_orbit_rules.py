"""The rules for orbits in words: every rule and premise has its row; a false premise is shown with
values at which it is false, any other with what Z3 says; a fault in a rule is one line.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from juggleproof.certificates import checker
from juggleproof.command.main import run
from juggleproof.judging.claims import place_in_file
from juggleproof.judging.conclusions import RULES, conclusion, meaning
from juggleproof.judging.evaluating import is_true_at, value_at
from juggleproof.judging.searches import claim_search
from juggleproof.judging.searches.unproved_premises import why
from juggleproof.statements.store import CERTIFICATES, STATEMENTS
from juggleproof.statements.vote import Vote
from juggleproof.votes.z3 import vote_and_model
from tests.certificates.checker.maps import (
    ASKED,
    COUNT,
    DOUBLE,
    FLIP,
    NEST,
    PUSH,
    SCALE,
    SUBTRACT,
    WHOLE,
    edited,
    read,
)
from tests.certificates.checker.test_map_rules import (
    FAILING,
    FAILING_IN_A_SPACE,
    FAILING_INTO,
    FAILING_WITH_GUARDS,
)
from tests.certificates.checker.test_returns import LOOP
from tests.certificates.checker.test_settles import TWO
from tests.rows import each_row

STATEMENTS_OF = [
    read(text)
    for text in (SUBTRACT, FLIP, NEST, DOUBLE, PUSH, SCALE, COUNT, WHOLE, TWO, LOOP, ASKED)
]
TEXTS = {name: one.text() for statements in STATEMENTS_OF for name, one in statements.items()}
KINDS = {name: one.kind for statements in STATEMENTS_OF for name, one in statements.items()}
SUBTRACTING = STATEMENTS_OF[0]
CONCLUSIONS = {
    "demo/map": "for 0 < a <= 1: f maps the space {x >= 0} into itself, and exactly one piece"
    " applies at each of its states: f(x) = x - 1 where x >= 1; f(x) = a*x where x < 1",
    "demo/descends": "for 0 < a < 1: f^N(s) is in the last stage {x < 1} for every state s of the"
    " space and every integer N >= rank(s), where rank = x",
    "demo/contracts": "for 0 < a < 1: e = 0 is a fixed point, is stable, and attracts the set"
    " {x < 1}: |f^n(s) - e| <= a^n |s - e| <= a^n for every state s of the space in the set"
    " and every integer n >= 0, where |s - e| = |x - e|; f takes the set into itself, and all"
    " states of the space with |s - e| <= 1/2 are in it",
    "demo/attracts": "for 0 < a < 1: e = 0 is stable and attracts every state s of the space:"
    " |f^(N + k)(s) - e| <= a^k for all integers k >= 0 and N >= rank(s), where rank = x,"
    " |s - e| = |x - e|",
    "demo/escapes": "for a = 1: the orbit of 1/2 is back after 1 step, by the pieces 2, and does"
    " not tend to e = 0",
    "demo/exactly": "for 0 < a <= 1: e = 0 is stable and attracts every state of the space if and"
    " only if 0 < a < 1",
    "demo/settles": "for 0 < a < 1: e = 0 is stable and attracts every state of the space",
    "flip/lyapunov": "for 0 < a < 1: e = 0 is a fixed point, is stable, and attracts every"
    " state of the space: V(f^(n + 1)(s)) <= V(f^n(s)), and |f^n(s) - e| >= distance for at most"
    " V(s)/least integers n >= 0, for every state s of the space and every distance > 0, where V(s)"
    " = the greatest of x where x >= 0; (a - 3)*x/4 where x < 0; least = (1 - a)*distance/8 with"
    " level = V(s); |s - e| is the largest of all |s_j - e_j|",
    "flip/unstable": "for a > 1: e = 0 is not stable: for"
    " 0 < distance <= 1 the state s = distance has |s - e| <= distance, and |f^n(s) - e| > 1 for"
    " some integer n >= 0, where |s - e| is the largest of all |s_j - e_j|",
    "nest/into-twice": "for 0 < a < 1: e = 0 is a fixed point, is stable, and attracts every state"
    " of the space {x >= 0}",
    "nest/exactly": "for 0 < a <= 1: e = 0 is stable and attracts every state of the space if and"
    " only if 0 < a < 1",
    "push/relation": "for 0 <= a < 1: each state x of the space of all states has a next state, and"
    " all next states are in it: u*x where u >= -a and u <= a and x > -1; -u*x/2 where u >= -a and"
    " u <= a and x < 1; x/6 where x > 5, for all u",
    "push/attracts": "for 0 <= a < 1/2: e = 0 is stable and attracts every state of the space;"
    " f^n(s) is any state that the relation leads to from s in n steps",
    "count/descends": "for a >= 0: f^N(s) is in the last stage {x < 1} for every state s of the"
    " space and every integer N that is large enough for s, where rank = (2*x, y)",
    "count/side": "f^N(s) is in the last stage {x >= -1 and x <= 1} for every state s of the"
    " space and every integer N >= rank(s), where rank = the greatest of x; -x where x <= 1",
    "whole/exactly": "for all n with n != 0, n an integer: e = 0 is stable and attracts every state"
    " of the space if and only if n != 0 and n^2 > 1",
    "scale/exactly": "for all a: e = 0 is stable and attracts every state of the space"
    " if and only if -1 < a < 1",
    "two/settles": "for 0 < a < 1: f^n(s) tends to one of e_1 = 2, e_2 = -2 for every state s of"
    " the space, and each is stable",
    "loop/returns": "for 0 < a < 1/2: every orbit tends to that of one of e_1 = 2 = f^2(e_1),"
    " e_2 = -2 = f(e_2): f^(N + n)(s) - f^n(e) tends to 0, for every state s of the space, with"
    " such an e and an integer N >= 0; and each such orbit is stable: |f^n(s) - f^n(e)| is small"
    " for all n >= 0 where |s - e| is",
    "asked/ends-in-roots": "for a > 9, every b: f^n(s) tends to e = (sqrt(a), b) for every state s"
    " of the space, and e is stable",
    "double/unstable": "e = 0 is not stable: for 0 < distance <= 1 the state s = distance has"
    " |s - e| <= distance, and |f^n(s) - e| > 1 for some integer n >= 0, where |s - e| is the"
    " largest of all |s_j - e_j|",
}


def kind_by_the_checker(rows: Sequence[str]) -> str:
    """The kind of rule that these lines are; nothing where they are none."""
    try:
        (statement,) = checker.read_statements("\n".join(["statement t/t", *rows])).values()
    except checker.Rejected as reason:
        assert reason.kind is checker.Kind.ORDER
        return ""
    return statement.kind if statement.kind in checker.orbit_rules() else ""


def kind_by_the_table(rows: Sequence[str]) -> str:
    order = "".join(row.partition(" ")[0] + " " for row in rows)
    return next((kind for kind, rule in RULES.items() if re.fullmatch(rule.lines, order)), "")


def test_every_rule_has_its_lines_in_the_order_of_the_checker_holds() -> None:
    assert RULES.keys() == checker.orbit_rules().keys()
    kinds = set()
    for text in TEXTS.values():
        rows = text.split("\n")[1:]
        for k in range(len(rows)):
            before, after = rows[:k], rows[k + 1 :]
            for changed in (
                rows,
                [*before, *after],
                [*rows[: k + 1], *rows[k:]],
                [*before, *after[:1], rows[k], *after[1:]],
                [*before, "root u = sqrt(1)", *rows[k:]],
                [*before, "let u = 1", *rows[k:]],
            ):
                kind = kind_by_the_checker(changed)
                kinds.add(kind)
                assert kind_by_the_table(changed) == kind, changed
    assert kinds == {"", *RULES}


def test_every_premise_of_every_rule_has_its_words_holds() -> None:
    named: dict[str, set[str]] = {kind: set() for kind in checker.orbit_rules()}
    for statements in STATEMENTS_OF:
        for statement in statements.values():
            for name in checker.premises_of(statement, statements):
                words = meaning(statement.kind, name)
                assert not set("{}") & set(words), name
                assert all(number in words for number in name.split("-")[1:] if number.isdigit())
                named[statement.kind].add(name.rstrip("-0123456789"))
    assert named == {kind: {*rule.premises} for kind, rule in RULES.items()}


@each_row("name", CONCLUSIONS)
def test_a_rule_is_concluded_with_its_numbers_holds(name: str) -> None:
    assert conclusion(KINDS[name], name, TEXTS) == CONCLUSIONS[name]


def test_names_of_the_point_in_a_value_are_concluded_with_their_meaning_holds() -> None:
    changed = TEXTS | {
        "demo/lyapunov": TEXTS["demo/lyapunov"].replace("value x\n", "value x_gap\n")
    }
    said = conclusion("lyapunov", "demo/lyapunov", changed)
    assert "V(s) = x_gap, x_gap = x - e; least = (1 - a)*distance with" in said


def test_letters_that_are_names_of_the_statement_give_way_holds() -> None:
    """A parameter e is not the point e, nor a state f_1 the map f at 1."""

    def put(text: str) -> str:
        return checker.put(text, {"a": "e", "x": "f_1"})

    changed = {name: put(text) for name, text in TEXTS.items() if name.startswith("demo/")}
    said = conclusion("contracts", "demo/contracts", changed)
    assert said.startswith("for 0 < e < 1: p = 0 is a fixed point, is stable, and attracts the set")
    assert "{f_1 < 1}: |F^n(s) - p| <= e^n |s - p| <= e^n for every state s" in said


def test_a_rank_and_definitions_of_the_statement_are_told_apart_holds() -> None:
    names = {"x": "order", "a": "rank"}
    changed = {name: checker.put(text, names) for name, text in TEXTS.items()}
    said = conclusion("descends", "demo/descends", changed)
    assert said.endswith("every integer N >= rho(s), where rho = order")
    sum_of = "forall x K\ninteger K\nlet c = 2\niterates x -> x + c\nafter K -> x + c*K"
    text = f"statement t/sum\n{sum_of}"
    assert conclusion("iterates", "t/sum", {"t/sum": text}).endswith("where f(x) = x + c, c = 2")


def test_roots_of_one_name_in_two_statements_are_told_apart_holds() -> None:
    """Each point has the root of its own statement."""
    texts = dict(TEXTS)
    for under, row in zip((2, 3), re.findall("contraction .*", texts["two/settles"])):
        name = row.removeprefix("contraction ")
        new = rf"\nroot c = sqrt({under})\g<1>\npoint c"
        texts[name], count = re.subn(r"(\non .*)\npoint .*", new, texts[name])
        assert count == 1
    said = conclusion("settles", "two/settles", texts)
    assert "tends to one of e_1 = sqrt(2), e_2 = sqrt(3) for every state" in said


def test_the_roots_of_a_conclusion_are_defined_below_it_holds() -> None:
    said = conclusion("descends", "asked/descends", TEXTS)
    assert said.endswith("where rank = d + e; e = sqrt(d); d = sqrt(c*x); c = sqrt(a)")


def test_a_domain_that_is_no_interval_is_concluded_as_it_stands_holds() -> None:
    changed = TEXTS | {"demo/map": TEXTS["demo/map"].replace("a > 0 and a <= 1", "a^2 < a")}
    assert conclusion("map", "demo/map", changed).startswith("for all a with a^2 < a: f maps")


@each_row(
    ("whole", "part", "old", "new", "premise"),
    [
        *((SUBTRACT, *row) for row in FAILING),
        *((FLIP, *row) for row in FAILING_WITH_GUARDS),
        *((DOUBLE, *row) for row in FAILING_IN_A_SPACE),
        *((NEST, *row) for row in FAILING_INTO),
    ],
)
def test_a_false_premise_has_values_at_which_it_is_false_holds(
    whole: str, part: str, old: str, new: str, premise: str
) -> None:
    statements = read(edited(whole, part, old, new))
    rule = next(one for name, one in statements.items() if name.endswith(f"/{part}"))
    false = checker.premises_of(rule, statements)[premise]
    vote, model = vote_and_model(false)
    line = why(rule.kind, premise, false, (vote, model), 1)
    if premise == "possible":  # Z3 alone says that nothing exists
        assert vote.answer == "fails" and model is None
        assert line.endswith(": Z3 says that it is false")
        return
    assert model is not None and ": false at " in line
    point = {name: value for name, value in model.point.items() if isinstance(value, Fraction)}
    assert point.keys() == model.point.keys()
    for name, text in (row.split(" = ", 1) for row in false.rows("let")):
        value = value_at(text, point)
        assert value is not None
        point[name] = value
    assert all(is_true_at(text, point) for text in false.rows("given") + false.rows("range"))
    (shown,) = false.rows("show" if model.part == "goal" else "have")
    assert is_true_at(shown, point) is False
    assert all(f"{name} = {model.point[name]}" in line for name in false.get("forall")[0])


def line_of(statement: str, premise: str) -> str:
    """Why this premise has no proof."""
    statements = read(statement)
    *_, rule = statements.values()
    one = checker.premises_of(rule, statements)[premise]
    return why(rule.kind, premise, one, vote_and_model(one), 1000)


PLANE = """
statement t/map
over a
domain a = 1
state x y
space x >= 0 and y >= 0
piece x >= y -> y/2, x/2
piece x < y -> y/2, x/2

statement t/descends
map t/map
domain a = 1
root u = sqrt(x^2 + y^2)
rank u
stage x = 0 and y = 0
"""


def test_both_sides_are_enclosed_where_a_root_is_irrational_holds() -> None:
    line = line_of(PLANE.replace("stage x = 0 and y = 0", "stage y != 0 or 2*x != 1"), "falls-1")
    assert (
        "x = 1/2, y = 0, u = 1/2, u_next = 1/4, where u_next <= u - 1 comes to 1/4 <= -1/2" in line
    )
    irrational = PLANE.replace("stage x = 0 and y = 0", "stage y != 1 or x != 1")
    line = line_of(irrational, "falls-1")
    assert line.endswith(
        "u = about 1.414214 (a root of z^2 - 2), u_next = about 0.707107 (a root of 2*z^2 - 1),"
        " where u_next <= u - 1 comes to about 0.707107 <= about 0.414214"
    )


def test_a_term_under_a_root_that_may_be_negative_is_named_holds() -> None:
    line = line_of(PLANE.replace("x^2 + y^2", "x - 1"), "bounded")
    assert line.startswith("bounded, the rank is at least 0 on the space: false at a = 1, x = ")
    assert ", where under the root u, x - 1 >= 0 comes to " in line and "u = " not in line


def test_a_long_goal_is_shown_by_its_numbers_holds() -> None:
    long = PLANE.replace("x >= 0 and y", f"{'x + ' * 40}x >= 0 and y").replace("-> y/2", "-> y - 1")
    line = line_of(long.partition("statement t/descends")[0], "stays-1")
    assert re.search(r": false at a = 1, x = [^ ]+, y = [^ ]+, where -[\d/]+ >= 0$", line), line


@each_row(
    ("kind", "old", "new", "premise", "says"),
    [
        ("contracts", "rate a", "rate 1", "constants", ", where 1 < 1 is false"),
        ("map", "piece x < 1", "piece x <= 1", "apart-2-1", ", x = 1"),
        (
            "descends",
            "stage x < 1",
            "stage not x >= 1 or x > 9",
            "stage-1-1",
            r", where not x_next >= 1 is false, x_next > 9 comes to [\d/]+ > 9",
        ),
        ("descends", "stage x < 1", "stage implies(x >= 1, x > 9)", "stage-1-1", r", x = [\d/]+"),
    ],
)
def test_what_is_false_is_shown_by_its_form_holds(
    kind: str, old: str, new: str, premise: str, says: str
) -> None:
    statements = read(edited(SUBTRACT, kind, old, new))
    one = checker.premises_of(statements[f"demo/{kind}"], statements)[premise]
    line = why(kind, premise, one, vote_and_model(one), 1)
    assert re.search(rf": false at a = .*{says}$", line), line


def test_a_false_recurrence_has_values_holds() -> None:
    (statement,) = read(
        "statement t/t\nforall x K\ninteger K\niterates x -> x + 2\nafter K -> x + 3*K"
    ).values()
    step = checker.premises_of(statement, {})["step"]
    line = why("iterates", "step", step, vote_and_model(step), 1)
    assert re.search(r"false at x = .*, where x_next \+ 2 = x \+ 3\*\(K \+ 1\) comes to ", line)


NOT_FOUND = "no certificate was found within the budget: try --budget 700, or a lemma"


@each_row(
    ("answer", "says"),
    [
        ("holds", f"Z3 says that it holds; {NOT_FOUND}"),
        ("unknown", f"Z3 gives no answer; {NOT_FOUND}"),
        ("fails", "Z3 says that it is false"),
    ],
)
def test_what_z3_says_without_values_holds(answer: str, says: str) -> None:
    premise = checker.premises_of(SUBTRACTING["demo/map"], {})["stays-2"]
    line = why("map", "stays-2", premise, (Vote("z3", answer, ""), None), 70)
    assert line == f"stays-2, piece 2 takes the space into itself: {says}"


# -------------------------------------------------------------------------------------------------
# From a file of one's own, by the command.

DOMAIN, SPACE = ("domain", "0 < a and a < 1"), ("space", "0 <= x and x <= 1")
MAP = (("over", "a"), DOMAIN, ("state", "x"), SPACE, ("piece", "0 <= x -> a*x"))
NEAR = (
    ("map", "mine/map"),
    DOMAIN,
    ("on", "0 <= x and x <= 1"),
    ("point", "0"),
    ("weights", "1"),
    ("rate", "a"),
    ("radius", "1"),
    ("size", "1"),
)
Rows = tuple[object, ...]


def file_of(folder: Path, near: Rows = NEAR, of_map: Rows = MAP) -> Path:
    """A claim of two rules, the second on line 10."""
    path = folder / "mine.py"
    path.write_text(
        "from juggleproof import MapRule, claim\n\n\n@claim('mine')\ndef settles():\n"
        f"    '''It settles.'''\n    return [\n        MapRule('map', {of_map!r}),\n"
        f"        MapRule(\n            'near', {near!r})]\n",
        encoding="utf-8",
    )
    return path


def put(rows: Rows, keyword: str, text: str) -> Rows:
    return tuple((keyword, text) if row[0] == keyword else row for row in rows)


def certify(path: Path, *more: str) -> int:
    return run(["certify", str(path), "--routes", "exact", "--jobs", "1", *more])


def test_an_overlap_and_a_gap_are_shown_with_a_state_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pieces = ("piece", "x <= 1/2 -> a*x"), ("piece", "x = 1/2 or x > 3/4 -> a*x")
    path = file_of(tmp_path, of_map=(*MAP[:4], *pieces))
    assert certify(path) == 1
    out = capsys.readouterr().out
    (gap,) = (line for line in out.splitlines() if "covers, " in line)
    (overlap,) = (line for line in out.splitlines() if "apart-2-1, " in line)
    place = place_in_file(str(path), 8)
    assert f"mine/map is open: 2 of the 5 premises of `map` at {place}:\n" in out
    assert gap.startswith(
        "      covers, the guard of some piece holds at each state of the space: false"
    )
    assert "x > 3/4 comes to " in gap and "x <= 1/2 comes to " in gap
    assert "the guards of pieces 1 and 2 do not overlap: false at a = " in overlap
    assert overlap.endswith("x = 1/2")
    assert "mine/near is open: it rests on mine/map, which is not certified" in out


def test_a_premise_within_no_budget_is_what_z3_says_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert certify(file_of(tmp_path), "--budget", "200") == 1
    out = capsys.readouterr().out
    assert (
        "Z3 says that it holds; no certificate was found within the budget: try --budget 2000,"
        in out
    )
    assert "false at" not in out


def test_what_was_open_is_searched_again_holds(tmp_path: Path) -> None:
    """With more work, and after what it rests on is mended."""
    overlapping = (*MAP, ("piece", "x >= 1 -> a"))
    assert certify(file_of(tmp_path), "--budget", "200") == 1
    assert certify(file_of(tmp_path)) == 0
    assert certify(file_of(tmp_path, of_map=overlapping)) == 1
    assert certify(file_of(tmp_path)) == 0


def test_an_open_rule_is_explained_with_the_text_of_its_premise_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = file_of(tmp_path, put(NEAR, "rate", "a/2"))
    assert certify(path) == 1
    place = place_in_file(str(path), 9)
    line = (
        f"1 of the 8 premises of `contracts` at {place}: closer-1, on the set, piece 1 multiplies"
    )
    assert line in capsys.readouterr().out
    assert run(["explain", "mine", str(path)]) == 0
    out = capsys.readouterr().out
    assert f"-> unknown: {line}" in out and "        show (-((a / 2)*distance)*(1) <= " in out
    assert "-> certified: for 0 < a < 1: f maps the space {0 <= x and x <= 1} into itself" in out
    assert "psatz" not in out and "proof       docs/theorem.md" in out


def test_a_rule_on_the_map_of_another_claim_is_explained_before_it_is_stored_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = file_of(tmp_path)
    near = [("domain", "0 < a and 2*a < 1") if row[0] == "domain" else row for row in NEAR]
    with path.open("a", encoding="utf-8") as file:
        file.write(
            "\n\n@claim('other', hints={'uses': ['mine/map']})\ndef too():\n"
            f"    '''It settles.'''\n    return MapRule('near', {tuple(near)!r})\n"
        )
    assert run(["explain", "other", str(path)]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "certified: for 0 < a < 1/2: e = 0 is a fixed point, is stable, and attracts" in out


def test_reasons_are_the_same_from_run_to_run_holds(tmp_path: Path) -> None:
    path = file_of(tmp_path, put(NEAR, "rate", "a/2"))
    stored = []
    for _ in range(2):
        assert certify(path, "--fresh") == 1
        folder = path.with_suffix(".certificates")
        stored.append([(folder / name).read_bytes() for name in (STATEMENTS, CERTIFICATES)])
    assert stored[0] == stored[1] and b"false at a = " in stored[0][1]


def test_a_rule_whose_proofs_the_checker_rejects_is_searched_again_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked, search = list[bool](), claim_search.search_premises

    def first_in_vain(*rest: Any) -> Any:
        asked.append(rest[-1])
        for name, proof in search(*rest):
            yield name, proof if rest[-1] else ("proof", [], ("close",))

    monkeypatch.setattr(claim_search, "search_premises", first_in_vain)
    assert certify(file_of(tmp_path)) == 0
    assert asked == [False, True, False, True]  # the map, and what is claimed of it


def test_a_stored_rule_is_open_where_its_map_is_open_now_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert certify(file_of(tmp_path)) == 0
    path = file_of(tmp_path, of_map=put(MAP, "piece", "0 <= x -> 2*a*x"))
    capsys.readouterr()
    assert run(["explain", "mine", str(path)]) == 0
    assert "-> unknown: it rests on mine/map, which is not certified" in capsys.readouterr().out
    assert certify(path) == 1


ORDER = (
    "; the lines of `contracts` are, in this order: map or relation, domain, root (any number), on,"
    " point,"
)
FAULTS: dict[str, tuple[Rows, str]] = {
    "missing": ((*NEAR[:3], NEAR[4], *NEAR[6:]), f"`point`, `rate` missing{ORDER}"),
    "out of order": (
        (*NEAR[:2], NEAR[3], NEAR[2], *NEAR[4:]),
        f"`on` after `point`{ORDER}",
    ),
    "twice": ((*NEAR[:2], *NEAR[1:]), f"`domain` twice{ORDER}"),
    "a line of maps": ((*NEAR, ("integer", "a")), f"`integer` left over{ORDER}"),
    "left over": ((*NEAR, ("ranks", "x")), f"`ranks` left over{ORDER}"),
    "no rule": ((("forall", "x"), ("show", "x = x")), "`show` left over; the lines of"),
    "no pair": ((*NEAR[:7], "size"), "each line of a rule is a pair (keyword, text)"),
    "no map": (
        put(NEAR, "map", "mine/mapp"),
        "the line `map mine/mapp` names no rule that stands before it; did you mean mine/map?",
    ),
    "no name": (
        put(NEAR, "map", "other"),
        "the line `map other` names no rule that stands before it; state it first, in this claim",
    ),
    "itself": (put(NEAR, "map", "mine/near"), "names no rule that stands before it"),
    "no term": (
        put(NEAR, "rate", "2**a"),
        "the line `rate 2**a`: unreadable text: 2**a",
    ),
    "no variable": (
        put(NEAR, "rate", "q"),
        "premise constants: an undeclared name: q",
    ),
    "division": (
        put(NEAR, "rate", "1/(2*a - 1)"),
        "premise constants: division by what may vanish",
    ),
    "a lemma for none": (
        (*NEAR, ("lemma", "closer-2: x <= 1")),
        "the line `lemma closer-2: ..` names no premise; name one of inside,",
    ),
    "a lemma for values": ((*NEAR, ("lemma", "possible: x <= 1")), "`lemma possible: ..` names no"),
    "a lemma with or": (
        (*NEAR, ("lemma", "closer-1: x < 1 or x = 1")),
        "premise closer-1: not a formula: x < 1 or x = 1, as a lemma without `or`",
    ),
    "a lemma of other names": (
        (*NEAR, ("lemma", "closer-1: q < 1")),
        "premise closer-1: an undeclared name: q",
    ),
    "two terms": (put(NEAR, "point", "0, 0"), "one term in the parameters for each state"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_rejects_lines_that_make_no_rule(
    fault: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rows, reason = FAULTS[fault]
    path = file_of(tmp_path, rows)
    assert certify(path) == 2
    done = capsys.readouterr()
    assert f"{path}:9: mine/near: " in done.err and reason in done.err
    assert len(done.err.splitlines()) == 1 and not done.out


@pytest.mark.parametrize("lemma", ["x_next <= a", "x_next = a*x and a*x <= a", "x + 1 != 0"])
def test_a_lemma_is_proved_first_and_used_holds(lemma: str, tmp_path: Path) -> None:
    path = file_of(tmp_path, (*NEAR, ("lemma", f"closer-1: {lemma}")))
    assert certify(path) == 0
    folder = path.with_suffix(".certificates")
    assert "lemma" not in (folder / STATEMENTS).read_text()
    rows = map(json.loads, (folder / CERTIFICATES).read_text().splitlines())
    proof = dict(rows)["mine/near"]["certified"]["closer-1"]
    assert proof[0] == "proof" and proof[2][0] == "sign"


def test_a_lemma_that_says_nothing_new_is_none_that_fails_holds(tmp_path: Path) -> None:
    assert certify(file_of(tmp_path, (*NEAR, ("lemma", "closer-1: x_next <= a*x")))) == 0


@pytest.mark.parametrize("lemma", ["x_next <= a*distance/2", "x = 0", "x != 0", "a < 0", "0 > x"])
def test_a_false_lemma_proves_no_false_premise_holds(
    lemma: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rows = (*put(NEAR, "rate", "a/2"), ("lemma", f"closer-1: {lemma}"))
    assert certify(file_of(tmp_path, rows)) == 1
    assert "closer-1, on the set, piece 1 multiplies" in capsys.readouterr().out


def test_rejects_the_name_of_another_kind_of_rule(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = file_of(tmp_path)
    text = path.read_text(encoding="utf-8")
    more = ", MapRule('more', (('descent', 'mine/map'), ('contraction', 'mine/near')))]"
    path.write_text(text.replace("])]", f"]){more}").replace(")))]\n", f"))){more}\n"))
    assert certify(path) == 2
    err = capsys.readouterr().err
    assert "mine/more: mine/map is a rule `map`; name one of the kind `descends`" in err


def test_rejects_a_relation_on_the_line_of_a_map(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    of_map = (*MAP[:3], ("input", "u"), SPACE, ("piece", "0 <= u and u <= a -> u*x"))
    assert certify(file_of(tmp_path, of_map=of_map)) == 2
    said = "mine/near: mine/map is a rule `relation`; write the line `relation mine/map`"
    assert said in capsys.readouterr().err
    relation = (("relation", "mine/map"), *NEAR[1:])
    assert certify(file_of(tmp_path, relation, of_map)) == 0


def test_decimals_and_cases_are_read_as_in_a_map_file_holds(tmp_path: Path) -> None:
    of_map = put(put(MAP, "piece", "max(0, a*x - 0.1*abs(x - 0.5))"), "domain", "0.1 < a and a < 1")
    near = put(put(NEAR, "on", "abs(2*x - 1) <= 1"), "domain", "0.5 < a and a < 0.75")
    path = file_of(tmp_path, put(near, "rate", "a + 0.2"), of_map)
    assert certify(path) == 0
    text = (path.with_suffix(".certificates") / STATEMENTS).read_text(encoding="utf-8")
    assert "rate a + (1/5)" in text and "abs(" not in text


def test_the_theorem_is_explained_without_certificates_holds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["explain", "theorem"]) == 0
    out = capsys.readouterr().out
    assert "psatz" not in out and "proof       docs/theorem.md" in out
    said = " ".join(out.split())
    assert "every integer N >= rank(s) + 3, where rank = 2*u + (1 - w)/2; u = sqrt(4*x" in said
    assert "is stable and attracts every state of the space if and only if 0 < alpha < 1/3" in said
