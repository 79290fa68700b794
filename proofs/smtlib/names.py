"""Names of an SMT-LIB script in our language: the same where they can be, else made from their
letters.
"""

from __future__ import annotations

import re
from collections.abc import Collection

from certificates.terms import NAME, RESERVED

OURS = RESERVED | {
    "alpha",
    "r",
    "g",
}  # the search gives these favoured values, as the paper's parameter and units have them


def our_name(symbol: str, taken: Collection[str]) -> str:
    """A name for a variable of the script that our language allows and that no other bears.

    >>> our_name("x", []), our_name("x'", ["x_1"]), our_name("lambda", []), our_name("|", [])
    ('x', 'x_', 'lambda_', 'v')
    """
    base = re.sub(r"\W", "_", symbol, flags=re.ASCII).lstrip("_0123456789") or "v"
    name = base if NAME.match(base) and base not in OURS else base + "_"
    count = 1
    while name in taken:
        count += 1
        name = f"{base}_{count}"
    return name
