"""True and false statements in the normal form and in physical units, each with what is known of it
by hand.
"""

from __future__ import annotations

from juggleproof.votes.questions import read_statement

H, B1, B2 = "given x >= 0", "given x >= 0 and x < w", "given x >= 0 and x >= w"
UNIT, THIRD = "range 0 < alpha and alpha < 1", "range 0 < alpha and 3*alpha < 1"
RATE = "have 1 - alpha > 0"
LEVEL = "2*x + (1 - w)^2/2 <= (1 + alpha)/(1 - alpha)^2"
LEVEL_1 = "2*(alpha*(w - x)) + (1 - (2 - alpha*w))^2/2 <= (1 + alpha)/(1 - alpha)^2"
LEVEL_2 = "2*(x - w) + (1 - (w + 2))^2/2 <= (1 + alpha)/(1 - alpha)^2"
GAIN = "(1 + alpha)*(w - 2*x - (1 - alpha)*w^2/2)"
ROOT = "root s = sqrt(2*(1 + alpha))"
SUP = "-(1 + alpha)*((1 + alpha)^2/2 - alpha*s)/(1 - alpha)"
PHYSICAL = ("given r > 0", "given g > 0")


def lines(*rows: str) -> str:
    return "\n".join(rows)


def _state(*rows: str) -> tuple[str, ...]:
    return ("forall alpha x w", *rows)


