"""The appendices of the paper and their sections, with their headings; formulas stand
between dollars."""

from __future__ import annotations

APPENDICES = {
    "A": "Maximal and supremal points",
    "B": "Handy equations, definitions, and parameterizations",
}
HEADINGS = {
    "A.1": "Maximum sustainable energy",
    "A.2": "Maximum energy change",
    "A.3": r"Supremum $\Delta E$ outside $\mathcal{R}$",
    "A.3.1": r"The boundary $R(\overline{b}) = 0$",
    "A.3.2": r"Finding $\Delta E_{\sup}$",
    "A.4": r"Number of impacts to enter $\mathcal{R}$",
    "B.1": "Time to collision",
    "B.2": "Important regions",
    "B.3": "System dynamics",
    "B.4": "Fixed point",
    "B.5": "Zero energy change boundary",
    "B.6": r"Boundary of $\mathcal{R}$",
    "B.7": "Table of notation",
}
