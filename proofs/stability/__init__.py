"""Stability of a map that is given alone: its fixed point, a function that falls, and for which
parameters, or an orbit that stays away; nothing here has to be believed, since all that is said is
certified by the checker.

In reading order, each importing those before it only:

- `given`: the map, read from a file or a map rule; text evaluated in floats, rationals and SymPy.
- `by_sign`: proofs by cases of signs that a search of functions suggests.
- `few_facts`: proofs from few facts, which are named.
- `certifying`: statements certified one after another, within counted work.
- `samples`: samples of parameters and states; points that move with the parameters.
- `points`: fixed points by elimination, and their multipliers.
- `domains`: for which parameters a fixed point can be stable.
- `functions`: functions that fall along all orbits, or grow close to a point.
- `entering`: boxes that every orbit enters.
- `refuting`: periodic orbits in exact terms.
- `settings`: a fixed point with a part of the domain.
- `attracting`, `failing`: that the point is stable and attracts every state, or not.
- `algebraic`, `by_equation`: fixed points that are no square roots, as parameters: in place of an
  old one, or with the equation that elimination leaves.
- `search`: all of it, in order, and the outcome.
- `claiming`: the same as a claim of one's own.
"""
