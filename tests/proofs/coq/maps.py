"""Claims on the orbits of maps, as a user's own file has them: with every rule, in one coordinate
and in two, with square roots of the parameter and of the state.
"""

from __future__ import annotations

from juggleproof import MapRule, claim

UNIT = "0 <= x and x <= 1"
BELOW_1 = "0 < a and a < 1"
BELOW_HALF = "0 < a and 2*a < 1"
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


@claim("shifted")
def a_fixed_point_that_moves_attracts() -> list[MapRule]:
    """x -> a x + 1 on x >= 0, 0 < a < 1: 1/(1 - a) is stable and attracts every state."""
    over = (("over", "a"), ("domain", "a > 0 and a != 1"), ("state", "x"), ("space", "x >= 0"))
    map_, have = ("map", "shifted/map"), ("have", "(1 - a)*x_point = 1")
    of = (map_, ("domain", "0 < a and a < 1 and 1 - a > 0"))
    value = (("value", "x_gap >= 0 -> x_gap"), ("value", "-x_gap"))
    falls = (("loss", "(1 - a)*value"), ("least", "(1 - a)*distance"), ("upper", "1"))
    return [
        MapRule("map", (*over, ("piece", "x < 1 -> a*x + 1"), ("piece", "x >= 1 -> 1 + x*a"))),
        MapRule(
            "near",
            (*of, ("on", "x >= 0"), ("point", "1/(1 - a)"), have, *value, *falls, ("radius", "1")),
        ),
        MapRule("down", (*of, ("rank", "0"), ("stage", "x >= 0"))),
        MapRule("all", (("descent", "shifted/down"), ("lyapunov", "shifted/near"))),
    ]


@claim("grown")
def zero_is_stable_just_below_1() -> list[MapRule]:
    """x -> a x for all x, a > 0, a != 1: 0 is stable and attracts every state just for a < 1."""
    line = "x^2 >= 0"
    over = (("over", "a"), ("domain", "a > 0 and a != 1"), ("state", "x"), ("space", line))
    map_, point = ("map", "grown/map"), ("point", "0")
    of = (map_, ("domain", BELOW_1))
    falls = (("loss", "(1 - a^2)*value"), ("least", "(1 - a^2)*distance^2"))
    direction = (("direction", "x_point + distance"), ("have", "x_point = 0"))
    grows = (("value", "x_gap >= 0 -> x_gap"), ("value", "-x"), ("rate", "a"))
    ends = (("upper", "1"), ("radius", "1"))
    return [
        MapRule("map", (*over, ("piece", line + " -> a*x"))),
        MapRule("near", (*of, ("on", line), point, ("value", "x_gap^2"), *falls, *ends)),
        MapRule("down", (*of, ("rank", "0"), ("stage", line))),
        MapRule("all", (("descent", "grown/down"), ("lyapunov", "grown/near"))),
        MapRule("away", (map_, ("domain", "a > 1"), point, *direction, *grows, *ends[::-1])),
        MapRule("exactly", (("attraction", "grown/all"), ("unstable", "grown/away"))),
    ]