TRUE: dict[str, str] = {
    name: lines(f"statement true/{name}", *rows)
    for name, rows in {
        "f1-in-H": _state(UNIT, B1, "show alpha*(w - x) >= 0"),
        "f2-in-H": _state(UNIT, B2, "show x - w >= 0"),
        "partition": ("forall x w", H, "show iff(x >= 0 and not x < w, x >= w)"),
        "B1-disjoint": ("forall x w", H, "show not (x < w and x >= w)"),
        "gain-identity": _state(
            UNIT, f"show 2*(alpha*(w - x)) + (1 - (2 - alpha*w))^2/2 - 2*x - (1 - w)^2/2 = {GAIN}"
        ),
        "B1-plus-in-Emax": _state(
            UNIT,
            B1,
            RATE,
            f"given {GAIN} >= 0",
            "show 2*x + (1 - w)^2/2 <= ((1 + alpha)/(1 - alpha))^2/2",
        ),
        "outside-loses": _state(UNIT, RATE, B1, f"given not {LEVEL}", f"show {GAIN} < 0"),
        "f1-R-in-R": _state(UNIT, RATE, B1, f"given {LEVEL}", f"show {LEVEL_1}"),
        "f2-R-in-R": _state(UNIT, RATE, B2, f"given {LEVEL}", f"show {LEVEL_2}"),
        "gain-at-most-max": _state(UNIT, RATE, B1, f"show {GAIN} <= (1 + alpha)/(1 - alpha)/2"),
        "gain-below-sup": (
            "forall alpha x w",
            UNIT,
            RATE,
            B1,
            f"given not {LEVEL}",
            ROOT,
            f"show {GAIN} < {SUP}",
        ),
        "sup-negative": ("forall alpha", UNIT, RATE, ROOT, f"show {SUP} < 0"),
        "sup-is-sup": (
            "forall alpha eps",
            UNIT,
            RATE,
            "given eps > 0",
            ROOT,
            "exists x w",
            "with x >= 0 and x < w",
            f"with not {LEVEL}",
            f"show {GAIN} > {SUP} - eps",
        ),
        "p-outside-R": (
            "forall alpha",
            THIRD,
            RATE,
            "have 1 + alpha > 0",
            "show 2*(2/(1 + alpha)) + (1 - 2/(1 + alpha))^2/2 > (1 + alpha)/(1 - alpha)^2",
        ),
        "e1-in-B1": (
            "forall alpha",
            UNIT,
            "have 1 + alpha > 0",
            "let x = 2*alpha/(1 + alpha)^2",
            "let w = 2/(1 + alpha)",
            "show x >= 0 and x < w",
        ),
        "e1-in-R": (
            "forall alpha",
            UNIT,
            RATE,
            "have 1 + alpha > 0",
            "let x = 2*alpha/(1 + alpha)^2",
            "let w = 2/(1 + alpha)",
            f"show {LEVEL}",
        ),
        "e1-fixed": (
            "forall alpha x w",
            UNIT,
            "have 1 + alpha > 0",
            (
                "show iff(alpha*(w - x) = x and 2 - alpha*w = w, x = 2*alpha/(1 + alpha)^2 and w ="
                " 2/(1 + alpha))"
            ),
        ),
        "trap": _state(
            THIRD,
            B1,
            "given alpha*w < 1",
            "show 0 <= alpha*(w - x) and alpha*(w - x) < 2 - alpha*w and alpha*(2 - alpha*w) < 1",
        ),
        "rank-on-B2": (
            "forall x w u",
            "given x >= 0 and x >= w and u >= 0 and u^2 = 4*x + (w - 1)^2",
            "show 2*u + (1 - (w + 2))/2 = 2*u + (1 - w)/2 - 1 and u^2 = 4*(x - w) + (w + 2 - 1)^2",
        ),
        "U-on-B1": (
            "forall alpha x w u",
            UNIT,
            B1,
            "given u >= 0 and u^2 = 4*alpha*(w - x) + (1 - alpha*w)^2",
            "show u <= 1 + alpha*w",
        ),
        "U-bounds-w": (
            "forall x w u",
            H,
            "given u >= 0 and u^2 = 4*x + (w - 1)^2",
            "show 1 - u <= w and w <= 1 + u",
        ),
        "rank-falls": (
            "forall alpha x w u z",
            THIRD,
            B1,
            "given w >= 6",
            "given u >= 0 and u^2 = 4*x + (w - 1)^2",
            "given z >= 0 and z^2 = 4*alpha*(w - x) + (1 - alpha*w)^2",
            "show 2*z + (1 - (2 - alpha*w))/2 <= 2*u + (1 - w)/2 - 1",
        ),
        "e2-in-H": (
            "forall alpha",
            UNIT,
            "have 1 + alpha > 0",
            "show iff(2*(3*alpha - 1)/(1 + alpha)^2 >= 0, 3*alpha >= 1)",
        ),
        "collision-time": (
            "forall b v r t",
            "given r > 0",
            "given v != r",
            "show iff(b + v*t = r*t, t = b/(r - v))",
        ),
        "seven": (
            "forall b v r g",
            *PHYSICAL,
            "given b >= 0",
            "given v < r",
            "let tau = b/(r - v)",
            "let T = 2*r/g",
            "show iff(0 <= tau and tau < T, g*b/2 + r*v < r^2)",
        ),
        "physical-f1-R": (
            "forall alpha b v r g",
            UNIT,
            RATE,
            *PHYSICAL,
            "let T = 2*r/g",
            "let S = r^2*(1 + alpha)/(1 - alpha)^2",
            "given b >= 0 and g*b/2 + r*v < r^2 and g*b + v^2/2 <= S",
            "show g*(alpha*(T*(r - v) - b)) + (-alpha*v - (1 - alpha)*r)^2/2 <= S",
        ),
        "physical-e1": (
            "forall alpha r g",
            UNIT,
            "have 1 + alpha > 0",
            *PHYSICAL,
            "let b = 4*alpha*r^2/((1 + alpha)^2*g)",
            "let v = -(1 - alpha)*r/(1 + alpha)",
            "show b >= 0 and g*b/2 + r*v < r^2",
        ),
        "flight-count": (
            "forall K alpha x w",
            "integer K",
            UNIT,
            "given K >= 1",
            "given alpha*(K*w - x) - K*(K - 1) >= 0 and x >= 0 and w > 0",
            "show alpha*w >= K - 1",
        ),
        "twenty": (
            "forall K alpha",
            "integer K",
            UNIT,
            RATE,
            "given K >= 1",
            "have K + 1 > 0",
            "have K + 2 > 0",
            (
                "show iff(K <= (1 + alpha)/(1 - alpha) and (1 + alpha)/(1 - alpha) < K + 1,"
                " (K - 1)/(K + 1) <= alpha and alpha < K/(K + 2))"
            ),
        ),
        "B1-plus-not-empty": (
            "forall alpha",
            UNIT,
            "exists x w",
            "with x >= 0 and x < w",
            f"show {GAIN} > 0",
        ),
        "square": ("forall x", "given 0 <= x and x <= 1", "show x*(1 - x) < 1/3"),
        "circle": ("forall x y", "given x^2 + y^2 <= 1", "show x*y < 3/5"),
        "third-B1-plus-in-Emax": _state(
            THIRD,
            B1,
            RATE,
            f"given {GAIN} >= 0",
            "show 2*x + (1 - w)^2/2 <= ((1 + alpha)/(1 - alpha))^2/2",
        ),
        "third-outside-loses": _state(THIRD, RATE, B1, f"given not {LEVEL}", f"show {GAIN} < 0"),
        "third-f1-R-in-R": _state(THIRD, RATE, B1, f"given {LEVEL}", f"show {LEVEL_1}"),
        "third-gain-at-most-max": _state(
            THIRD, RATE, B1, f"show {GAIN} <= (1 + alpha)/(1 - alpha)/2"
        ),
        "third-gain-below-sup": (
            "forall alpha x w",
            THIRD,
            RATE,
            B1,
            f"given not {LEVEL}",
            ROOT,
            f"show {GAIN} < {SUP}",
        ),
        "third-physical-f1-R": (
            "forall alpha b v r g",
            THIRD,
            RATE,
            *PHYSICAL,
            "let T = 2*r/g",
            "let S = r^2*(1 + alpha)/(1 - alpha)^2",
            "given b >= 0 and g*b/2 + r*v < r^2 and g*b + v^2/2 <= S",
            "show g*(alpha*(T*(r - v) - b)) + (-alpha*v - (1 - alpha)*r)^2/2 <= S",
        ),
        "third-near-in-B1": _state(
            THIRD,
            RATE,
            f"given x >= 0 and {LEVEL}",
            "have 1 + alpha > 0",
            "given 20*(w - 2/(1 + alpha))^2 <= (1/3 - alpha)^2",
            "show x < w",
        ),
        "bump": ("forall x y", "given x^2 + y^2 <= 1", "show x^2 + x*y + y^2 <= 3/2"),
        "quarter": ("forall x", "given 0 <= x and x <= 1", "show x*(1 - x) <= 1/4"),
    }.items()
}

