"""Claims of one's own under the map rules: certified, told with their range, and settled again
where a statement that they rest on changes.
"""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

from juggleproof.judging.claims import Assertion, Claim
from juggleproof.judging.forms import always
from juggleproof.judging.judge import judge
from juggleproof.judging.judgement import Resources
from juggleproof.judging.rule_ranges import range_of_rule
from juggleproof.papers.paper import opened
from juggleproof.statements.language import MapRule, Roles, Statement, real
from tests.command.running import Done, run
from tests.judging.loading import loaded_anew
from tests.rows import each_row

CLAIMS = """
from juggleproof import MapRule, claim

@claim("mine")
def it_comes_to_rest():
    '''What is subtracted from, then halved, tends to 0.'''
    return [
        MapRule("map", (("over", "alpha"), ("domain", "alpha > 0 and alpha < 1"), ("state", "x"),
                        ("space", "x >= 0"),
                        ("piece", "x >= 1 -> x - 1"), ("piece", "x < 1 -> alpha*x"))),
        MapRule("descends", (("map", "mine/map"), ("domain", "alpha > 0 and 2*alpha < 1"),
                             ("rank", "x"), ("stage", "x < 1"))),
        MapRule("contracts", (("map", "mine/map"), ("domain", "alpha > 0 and alpha < 1"),
                              ("on", "ON"), ("point", "0"), ("weights", "1"),
                              ("rate", "alpha"), ("radius", "1/2"), ("size", "1"))),
        MapRule("attracts", (("descent", "mine/descends"), ("contraction", "mine/contracts"))),
    ]
"""


def certify(folder: Path, on: str) -> Done:
    path = folder / "mine.py"
    path.write_text(CLAIMS.replace("ON", on), encoding="utf-8")
    return run("certify", str(path), "--routes", "exact", "--jobs", "1")


def test_rules_of_ones_own_hold_and_tell_their_range(tmp_path: Path) -> None:
    done = certify(tmp_path, "x < 1")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "1 holds" in done.stdout and "at least 0 < alpha < 1/2" in done.stdout


def test_a_rule_is_settled_again_where_what_it_rests_on_changes(tmp_path: Path) -> None:
    certify(tmp_path, "x < 1")
    for on in ("x < 1 and (x < 3 or x < 4)", "x < 1"):
        done = certify(tmp_path, on)
        assert done.returncode == 0 and "rejected" not in done.stdout, done.stdout + done.stderr


def test_a_rule_fails_without_its_set(tmp_path: Path) -> None:
    done = certify(tmp_path, "x < 1/4")
    assert done.returncode == 1 and "1 unknown" in done.stdout


def test_no_claim_is_left_out_where_its_file_was_loaded_before() -> None:
    loaded = loaded_anew()
    assert loaded.claims == [one.id for one in opened().claims()]
    assert "theorem-roots" in loaded.claims


SHARP = {
    "t/map": "statement t/map\nover a\ndomain a > 0",
    "t/falls": "statement t/falls\nmap t/map\ndomain a > 0 and 3*a < 1",
    "t/attracts": "statement t/attracts\ndescent t/falls\ncontraction t/closes",
    "t/exactly": "statement t/exactly\nattraction t/attracts\nescape t/escapes",
}


@each_row("is_conclusion, text", [(True, "0 < a < 1/3"), (False, "at least 0 < a < 1/3")])
def test_a_range_is_sharp_only_for_the_conclusion_itself_holds(
    is_conclusion: bool, text: str
) -> None:
    assert range_of_rule("t/exactly", SHARP, is_conclusion=is_conclusion) == text


def test_what_is_asked_of_other_parameters_is_part_of_the_range_holds() -> None:
    both = {
        name: text.replace("over a\ndomain a > 0", "over a b\ndomain a > 0 and b > 0").replace(
            "3*a < 1", "3*a < 1 and b > 0 and b < 1"
        )
        for name, text in SHARP.items()
    }
    assert range_of_rule("t/exactly", both) == "a > 0 and 3*a < 1 and b > 0 and b < 1"
    within = {name: text.replace(" and b < 1", "") for name, text in both.items()}
    assert range_of_rule("t/exactly", within) == "a > 0 and 3*a < 1 and b > 0"
    stated = Roles({"a": (real("a") > 0,)})
    assert range_of_rule("t/exactly", within, stated) == "0 < a < 1/3"


