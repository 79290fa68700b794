"""What orbits do for restitutions from 1/3 on, which the paper leaves open, as claims.

impacts     the map from impact to impact: where each e_K begins, and the box that it attracts
below_a_half   from 1/3 to 1/2 every orbit tends to e_1 or to e_2
unequal     an orbit of 12 unequal flights: where it exists, and what it attracts
settling    from 1/2 to where that orbit begins every orbit tends to the orbit of some e_K
"""

SECTIONS = ("impacts", "below_a_half", "unequal", "settling")
