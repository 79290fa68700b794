"""The impacts of a ball at 1/3 < alpha < 1/2, which come to flights of one period, or of two: a
claim of one's own, with its range and its conclusion; without a word that it needs it is refused.
"""

from __future__ import annotations

from pathlib import Path

from tests.command.running import Done, run

# A flight of K periods follows the impact with phase x/w and velocity w; the K-th piece is that
# with 0 <= x_next < w_next.
CLAIM = """
from juggleproof import MapRule, claim

DOMAIN = ("domain", "3*alpha > 1 and 2*alpha < 1 and 1 + alpha > 0 and 1 - alpha > 0")
ONE = "alpha*(2*w - x) < 2"
TWO = "alpha*(2*w - x) >= 2 and alpha*(3*w - x) < 6"
THREE = "alpha*(3*w - x) >= 6"
NEXT = "(alpha*(2*w - x) - 2)", "(4 - alpha*w)"
TWICE = f"{TWO} and alpha*(2*{NEXT[1]} - {NEXT[0]}) >= 2 and alpha*(3*{NEXT[1]} - {NEXT[0]}) < 6"
OF = (("map", "impacts/map"), DOMAIN)


def near(periods, on):
    born = f"({periods + 1}*alpha - {periods - 1})"
    return (
        *(*OF, ("on", on)),
        ("point", f"{periods}*{born}/(1 + alpha)^2, {2 * periods}/(1 + alpha)"),
        *(("weights", f"{2 * periods}*alpha/(1 - alpha), 1"), ("rate", "(1 + alpha)/2")),
        *(("radius", f"(1 - alpha)*{born}/20"), ("size", "20")),
    )


@claim("impacts")
def the_flights_settle():
    '''For 1/3 < alpha < 1/2 the impacts tend to flights of one period, or to flights of two.'''
    return [
        MapRule("map", (
            *(("over", "alpha"), DOMAIN, ("state", "x w"), ("space", "0 <= x and x < w and w < 5")),
            ("piece", f"{ONE} -> alpha*(w - x), 2 - alpha*w"),
            ("piece", f"{TWO} -> alpha*(2*w - x) - 2, 4 - alpha*w"),
            ("piece", f"{THREE} -> alpha*(3*w - x) - 6, 6 - alpha*w"),
        )),
        MapRule("descends", (*OF, ("rank", "0"), ("stage", "0 <= x"))),
        MapRule("one", near(1, ONE)),
        MapRule("two", near(2, TWICE)),
        MapRule("settles", (
            *(("descent", "impacts/descends"), ("never", "2 3"), ("never", "3 3")),
            *(("contraction", "impacts/one"), ("word", "1")),
            *(("contraction", "impacts/two"), ("word", "2 2")),
        )),
    ]
"""


def certify(folder: Path, text: str) -> Done:
    path = folder / "impacts.py"
    path.write_text(text, encoding="utf-8")
    return run("certify", str(path), "--routes", "exact", "--jobs", "1")


def test_flights_come_to_one_period_or_two_holds(tmp_path: Path) -> None:
    done = certify(tmp_path, CLAIM)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "1 holds" in done.stdout and "at least 1/3 < alpha < 1/2" in done.stdout


def test_the_flights_come_to_an_end_fails_without_a_word_that_it_needs(tmp_path: Path) -> None:
    done = certify(tmp_path, CLAIM.replace('("never", "2 3"), ', ""))
    assert done.returncode != 0
    assert "words of every length hold none of these: impacts/settles" in done.stderr


def test_the_flights_come_to_an_end_fails_with_a_word_that_states_follow(tmp_path: Path) -> None:
    text = CLAIM.replace('("never", "3 3")', '("never", "3 3"), ("never", "2 1")')
    done = certify(tmp_path, text)
    assert done.returncode == 1 and "1 unknown" in done.stdout, done.stdout + done.stderr
