"""Lower bounds of polynomials on boxes, by trees of Bernstein coefficients or by squares; states
over boxes; rules `boxes`, `psatz` and `sign`.

The files, each after those that it imports:

- `branching`: a box tree for any polynomial, the box of least bound first
- `descent`: points of a box where a polynomial is small
- `over_box`: one fact over the box of the others, by a small tree
- `squares`: squares around a point, where halving boxes leads nowhere; facts over a box by them
- `enclosures`: a bound within a width of the value at a point, by the two of them
"""
