"""One leaf: identities that show that facts contradict one another; rule `psatz`.

Source: Stengle, A Nullstellensatz and a Positivstellensatz in semialgebraic geometry, Mathematische
Annalen 207 (1974).  The files, each after those that it imports:

- `linear_program`: positive combinations that vanish identically, exact on the support that floats
  propose
- `basis`: the last basis of a linear program, by floats
- `facts`: the facts of a state; scales by homogeneity, equations used up, signs at sight
- `candidates`: polynomials to square, or to make cases of by sign
- `problem`: the facts of one leaf, ready for a search; whether floats see a point that meets them
- `lifting`: identities between them as nodes over the facts of the state
- `linear`: products of facts, by a linear program
- `by_monomials`: products of bounds along the monomials of a fact, by a linear program
- `orthant`: facts times monomials, in coordinates that the facts make nonnegative
- `sums_of_squares`: facts times sums of squares, by a semidefinite program
- `parameters`: which variables of a goal are parameters, and products of their bounds
- `forms`: quadratic forms with parameters in a box, by Bernstein coefficients
"""
