"""Maps that are not the paper's, with all that the map rules say of them, and the certificates that
the search has found.  These stand in `maps.json`, so that a test of the checker depends on no
search; `tests/search/map_certificates.py` finds them anew.
"""

from __future__ import annotations

import json
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from juggleproof.certificates import checker

Json = Any
FOUND = Path(__file__).with_name("maps.json")

# One is subtracted until what is left is less than 1, and that is multiplied by a: to 0 exactly for
# a < 1.
SUBTRACT = """
statement demo/map
over a
domain a > 0 and a <= 1
state x
space x >= 0
piece x >= 1 -> x - 1
piece x < 1 -> a*x

statement demo/descends
map demo/map
domain a > 0 and a < 1
rank x
stage x < 1

statement demo/contracts
map demo/map
domain a > 0 and a < 1
on x < 1
point 0
weights 1
rate a
radius 1/2
size 1

statement demo/attracts
descent demo/descends
contraction demo/contracts

statement demo/lyapunov
map demo/map
domain a > 0 and a < 1
on x < 1
point 0
value x
loss (1 - a)*value
least (1 - a)*distance
upper 1
radius 1/2

statement demo/settles
descent demo/descends
lyapunov demo/lyapunov

statement demo/escapes
map demo/map
domain a = 1
point 0
start 1/2
word 2

statement demo/exactly
attraction demo/attracts
escape demo/escapes
"""

# Three variables: a count that runs down, and a point of the plane that is turned meanwhile, then
# drawn to (1/2, 0) with a shear.
TURN = """
statement turn/map
over b
domain b >= 0 and 8*b < 1
state n x y
space n >= 0 and x >= -1 and x <= 1 and y >= -1 and y <= 1
piece n >= 1 -> n - 1, -y, x
piece n < 1 -> n/2, 1/4 + x/2 + b*y, y/3

statement turn/descends
map turn/map
domain b >= 0 and 8*b < 1
root d = sqrt(4*n^2)
rank d/2
stage n < 1

statement turn/contracts
map turn/map
domain b >= 0 and 8*b < 1 and 1 - 2*b > 0
on n < 1
point 0, 1/2, 0
weights 2, 2, 1
rate 5/8
radius 1/4
size 1

statement turn/attracts
descent turn/descends
contraction turn/contracts
"""

# Two steps multiply a state by a: 0 attracts every state for a < 1, and is unstable for a > 1.
FLIP = """
statement flip/map
over a
domain a > 0 and a != 1
state x
space 0 = 0
piece x >= 0 -> -2*a*x
piece x < 0 -> -x/2

statement flip/descends
map flip/map
domain a > 0 and a < 1
rank 0
stage 0 = 0

statement flip/lyapunov
map flip/map
domain a > 0 and a < 1
on 0 = 0
point 0
value x >= 0 -> x
value x < 0 -> (a - 3)*x/4
loss (1 - a)*value/4
least (1 - a)*distance/8
upper 1
radius 1

statement flip/attracts
descent flip/descends
lyapunov flip/lyapunov

statement flip/unstable
map flip/map
domain a > 1 and a > 0 and 1 + a > 0
point 0
direction distance
value x >= 0 -> x
value x < 0 -> -(1 + a)*x/(4*a)
rate 2*a/(1 + a)
radius 1
upper 1

statement flip/exactly
attraction flip/attracts
unstable flip/unstable
"""

# The same map on three spaces, each in the one before it: what attracts the least attracts all.
NEST = """
statement nest/map
over a
domain a > 0 and a <= 1
state x
space x >= 0
piece x > 1 -> x - 1
piece x <= 1 -> a*x

statement nest/middle
over a
domain a > 0 and a < 1
state x
space x >= 0 and x <= 5
piece x > 1 -> x - 1
piece x <= 1 -> a*x

statement nest/inner
over a
domain a > 0 and a < 1
state x
space x >= 0 and x <= 1
piece x > 1 -> x - 1
piece x <= 1 -> a*x

statement nest/at-once
map nest/inner
domain a > 0 and a < 1
rank 0
stage 0 = 0

statement nest/contracts
map nest/inner
domain a > 0 and a < 1
on 0 = 0
point 0
weights 1
rate a
radius 1/2
size 1

statement nest/attracts
descent nest/at-once
contraction nest/contracts

statement nest/descends
map nest/middle
domain a > 0 and a < 1
rank x
stage x <= 1

statement nest/into
descent nest/descends
attraction nest/attracts
radius 1

statement nest/descends-first
map nest/map
domain a > 0 and a < 1
rank x
stage x <= 4

statement nest/into-twice
descent nest/descends-first
attraction nest/into
radius 1

statement nest/escapes
map nest/map
domain a = 1
point 0
start 1/2
word 2

statement nest/exactly
attraction nest/into-twice
escape nest/escapes
"""

