"""Proofs that a function falls along the orbits of a map.

- `by_factors`: of one variable, by the signs of the factors of what is to be contradicted; rules
  `sign`, `psatz`
"""
