"""Words of flights that follow no impact, for the claims that all orbits tend to some e_K: a search
at a few exact restitutions, which proves nothing of the others.

    python -m juggleproof.benchmarks.words

The impacts with the same next flights form a convex polygon.  A word is taken for impossible if its
polygon is empty, or has no area, at all the restitutions tried.  Of these words, long ones are
dropped first, as long as every sequence of flights without a word that is kept, and without a run
of equal flights, at last repeats the same flights for ever.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from fractions import Fraction
from itertools import islice

from flint import fmpq

from juggleproof import symbolic
from juggleproof.algebra.numbers import exact
from juggleproof.benchmarks.processes import cpu_seconds
from juggleproof.certificates import checker
from juggleproof.proofs.restitution.settling import RANGES, Restitutions

Point = tuple[fmpq, fmpq]  # an impact (x, w)
Word = tuple[int, ...]  # periods of flights that follow one another
Side = tuple[fmpq, fmpq, fmpq]  # a, b, c: the points with a x + b w + c >= 0
TRIED = 4  # restitutions in a range, beside those next to its ends
NEXT_TO = Fraction(1, 10**6)
FASTEST = 100  # closing speeds that are looked at
LONGEST = 40  # flights in a word


def flown(periods: int, alpha: fmpq, impact: Point) -> Point:
    """The next impact."""
    x, w = impact
    return alpha * (periods * w - x) - periods * (periods - 1), 2 * periods - alpha * w


def sides(periods: int, alpha: fmpq) -> Iterator[Side]:
    """The sides of the set where the next flight lasts this many periods: after it 0 <= x <= w."""
    yield -alpha, alpha * periods, fmpq(-periods * (periods - 1))
    yield alpha, -alpha * (periods + 1), fmpq(periods * (periods + 1))


def cut(polygon: Sequence[Point], side: Side) -> list[Point]:
    """The part of a convex polygon on a side; no points if it has no area.

    >>> square = [(fmpq(a), fmpq(b)) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    >>> cut(square, (fmpq(-1), fmpq(0), fmpq(1, 2)))
    [(0, 0), (1/2, 0), (1/2, 1), (0, 1)]
    >>> cut(square, (fmpq(-1), fmpq(0), fmpq(0)))
    []
    """
    a, b, c = side
    values = [a * x + b * w + c for x, w in polygon]
    found: list[Point] = []
    for k, (here, value) in enumerate(zip(polygon, values)):
        (x, w), last = polygon[k - 1], values[k - 1]
        if value * last < 0:
            part = last / (last - value)
            found.append((x + part * (here[0] - x), w + part * (here[1] - w)))
        if value >= 0:
            found.append(here)
    return found if len(found) > 2 else []


def followed(alpha: fmpq, most: int) -> Iterator[set[Word]]:
    """Yields the words of 1, 2 and more flights, of at most `most` periods each, after impacts."""
    triangle = [(fmpq(0), fmpq(0)), (fmpq(0), fmpq(FASTEST)), (fmpq(FASTEST), fmpq(FASTEST))]
    level: dict[Word, list[Point]] = {(): triangle}
    while True:
        after: dict[Word, list[Point]] = {}
        for word, polygon in level.items():
            for periods in range(1, most + 1):
                part = polygon
                for side in sides(periods, alpha):
                    part = cut(part, side)
                if part:
                    after[(*word, periods)] = [flown(periods, alpha, one) for one in part]
        level = after
        yield set(level)


def impossible(levels: Sequence[Collection[Word]], most: int) -> list[Word]:
    """The shortest impossible words: no impact has such a word of next flights, but some have the
    word without its first flight, and some the word without its last.
    """
    return [
        (*word, periods)
        for shorter, level in zip(levels, levels[1:])
        for word in sorted(shorter)
        for periods in range(1, most + 1)
        if (*word, periods) not in level and (*word, periods)[1:] in shorter
    ]


def run_of(periods: int, levels: Sequence[Collection[Word]], most: int) -> Word | None:
    """The shortest run of flights of this many periods after which no other flight comes; None if
    the words are too short to tell.
    """
    for count in range(1, len(levels) - 1):
        others = ((periods,) * count + (last,) for last in range(1, most + 1) if last != periods)
        if not any(word in levels[count + 1] for word in others):
            return (periods,) * count
    return None


def is_enough(words: Collection[Word], repeated: Collection[Word], most: int) -> bool:
    """Whether, by the checker, every endless sequence of flights of at most `most` periods each
    that holds none of these words repeats at last one of the repeated words for ever.

    >>> is_enough([(1, 1), (2,)], [], 2), is_enough([(1, 1), (2, 2)], [], 2)
    (True, False)
    >>> is_enough([(1, 1), (2, 2)], [(2, 1)], 2)
    True
    """
    try:
        checker.require_no_other([*words], [*repeated], most, "words", checker.Work())
    except checker.Rejected:
        return False
    return True


def find_words(
    alphas: Sequence[Fraction], most: int, repeated: Collection[Word]
) -> tuple[list[Word], list[Word]]:
    """For each length up to `most`, the run of equal flights after which no other comes; and
    impossible words.  Every sequence of flights that does not repeat one of the repeated words for
    ever holds one of these runs or words.

    Raises ValueError if words of `LONGEST` flights are too short for that.
    """
    levels: list[Collection[Word]] = [{()}]
    for level in islice(zip(*(followed(exact(alpha), most) for alpha in alphas)), LONGEST):
        levels.append(set().union(*level))
        ends = (run_of(periods, levels, most) for periods in range(1, most + 1))
        runs = [run for run in ends if run is not None]
        found = impossible(levels, most)
        if len(runs) == most and is_enough([*runs, *found], repeated, most):
            break
    else:
        raise ValueError(f"words of {LONGEST} flights are too short")
    for word in sorted(found, key=lambda word: -len(word)):
        others = [one for one in found if one != word]
        if is_enough([*runs, *others], repeated, most):
            found = others
    return runs, sorted(found, key=lambda word: (len(word), word))


def restitutions(least: Fraction, most: Fraction) -> list[Fraction]:
    """The restitutions at which the search looks: in a range and next to its ends, or on both sides
    of a single one.
    """
    if least == most:
        return [least - NEXT_TO, most + NEXT_TO]
    step = (most - least) / TRIED
    inside = [least + step * (k + Fraction(1, 2)) for k in range(TRIED)]
    return [least + NEXT_TO, *inside, most - NEXT_TO]


def last_of(chosen: Restitutions) -> Fraction:
    """The end of a range, or the last restitution before it, by steps of NEXT_TO, at which the
    repeated flights bring back a point below the table.
    """
    alpha = chosen.most
    if chosen.repeated:
        height = symbolic.normal_periodic_impact(chosen.repeated)[0]
        while height.subs(symbolic.alpha, alpha) >= 0:
            alpha -= NEXT_TO
    return alpha


def written(words: Sequence[Word]) -> str:
    """The words as the table of claims has them."""
    return " ".join("".join(map(str, word)) for word in words)


def search_for(chosen: Restitutions) -> tuple[str, str]:
    """The runs and the words of a row of the table."""
    alphas = restitutions(chosen.least, last_of(chosen))
    repeated = [chosen.repeated] if chosen.repeated else []
    runs, never = find_words(alphas, chosen.longest - 1, repeated)
    return written(runs), written(never)


def main() -> None:
    """Prints what is found for each row of the table."""
    for claim, chosen in RANGES.items():
        began = cpu_seconds()
        runs, never = search_for(chosen)
        same = (runs, never) == (chosen.runs, chosen.never)
        print(f"{claim}: {'as stated' if same else 'differs'}, {cpu_seconds() - began:.1f} s")
        print(f"  {runs}\n  {never}")


if __name__ == "__main__":
    main()
