"""The part on the vibrating table: the impact of one corner, with friction, and what it guarantees,
as claims.
"""

SECTIONS = ("corner", "modes")