@claim("turned")
def zero_attracts_just_between_minus_1_and_1() -> list[MapRule]:
    """x -> a x for all x and a: 0 is stable and attracts every state just for -1 < a < 1."""
    line = "x^2 >= 0"
    over = (("over", "a"), ("domain", "0 = 0"), ("state", "x"), ("space", line))
    map_, point, start = ("map", "turned/map"), ("point", "0"), ("start", "1")
    of = (map_, ("domain", "-1 < a and a < 1"))
    falls = (("loss", "(1 - a^2)*value"), ("least", "(1 - a^2)*distance^2"))
    ends = (("radius", "1"), ("upper", "1"))
    grows = (("direction", "distance"), ("value", "x^2"), ("rate", "a^2"), *ends)
    return [
        MapRule("map", (*over, ("piece", line + " -> a*x"))),
        MapRule("near", (*of, ("on", line), point, ("value", "x^2"), *falls, *ends[::-1])),
        MapRule("down", (*of, ("rank", "0"), ("stage", line))),
        MapRule("all", (("descent", "turned/down"), ("lyapunov", "turned/near"))),
        MapRule("grows", (map_, ("domain", "a > 1"), point, *grows)),
        MapRule("swings", (map_, ("domain", "a < -1"), point, *grows)),
        MapRule("stays", (map_, ("domain", "a = 1"), point, start, ("word", "1"))),
        MapRule("flips", (map_, ("domain", "a = -1"), point, start, ("word", "1 1"))),
        MapRule(
            "exactly",
            (
                ("attraction", "turned/all"),
                ("unstable", "turned/grows"),
                ("escape", "turned/stays"),
                ("escape", "turned/flips"),
                ("unstable", "turned/swings"),
            ),
        ),
    ]


@claim("falling")
def zero_attracts_from_above() -> list[MapRule]:
    """x -> a x for x <= 1, x - 1 above: what attracts [0, 1] attracts all x >= 0."""
    over = (("over", "a"), ("domain", BELOW_1), ("state", "x"))
    pieces = (("piece", "x <= 1 -> a*x"), ("piece", "x > 1 -> x - 1"))
    of = (("map", "falling/small"), ("domain", BELOW_1))
    set_ = (("on", UNIT), ("point", "0"))
    rank = (("domain", BELOW_1), ("rank", "x"), ("stage", "x <= 1"))
    return [
        MapRule("small", (*over, ("space", UNIT), *pieces)),
        MapRule("near", (*of, *set_, *norm("1", rate="a", radius="1", size="1"))),
        MapRule("down", (*of, ("rank", "0"), ("stage", UNIT))),
        MapRule("inner", (("descent", "falling/down"), ("contraction", "falling/near"))),
        MapRule("large", (*over, ("space", "x >= 0"), *pieces)),
        MapRule("falls", (("map", "falling/large"), *rank)),
        MapRule(
            "all",
            (("descent", "falling/falls"), ("attraction", "falling/inner"), ("radius", "1/2")),
        ),
    ]


@claim("cycle")
def a_point_that_two_states_never_reach() -> list[MapRule]:
    """x -> a x (1 - x) on [0, 1], 3 < a < 7/2: 1 - 1/a does not attract a state of period 2."""
    over = (("over", "a"), ("domain", "3 < a and a < 7/2"), ("state", "x"), ("space", UNIT))
    root = ("root", "u = sqrt(a^2 - 2*a - 3)")
    orbit = (("point", "1 - 1/a"), ("start", "(a + 1 - u)/(2*a)"), ("word", "1 1"))
    domain = ("domain", "3 < a and a < 7/2 and a > 0")
    return [
        MapRule("map", (*over, ("piece", "x >= 0 -> a*x*(1 - x)"))),
        MapRule("away", (("map", "cycle/map"), domain, root, *orbit)),
    ]


@claim("pushed")
def zero_attracts_whatever_the_input() -> list[MapRule]:
    """x -> u x, |u| <= a < 1, for x < 1, x - 1 above: all executions from x > -1 tend to 0."""
    over = (("over", "a"), ("domain", BELOW_1), ("state", "x"), ("input", "u"))
    pieces = (("piece", "-a <= u and u <= a and x < 1 -> u*x"), ("piece", "x >= 1 -> x - 1"))
    of, open_ = (("relation", "pushed/small"), ("domain", BELOW_1)), "-1 < x and x < 1"
    set_, numbers = (("on", open_), ("point", "0")), norm("1", rate="a", radius="1/2", size="1")
    rank = (("domain", BELOW_1), ("rank", "x + 1"), ("stage", open_))
    return [
        MapRule("small", (*over, ("space", open_), *pieces)),
        MapRule("near", (*of, *set_, *numbers)),
        MapRule("down", (*of, ("rank", "0"), ("stage", open_))),
        MapRule("inner", (("descent", "pushed/down"), ("contraction", "pushed/near"))),
        MapRule("large", (*over, ("space", "-1 < x"), *pieces)),
        MapRule("falls", (("relation", "pushed/large"), *rank)),
        MapRule(
            "all",
            (("descent", "pushed/falls"), ("attraction", "pushed/inner"), ("radius", "1/2")),
        ),
    ]


