"""Several attractors: every orbit tends to one of them, where every sequence of pieces holds one
word that no orbit follows, or one that leads to an attractor, or repeats one that no orbit follows
for ever.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from juggleproof.certificates import checker
from juggleproof.certificates.checker import Kind, Work
from juggleproof.certificates.checker.orbits import Word, require_no_other
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
# One point that attracts, and states farther off, which come nearer to it by 1 in two steps.
NEARER = """
statement near/map
over
domain 0 = 0
state x
space x >= -9 and x <= -1 or x >= 0 and x <= 9
piece x >= 1 -> -x
piece x < 0 -> -x - 1
piece x >= 0 and x < 1 -> x/2

statement near/descends
map near/map
domain 0 = 0
rank 0
stage 0 = 0

statement near/point
map near/map
domain 0 = 0
on x >= 0 and x < 1
point 0
weights 1
rate 1/2
radius 1/2
size 1

statement near/settles
descent near/descends
never 1 1
never 2 2
rank x
word 1 2
contraction near/point
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
# (what stands in near/settles, what is put in its place, its premise that fails)
RISING = [
    ("rank x", "rank x/2", "falls-1"),
    ("rank x", "rank x - 2", "falls-1"),
    ("word 1 2", "word 2 1", "falls-1"),
    ("rank x\nword 1 2", "rank x\nword 1 2\nrank -x\nword 1 2", "falls-2"),
    ("word 3", "word 3\ncontraction near/point\nword 2 3", "ends-2"),
]
# (the same, why it is refused)
OTHER_RANKS: list[tuple[str, str, Expected]] = [
    ("rank x\nword 1 2\n", "", (Kind.WORDS, "near/settles")),
    ("rank x\nword 1 2", "rank x\nword 1", (Kind.WORDS, "near/settles")),
    ("rank x\nword 1 2", "rank x\nword 1 2 1", (Kind.WORDS, "near/settles")),
    ("rank x\nword 1 2", "rank x\nword 1 2 1 2", (Kind.WORDS, "near/settles")),
    ("rank x\nword 1 2", "rank x\nword", (Kind.WORDS, "near/settles")),
    ("rank x", "rank x\nword\nrank x", (Kind.WORD, "near/descends")),
    ("rank x", "rank x\nword 1 4\nrank x", (Kind.INDEX, "3")),
    ("never 2 2\n", "", (Kind.WORDS, "near/settles")),
    ("never 1 1\n", "", (Kind.WORDS, "near/settles")),
    ("rank x", "rank x > 0 -> x", (Kind.VALUE, "near/settles")),
    ("rank x", "rank x, x", (Kind.VALUE, "near/settles")),
    # a state on the way, by which a rank would be another one each time
    ("rank x", "rank x_0", (Kind.VALUE, "near/settles")),
    ("rank x", "rank -x_1", (Kind.VALUE, "near/settles")),
    ("rank x", "rank x_next + 1", (Kind.VALUE, "near/settles")),
]


def two(old: str, new: str) -> str:
    """The statements up to two/settles, with one change in that."""
    return edited(up_to(TWO, "two/settles"), "settles", old, new)


def assert_fails_at(premise: str, text: str, whole: str, name: str) -> None:
    """The premise of the statement has no proof in the text, and the proof in the whole is none."""
    found = searched(text)
    assert found[name] == {"unknown": f"no proof of the premise {premise} was found"}
    outcome, reason = checked(text, {**found, name: searched(whole)[name]})[name]
    assert outcome == "rejected" and reason is not None
    assert reason.place == f"premise {premise} of {name}" or reason.kind is Kind.PREMISES


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
    assert_fails_at(premise, edited(up_to(TWO, "two/settles"), kind, old, new), TWO, "two/settles")


@pytest.mark.parametrize(("old", "new", "expected"), MALFORMED)
def test_rejects_words_that_leave_others_and_names_of_other_kinds(
    old: str, new: str, expected: Expected
) -> None:
    outcome, reason = checked(two(old, new), searched(TWO))["two/settles"]
    assert outcome == "rejected"
    assert refused(reason, expected), reason


def test_words_that_no_orbit_repeats_for_ever_are_enough_holds() -> None:
    assert checked(NEARER, searched(NEARER))["near/settles"] == ("certified", None)
    turned = edited(
        edited(NEARER, "settles", "rank x", "rank -x"), "settles", "word 1 2", "word 2 1"
    )
    assert checked(turned, searched(turned))["near/settles"] == ("certified", None)


