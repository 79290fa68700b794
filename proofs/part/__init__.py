"""The part on the vibrating table: the impact of one corner, with friction, and what it
guarantees, as claims.

    corner  names, hypotheses, the modes and their conditions, what an impulse does
    modes   the impulse of each mode, its energy, and that the modes cover every impact
"""

SECTIONS = ("corner", "modes")
