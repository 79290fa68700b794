"""`juggleproof bench`: the paper's bounds and orbits by every method in one run, error against
seconds.
"""
