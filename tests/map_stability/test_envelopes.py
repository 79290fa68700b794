"""Maps of one variable are proved stable by envelopes, up to the parameters where the multiplier is
-1 and no further.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as some

from juggleproof.command.check import check
from juggleproof.map_stability.functions.envelopes import Envelope, candidates_for
from juggleproof.map_stability.terms import value
from juggleproof.statements.store import STATEMENTS
from tests.command import running
from tests.map_stability.maps import at_point, map_of

LOGISTIC = "over a\ndomain 1 < a and a < 4\nstate x\nspace 0 < x and x < 1\npiece a*x*(1 - x)\n"
PROVED = {  # name: (text, first line, a hypothesis, a weaker one)
    "logistic": (
        LOGISTIC,
        "in part  logistic: ((a - 1)/a) is stable and attracts every state if and only if a <= 3",
        "3 - a >= 0",
        "7/2 - a >= 0",
    ),
    "hassell": (
        "over r\ndomain r > 1\nstate x\nspace x > 0\npiece r*x/(1 + x)^2\n",
        "proved   hassell: (sqrt(r) - 1) is stable and attracts every state",
        "domain r > 1 and r > 0",
        "domain r > 1/2 and r > 0",
    ),
}
POSITIVE = some.fractions(Fraction(1, 20), 20, max_denominator=20)


@pytest.fixture(
    scope="module", params=["hassell", pytest.param("logistic", marks=pytest.mark.exhaust)]
)
def proved(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the certificates."""
    name = request.param
    folder = tmp_path_factory.mktemp(name)
    (folder / f"{name}.map").write_text(PROVED[name][0])
    done = running.run("stability", str(folder / f"{name}.map"), "-o", str(folder))
    assert done.stdout.partition("\n")[0] == PROVED[name][1]
    return folder / f"{name}.certificates"


def test_the_checker_takes_what_is_proved_by_an_envelope_holds(proved: Path) -> None:
    assert check(proved) == 0


def test_rejects_an_envelope_for_more_parameters(proved: Path, tmp_path: Path) -> None:
    _, _, given_, weaker = PROVED[proved.stem]
    for file in proved.iterdir():
        text = file.read_text()
        assert file.name != STATEMENTS or given_ in text
        (tmp_path / file.name).write_text(text.replace(given_, weaker))
    assert check(tmp_path) == 1


@given(e=POSITIVE, b=POSITIVE, x=POSITIVE)
def test_v_is_the_same_at_a_state_and_its_image_under_the_involution_holds(
    e: Fraction, b: Fraction, x: Fraction
) -> None:
    gap = x - e
    if e - b * gap <= 0:  # beyond the image of the bound
        return
    image = -e * gap / (e + (1 - b) * gap)
    (term,) = Envelope("x", "e - b*x_gap", "e").function("x").terms
    here, there = (value(term, {"x": e + g, "x_gap": g, "e": e, "b": b}) for g in (gap, image))
    assert here == there


@pytest.mark.parametrize(("slope", "fits"), [(1, False), (2, False), (3, True)])
def test_rejects_an_envelope_of_another_second_derivative(slope: int, fits: bool) -> None:
    """At a = 3 the involution has to have that of the map, so b = 3."""
    system = replace(map_of(LOGISTIC.rstrip()), domain="2 < a and a <= 3 and a > 0")
    setting = replace(at_point(system, "(a - 1)/a"), have=())
    upper = f"(1 + {slope})*(a - 1) - {slope}*a*x"
    inner = replace(system, space=f"0 < x and {upper} > 0")
    envelope = Envelope("x", upper, "(a - 1)/a")
    found = candidates_for(replace(setting, system=inner), envelope, closed=True)
    assert bool(list(found)) is fits