FALSE: dict[str, str] = {
    name: lines(f"statement false/{name}", *rows)
    for name, rows in {
        "open-H-invariant": _state(UNIT, "given x > 0 and x >= w", "show x - w > 0"),
        "tau-at-most-T": (
            "forall b v r g",
            *PHYSICAL,
            "given b >= 0",
            "given v < r",
            "show iff(b/(r - v) <= 2*r/g, g*b/2 + r*v < r^2)",
        ),
        "B2-by-time": ("forall x w", H, "given w != 0", "show iff(x >= w, x/w >= 1)"),
        "gain-never-zero": _state(UNIT, B1, f"show {GAIN} != 0"),
        "gain-below-max": _state(UNIT, RATE, B1, f"show {GAIN} < (1 + alpha)/(1 - alpha)/2"),
        "e1-misprint": (
            "forall alpha",
            UNIT,
            "have 1 - alpha^2 > 0",
            "have 1 + alpha > 0",
            RATE,
            "show 2*alpha/(1 + alpha)^2 = (1 - alpha)/(1 + alpha)*(alpha/(1 - alpha))",
        ),
        "p-outside-R-whole": (
            "forall alpha",
            UNIT,
            RATE,
            "have 1 + alpha > 0",
            "show 2*(2/(1 + alpha)) + (1 - 2/(1 + alpha))^2/2 > (1 + alpha)/(1 - alpha)^2",
        ),
        "trap-half": _state(
            "range 0 < alpha and alpha < 3/5",
            B1,
            "given alpha*w < 1",
            "show alpha*(2 - alpha*w) < 1",
        ),
        "kinetic-decreases": _state(
            THIRD,
            "have 1 + alpha > 0",
            B2,
            RATE,
            f"given {LEVEL}",
            "show (w + 2 - 2/(1 + alpha))^2 < (w - 2/(1 + alpha))^2",
        ),
        "sup-misprint": (
            "forall alpha",
            UNIT,
            RATE,
            ROOT,
            (
                "show (-(1 + alpha)/(1 - alpha) + 1 + alpha - s*alpha/(1 - alpha))*(1 + alpha)"
                f" = {SUP}"
            ),
        ),
        "root-irrational": ("forall x", "given x > 0", "show x^2 != 2"),
        "two-roots": (
            "forall x y",
            "given x^2 = 2 and y^2 = 3 and x > 0 and y > 0",
            "show (x + y)^2 != 5 + 2*x*y",
        ),
        "e2-always": (
            "forall alpha",
            UNIT,
            "have 1 + alpha > 0",
            "show 2*(3*alpha - 1)/(1 + alpha)^2 >= 0",
        ),
        "rank-at-impact": (
            "forall alpha x w u z",
            UNIT,
            B1,
            "given w >= 6",
            "given u >= 0 and u^2 = 4*x + (w - 1)^2",
            "given z >= 0 and z^2 = 4*alpha*(w - x) + (1 - alpha*w)^2",
            "show 2*z + (1 - (2 - alpha*w))/2 <= 2*u + (1 - w)/2 - 1",
        ),
        "some-state-gains-more": (
            "forall alpha",
            UNIT,
            RATE,
            "exists x w",
            "with x >= 0 and x < w",
            f"show {GAIN} > (1 + alpha)/(1 - alpha)/2",
        ),
        "integer-jacobian": (
            "forall K alpha",
            "integer K",
            UNIT,
            "given K >= 1",
            "show alpha*K < 3/2",
        ),
        "strict-square": ("forall x", "given 0 <= x and x <= 1", "show x*(1 - x) < 1/4"),
        "circle-half": ("forall x y", "given x^2 + y^2 <= 1", "show x*y < 2/5"),
        "physical-jump": (
            "forall b v r g",
            *PHYSICAL,
            "given b >= 0 and g*b/2 + r*v < r^2",
            "show g*b + v^2/2 <= r^2",
        ),
    }.items()
}

SHARP = """statement sharp/trap
forall alpha x w
range 0 < alpha and 3*alpha < 1
given x >= 0 and x < w and alpha*w < 1
show alpha*(w - x) < 2 - alpha*w and alpha*(2 - alpha*w) < 1

statement sharp/trap-range
sharp sharp/trap
over alpha
domain 0 < alpha and alpha < 1
holds 2*alpha <= 1

statement sharp/trap-wrong
sharp sharp/trap
over alpha
domain 0 < alpha and alpha < 1
holds 3*alpha < 1

statement sharp/trap-wide
sharp sharp/trap
over alpha
domain 0 < alpha and alpha < 1
holds 4*alpha < 3
"""

ITERATES = """statement iterates/flight
forall x w K
integer K
iterates (x, w) -> (x - w, w + 2)
after K -> (x - K*w - K*(K - 1), w + 2*K)
"""

STATEMENTS = {
    name: (read_statement(text), expected)
    for kind, expected in ((TRUE, True), (FALSE, False))
    for name, text in kind.items()
}
