"""Lower bounds of polynomials on boxes, by trees of Bernstein coefficients or by squares; rules
`boxes` and `psatz`.

The files, each after those that it imports:

- `small`: polynomials and box trees as plain data, without NumPy
- `branching`: a box tree for any polynomial, the box of least bound first
- `squares`: squares around a point, where halving boxes leads nowhere
- `enclosures`: a bound within a width of the value at a point, by the two of them
"""