# Several next states: a state is drawn to 0 by a factor that may be another one at each step.
PUSH = """
statement push/relation
over a
domain a >= 0 and a < 1
state x
input u
space 0 = 0
piece u >= -a and u <= a and x > -1 -> u*x
piece u >= -a and u <= a and x < 1 -> -u*x/2
piece x > 5 -> x/6

statement push/descends
relation push/relation
domain a >= 0 and a < 1/2
rank 0
stage 0 = 0

statement push/contracts
relation push/relation
domain a >= 0 and a < 1/2
on x >= -2 and x <= 2
point 0
weights 1
rate 1/2
radius 2
size 2

statement push/lyapunov
relation push/relation
domain a >= 0 and a < 1/2
on 0 = 0
point 0
value x
value -x
loss value/2
least distance/2
upper 1
radius 1

statement push/attracts
descent push/descends
lyapunov push/lyapunov
"""

# Without inputs, where the pieces overlap: a state is halved, or taken to a third.
SWITCH = """
statement switch/relation
over
domain 0 = 0
state x
input
space 0 = 0
piece x >= -1 -> x/2
piece x <= 1 -> -x/3

statement switch/contracts
relation switch/relation
domain 0 = 0
on x^2 <= 1
point 0
weights 1
rate 1/2
radius 1
size 1
"""

# No parameter: a state is doubled.
DOUBLE = """
statement double/map
over
domain 0 = 0
state x
space x >= 0
piece x >= 0 -> 2*x

statement double/unstable
map double/map
domain 0 = 0
root r = sqrt(x)
point 0
direction distance
value r^2
rate 2
radius 1
upper 1
"""

# A state is multiplied by a: to 0 exactly for -1 < a < 1, refuted elsewhere in three ways.
SCALE = """
statement scale/map
over a
domain 0 = 0
state x
space 0 = 0
piece 0 = 0 -> a*x

statement scale/descends
map scale/map
domain a > -1 and a < 1
rank 0
stage 0 = 0

statement scale/lyapunov
map scale/map
domain a^2 < 1
on 0 = 0
point 0
value x^2
loss (1 - a^2)*value
least (1 - a^2)*distance^2
upper 1
radius 1

statement scale/attracts
descent scale/descends
lyapunov scale/lyapunov

statement scale/unstable
map scale/map
domain a^2 > 1
point 0
direction distance
value x^2
rate a^2
radius 1
upper 1

statement scale/stays
map scale/map
domain a = 1
point 0
start 1
word 1

statement scale/flips
map scale/map
domain a = -1
point a - a
start 1
word 1 1

statement scale/exactly
attraction scale/attracts
escape scale/flips
unstable scale/unstable
escape scale/stays
"""

# The second of two numbers runs down; then the first is halved, and the second put back by as much
# as parameter and first say. And a state that steps to 0 from both sides: its distance is the rank.
COUNT = """
statement count/map
over a
domain a >= 0
state x y
space x >= 0 and y >= 0
piece y >= 1 -> x, y - 1
piece y < 1 -> x/2, a*x^2

statement count/descends
map count/map
domain a >= 0
rank 2*x, y
stage x < 1

statement count/sides
over
domain 0 = 0
state x
space 0 = 0
piece x > 0 -> x - 1
piece x <= 0 -> x + 1

statement count/side
map count/sides
domain 0 = 0
rank x
rank x <= 1 -> -x
stage x >= -1 and x <= 1

statement count/both
map count/sides
domain 0 = 0
rank x > 2 -> 1, x
rank x < -2 -> 1, -x
rank x >= -2 and x <= 2 -> 0, 0
stage x >= -2 and x <= 2
"""

