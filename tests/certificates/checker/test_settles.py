"""Several attractors: every orbit tends to one of them, where every long word of pieces holds one
that no orbit follows, or one that leads to an attractor.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.certificates import checker
from juggleproof.certificates.checker import Kind, Work
from juggleproof.certificates.checker.orbits import require_one_in_all
from tests.certificates.checker.harness import Expected, refused
from tests.certificates.checker.maps import PUSH, checked, edited, read, searched, up_to

# Two points that attract, a gap between them that every state leaves at once, and a boundary that
# is left sooner or later.
TWO = """
statement two/map
over a
domain a > 0 and a < 1
state x
space x >= -9 and x <= 9
piece x >= 1 -> 2 + a*(x - 2)
piece x > -1 and x < 1 -> x + 2
piece x <= -1 -> a*(x + 2) - 2

statement two/descends
map two/map
domain a > 0 and a < 1
rank 0
stage 0 = 0

statement two/up
map two/map
domain a > 0 and a < 1
on x >= 1
point 2
weights 1
rate a
radius 1/2
size 8

statement two/down
map two/map
domain a > 0 and a < 1
root c = sqrt(x^2)
on -c <= -1 and c = -x
point -2
weights 1
rate a
radius 1/2
size 8

statement two/settles
descent two/descends
never 2 2
contraction two/up
word 1
contraction two/down
word 3

statement two/outside
map two/map
domain a > 0 and a < 1
root d = sqrt(x^2)
rank 0
stage 0 = 0
stage d >= 1

