"""Stability of a map that is given alone: its fixed point, a function that falls along its orbits,
and for which parameters, or an orbit that stays away.  Nothing here has to be believed: the checker
certifies all that is said.

In reading order, each importing those before it only:

- `limits`: the constants that steer the searches.
- `terms`: terms and formulas as text, evaluated in floats, rationals and SymPy.
- `maps`: maps as text, read from a file or a map rule.
- `premise_searches`: searches for proofs of a premise that a family of functions suggests.
- `certifying`: candidates, and statements that are certified within counted work.
- `samples`: samples of parameters and states; points that move with the parameters.
- `points`: fixed points by elimination, and their multipliers.
- `domains`: for which parameters a fixed point can be stable.
- `functions`: functions that fall along all orbits, or grow close to a point.
- `entering`: boxes that every orbit enters.
- `refuting`: periodic orbits in exact terms.
- `settings`: a fixed point with a part of the domain.
- `findings`: what certified statements say of the map, as a sentence.
- `attracting`: the list of strategies that show a point to be stable and to attract every state.
- `failing`: that a point is not stable, or does not attract every state.
- `points_as_parameters`, `points_by_equation`: fixed points that square roots do not express. Such
  a point takes the place of a parameter, or is a further one, with an equation in the domain.
- `search`: all of it, in order, and the outcome.
- `claiming`: the same as a claim of one's own.
"""