@pytest.mark.parametrize(("old", "new", "premise"), RISING)
def test_one_point_attracts_every_state_fails_without_its_premise(
    old: str, new: str, premise: str
) -> None:
    assert_fails_at(premise, edited(NEARER, "settles", old, new), NEARER, "near/settles")


@pytest.mark.parametrize(("old", "new", "expected"), OTHER_RANKS)
def test_rejects_ranks_of_other_words_and_of_states_on_the_way(
    old: str, new: str, expected: Expected
) -> None:
    text = edited(NEARER, "settles", old, new)
    outcome, reason = checked(text, searched(NEARER))["near/settles"]
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


def avoiding(words: Collection[Word], letters: int, length: int) -> Iterator[Word]:
    """The words of this length that hold none of the words, by trying each."""
    for long in product(range(1, letters + 1), repeat=length):
        if not any(word == long[n : n + len(word)] for word in words for n in range(length)):
            yield long


def holds_one(words: Collection[Word], letters: int, repeated: Collection[Word] = ()) -> bool:
    try:
        require_no_other([*words], [*repeated], letters, "two/settles", Work())
    except checker.Rejected as reason:
        assert refused(reason, (Kind.WORDS, "two/settles"))
        return False
    return True


WORDS = st.sets(st.lists(st.integers(1, 2), min_size=1, max_size=4).map(tuple), min_size=1)


@given(WORDS)
def test_words_are_in_every_long_word_holds(words: set[Word]) -> None:
    """A word as long as all these together with none of them would come back to an end."""
    long = min(12, sum(map(len, words)) + 1)
    if long < 12:
        assert holds_one(words, 2) is not any(avoiding(words, 2, long))


@given(
    st.sets(st.lists(st.integers(1, 2), min_size=1, max_size=3).map(tuple), min_size=1, max_size=3),
    st.lists(st.integers(1, 2), min_size=1, max_size=3).map(tuple),
)
def test_words_are_in_every_long_word_but_a_repeated_one_holds(
    words: set[Word], repeated: Word
) -> None:
    """The middle of a long word, with as much before it and after it as there are ends of words."""
    ends = len({word[:n] for word in words for n in range(len(word))} | {()})
    if ends < 4:
        size = ends + len(repeated)
        again = repeated * (size + 1)
        turns = {again[n : n + size] for n in range(len(repeated))}
        middles = {long[ends:-ends] for long in avoiding(words, 2, 2 * ends + size)}
        # a word that repeats a shorter one is not the word round a circle
        alone = len(turns) == len(repeated)
        assert holds_one(words, 2, [repeated]) is (not middles or alone and middles <= turns)


@pytest.mark.parametrize(
    ("texts", "repeated", "expected"),
    [
        ("1 1, 2 2", "1 2", True),
        ("1 1, 2 2", "2 1", True),
        ("1 1, 2 2", "2 1 2 1", False),
        ("1 1, 2 2", "1 2 1", False),
        ("1 1, 2 2", "1", False),
        ("2 2", "1 2", False),
        ("2 2", "1 2, 1", False),
        # from one circle to another and back
        ("1 1 1", "2, 1 2", False),
        # from one circle to another, and never back
        ("1 2", "1, 2", True),
        ("1 2", "2", False),
        ("1 1 2, 2 1 1, 2 2 1, 1 2 2", "1, 2, 1 2", True),
    ],
)
def test_words_are_in_every_long_word_but_repeated_ones(
    texts: str, repeated: str, expected: bool
) -> None:
    words, more = (
        [tuple(map(int, one.split())) for one in text.split(",")] for text in (texts, repeated)
    )
    assert holds_one(words, 2, more) is expected


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
        ([[1] * 200 + [2] * 200, [1] * 200, [2] * 201, [3]], 3),
        # each letter leads to the next alone, so that 130 ends go one at a time
        ([[k, n] for k in range(1, 131) for n in range(1, 131) if n != k + 1], 130),
        # a circle of 290 letters, which is turned
        ([[k, n] for k in range(1, 291) for n in range(1, 291) if n != k % 290 + 1], 290),
    ],
)
def test_rejects_words_that_take_too_much_work(words: list[list[int]], letters: int) -> None:
    with pytest.raises(checker.Rejected) as info:
        require_no_other(words, [], letters, "two/settles", Work(10**6))
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


@pytest.mark.parametrize("text", ["01 2", "+1 2", "1_2", "1  2", "1 2.0", "-0 1"])
def test_rejects_numbers_of_pieces_in_another_way_of_writing(text: str) -> None:
    with pytest.raises(checker.Rejected) as info:
        read(edited(NEARER, "settles", "word 1 2", f"word {text}"))
    assert info.value.kind is Kind.LINE_SHAPE
