"""Decreasing maps of one variable are settled by their second iterate, and nothing is proposed
where it goes away from the point.
"""

from __future__ import annotations

from juggleproof.proofs.stability.attracting import by_second_iterate
from juggleproof.proofs.stability.certifying import Proof
from juggleproof.proofs.stability.functions.second_iterate import (
    licensed_space,
    second_iterate_rules,
)
from juggleproof.proofs.stability.functions.values import Setting
from juggleproof.proofs.stability.given import read_rows
from juggleproof.proofs.stability.points import PARAMETERS, fixed_points
from juggleproof.proofs.stability.samples import region, with_licences
from juggleproof.proofs.stability.settings import setting_of

INHIBITED = "e*(1 + e^2)/(1 + x^2)"


def setting_at(piece: str, domain: str) -> Setting:
    """The map on x >= 0 with the point e."""
    rows = [("over", "e"), ("domain", domain), ("state", "x"), ("space", "x >= 0")]
    system = with_licences(read_rows("inhibited", [*rows, ("piece", piece), ("point", "e")]))
    assert len(region(system.domain, system.parameters, PARAMETERS)["e"])
    (fixed,) = fixed_points(system)
    return setting_of(system, fixed, system.domain)


def proposed(setting: Setting) -> list[str]:
    return [rule.name for rule, _ in second_iterate_rules(setting, "x >= 0", "inhibited/lyapunov")]


def test_a_map_without_cycles_of_two_is_settled_holds() -> None:
    setting, proof = setting_at(INHIBITED, "0 < e and e < 1"), Proof()
    assert licensed_space(setting) == "x >= 0 and x^2 + 1 > 0"
    assert not proof.add(setting.system.rule("inhibited/map"))
    assert by_second_iterate(proof, setting, lambda text: None)
    assert proof.rules[-1].name == "inhibited/attracts"
    assert len(str(proof.certificates)) < 40_000


def test_a_cycle_of_two_fails_without_a_slope_above_minus_one() -> None:
    """x and 1/x are a cycle where x + 1/x = e (1 + e^2)."""
    assert proposed(setting_at(INHIBITED, "1 < e and e < 2")) == []


def test_rejects_a_map_that_grows_at_its_point() -> None:
    assert proposed(setting_at("x*(1 + e)/(1 + x)", "0 < e and e < 1")) == []