# A parameter that is an integer: what is left is divided by it, or it is taken away.
WHOLE = """
statement whole/map
over n
integer n
domain n != 0
state x
space 0 = 0
piece 0 = 0 -> x/n

statement whole/descends
map whole/map
domain n != 0 and n^2 > 1
rank 0
stage 0 = 0

statement whole/lyapunov
map whole/map
domain n != 0 and n^2 > 1
on 0 = 0
point 0
value x^2
loss (1 - 1/n^2)*value
least (1 - 1/n^2)*distance^2
upper 1
radius 1

statement whole/attracts
descent whole/descends
lyapunov whole/lyapunov

statement whole/stays
map whole/map
domain n != 0 and n = 1
point 0
start 1
word 1

statement whole/flips
map whole/map
domain n != 0 and n = -1
point 0
start 1
word 1 1

statement whole/exactly
attraction whole/attracts
escape whole/stays
escape whole/flips

statement whole/subtracts
over n
integer n
domain n > 0
state x
space x >= 0
piece x >= n -> x - n
piece x < n -> x/2

statement whole/subtracts-descends
map whole/subtracts
domain n > 0
rank x
stage x < n

statement whole/contracts
map whole/subtracts
domain n > 0
on x < n
point 0
weights 1
rate 1/2
radius 1/2
size n

statement whole/relation
over n
integer n
domain n > 0
state x
input u
space x >= 0
piece u >= 1 and x >= n -> x - n
piece x < n -> x/2

statement whole/related
relation whole/relation
domain n > 0
rank x
stage x < n
"""


def read(text: str) -> dict[str, checker.Statement]:
    """The statements of a text."""
    statements: dict[str, checker.Statement] = checker.read_statements(text)
    return statements


@cache
def found() -> dict[str, Json]:
    """What the search has found of each text, by its key."""
    return dict(json.loads(FOUND.read_text(encoding="utf-8")))


def key(text: str) -> str:
    """The key of a text: it tells of the last statement and of those before it."""
    return sha256(text.strip().encode()).hexdigest()[:16]


def certificate_of(text: str) -> Json:
    """The certificate of the last statement of a text, or the reason why none was found."""
    if key(text) not in found():
        raise LookupError(f"{FOUND}: not searched; tests/search/map_certificates.py searches")
    return found()[key(text)]


def searched(text: str) -> dict[str, Json]:
    """{name: certificate or the reason why none was found} for the statements of a text in order,
    as far as those before are certified.
    """
    before, _, last = text.strip().rpartition("\n\n")
    certificates = searched(before) if before else {}  # most texts begin as another does
    if not any("unknown" in certificate for certificate in certificates.values()):
        certificates[last.split()[1]] = certificate_of(text)
    return certificates


def checked(
    text: str, certificates: dict[str, Json]
) -> dict[str, tuple[str, checker.Rejected | None]]:
    """{name: (outcome, reason)} by the checker alone."""
    known: dict[str, checker.Statement] = {}
    results: dict[str, tuple[str, checker.Rejected | None]] = {}
    for name, statement in read(text).items():
        results[name] = checker.check_one(statement, certificates.get(name, {}), known, {})
        if results[name][0] == "certified":
            known[name] = statement
    return results


def up_to(text: str, name: str) -> str:
    """The text without the statements after this one."""
    before, head, rest = text.partition(f"statement {name}\n")
    return before + head + rest.split("\n\n")[0].rstrip() + "\n"


def edited(text: str, kind: str, old: str, new: str) -> str:
    """The text with one change in the statement of this kind."""
    blocks = text.strip().split("\n\n")
    index = next(i for i, block in enumerate(blocks) if block.split("\n")[0].endswith("/" + kind))
    if old not in blocks[index]:
        raise ValueError(f"{old!r} does not stand in {kind}")
    blocks[index] = blocks[index].replace(old, new)
    return "\n\n".join(blocks) + "\n"


