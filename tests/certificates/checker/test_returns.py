"""A map that makes several steps of another at once: orbits of that come to the orbits of the
points to which it settles, where near each point it always makes the same steps.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.certificates import checker
from juggleproof.certificates.checker import Kind
from tests.certificates.checker.harness import Expected, refused
from tests.certificates.checker.maps import PUSH, checked, edited, read, searched, up_to

# On the right two steps lead out beyond 10 and back nearer to 2; on the left one leads nearer to
# -2.
LOOP = """
statement loop/map
over a
domain a > 0 and 2*a < 1
state x
space x >= -9 and x <= 20
piece x <= -1 -> a*(x + 2) - 2
piece x > -1 and x < 1 -> x + 2
piece x >= 1 and x <= 9 and x > 0 -> 9 + 10/x
piece x > 9 and x < 10 -> x - 8
piece x >= 10 and x - 9 > 0 -> 2 + a*(10/(x - 9) - 2)

statement loop/faster
over a
domain a > 0 and 2*a < 1
state x
space x >= -9 and x <= 20
piece x >= 1 and x <= 9 and x > 0 -> 2 + a*(x - 2)
piece x > 9 and x < 10 -> x - 8
piece x >= 10 and x - 9 > 0 -> 2 + a*(10/(x - 9) - 2)
piece x > -1 and x < 1 -> x + 2
piece x <= -1 -> a*(x + 2) - 2

statement loop/descends
map loop/faster
domain a > 0 and 2*a < 1
rank 0
stage 0 = 0
stage (x >= 1 and x <= 9) or x <= -1

statement loop/up
map loop/faster
domain a > 0 and 2*a < 1
on x >= 1 and x <= 9
point 2
weights 1
rate a
radius 1/2
size 20

statement loop/down
map loop/faster
domain a > 0 and 2*a < 1
root c = sqrt(x^2)
on -c <= -1 and c = -x
point -2
weights 1
rate a
radius 1/2
size 20

statement loop/settles
descent loop/descends
never 2
never 3
never 4
contraction loop/up
word 1
contraction loop/down
word 5

