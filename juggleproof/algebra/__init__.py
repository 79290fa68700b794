"""Arithmetic that the search and the votes share; nothing here has to be believed.

In reading order:

- `trees`: what formulas of all kinds have in common, which are trees of joins;
- `numbers`: real algebraic numbers, signs of polynomials at them, polynomials in one variable;
- `number_field`: several algebraic numbers as polynomials in one of them;
- `box_trees`: trees of boxes by Bernstein coefficients, for small problems;
- `polynomials`: between the checker's polynomials, FLINT's, and arrays;
- `intervals`: enclosures of a polynomial on a box, in Arb's balls;
- `conditions`: the condition of a statement as FLINT's polynomials, and where it can change its
  truth as a parameter moves;
- `semidefinite`: the program of sums of squares, its rounding to rationals, and LDL^T.
"""