# What nothing here proves, with a line of every kind and more of each than one: roots of parameters
# and of the state, two stages, two steps.
ASKED = """
statement asked/map
over a b
domain a > 0
state x y
space x >= 0
piece x >= 1 -> x - 1, y
piece x < 1 -> a*y, b

statement asked/descends
map asked/map
domain a > 1
root c = sqrt(a)
root d = sqrt(c*x)
root e = sqrt(d)
rank d + e
stage x < 1
stage x < c

statement asked/contracts
map asked/map
domain a > 2
root c = sqrt(a)
root k = sqrt(a + 1)
root h = sqrt(y^2)
on h < 1
point c, b
weights 1, k
rate a
radius b
size c

statement asked/attracts
descent asked/descends
contraction asked/contracts

statement asked/lyapunov
map asked/map
domain a > 2
root c = sqrt(a)
root h = sqrt(y^2)
on h < 1 and x_gap < y_point
point c, b
have x_point^2 = a
have y_point < 1
value c*y
value h > 2 -> x + h*y_gap
loss value*x
least level + distance
upper c
radius b

statement asked/lyapunov-of-one-term
map asked/map
domain a > 4
on x < 1
point a, b
value x > 0 -> x^2
loss value
least distance
upper a
radius b

statement asked/settles
descent asked/descends
lyapunov asked/lyapunov

statement asked/unstable
map asked/map
domain a > 3
root c = sqrt(a)
root h = sqrt(y^2)
point c, b
direction x_point + distance, b
have x_point = c
value h > 1 -> x_gap
value x*h
rate c
radius b
upper a

statement asked/of-integers
over a b
integer b
domain a > 0
state x y
space x >= b
piece 0 = 0 -> x + b, y

statement asked/lyapunov-of-integers
map asked/of-integers
domain a > 2
on x < 1
point a, b
have x_point = a
value x^2
loss value
least distance
upper a
radius b

statement asked/inner
over a b
domain a > 0
state x y
space x >= 0 and y >= 0
piece x >= 1 -> x - 1, y
piece x < 1 -> a*y, b

statement asked/inner-descends
map asked/inner
domain a > 5
rank x
stage y < 1

statement asked/inner-contracts
map asked/inner
domain a > 6
root c = sqrt(a)
root k = sqrt(a + 1)
on y < 2
point k, b
weights 1, 1
rate a
radius b
size k

statement asked/inner-attracts
descent asked/inner-descends
contraction asked/inner-contracts

statement asked/into
descent asked/descends
attraction asked/inner-attracts
radius k

statement asked/exactly-unstable
attraction asked/into
unstable asked/unstable

statement asked/relation
over a b
domain a > 0
state x y
input u w
space x >= 0
piece x >= u -> x - 1, w
piece u < b -> a*y, b

statement asked/descends-related
relation asked/relation
domain a > 7
root d = sqrt(x)
rank d
stage x < 1

statement asked/descends-by-several
map asked/map
domain a > 8
root d = sqrt(x)
rank x > 2 -> d, y, a
rank x, y^2, b
stage x < 1

statement asked/escapes
map asked/map
domain a > 3
root m = sqrt(a)
root c = sqrt(a)
point m, 0
start b - m, a
word 2 1

statement asked/exactly
attraction asked/attracts
escape asked/escapes

statement asked/exactly-twice
attraction asked/attracts
unstable asked/unstable
escape asked/escapes

statement asked/descends-in-roots
map asked/map
domain a > 9
root c = sqrt(a)
root d = sqrt(c*x)
rank d
stage d < c

statement asked/ends
descent asked/descends
never 2 2
never 1 1 2
contraction asked/contracts
word 2 1
contraction asked/contracts
word 1 1

statement asked/ends-by-ranks
descent asked/descends-in-roots
never 1 1
never 2 2 1
rank b - y
word 2
rank x + a*y
word 1 2
contraction asked/contracts
word 1 1 1

statement asked/ends-in-roots
descent asked/descends-in-roots
never 2
contraction asked/contracts
word 1 1

statement asked/faster
over a b
domain a > 1
state x y
space x >= 0
piece x >= 2 -> x - 2, a*y
piece x < 2 -> x^2, y + b

statement asked/returns
map asked/faster
settling asked/ends-in-roots
word 1 2 1
word 2

statement asked/returns-by-ranks
map asked/faster
settling asked/ends-by-ranks
word 1
word 2 2

statement asked/powers
forall x y w n
integer n
let z = w + 1
iterates (x, y) -> (x + z, y)
after n -> (x + n*z, y)
"""