@claim("switched")
def origin_attracts_however_it_is_switched() -> list[MapRule]:
    """Two linear maps of the quadrant, either at each step: all executions tend to the origin."""
    quadrant = "0 <= x and 0 <= y"
    over = (("over", "a"), ("domain", BELOW_1), ("state", "x y"), ("input", ""))
    pieces = (("piece", "x >= 0 -> a*y, a*x"), ("piece", "y >= 0 -> a*x, a*y/2"))
    of = (("relation", "switched/step"), ("domain", BELOW_1))
    value = (("value", "x_gap"), ("value", "y_gap >= 0 -> y_gap"))
    falls = (("loss", "(1 - a)*value"), ("least", "(1 - a)*distance"), ("upper", "1"))
    return [
        MapRule("step", (*over, ("space", quadrant), *pieces)),
        MapRule(
            "near", (*of, ("on", quadrant), ("point", "0, 0"), *value, *falls, ("radius", "1"))
        ),
        MapRule("down", (*of, ("rank", "0"), ("stage", quadrant))),
        MapRule("all", (("descent", "switched/down"), ("lyapunov", "switched/near"))),
    ]


@claim("counted")
def origin_attracts_just_from_2() -> list[MapRule]:
    """The second number runs down, then the first is divided by an integer n, and the second put
    back: all tends to the origin just for n > 1.
    """
    over = (("over", "n"), ("integer", "n"), ("domain", "n > 0"), ("state", "x y"))
    pieces = (
        ("piece", "y >= 1 -> x, y - 1"),
        ("piece", "y < 1 and x >= 1 -> x/n, x^2 - x"),
        ("piece", "y < 1 and x < 1 -> x/n, y/2"),
    )
    map_, point = ("map", "counted/map"), ("point", "0, 0")
    of, below_1 = (map_, ("domain", "n > 0 and n > 1")), "x < 1 and y < 1"
    numbers = norm("1, 1", rate="1/2", radius="1/2", size="1")
    start = (("start", "1, 0"), ("word", "2"))
    return [
        MapRule("map", (*over, ("space", "x >= 0 and y >= 0"), *pieces)),
        MapRule("down", (*of, ("rank", "2*x, y"), ("stage", below_1))),
        MapRule("near", (*of, ("on", below_1), point, *numbers)),
        MapRule("all", (("descent", "counted/down"), ("contraction", "counted/near"))),
        MapRule("stays", (map_, ("domain", "n > 0 and n = 1"), point, *start)),
        MapRule("exactly", (("attraction", "counted/all"), ("escape", "counted/stays"))),
    ]


def steps(bound: str) -> tuple[tuple[str, str], ...]:
    """A step towards 0 from outside of a bound, and a x within, for a state x."""
    inside = f"-{bound} <= x and x <= {bound}"
    outside = (("piece", f"x > {bound} -> x - 1"), ("piece", f"x < -{bound} -> x + 1"))
    return (*outside, ("piece", f"{inside} -> a*x"))


