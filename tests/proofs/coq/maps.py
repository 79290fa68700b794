"""Claims on the orbits of maps, as a user's own file has them: in one coordinate, with every rule;
and in two, with square roots of the parameter and of the state.
"""

from __future__ import annotations

from juggleproof import MapRule, claim

UNIT = "0 <= x and x <= 1"
BELOW_1 = "0 < a and a < 1"
SQUARE = "0 <= x and x <= 10 and 0 <= y and y <= 10"
RANGE = "1 <= a and a <= 4"


@claim("scaled")
def zero_attracts_just_below_1() -> list[MapRule]:
    """x -> a x on [0, 1], 0 < a <= 1: 0 is stable and attracts every state just for a < 1."""
    over = (("over", "a"), ("domain", "0 < a and a <= 1"))
    of = (("map", "scaled/map"), ("domain", BELOW_1))
    point = (("on", UNIT), ("point", "0"))
    return [
        MapRule("map", (*over, ("state", "x"), ("space", UNIT), ("piece", "0 <= x -> a*x"))),
        MapRule("down", (*of, ("rank", "0"), ("stage", UNIT))),
        MapRule("near", (*of, *point, *norm("1", rate="a", radius="1", size="1"))),
        MapRule("all", (("descent", "scaled/down"), ("contraction", "scaled/near"))),
        MapRule(
            "away",
            (of[0], ("domain", "a = 1"), ("point", "0"), ("start", "1"), ("word", "1")),
        ),
        MapRule("exactly", (("attraction", "scaled/all"), ("escape", "scaled/away"))),
    ]


@claim("mixed")
def origin_attracts_the_square() -> list[MapRule]:
    """Two linear pieces on a square: the origin is stable and attracts every state."""
    state = (("state", "x y"), ("space", SQUARE))
    pieces = (("piece", "x >= y -> (x + y)/4, x/4"), ("piece", "not x >= y -> x/4, (x + y)/4"))
    of = (("map", "mixed/map"), ("domain", RANGE))
    set_ = (("root", "u = sqrt(a)"), ("on", SQUARE), ("point", "u - u, 0"))
    rank = (("root", "v = sqrt(x^2 + y^2)"), ("rank", "x + y"), ("stage", "v <= 20"))
    return [
        MapRule("map", (("over", "a"), ("domain", RANGE), *state, *pieces)),
        MapRule("near", (*of, *set_, *norm("1, 1", rate="1/2", radius="u", size="10"))),
        MapRule("down", (*of, *rank)),
        MapRule("all", (("descent", "mixed/down"), ("contraction", "mixed/near"))),
    ]


def norm(weights: str, rate: str, radius: str, size: str) -> tuple[tuple[str, str], ...]:
    """The numbers of a contraction."""
    return ("weights", weights), ("rate", rate), ("radius", radius), ("size", size)
