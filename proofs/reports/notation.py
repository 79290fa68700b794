r"""The notation macros of the LaTeX reports, one for each of the paper's accented names and
regions: an author changes them in one place.
"""

from __future__ import annotations

import re

PREFIX = "jug"
# macro, what it stands for, the ways in which prints and formulas write it
MACROS = (
    ("speed", r"\dot{\bar\beta}", r"\\dot\{\\bar(?:\{\s*\\beta\}|\s*\\beta)\}"),
    ("height", r"\bar\beta", r"\\bar(?:\{\s*\\beta\}|\s*\\beta(?![A-Za-z]))"),
    ("launch", r"\dot\rho_0", r"\\dot(?:\{\s*\\rho\}|\s*\\rho)_(?:0|\{0\})"),
    ("gravity", r"\gamma", r"\\gamma(?![A-Za-z])"),
    ("restitution", r"\alpha", r"\\alpha(?![A-Za-z])"),
    ("collisiontime", r"\tau_c", r"\\tau_(?:c(?![A-Za-z])|\{c\})"),
    ("H", r"\mathcal{H}", r"\\mathcal(?:\{H\}|\s+H)"),
    ("B", r"\mathcal{B}", r"\\mathcal(?:\{B\}|\s+B)"),
    ("R", r"\mathcal{R}", r"\\mathcal(?:\{R\}|\s+R)"),
    ("state", r"\bar b", r"\\bar(?:\{\s*b\}|\s+b(?![A-Za-z]))"),
)
_NARROW = re.compile(
    r"\\overline(?=\s*(?:\{\s*(?:\\[A-Za-z]+|[A-Za-z])\s*\}|\\[A-Za-z]+|[A-Za-z]))"
)


def narrow(latex: str) -> str:
    r"""A bar over one letter is \bar.

    >>> narrow(r"\dot{\overline{\beta}} + \overline b")
    '\\dot{\\bar{\\beta}} + \\bar b'
    """
    return _NARROW.sub(r"\\bar", latex)


def with_macros(latex: str) -> str:
    r"""The same LaTeX with the notation macros.

    >>> with_macros(r"\gamma\overline{\beta} + \frac{1}{2} \dot{\overline{\beta}}^2")
    '\\juggravity\\jugheight + \\frac{1}{2} \\jugspeed^2'
    """
    shown = narrow(latex)
    for name, _, pattern in MACROS:
        macro = f"\\{PREFIX}{name}"
        shown = re.sub(
            pattern + r"(\s*)(?=(.?))",
            lambda found, macro=macro: (
                macro + (" " if found.group(2).isalpha() else found.group(1))  # type: ignore[misc]
            ),
            shown,
            flags=re.DOTALL,
        )
    return shown


def without_macros(latex: str) -> str:
    r"""The LaTeX with every notation macro replaced by what it stands for.

    >>> without_macros(r"\juggravity T")
    '\\gamma T'
    """
    for name, means, _ in MACROS:
        latex = re.sub(rf"\\{PREFIX}{name}(?![A-Za-z])", lambda _, means=means: means, latex)  # type: ignore[misc]
    return latex