statement loop/returns
map loop/map
settling loop/settles
word 3 5
word 4
word 5
word 2
word 1
"""
RIGHT = "on x >= 1 and x <= 9"
# (statement, what stands there, what is put in its place, the premise of loop/returns that fails)
FAILING = [
    ("map", "2*a < 1", "4*a < 1", "inside"),
    ("map", "10/(x - 9) - 2", "10/(x - 9) - 3", "word-1"),
    ("faster", "-> x + 2", "-> x - x + 2", "word-4"),
    ("returns", "word 3 5", "word 3", "word-1"),
    ("returns", "word 3 5", "word 5 3", "word-1"),
    ("returns", "word 3 5", "word 3 5 2", "word-1"),
    ("returns", "word 2\nword 1", "word 1\nword 1", "word-4"),
    ("up", RIGHT, f"{RIGHT} or x >= 10", "piece-1"),
    ("settles", "word 5", "word 5\ncontraction loop/up\nword 2 1", "piece-3"),
]
# (what stands in loop/returns, what is put in its place, why it is refused)
MALFORMED: list[tuple[str, str, Expected]] = [
    ("word 3 5\n", "", (Kind.WORD_EACH, "loop/returns")),
    ("word 3 5", "word 3 5\nword 3 5", (Kind.WORD_EACH, "loop/returns")),
    ("word 3 5", "word", (Kind.WORD, "loop/map")),
    ("word 3 5", "word 3 6", (Kind.INDEX, "5")),
    ("word 3 5", "word 3 0", (Kind.INDEX, "-1")),
    ("map loop/map", "map loop/descends", (Kind.EARLIER, "map loop/descends")),
    ("map loop/map", "map loop/later", (Kind.EARLIER, "map loop/later")),
    ("settling loop/settles", "settling loop/up", (Kind.EARLIER, "settles loop/up")),
]
# (what stands in loop/map, what is put in its place): other parameters, state and space
OTHERS = [
    ("over a", "over a b"),
    ("space x >= -9", "space x >= -10"),
    ("space x >= -9", "space x >= -8"),
]


def step(a: Fraction, x: Fraction) -> Fraction:
    """The map, in exact numbers."""
    if x < 1:
        return x + 2 if x > -1 else a * (x + 2) - 2
    if x < 10:
        return 9 + 10 / x if x <= 9 else x - 8
    return 2 + a * (10 / (x - 9) - 2)


def orbit(f: Callable[[Fraction], Fraction], x: Fraction, length: int) -> list[Fraction]:
    found = [x]
    while len(found) < length:
        found.append(f(found[-1]))
    return found


def test_every_orbit_tends_to_one_of_two_orbits_holds() -> None:
    results = checked(LOOP, searched(LOOP))
    assert {outcome for outcome, _ in results.values()} == {"certified"}, results


@given(
    a=st.fractions(Fraction(1, 100), Fraction(49, 100), max_denominator=100),
    x=st.fractions(-9, 20, max_denominator=50),
)
def test_orbits_come_to_those_of_the_points_holds(a: Fraction, x: Fraction) -> None:
    def f(y: Fraction) -> Fraction:
        return step(a, y)

    start = next(n for n, y in enumerate(orbit(f, x, 4)) if y <= -1 or 1 <= y <= 9)
    states = orbit(f, x, start + 11)[start:]
    point = Fraction(2 if states[0] > 0 else -2)
    assert f(f(point)) == point
    near = [abs(one - other) for one, other in zip(states, orbit(f, point, 11))]
    assert all(after <= a * before for before, after in zip(near[::2], near[2::2]))


@pytest.mark.parametrize(("kind", "old", "new", "premise"), FAILING)
def test_orbits_come_to_those_of_the_points_fails_without_its_premise(
    kind: str, old: str, new: str, premise: str
) -> None:
    text, name = edited(LOOP, kind, old, new), "loop/returns"
    found = searched(text)
    assert found[name] == {"unknown": f"no proof of the premise {premise} was found"}
    outcome, reason = checked(text, {**found, name: searched(LOOP)[name]})[name]
    assert outcome == "rejected" and reason is not None
    # the certificate of other premises, or of one with more or fewer states on the way
    others = (Kind.PREMISES, Kind.MALFORMED)
    assert reason.place == f"premise {premise} of {name}" or reason.kind in others


# Left of 0 the orbits go out to the left, right of it to the right, as 0 does: the returns tend to
# 0 from both sides, and what starts on the left never comes near the orbit of 0.
JUMP = """
statement jump/map
over a
domain a > 0 and 2*a < 1
state x
space x >= -29 and x <= 29
piece x >= 0 and x <= 9 -> x + 20
piece x > 9 -> a*(x - 20)
piece x < 0 and x >= -9 -> x - 20
piece x < -9 -> a*(x + 20)

statement jump/faster
over a
domain a > 0 and 2*a < 1
state x
space x >= -29 and x <= 29
piece x >= 0 and x <= 9 -> a*x
piece x > 9 -> a*(x - 20)
piece x < 0 and x >= -9 -> a*x
piece x < -9 -> a*(x + 20)

statement jump/descends
map jump/faster
domain a > 0 and 2*a < 1
rank 0
stage 0 = 0
stage x >= -9 and x <= 9

statement jump/near
map jump/faster
domain a > 0 and 2*a < 1
on x >= -9 and x <= 9
point 0
weights 1
rate a
radius 1
size 9

statement jump/settles
descent jump/descends
never 2
never 4
contraction jump/near
word 1
contraction jump/near
word 3

