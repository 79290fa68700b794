"""Stability of a map that is given alone: its fixed point, a function that falls, and for which
parameters, or an orbit that stays away; nothing here has to be believed, since all that is said is
certified by the checker.

In reading order, each importing those before it only:

- `given`: the map, read from a file or a map rule; text evaluated in floats, rationals and SymPy.
- `samples`: samples of parameters and states; points that move with the parameters.
- `points`: fixed points by elimination, and their multipliers.
- `domains`: for which parameters a fixed point can be stable.
- `values`: Lyapunov functions by linear programs on samples, and the constants of their rule.
- `norms`: polytope norms that piecewise affine maps contract.
- `envelopes`: functions of one variable, by fractional linear involutions.
- `part_metric`: greatest weighted distances, with the part metric.
- `saturated`: quadratic forms that fall by c V/(1 + V), as saturated maps ask for.
- `by_sign`: proofs by cases of signs that a search of functions suggests.
- `by_products`: proofs by few facts times many products of what is positive.
- `refuting`, `chetaev`: periodic orbits in exact terms, and functions that grow.
- `certifying`: statements certified one after another, within counted work.
- `ratios`: greatest weighted ratios, with weights that depend on the parameters.
- `settings`: a fixed point with a part of the domain.
- `attracting`, `failing`: that the point is stable and attracts every state, or not.
- `search`: all of it, in order, and the outcome.
- `claiming`: the same as a claim of one's own.
"""