def test_the_range_of_several_attractors_is_that_of_the_descent_holds() -> None:
    ends = "never 1\ncontraction t/closes\nword 2"
    texts = SHARP | {"t/settles": f"statement t/settles\ndescent t/falls\n{ends}"}
    assert range_of_rule("t/settles", texts) == "at least 0 < a < 1/3"
    texts["t/returns"] = "statement t/returns\nmap t/map\nsettling t/settles\nword 1\nword 2"
    assert range_of_rule("t/returns", texts) == "at least 0 < a < 1/3"


@each_row(
    "domain, text",
    [
        ("a^2 <= 2 and a >= 0", "at least 0 <= a <= 1393/985"),
        ("a^2 > 2 and a > 0", "at least a >= 1970/1393"),
        ("a > 0 and a^2 < 2 and 2*a^2 > 1", "at least 985/1393 <= a <= 1393/985"),
        ("a^2 > 2", "at least a^2 > 2"),  # two intervals
        ("a^2 > 2 and 10^14*a^2 < 2*10^14 + 1", "at least a^2 > 2 and 10^14*a^2 < 2*10^14 + 1"),
        ("0 < a and a^2 < 0", "at least 0 < a and a^2 < 0"),
    ],
)
def test_an_irrational_end_is_told_inside_of_it_holds(domain: str, text: str) -> None:
    assert range_of_rule("t/map", {"t/map": f"statement t/map\nover a\ndomain {domain}"}) == text


def test_a_sharp_range_is_told_exactly_holds() -> None:
    texts = SHARP | {"t/falls": SHARP["t/falls"].replace("3*a < 1", "3*a^2 < 1")}
    assert range_of_rule("t/exactly", texts) == "a > 0 and 3*a^2 < 1"


def test_a_rule_without_a_domain_has_no_range_holds() -> None:
    text = "statement t/sum\nforall x K\ninteger K\niterates x -> x + 2\nafter K -> x + 2*K"
    assert range_of_rule("t/sum", {"t/sum": text}) == ""


def test_a_map_without_parameters_has_no_range_holds() -> None:
    texts = {
        "t/map": "statement t/map\nover \ndomain 0 < 1\nstate x",
        "t/near": "map t/map\ndomain 0 < 1",
    }
    assert range_of_rule("t/near", texts) == range_of_rule("t/map", texts) == ""


def scaled(name: str, domain: str, over: str = "a") -> MapRule:
    space = ("space", "0 <= x and x <= 1")
    rows = ("over", over), ("domain", domain), ("state", "x"), space, ("piece", "a*x")
    return MapRule(name, rows)


def near(domain: str) -> MapRule:
    at = ("on", "0 <= x and x <= 1"), ("point", "0"), ("weights", "1"), ("rate", "a")
    return MapRule(
        "near", (("map", "own/f"), ("domain", domain), *at, ("radius", "1"), ("size", "1"))
    )


def told(*parts: Statement | MapRule) -> str | None:
    """The display of the range of a claim that asserts these, the last of them a map rule."""
    claim = Claim("own", "", "", "what they say", lambda: Assertion(parts))
    sharp = judge(claim, Resources(routes=("exact",))).sharp.get("")
    return sharp and sharp.text


WHOLE = "0 < a and a < 1"
BELOW_HALF = always(real("a") < Fraction(1, 2), in_range=[real("a") > 0, real("a") < 1])


@each_row(
    "parts",
    [
        (BELOW_HALF, scaled("f", WHOLE), near(WHOLE)),
        (scaled("f", WHOLE), near("0 < a and 2*a < 1"), scaled("g", WHOLE)),
    ],
)
def test_rejects_range_of_the_last_rule_where_another_part_does_not_hold(
    parts: tuple[Statement | MapRule, ...],
) -> None:
    assert told(*parts) is None


def test_range_of_the_last_rule_within_the_domains_of_the_others_holds() -> None:
    rules = scaled("g", "0 < a and a < 3/4"), scaled("f", WHOLE), near("0 < a and 2*a < 1")
    assert told(*rules) == "at least 0 < a < 1/2"


@each_row("more", ["a < b", "b = 3"])
def test_range_of_a_rule_is_told_with_all_of_its_conditions_holds(more: str) -> None:
    assert told(scaled("f", f"{WHOLE} and {more}", "a b")) == f"at least {WHOLE} and {more}"
