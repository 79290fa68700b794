"""Mutants of the second checker: one formula changed, in its text."""

from __future__ import annotations

import types
from pathlib import Path
from typing import Any, NamedTuple

from juggleproof.certificates.sine import checker, flights
from tests.certificates.sine.states import Code

TEXTS = {one.__name__: Path(str(one.__file__)).read_text() for one in (flights, checker)}


class Mutant(NamedTuple):
    """`new` in place of the one `old` in the text of a file."""

    file: types.ModuleType
    name: str
    old: str
    new: str


def compiled(file: types.ModuleType, text: str) -> dict[str, Any]:
    other = types.ModuleType(file.__name__)
    other.__package__ = file.__package__
    other.__file__ = file.__file__
    exec(compile(text, str(file.__file__), "exec"), vars(other))
    return vars(other)


def mutated(mutant: Mutant) -> Code:
    """The second checker with a mutant in it; the one that is imported stays as it is."""
    texts = dict(TEXTS)
    text = texts[mutant.file.__name__]
    if text.count(mutant.old) != 1:
        raise ValueError(f"{mutant.name}: {mutant.old!r} stands {text.count(mutant.old)} times")
    texts[mutant.file.__name__] = text.replace(mutant.old, mutant.new)
    below = compiled(flights, texts[flights.__name__])
    above = compiled(checker, texts[checker.__name__])
    above.update({name: below[name] for name in above if name in below and name in IMPORTED})
    return Code(types.SimpleNamespace(**below), types.SimpleNamespace(**above))


IMPORTED = {
    name
    for name, value in vars(flights).items()
    if not name.startswith("_") and vars(checker).get(name) is value
}

