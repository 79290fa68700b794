"""The table that moves as a sine, which the paper leaves open, as claims.

bounces     the bounces of one period, when they are born and stable, and the other bounce
everywhere  where every motion tends to the bounce
"""

SECTIONS = ("bounces", "everywhere")
