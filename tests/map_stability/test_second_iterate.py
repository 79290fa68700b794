"""Decreasing maps of one variable are settled by their second iterate, and nothing is proposed
where it goes away from the point.
"""

from __future__ import annotations

from juggleproof.map_stability.functions.candidates import Setting
from juggleproof.map_stability.functions.second_iterate import (
    licensed_space,
    second_iterate_candidates,
)
from tests.map_stability.maps import at_point, map_of, proved

INHIBITED = "e*(1 + e^2)/(1 + x^2)"


def setting_at(piece: str, domain: str) -> Setting:
    """The map on x >= 0 with the point e."""
    text = f"over e\ndomain {domain}\nstate x\nspace x >= 0\npiece {piece}\npoint e"
    return at_point(map_of(text))


def test_a_map_without_cycles_of_two_is_settled_holds() -> None:
    setting = setting_at(INHIBITED, "0 < e and e < 1")
    assert licensed_space(setting) == "x >= 0 and x^2 + 1 > 0"
    assert proved(setting, second_iterate_candidates, licensed=True)[-1] == "attracts"


def test_a_cycle_of_two_fails_without_a_slope_above_minus_one() -> None:
    """x and 1/x are a cycle where x + 1/x = e (1 + e^2)."""
    assert not list(second_iterate_candidates(setting_at(INHIBITED, "1 < e and e < 2")))


def test_rejects_a_map_that_grows_at_its_point() -> None:
    setting = setting_at("x*(1 + e)/(1 + x)", "0 < e and e < 1")
    assert not list(second_iterate_candidates(setting))