statement two/from-outside
descent two/outside
never 2
contraction two/up
word 1 1
contraction two/down
word 3
"""
# (statement, what stands there, what is put in its place, the premise of two/settles that fails)
FAILING = [
    ("map", "x + 2", "x - x", "never-1"),
    ("up", "domain a > 0 and a < 1", "domain a > 0 and a < 1/2", "inside-1"),
    ("down", "domain a > 0 and a < 1", "domain a > 1/2 and a < 1", "inside-2"),
    ("up", "on x >= 1", "on x >= 3/2", "ends-1"),
    ("down", "-c <= -1", "-c <= -3/2", "ends-2"),
    ("settles", "never 2 2", "never 2 1\nnever 2 2", "never-1"),
    ("settles", "word 3", "word 3\ncontraction two/down\nword 2", "ends-3"),
]
# (what stands in two/settles, what is put in its place, why it is refused)
MALFORMED: list[tuple[str, str, Expected]] = [
    ("never 2 2\n", "", (Kind.WORDS, "two/settles")),
    ("never 2 2", "never 2 3", (Kind.WORDS, "two/settles")),
    ("word 1\n", "word 1 3\n", (Kind.WORDS, "two/settles")),
    ("word 3", "word 3 1", (Kind.WORDS, "two/settles")),
    ("word 3", "word", (Kind.WORDS, "two/settles")),
    ("word 3", "word\ncontraction two/down\nword 3", (Kind.WORD, "two/descends")),
    ("never 2 2", "never 2 2\nnever", (Kind.WORD, "two/descends")),
    ("never 2 2", "never 2 2\nnever 4", (Kind.INDEX, "3")),
    ("never 2 2", "never 2 2\nnever 0", (Kind.INDEX, "-1")),
    ("word 3", "word 3 4\ncontraction two/down\nword 3", (Kind.INDEX, "3")),
    ("contraction two/down", "contraction two/descends", (Kind.EARLIER, "contracts two/descends")),
    ("contraction two/down", "contraction two/later", (Kind.EARLIER, "contracts two/later")),
    ("descent two/descends", "descent two/up", (Kind.EARLIER, "descends two/up")),
]


def two(old: str, new: str) -> str:
    """The statements up to two/settles, with one change in that."""
    return edited(up_to(TWO, "two/settles"), "settles", old, new)


def test_every_orbit_tends_to_one_of_two_points_holds() -> None:
    results = checked(TWO, searched(TWO))
    assert {outcome for outcome, _ in results.values()} == {"certified"}, results


def test_one_attractor_is_enough_holds() -> None:
    text = up_to(TWO, "two/up").replace("x >= -9", "x > -1") + (
        "\nstatement two/settles\ndescent two/descends\nnever 2 2\ncontraction two/up\nword 1\n"
    )
    text = text.replace("piece x <= -1 -> a*(x + 2) - 2\n", "")
    assert checked(text, searched(text))["two/settles"] == ("certified", None)


@pytest.mark.parametrize(("kind", "old", "new", "premise"), FAILING)
def test_two_points_attract_every_state_fails_without_its_premise(
    kind: str, old: str, new: str, premise: str
) -> None:
    text, name = edited(up_to(TWO, "two/settles"), kind, old, new), "two/settles"
    found = searched(text)
    assert found[name] == {"unknown": f"no proof of the premise {premise} was found"}
    outcome, reason = checked(text, {**found, name: searched(TWO)[name]})[name]
    assert outcome == "rejected" and reason is not None
    assert reason.place == f"premise {premise} of {name}" or reason.kind is Kind.PREMISES


@pytest.mark.parametrize(("old", "new", "expected"), MALFORMED)
def test_rejects_words_that_leave_others_and_names_of_other_kinds(
    old: str, new: str, expected: Expected
) -> None:
    outcome, reason = checked(two(old, new), searched(TWO))["two/settles"]
    assert outcome == "rejected"
    assert refused(reason, expected), reason


@pytest.mark.parametrize("kind", ["up", "down", "descends"])
def test_rejects_what_is_named_and_not_certified(kind: str) -> None:
    found = {name: one for name, one in searched(TWO).items() if name != f"two/{kind}"}
    _, reason = checked(TWO, found)["two/settles"]
    word = "descends" if kind == "descends" else "contracts"
    assert refused(reason, (Kind.EARLIER, f"{word} two/{kind}"))


@pytest.mark.parametrize("kind", ["up", "down", "descends"])
def test_rejects_a_contraction_of_another_map_of_the_same_text(kind: str) -> None:
    copy = TWO.strip().split("\n\n")[0].replace("two/map", "two/copy")
    whole = up_to(TWO, "two/settles")
    text = copy + "\n\n" + edited(whole, kind, "map two/map", "map two/copy")
    found = {**searched(TWO), **searched(up_to(text, f"two/{kind}"))}
    outcome, reason = checked(text, found)["two/settles"]
    assert outcome == "rejected"
    assert refused(reason, (Kind.OTHER_MAP, "two/settles"))


def test_rejects_a_relation() -> None:
    """What no state follows by the images of one choice of inputs, it may follow by others."""
    names = ["relation", "descends", "contracts"]
    blocks = [one for one in PUSH.strip().split("\n\n") if one.split()[1].split("/")[1] in names]
    text = "\n\n".join(blocks) + (
        "\n\nstatement push/to-one\ndescent push/descends\ncontraction push/contracts\nword 1\n"
        "contraction push/contracts\nword 2\ncontraction push/contracts\nword 3\n"
    )
    found = {**searched(PUSH), "push/to-one": {"certified": {}}}
    outcome, reason = checked(text, found)["push/to-one"]
    assert outcome == "rejected"
    assert refused(reason, (Kind.EARLIER, "map push/relation"))


@pytest.mark.parametrize(
    ("root", "expected"),
    [
        ("x_0 = sqrt(a)", (Kind.VARIABLE_TWICE, "x_0")),
        ("x_1 = sqrt(a)", (Kind.NAME, "x_1")),
    ],
)
def test_rejects_a_root_with_the_name_of_a_state_on_the_way(root: str, expected: Expected) -> None:
    text = edited(TWO, "outside", "root d", f"root {root}\nroot d")
    statements = read(edited(text, "from-outside", "never 2", "never 2 2\nnever 2"))
    premises = checker.premises_of(statements["two/from-outside"], statements)
    with pytest.raises(checker.Rejected) as info:
        checker.Unfolding(premises["never-1"], checker.Context())
    assert refused(info.value, expected)


def test_rejects_one_name_for_the_roots_of_two_terms() -> None:
    text = edited(TWO, "down", "root c = sqrt(x^2)\non -c <= -1 and c = -x", "DOWN")
    text = text.replace("DOWN", "root d = sqrt(x^2 + a)\non x <= -1 and d >= 0")
    name = "two/from-outside"
    outcome, reason = checked(text, {**searched(TWO), **searched(up_to(text, "two/down"))})[name]
    assert outcome == "rejected"
    assert refused(reason, (Kind.VARIABLE_TWICE, "d_0", f"premise ends-2 of {name}"))


def avoided(words: list[tuple[int, ...]], letters: int, length: int) -> bool:
    """Whether a word of this length holds none of the words, by trying each."""
    return any(
        not any(word == long[n : n + len(word)] for word in words for n in range(length))
        for long in product(range(1, letters + 1), repeat=length)
    )


def holds_one(words: list[tuple[int, ...]], letters: int) -> bool:
    try:
        require_one_in_all(words, letters, "two/settles", Work())
    except checker.Rejected as reason:
        assert refused(reason, (Kind.WORDS, "two/settles"))
        return False
    return True


@given(st.sets(st.lists(st.integers(1, 2), min_size=1, max_size=4).map(tuple), min_size=1))
def test_words_are_in_every_long_word_holds(words: set[tuple[int, ...]]) -> None:
    """A word as long as all these together with none of them would come back to an end."""
    long = min(12, sum(map(len, words)) + 1)
    if long < 12:
        assert holds_one([*words], 2) is not avoided([*words], 2, long)


@pytest.mark.parametrize(
    ("texts", "letters", "expected"),
    [
        ("1", 1, True),
        ("1 1 1", 1, True),
        ("1 2", 2, False),
        ("1 2, 2 1, 1 1 1, 2 2 2 2", 2, True),
        ("1 2, 2 1, 1 1 1", 2, False),
        ("1 2, 1 1, 2 2", 2, True),
        ("1 2 1, 1 1, 2 2", 2, True),
        ("1, 2", 3, False),
        ("1, 2, 3", 3, True),
        ("1, 2, 3, 3 3 3", 3, True),
        # 1 1 2 is found where an end 1 1 of a word 1 1 1 is kept
        ("1 1 1, 1 1 2, 2 1, 2 2", 2, True),
        ("2 1 1, 1 1 2, 2 2, 1 1 1, 1 2 1", 2, True),
        ("2 1 1, 1 1 2, 2 2, 1 1 1", 2, False),
        # the 6 words that settle flights of one and two periods, with the two ends
        ("1 2 1, 2 1 2, 1 1 1 2, 1 2 2 2 1, 2 2 2 2 1, 2 1 1 2 2 1 1 2, 1 1 1, 2 2 2 2", 2, True),
        ("1 2 1, 2 1 2, 1 1 1 2, 1 2 2 2 1, 2 2 2 2 1, 1 1 1, 2 2 2 2", 2, False),
    ],
)
def test_words_are_in_every_long_word(texts: str, letters: int, expected: bool) -> None:
    words = [tuple(map(int, text.split())) for text in texts.split(",")]
    assert holds_one(words, letters) is expected


@pytest.mark.parametrize(
    ("words", "letters"),
    [
        ([[1], [1] * 1200], 1),  # the ends of a word, and then the words that are read
        ([[1] * 200 + [2] * 200, [1] * 200, [2] * 201], 2),
    ],
)
def test_rejects_words_that_take_too_much_work(words: list[list[int]], letters: int) -> None:
    with pytest.raises(checker.Rejected) as info:
        require_one_in_all(words, letters, "two/settles", Work(10**6))
    assert refused(info.value, Kind.WORK)


@given(
    a=st.fractions(Fraction(1, 100), Fraction(9, 10), max_denominator=100),
    x=st.fractions(-9, 9, max_denominator=50),
)
def test_orbits_tend_to_one_of_the_points_holds(a: Fraction, x: Fraction) -> None:
    aim = 2 if x > -1 else -2
    for _ in range(1 + (-1 < x < 1)):
        x = 2 + a * (x - 2) if x >= 1 else x + 2 if x > -1 else a * (x + 2) - 2
    first = abs(x - aim)
    for _ in range(5):
        x = 2 + a * (x - 2) if x >= 1 else x + 2 if x > -1 else a * (x + 2) - 2
    assert abs(x - aim) <= a**5 * first