IN_FLIGHTS = (
    # tables
    ("S without the width of its column", "radius = gamma * self.turn >> BITS", "radius = 0"),
    (
        "S without alpha",
        "by_alpha = (self.k_high * self.alpha_half >> BITS) * (abs(self.sin[j]) + self.turn)",
        "by_alpha = 0",
    ),
    ("S without g", "by_g = self.g_half * (abs(self.cos[j]) + self.turn)", "by_g = 0"),
    ("S in alpha without its second order", "(abs(self.sin[j]) + self.turn)", "abs(self.sin[j])"),
    ("S in g without its second order", "(abs(self.cos[j]) + self.turn)", "abs(self.cos[j])"),
    (
        "S with half of 2 pi in alpha and g",
        "((by_alpha + by_g >> BITS) + 1) * PI2 >> BITS",
        "((by_alpha + by_g >> BITS) + 1) * PI2 >> BITS + 1",
    ),
    (
        "a slope of c for each alpha",
        "self.k_high = ONE**3 // (ONE + self.alpha_low) ** 2 + 1",
        "self.k_high = self.k_low",
    ),
    (
        "a slope of c for each alpha, from below",
        "self.k_low = ONE**3 // (ONE + self.alpha_high) ** 2",
        "self.k_low = ONE**3 // (ONE + self.alpha_low) ** 2",
    ),
    ("gravity alone bounds the fall", "self.fall = ONE + gamma", "self.fall = ONE"),
    ("the table alone bounds the fall", "self.fall = ONE + gamma", "self.fall = gamma"),
    (
        "the greatest speed of the smallest g",
        "isqrt(c_high**2 + g_up**2)",
        "isqrt(c_high**2 + g_down**2)",
    ),
    ("the greatest speed without c", "isqrt(c_high**2 + g_up**2)", "isqrt(g_up**2)"),
    (
        "c of the greatest alpha",
        "c_high = (ONE - self.alpha_low) * ONE // (2 * (ONE + self.alpha_low)) + 1",
        "c_high = (ONE - self.alpha_high) * ONE // (2 * (ONE + self.alpha_high)) + 1",
    ),
    (
        "half of c",
        "c = (ONE - self.alpha) * ONE // (2 * (ONE + self.alpha))",
        "c = (ONE - self.alpha) * ONE // (4 * (ONE + self.alpha))",
    ),
    (
        "the sine of another phase",
        "self.sin[columns // 2 :] + self.sin[: columns // 2]",
        "self.sin[columns :] + self.sin[: columns]",
    ),
    (
        "a velocity of the other sign",
        "c * cos - self.g * sin >> BITS",
        "c * cos + self.g * sin >> BITS",
    ),
    ("no room for roundings", "SLACK = 256", "SLACK = 0"),
    # absorbing strip
    (
        "a strip of half the heights",
        "4 * flights.rho * ONE * ONE // PI2",
        "2 * flights.rho * ONE * ONE // PI2",
    ),
    (
        "a strip without impacts",
        "flights.rho + (flights.alpha_high * top >> BITS) + 1",
        "flights.rho + 1",
    ),
    (
        "a strip of the least alpha",
        "flights.rho + (flights.alpha_high * top >> BITS) + 1",
        "flights.rho + (flights.alpha_low * top >> BITS) + 1",
    ),
    (
        "a strip without the table's speed",
        "flights.rho + isqrt(square) + 1 < top",
        "isqrt(square) + 1 < top",
    ),
    # F on a line
    ("F without gravity", "value -= d * d >> BITS + 1", "value -= 0"),
    ("F with twice gravity", "value -= d * d >> BITS + 1", "value -= d * d >> BITS"),
    ("F without the table's velocity", "+ (flights.velocity[j] * n >> shift)", ""),
    (
        "F without the height",
        "value = flights.height[j] - flights.height[q]",
        "value = flights.height[j]",
    ),
    ("F_x of one d", "low, high = d - flights.half, d + flights.half", "low, high = d, d"),
    (
        "F_x of one S",
        "self.lag_low, self.lag_high = ONE - flights.S_high[i], ONE - flights.S_low[i]",
        "self.lag_low = self.lag_high = ONE - (flights.S_low[i] + flights.S_high[i] >> 1)",
    ),
    (
        "F_x without alpha s from above",
        "max(lag_high - least, most - lag_low)",
        "max(lag_high, most - lag_low)",
    ),
    (
        "F_x without alpha s from below",
        "max(lag_high - least, most - lag_low)",
        "max(lag_high - least, -lag_low)",
    ),
    ("F_x from above alone", "max(lag_high - least, most - lag_low)", "lag_high - least"),
    ("F_x from below alone", "max(lag_high - least, most - lag_low)", "most - lag_low"),
    (
        "F_x with the wrong end of d, from below",
        "low if self.lag_low >= 0 else high",
        "high if self.lag_low >= 0 else low",
    ),
    (
        "F_x with the wrong end of d, from above",
        "high if self.lag_high >= 0 else low",
        "low if self.lag_high >= 0 else high",
    ),
    ("F without its width in x", "by_x * flights.half + by_alpha", "by_alpha"),
    (
        "F without its width in alpha",
        "+ by_alpha * flights.alpha_half >> BITS\n        value += rebound",
        ">> BITS\n        value += rebound",
    ),
    ("F without its width in s", "(flights.alpha_high * high >> BITS) * speed + by_g", "by_g"),
    ("F without its width in g", "* speed + by_g * flights.g_half", "* speed"),
    ("F_alpha of one x", "moves = (flights.turn * high >> BITS) + SLACK", "moves = SLACK"),
    (
        "F_alpha without its sines",
        "by_c = (sin[j] - sin[q]) * ONE // PI2 + (cos[j] * n >> shift)",
        "by_c = cos[j] * n >> shift",
    ),
    (
        "F_alpha without its cosine",
        "by_c = (sin[j] - sin[q]) * ONE // PI2 + (cos[j] * n >> shift)",
        "by_c = (sin[j] - sin[q]) * ONE // PI2",
    ),
    ("F_alpha without s d from above", "(s_high * high >> BITS) + 1 - c_low", "0 - c_low"),
    ("F_alpha without s d from below", "c_high - (s_low * low >> BITS)", "c_high"),
    (
        "F_alpha from above alone",
        "max((s_high * high >> BITS) + 1 - c_low, c_high - (s_low * low >> BITS))",
        "(s_high * high >> BITS) + 1 - c_low",
    ),
    (
        "F_alpha from below alone",
        "max((s_high * high >> BITS) + 1 - c_low, c_high - (s_low * low >> BITS))",
        "c_high - (s_low * low >> BITS)",
    ),
    (
        "F_g without its cosines",
        "by_g = abs((cos[j] - cos[q]) * ONE // PI2 - (sin[j] * n >> shift)) + moves",
        "by_g = abs(sin[j] * n >> shift) + moves",
    ),
    (
        "F_g without its sine",
        "by_g = abs((cos[j] - cos[q]) * ONE // PI2 - (sin[j] * n >> shift)) + moves",
        "by_g = abs((cos[j] - cos[q]) * ONE // PI2) + moves",
    ),
    ("F_g of one x", "- (sin[j] * n >> shift)) + moves", "- (sin[j] * n >> shift))"),
    ("F without alpha s", "value += rebound * n >> flights.shift", "value += 0"),
    (
        "alpha s at the lower end of its row",
        "rebound = flights.alpha * (low + high) >> BITS + 1",
        "rebound = flights.alpha * low >> BITS",
    ),
    # s1
    (
        "s1 without d",
        "value = (p - j) * flights.half + flights.velocity[q]",
        "value = flights.velocity[q]",
    ),
    (
        "s1 without the table's velocity",
        "+ flights.velocity[q] - flights.velocity[j]",
        "- flights.velocity[j]",
    ),
    ("s1 without its width in x", "radius = self.lag * flights.half + by_g", "radius = by_g"),
    (
        "s1 of one S",
        "self.lag = max(abs(self.lag_low), abs(self.lag_high))",
        "self.lag = abs(self.lag_low + self.lag_high) >> 1",
    ),
    (
        "s1 without its width in g",
        "self.lag * flights.half + by_g * flights.g_half",
        "self.lag * flights.half",
    ),
    (
        "s1 without its width in s",
        "radius += flights.alpha_high * (ONE // (2 * flights.per_unit))",
        "radius += 0",
    ),
    (
        "s1 without its width in alpha",
        "radius += max(c_high - s_low, s_high - c_low) * self.flights.alpha_half >> BITS",
        "radius += 0",
    ),
    ("s1 in alpha from above alone", "max(c_high - s_low, s_high - c_low)", "(c_high - s_low)"),
    ("s1 in alpha from below alone", "max(c_high - s_low, s_high - c_low)", "(s_high - c_low)"),
    ("s1 without its width in x1", "radius += lag * flights.half", "radius += 0"),
    (
        "s1 of one S at x1",
        "lag = max(abs(ONE - flights.S_low[t]), abs(ONE - flights.S_high[t]))",
        "lag = abs(2 * ONE - flights.S_low[t] - flights.S_high[t]) >> 1",
    ),
    (
        "s1 in alpha and g of one x1",
        "moves = flights.turn * (2 if p & 1 else 1) + SLACK",
        "moves = flights.turn + SLACK",
    ),
    (
        "s1 in alpha and g of one x",
        "moves = flights.turn * (2 if p & 1 else 1) + SLACK",
        "moves = SLACK",
    ),
    (
        "s1 in g of one x",
        "by_g = abs(flights.sin[j] - flights.sin[q]) + moves",
        "by_g = abs(flights.sin[j] - flights.sin[q])",
    ),
    (
        "s1 without alpha s",
        "return value - rebound - radius, value - rebound + radius",
        "return value - radius, value + radius",
    ),
    # the walk
    ("no landing where s1 may be 0", "if fastest < 0 or", "if slowest < 0 or"),
    ("landings in the slowest row alone", "min(fastest >> unit, rows - 1)", "lowest"),
    ("landings in the fastest row alone", "(m, lowest, min", "(m, fastest >> unit, min"),
    (
        "no landing in the own column",
        "if self.rise[0] <= 0 and least * 2 * columns <= -self.rise[0]:",
        "if False:",
    ),
    (
        "the own column, half as wide",
        "least * 2 * columns <= -self.rise[0]",
        "least * 4 * columns <= -self.rise[0]",
    ),
    (
        "the own column with alpha s above",
        "least * 2 * columns <= -self.rise[0]",
        "most * 2 * columns <= -self.rise[0]",
    ),
    (
        "no fall over the own column",
        "low, slope = 0, least + (min(0, self.rise[0]) * step >> BITS)",
        "low, slope = 0, least",
    ),
    ("a rise over the own column", "min(0, self.rise[0]) * step", "self.rise[0] * step"),
    (
        "the slope of the slowest",
        "low, slope = 0, -self.speed(2 * m, row)[1]",
        "low, slope = 0, -self.speed(2 * m, row)[0]",
    ),
    (
        "an end where F < 0 for one",
        "if most_height < 0:\n                break",
        "if least_height < 0:\n                break",
    ),
    (
        "F from above for F from below",
        "low = max(low, least_height)",
        "low = max(low, most_height)",
    ),
    (
        "a jump that falls at half the rate",
        "isqrt(slope * slope + 2 * fall * low)) * ONE // fall",
        "isqrt(slope * slope + 2 * fall * low)) * ONE * 2 // fall",
    ),
    (
        "a jump that nothing checks",
        "low += (slope * time >> BITS) - (fall * (time * time >> BITS + 1) >> BITS)",
        "low += 0",
    ),
    (
        "a jump without its fall",
        "low += (slope * time >> BITS) - (fall * (time * time >> BITS + 1) >> BITS)",
        "low += (slope * time >> BITS)",
    ),
    ("a slope that a jump leaves as it is", "slope -= (fall * time >> BITS) + 1", "slope -= 0"),
    (
        "the slope of the slowest before a jump",
        "slope = max(slope, -self.speed(2 * m, row)[1])",
        "slope = max(slope, -self.speed(2 * m, row)[0])",
    ),
    (
        "a column that falls and is free",
        "free = after > 0 if rise <= 0 else slope >= 0",
        "free = after > 0",
    ),
    (
        "a column whose end is free",
        "after > 0 if rise <= 0 else slope >= 0",
        "True if rise <= 0 else slope >= 0",
    ),
    (
        "a column free as F rises",
        "after > 0 if rise <= 0 else slope >= 0",
        "after > 0 if rise <= 0 else True",
    ),
    (
        "a column without its rise",
        "after = low + (slope * step >> BITS) + (rise * step >> BITS + 1) * step // ONE",
        "after = low + (slope * step >> BITS)",
    ),
    (
        "a column free by its ends, convex or not",
        "low > bend and self.height(m + 1, row)[0] > bend",
        "low > 0 and self.height(m + 1, row)[0] > 0",
    ),
    (
        "a column free by its left end",
        "low > bend and self.height(m + 1, row)[0] > bend",
        "low > bend",
    ),
    (
        "a column free by its right end",
        "low > bend and self.height(m + 1, row)[0] > bend",
        "self.height(m + 1, row)[0] > bend",
    ),
    (
        "a quarter of the convexity",
        "square = 8 * flights.columns**2",
        "square = 32 * flights.columns**2",
    ),
    (
        "a convexity of the lowest S",
        "max(0, flights.S_high[t] - ONE) // square + 1",
        "max(0, flights.S_low[t] - ONE) // square + 1",
    ),
    ("a bound of F that goes on where it landed", "low = max(after, 0)", "low = abs(after)"),
    (
        "a slope that never falls",
        "slope += rise * step >> BITS",
        "slope += max(0, rise) * step >> BITS",
    ),
    (
        "a slope of twice the rise",
        "slope += rise * step >> BITS",
        "slope += rise * step >> BITS - 1",
    ),
    (
        "the rises of columns counted from 0",
        "self.rise = [flights.S_low[t] - ONE for t in order]",
        "self.rise = [low - ONE for low in flights.S_low]",
    ),
    (
        "the highest rise",
        "self.rise = [flights.S_low[t] - ONE for t in order]",
        "self.rise = [flights.S_high[t] - ONE for t in order]",
    ),
    (
        "rows that start where the last of the row below lands",
        "first = landings[0][0]",
        "first = landings[-1][0]",
    ),
)
