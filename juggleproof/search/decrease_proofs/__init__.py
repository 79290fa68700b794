"""Proofs that a function falls along the orbits of a map.

- `by_products`: by few facts times many products of what is positive; rule `psatz`
- `by_factors`: of one variable, by the signs of the factors of what is to be contradicted; rules
  `sign`, `psatz`
"""
