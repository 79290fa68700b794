r"""How the names of statements are written on paper, in the notation of the paper; names that it
lacks are made from their letters.

The notation table of a report is this table with its explanations.
"""

from __future__ import annotations

import re

# name in statements, LaTeX, explanation for the notation table (empty: not listed)
NOTATION = (
    ("alpha", r"\alpha", "coefficient of restitution, 0 < alpha < 1"),
    ("r", r"\dot\rho_0", "launch velocity of the table"),
    ("g", r"\gamma", "gravity"),
    ("T", "T", "period of the table, T = 2*r/g"),
    ("beta", r"\bar\beta", "height of the ball when the table is at its lowest"),
    ("v", r"\dot{\bar\beta}", "velocity of the ball at that time"),
    ("tau", r"\tau", "time since the table was at its lowest"),
    ("tau_c", r"\tau_c", "time to collision"),
    ("tau_w", r"\tau_w", "longest time of flight at an energy"),
    ("t", "t", "time"),
    ("K", "K", "number of periods from one impact to the next"),
    ("s", "s", "the square root of 2*(1 + alpha)"),
    ("x", "x", "height in units of r*T: x = beta/(r*T)"),
    ("w", "w", "closing speed in units of r: w = 1 - v/r"),
    ("u", "u", "speed that the energy alone would give, in units of r: u^2 = 4*x + (w - 1)^2"),
    ("E_max", r"E_{\max}", "greatest energy that an impact does not lower"),
    ("dE_max", r"\Delta E_{\max}", "greatest energy change of an impact"),
    ("dE_sup", r"\Delta E_{\sup}", "supremum of the energy change of impacts outside R"),
    ("dE_2", r"\Delta_2 E", ""),
    ("dE_dbeta", r"\frac{\partial\Delta_1 E}{\partial\bar\beta}", ""),
    ("dE_dv", r"\frac{\partial\Delta_1 E}{\partial\dot{\bar\beta}}", ""),
    ("dR_dbeta", r"\frac{\partial R}{\partial\bar\beta}", ""),
    ("dR_dv", r"\frac{\partial R}{\partial\dot{\bar\beta}}", ""),
    ("eps", r"\epsilon", ""),
    ("lam", r"\lambda", ""),
    ("theta", r"\theta", ""),
    ("rho", r"\rho", ""),
    ("mu", r"\mu", ""),
    ("sigma", r"\sigma", ""),
    ("omega", r"\omega", ""),
    ("delta", r"\delta", ""),
    ("chi", r"\chi", ""),
    ("chi_dot", r"\dot\chi", ""),
    ("chi_dot_after", r"\dot\chi_{\mathrm{after}}", ""),
    ("change_1", r"\Delta_1 E", ""),
    ("change_2", r"\Delta_2 E", ""),
)
GLYPHS = {name: latex for name, latex, _ in NOTATION}
# The order in which the paper writes factors, and the addends that hold them: numbers, alpha, and
# then these.
ORDER = (
    "alpha",
    "eps",
    "K",
    "n",
    "k",
    "g",
    "T",
    "t",
    "tau",
    "tau_c",
    "r",
    "x",
    "beta",
    "beta0",
    "z1",
    "v",
    "v0",
    "z2",
    "w",
    "u",
    "s",
)


def glyph(name: str) -> str:
    r"""A name of a statement as LaTeX.

    >>> glyph("v"), glyph("beta0"), glyph("z2")
    ('\\dot{\\bar\\beta}', '\\bar\\beta_0', 'z_2')
    >>> glyph("v_next"), glyph("lift")
    ('\\dot{\\bar\\beta}_{\\mathrm{next}}', '\\mathit{lift}')
    """
    if name in GLYPHS:
        return GLYPHS[name]
    base, _, below = name.partition("_")
    digits = re.fullmatch(r"([A-Za-z]+)(\d+)", base)
    if digits and not below:
        base, below = digits.group(1), digits.group(2)
    shown = GLYPHS.get(base, base if len(base) == 1 else rf"\mathit{{{base}}}")
    if not below:
        return shown
    if below in GLYPHS or len(below) == 1:
        return f"{shown}_{GLYPHS.get(below, below)}"
    return (
        f"{shown}_{{{below}}}"
        if below.isdecimal()
        else rf"{shown}_{{\mathrm{{{below.replace('_', ' ')}}}}}"
    )