@claim("walked")
def zero_attracts_from_both_sides() -> list[MapRule]:
    """Steps towards 0, and a x within 1: as it is for any execution within, so for all orbits."""
    over = (("over", "a"), ("domain", BELOW_1), ("state", "x"))
    of, inside = (("relation", "walked/small"), ("domain", BELOW_1)), "-1 <= x and x <= 1"
    set_, numbers = (("on", inside), ("point", "0")), norm("1", rate="a", radius="1", size="1")
    rank = (("rank", "x"), ("rank", "x <= 1 -> -x"), ("stage", inside))
    return [
        MapRule("small", (*over, ("input", "u"), ("space", inside), *steps("1"))),
        MapRule("near", (*of, *set_, *numbers)),
        MapRule("down", (*of, ("rank", "0"), ("stage", inside))),
        MapRule("inner", (("descent", "walked/down"), ("contraction", "walked/near"))),
        MapRule("large", (*over, ("space", "0 = 0"), *steps("1"))),
        MapRule("falls", (("map", "walked/large"), ("domain", BELOW_1), *rank)),
        MapRule(
            "all",
            (("descent", "walked/falls"), ("attraction", "walked/inner"), ("radius", "1/2")),
        ),
    ]


@claim("drawn")
def zero_attracts_executions_from_both_sides() -> list[MapRule]:
    """The same within 2, as a relation of which the map is a part."""
    over = (("over", "a"), ("domain", BELOW_1), ("state", "x"))
    of, inside = (("map", "drawn/small"), ("domain", BELOW_1)), "-2 <= x and x <= 2"
    set_, numbers = (("on", inside), ("point", "0")), norm("1", rate="a", radius="1", size="2")
    rank = (("rank", "x > 2 -> 1, x"), ("rank", "x < -2 -> 1, -x"), ("rank", f"{inside} -> 0, 0"))
    return [
        MapRule("small", (*over, ("space", inside), *steps("2"))),
        MapRule("near", (*of, *set_, *numbers)),
        MapRule("down", (*of, ("rank", "0"), ("stage", inside))),
        MapRule("inner", (("descent", "drawn/down"), ("contraction", "drawn/near"))),
        MapRule("large", (*over, ("input", "u v"), ("space", "0 = 0"), *steps("2"))),
        MapRule(
            "falls",
            (("relation", "drawn/large"), ("domain", BELOW_1), *rank, ("stage", inside)),
        ),
        MapRule(
            "all", (("descent", "drawn/falls"), ("attraction", "drawn/inner"), ("radius", "1/2"))
        ),
    ]


@claim("parted")
def two_points_attract() -> list[MapRule]:
    """What is within 1 of 0 moves up; the rest contracts to 2 or to -2."""
    pieces = (
        ("piece", "x >= 1 -> a*(x - 2) + 2"),
        ("piece", "x > -1 and x < 1 -> x + 2"),
        ("piece", "x <= -1 -> a*(x + 2) - 2"),
    )
    over = (("over", "a"), ("domain", BELOW_1))
    of = (("map", "parted/map"), ("domain", BELOW_1))
    numbers = norm("1", rate="a", radius="1/2", size="8")
    stages = (("stage", "0 = 0"), ("stage", "u >= 1"))
    words = (
        *(("never", "2"), ("never", "1 3")),
        *(("contraction", "parted/up"), ("word", "1 1")),
        *(("contraction", "parted/down"), ("word", "3")),
    )
    return [
        MapRule("map", (*over, ("state", "x"), ("space", "x >= -9 and x <= 9"), *pieces)),
        MapRule("outside", (*of, ("root", "u = sqrt(x^2)"), ("rank", "0"), *stages)),
        MapRule("up", (*of, ("on", "x >= 1"), ("point", "2"), *numbers)),
        MapRule("down", (*of, ("on", "x <= -1"), ("point", "-2"), *numbers)),
        MapRule("ends", (("descent", "parted/outside"), *words)),
    ]


