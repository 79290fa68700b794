"""The appendices of the paper and their sections, with their headings as LaTeX."""

from __future__ import annotations

APPENDICES = {
    "A": "Maximal and supremal points",
    "B": "Handy equations, definitions, and parameterizations",
}
HEADINGS = {
    "A.1": "Maximum sustainable energy",
    "A.2": "Maximum energy change",
    "A.3": r"Supremum \texorpdfstring{$\Delta E$}{of Delta E} outside \texorpdfstring{$\jugR$}{R}",
    "A.3.1": r"The boundary \texorpdfstring{$R(\jugstate) = 0$}{R(b) = 0}",
    "A.3.2": r"Finding \texorpdfstring{$\Delta E_{\sup}$}{the supremum}",
    "A.4": r"Number of impacts to enter \texorpdfstring{$\jugR$}{R}",
    "B.1": "Time to collision",
    "B.2": "Important regions",
    "B.3": "System dynamics",
    "B.4": "Fixed point",
    "B.5": "Zero energy change boundary",
    "B.6": r"Boundary of \texorpdfstring{$\jugR$}{R}",
    "B.7": "Table of notation",
}
