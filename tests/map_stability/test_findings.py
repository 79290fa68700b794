"""What is said of a map is what its certified statements say: no condition, point or set is lost,
also where the point fails at an end alone, which samples miss.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

from juggleproof import MapRule, stability
from juggleproof.judging.conclusions import RuleLines
from juggleproof.map_stability.findings import MapFinding, ParameterMeaning, finding_of
from juggleproof.map_stability.maps import Map
from juggleproof.map_stability.search import Outcome, search_stability
from juggleproof.map_stability.terms import holds
from juggleproof.statements.language import ClaimError, bounds_of
from tests.command import running
from tests.map_stability.maps import exact_next, map_of

EVERY = "is stable and attracts every state"
SAID = re.compile(rf"(?P<point>.+?) {EVERY}(?P<how> (?:at least where|where|if and only if) )?(.*)")
UNIT = "over a\ndomain 0 <= a and a <= 1\n"
SATURATED = "x - h*max(-1, min(1, 2*x + y)), y - h*max(-1, min(1, x + 2*y))"
FAILS_AT_AN_END = {  # by what certifies it: the map, and for which parameters its point attracts
    "norm": (UNIT + "state x y\npiece a*x, y/2", "a < 1"),
    "norm-turned": (UNIT + "state x y\npiece a*y, -a*x", "a < 1"),
    "norm-in-a-circle": (UNIT + "state x y z\npiece a*y, a*z, a*x", "a < 1"),
    "corner": (
        "over a b\ndomain 0 <= a and a <= 1 and 0 <= b and b <= 1\nstate x y\npiece a*b*x, y/2",
        "a*b < 1",
    ),
    "two-corners": (
        "over a b\ndomain 0 <= a and a <= 1 and 0 <= b and b <= 1\nstate x y\npiece a*x, b*y",
        "a < 1 and b < 1",
    ),
    "irrational-end": (
        "over a\ndomain 0 <= a and a^2 <= 2\nstate x y\npiece a^2*x/2, y/2",
        "a^2 < 2",
    ),
    "quotient": (UNIT + "state x y\npiece a*x/(1 + y^2), y/2", "a < 1"),
    "weighted-sum": (
        "over a\ndomain 0 < a and a <= 1/2\nstate x y\npiece 1 - a*abs(x) + y, x/2",
        "a < 1/2",
    ),
    "saturated": (f"over h\ndomain 0 <= h and h <= 1/2\nstate x y\npiece {SATURATED}", "h > 0"),
    "intervals": (
        "over a\ndomain 0 < a and a <= 1\nstate p\nspace p >= 0\npiece max(0, 1 - a*p)",
        "a < 1",
    ),
    "tent": (UNIT + "state x\nspace 0 <= x and x <= 1\npiece a*min(x, 1 - x)", "a < 1"),
    "ratio": (
        "over r\ndomain 1 <= r and r < 3\nstate x y\nspace x > 0 and y > 0\npiece r*x/(1 + y), x",
        "r > 1",
    ),
    "envelope": (
        "over a\ndomain 1 <= a and a <= 3\nstate x\nspace 0 < x and x < 1\npiece a*x*(1 - x)",
        "a > 1",
    ),
    "box-entered": (UNIT + "state x y\npiece max(-1, min(1, a*x)), y/2", "a < 1"),
    "end-of-the-space": ("state x y\nspace 0 <= x and x <= 1\npiece x^2, y/2", "0 < 0"),
    "licence": (  # no fixed point for a > 0, and one at a = 0
        UNIT + "state x\nspace x >= 0\npiece x < 1 -> x + 1/a\npiece x >= 1 -> x + a",
        "0 < 0",
    ),
}


def corners(system: Map) -> Iterator[dict[str, Fraction]]:
    """Parameters of the domain: ends that belong to it, and what is close to them and between."""
    ranges = []
    for name in system.parameters:
        low, high = bounds_of(system.domain, name) or (None, None)
        ends = Fraction(low[0] if low else -2), Fraction(high[0] if high else 2)
        ranges.append([ends[0] + Fraction(k, 64) * (ends[1] - ends[0]) for k in (0, 1, 32, 63, 64)])
    for values in product(*ranges):
        parameters = dict(zip(system.parameters, values))
        if holds(system.domain, parameters):
            yield parameters


def condition_in(finding: MapFinding) -> tuple[str, bool] | None:
    """For which parameters the sentence says that the point attracts every state, and whether it
    says for these alone; nothing where it does not say that.
    """
    said = SAID.match(finding.sentence.partition(";")[0])
    if not said:
        return None
    sharp = (said["how"] or "").strip() == "if and only if"
    return (said[3].partition(", of all")[0] or "0 < 1"), sharp


def whole_domains(outcome: Outcome, system: Map) -> list[str]:
    """The domains of the certified statements that the point attracts every state of the space."""
    texts = {rule.name: rule.text() for rule in outcome.proof.rules}
    found = []
    for name in texts:
        lines, kind = RuleLines(name, texts), outcome.proof.known[name].kind
        if kind in ("attracts", "into"):
            lines = lines.named("descent")
        elif kind not in ("lyapunov", "contracts") or lines.one("on") not in (
            "0 < 1",
            system.space,
        ):
            continue
        if lines.of_map().one("space") == system.space:
            found.append(lines.one("domain"))
    return found


def assert_true(outcome: Outcome, system: Map, truth: str) -> None:
    """What is said holds, and is certified, at the ends of the domain and inside."""
    finding = outcome.finding
    said = condition_in(finding)
    for parameters in corners(system):
        stable = bool(holds(truth, parameters))
        if finding.verdict == "refuted":
            assert not stable, parameters
        if said is None:
            continue
        claimed = bool(holds(said[0], parameters))
        assert stable or not claimed, (finding.sentence, parameters)
        assert claimed or not (stable and said[1]), (finding.sentence, parameters)
        certified = any(holds(domain, parameters) for domain in whole_domains(outcome, system))
        assert certified or not claimed, (finding.sentence, parameters)
    if finding.verdict == "proved":
        assert finding.condition == finding.attracted == ""
        assert all(holds(truth, parameters) for parameters in corners(system))


LONG = {"irrational-end", "saturated", "envelope", "box-entered", "weighted-sum", "ratio"}
LONG |= {"norm-in-a-circle", "two-corners", "corner", "norm", "norm-turned", "intervals"}
LONG |= {"quotient"}


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.exhaust) if name in LONG else name
        for name in FAILS_AT_AN_END
    ],
)
def test_a_point_that_fails_at_an_end_alone_is_not_proved_there_holds(name: str) -> None:
    text, truth = FAILS_AT_AN_END[name]
    system = map_of(text, name)
    outcome = search_stability(system)
    assert outcome.finding.verdict in ("in part", "refuted")
    assert_true(outcome, system, truth)


NUMBERS = some.sampled_from([Fraction(k, 2) for k in range(-4, 5)])
SHAPES = {  # a map, and where its point 0 attracts every state
    "{}*a*x, y/2": "{0}*a < 1 and {0}*a > -1",
    "{}*a*y, a*x": "{0}*a*a < 1 and {0}*a*a > -1",
    "a*x, {}*a*x": "a < 1 and a > -1",
    "a*x/(1 + y^2), {}*y/2": "a < 1 and a > -1 and {0} < 2 and {0} > -2",
}


@pytest.mark.exhaust
@given(
    shape=some.sampled_from(sorted(SHAPES)),
    number=NUMBERS,
    ends=some.tuples(NUMBERS, NUMBERS).filter(lambda ends: ends[0] < ends[1]),
    signs=some.tuples(some.sampled_from(["<", "<="]), some.sampled_from(["<", "<="])),
)
@settings(max_examples=8, deadline=None, derandomize=True)
def test_what_is_said_of_a_drawn_map_is_so_at_the_ends_of_its_domain_holds(
    shape: str, number: Fraction, ends: tuple[Fraction, Fraction], signs: tuple[str, str]
) -> None:
    domain = f"{ends[0]} {signs[0]} a and a {signs[1]} {ends[1]}"
    text = f"over a\ndomain {domain}\nstate x y\npiece {shape.format(f'({number})')}"
    system = map_of(text, "drawn")
    outcome = search_stability(system)
    assert_true(outcome, system, SHAPES[shape].format(f"({number})"))
    for parameters in corners(system):
        said = condition_in(outcome.finding)
        if said and holds(said[0], parameters):
            assert_tends_to_0(system, parameters)


def assert_tends_to_0(system: Map, parameters: Mapping[str, Fraction]) -> None:
    """An exact orbit comes closer to the point 0 than it began."""
    point = {**parameters, "x": Fraction(1), "y": Fraction(-1)}
    for _ in range(200):
        point = exact_next(system, point)
        point |= {name: value.limit_denominator(10**12) for name, value in point.items()}
        if max(abs(point["x"]), abs(point["y"])) < Fraction(9, 10):
            return
    raise AssertionError(f"the orbit stays away at {parameters}")


POINTS = "state x\npiece x < 0 -> x - (x^2 - 2)\npiece x >= 0 -> x + (x^2 - 3)"


def test_each_point_has_the_root_of_its_own_statement_holds() -> None:
    finding = search_stability(map_of(POINTS, "roots")).finding
    assert finding.sentence == "(-sqrt(2)) is not stable; sqrt(3) is not stable"


def test_a_parameter_named_e_is_not_the_point_holds(tmp_path: Path) -> None:
    (tmp_path / "e.map").write_text("over e\ndomain 0 <= e and e < 1\nstate x\npiece e*x\n")
    printed = running.run("stability", str(tmp_path / "e.map")).stdout
    assert "lyapunov: for 0 <= e < 1: p = 0 is a fixed point" in printed


def test_the_exit_code_tells_the_whole_from_a_part_holds(tmp_path: Path) -> None:
    texts = {0: "1/2*x", 1: "2*x", 3: "a*x"}
    for code, image in texts.items():
        path = tmp_path / "one.map"
        path.write_text(f"over a\ndomain 0 <= a and a <= 1\nstate x\npiece {image}\n")
        assert running.run("stability", str(path)).returncode == code
    (tmp_path / "all.py").write_text(
        "from juggleproof import MapRule, claim\n\n@claim('all')\ndef maps():\n    '''Maps.'''\n"
        "    rows = ('over', 'a'), ('domain', '0 <= a and a <= 1'), ('state', 'x')\n"
        f"    return [MapRule(f'm{{k}}', (*rows, ('piece', one)))\n"
        f"            for k, one in enumerate({list(texts.values())})]\n"
    )
    assert running.run("stability", str(tmp_path / "all.py")).returncode == 1


def test_what_is_written_says_no_more_than_the_first_line_holds(tmp_path: Path) -> None:
    (tmp_path / "s1.map").write_text(FAILS_AT_AN_END["norm"][0] + "\n")
    done = running.run("stability", str(tmp_path / "s1.map"), "-o", str(tmp_path))
    said = done.stdout.partition("\n")[0].partition(": ")[2]
    assert said == f"(0, 0) {EVERY} if and only if a < 1"
    assert f'"""{said}."""' in (tmp_path / "s1.py").read_text()
    assert f"# {said}" in (tmp_path / "s1.certificates/statements.txt").read_text()


def test_rejects_a_claim_for_a_domain_of_which_a_part_is_certified() -> None:
    rows = tuple(
        (line.split()[0], line.partition(" ")[2]) for line in FAILS_AT_AN_END["norm"][0].split("\n")
    )
    with pytest.raises(ClaimError, match="s1: in part: .* if and only if a < 1"):
        stability(MapRule("s1", rows))


def forged(outcome: Outcome, system: Map, **rows: str) -> MapFinding | None:
    """What is said where the statements have other lines, as if a search had made them so."""
    rules = [
        MapRule(rule.name, tuple((key, rows.get(key, text)) for key, text in rule.rows))
        for rule in outcome.proof.rules
    ]
    return finding_of(system, rules, outcome.proof.known)


def test_a_sentence_follows_the_statements_and_nothing_else_holds() -> None:
    """Whatever line of a statement says less, the sentence says less."""
    system = map_of("over a\ndomain 0 <= a and a < 1\nstate x\npiece a*x", "half")
    outcome = search_stability(system)
    whole = forged(outcome, system)
    assert whole and (whole.verdict, whole.sentence) == ("proved", f"0 {EVERY}")
    part = forged(outcome, system, domain="0 <= a and a < 1 and a < 1/2")
    assert part and (part.verdict, part.condition) == ("in part", "a < 1/2")
    assert part.sentence == f"0 {EVERY} at least where a < 1/2"
    near = forged(outcome, system, on="x_gap <= 3 and -x_gap <= 3")
    assert near and (near.verdict, near.attracted) == ("in part", "x_gap <= 3 and -x_gap <= 3")
    assert near.sentence.startswith("0 is stable, and attracts every state with |x| <= 3; ")
    other = forged(outcome, system, point="1/7")
    assert other and other.sentence == f"1/7 {EVERY}"
    assert forged(outcome, system, space="x > -5") is None
    doubt = finding_of(
        system, outcome.proof.rules, outcome.proof.known, ParameterMeaning("here", False)
    )
    assert doubt and (doubt.verdict, doubt.sentence) == ("in part", f"0 {EVERY}; here")


def test_rejects_that_a_map_has_no_fixed_point_without_guards_that_say_so() -> None:
    system = map_of("state x\npiece x + 1", "shift")
    outcome = search_stability(system)
    assert outcome.finding.verdict == "refuted"
    last = outcome.proof.rules[-1]
    assert dict(last.rows)["piece"].startswith("x + 1 != x -> ")
    assert forged(outcome, system, piece="0 < 1 -> x + 1") is None
