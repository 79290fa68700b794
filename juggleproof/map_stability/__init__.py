"""The search for the stability of a map.  Only the map is given.  The search finds a fixed point
and a function that falls along all orbits, with the parameters for which it does, or an orbit that
stays away from the point.  None of it has to be believed: the checker certifies every statement.

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
- `failing`: proofs that a point is not stable, or does not attract every state.
- `points_as_parameters`, `points_by_equation`: fixed points that square roots do not express. Such
  a point replaces a parameter, or becomes one more parameter with an equation in the domain.
- `search`: the whole search, in order, and its outcome.
- `claiming`: stability as a claim of one's own.
"""