@claim("nearer")
def what_is_far_comes_nearer_by_one() -> list[MapRule]:
    """From 1 on x moves to -x, and back to x - 1; what is less than 1 contracts to 0."""
    pieces = (
        ("piece", "x >= 1 -> -x"),
        ("piece", "x < 0 -> -x - 1"),
        ("piece", "x >= 0 and x < 1 -> a*x"),
    )
    over = (("over", "a"), ("domain", BELOW_1), ("state", "x"))
    of = (("map", "nearer/map"), ("domain", BELOW_1))
    words = (
        *(("never", "1 1"), ("never", "2 2"), ("rank", "x"), ("word", "1 2")),
        *(("rank", "-x + a*0"), ("word", "2 1"), ("contraction", "nearer/near"), ("word", "3")),
    )
    return [
        MapRule("map", (*over, ("space", "x <= -1 or x >= 0"), *pieces)),
        MapRule("all", (*of, ("rank", "0"), ("stage", "0 = 0"))),
        MapRule(
            "near",
            (*of, ("on", "x >= 0 and x < 1"), ("point", "0"), *norm("1", "a", "1/2", "1")),
        ),
        MapRule("ends", (("descent", "nearer/all"), *words)),
    ]


@claim("returned")
def an_orbit_of_two_states_attracts() -> list[MapRule]:
    """What is at most 9 moves out to 10 or more and back; both steps at once contract to 2."""
    over = (("over", "a"), ("domain", BELOW_HALF), ("state", "x"))
    space = ("space", "(x >= 1 and x <= 9) or (x >= 10 and x <= 19)")
    far = "x >= 10 and x - 9 > 0"
    back = ("piece", f"{far} -> 2 + a*(10/(x - 9) - 2)")
    of = (("map", "returned/twice"), ("domain", BELOW_HALF))
    numbers = norm("1", rate="a", radius="1", size="8")
    return [
        MapRule("map", (*over, space, ("piece", "x <= 9 and x > 0 -> 9 + 10/x"), back)),
        MapRule("twice", (*over, space, ("piece", "x <= 9 and x > 0 -> 2 + a*(x - 2)"), back)),
        MapRule("down", (*of, ("rank", "0"), ("stage", "0 = 0"), ("stage", "x <= 9"))),
        MapRule("near", (*of, ("on", "x <= 9"), ("point", "2"), *numbers)),
        MapRule(
            "ends",
            (
                *(("descent", "returned/down"), ("never", "2")),
                *(("contraction", "returned/near"), ("word", "1")),
            ),
        ),
        MapRule(
            "orbits",
            (
                *(("map", "returned/map"), ("settling", "returned/ends")),
                *(("word", "1 2"), ("word", "2")),
            ),
        ),
    ]


# Words of Coq, and names that the files use, which are names of parameters in a claim.
WORDS = (
    "Axiom CoFixpoint Definition Fixpoint Hypothesis IF Parameter Prop SProp Set Theorem Variable"
    " at by cofix end exists exists2 fix forall fun let match mod then until using where"
    " R S O I Z e f k n s exp sin Rmax PI conj nat State Map space guard_1 of_s of_1 of_dom"
)


@claim("named")
def any_name_is_one_in_coq() -> list[MapRule]:
    """x -> x/2, of a state and parameters whose names mean something else in Coq."""
    of = (("map", "named/map"), ("domain", "R > 0"))
    state = (("state", "Type"), ("space", "0 <= Type and Type <= 1"), ("piece", "R > 0 -> Type/2"))
    rank = (("rank", "Type"), ("rank", f"{WORDS.replace(' ', ' + ')} > 0 -> Type"))
    set_ = (("on", "Type <= 1"), ("point", "0"))
    return [
        MapRule("map", (("over", WORDS), of[1], *state)),
        MapRule("down", (*of, *rank, ("stage", "Type <= 1"))),
        MapRule("near", (*of, *set_, *norm("1", rate="1/2", radius="1", size="1"))),
        MapRule("all", (("descent", "named/down"), ("contraction", "named/near"))),
    ]


def norm(weights: str, rate: str, radius: str, size: str) -> tuple[tuple[str, str], ...]:
    """The numbers of a contraction."""
    return ("weights", weights), ("rate", rate), ("radius", radius), ("size", size)