statement jump/returns
map jump/map
settling jump/settles
word 1 2
word 2
word 3 4
word 4
"""


def test_orbits_come_to_those_of_the_points_fails_without_one_piece_near_each() -> None:
    found = searched(JUMP)
    returns = found.pop("jump/returns")
    assert returns == {"unknown": "no proof of the premise piece-1 was found"}
    assert {outcome for outcome, _ in checked(up_to(JUMP, "jump/settles"), found).values()} == {
        "certified"
    }
    a = Fraction(1, 4)

    def f(x: Fraction) -> Fraction:
        if -9 <= x <= 9:
            return x + 20 if x >= 0 else x - 20
        return a * (x - 20) if x > 9 else a * (x + 20)

    assert orbit(f, Fraction(0), 3) == [0, 20, 0]
    left = orbit(f, Fraction(-1), 40)
    assert all(abs(x) < 2 for x in left[::2])  # the returns
    assert all(min(abs(x - 20), abs(x)) > 18 for x in left[1::2])


@pytest.mark.parametrize(("old", "new", "expected"), MALFORMED)
def test_rejects_words_that_are_not_of_the_map_and_names_of_other_kinds(
    old: str, new: str, expected: Expected
) -> None:
    outcome, reason = checked(edited(LOOP, "returns", old, new), searched(LOOP))["loop/returns"]
    assert outcome == "rejected"
    assert refused(reason, expected), reason


@pytest.mark.parametrize(("old", "new"), OTHERS)
def test_rejects_a_map_of_other_states(old: str, new: str) -> None:
    """On x >= -10 there may be orbits of which the faster map says nothing."""
    text = edited(LOOP, "map", old, new)
    found = {**searched(LOOP), **searched(up_to(text, "loop/map"))}
    outcome, reason = checked(text, found)["loop/returns"]
    assert outcome == "rejected"
    assert refused(reason, (Kind.OTHER_MAP, "loop/returns")), reason


def test_rejects_a_map_with_another_name_of_the_state_and_other_integers() -> None:
    block, *others = LOOP.strip().split("\n\n")
    over = "over a b"
    two = "\n\n".join([block, *others]).replace("over a", over)
    texts = [
        two.replace(over, f"{over}\ninteger b", 1),
        "\n\n".join([block.replace("x", "y"), *others]),
    ]
    for text in texts:
        found = searched(up_to(text, "loop/settles"))
        outcome, reason = checked(text, {**found, "loop/returns": {"certified": {}}})[
            "loop/returns"
        ]
        assert outcome == "rejected"
        assert refused(reason, (Kind.OTHER_MAP, "loop/returns")), reason


@pytest.mark.parametrize("kind", ["map", "settles"])
def test_rejects_what_is_named_and_not_certified(kind: str) -> None:
    found = {name: one for name, one in searched(LOOP).items() if name != f"loop/{kind}"}
    _, reason = checked(LOOP, found)["loop/returns"]
    assert refused(reason, (Kind.EARLIER, f"{kind} loop/{kind}"))


def test_rejects_a_relation() -> None:
    """A word of its pieces is followed by some executions, and not by all."""
    relation = PUSH.strip().split("\n\n")[0]
    text = f"{relation}\n\n{edited(LOOP, 'returns', 'map loop/map', 'map push/relation')}"
    outcome, reason = checked(text, {**searched(PUSH), **searched(LOOP)})["loop/returns"]
    assert outcome == "rejected"
    assert refused(reason, (Kind.EARLIER, "map push/relation"))


@pytest.mark.parametrize(("root", "name"), [("", "x_0"), ("root x_1 = sqrt(a)", "x_1")])
def test_rejects_a_parameter_or_root_with_the_name_of_a_state_on_the_way(
    root: str, name: str
) -> None:
    text = edited(LOOP, "descends", "rank 0", f"{root}\nrank 0") if root else LOOP
    text = text if root else text.replace("over a", "over a x_0")
    statements = read(text)
    premises = checker.premises_of(statements["loop/returns"], statements)
    with pytest.raises(checker.Rejected) as info:
        checker.Unfolding(premises["word-1"], checker.Context())
    assert refused(info.value, (Kind.NAME, name)), info.value


def test_rejects_words_that_take_too_much_work() -> None:
    text = edited(LOOP, "returns", "word 3 5", f"word{' 3 5' * 20_000}")
    _, reason = checked(text, searched(LOOP))["loop/returns"]
    assert refused(reason, Kind.WORK)
