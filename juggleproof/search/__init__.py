"""The untrusted search: finds certificates that the checker then reads; nothing here has to be
believed.

The files and folders, each after those that it imports:

- `psatz`: one leaf, where facts contradict one another; rule `psatz`
- `small_proofs`: what needs little work; linear statements; the searches in turn
- `boxes`: lower bounds of polynomials on boxes, and states over boxes; rules `boxes`, `psatz`,
  `sign`
- `one_variable`: states over one variable, all of them
- `by_variables`: forms that are no sums of squares, by cases of a variable; rules `sign`, `psatz`
- `closing`: a whole state; rules `close`, `cases`, `sign`, `integral`, `boxes`, `use`
- `at_one_number`: a state whose only variable is an algebraic number
- `decrease_proofs`: proofs that a function of a map falls; rules `sign`, `psatz`
- `candidates`: simple values for one variable
- `terms`: quotients and square roots proposed for unknowns
- `samples`: exact values for all variables of a condition
- `hints`: what Z3 and floats suggest: votes, models, conflicts of clauses
- `scales`: the scales of a statement, a state with scales set to 1, and the way back
- `templates`: terms for unknowns, tried on samples
- `witness_terms`: what terms are sought for, and how the checker takes them
- `ranges`: sets of one parameter, and verdicts along it
- `families_on_a_line`: terms over one parameter, piece by piece
- `families`: terms on all of a state, split by signs; conditions solved for a parameter
- `towers_of_roots`: points by equations, each root over the ones before it
- `points`: points, counterexamples and witnesses, as the checker's `finds` takes them
- `certificate`: the certificate of a statement for all reals or of existence, and of map rules:
  `universal`, `iterates`, `map`, `relation`, `descends`, `contracts`, `lyapunov`, `attracts`,
  `into`, `escapes`, `unstable`, `exactly`, `settles`, `returns`
- `sharp`, `sharp_plane`: sharp ranges over one parameter, or over several; rule `sharp`

What takes a budget raises `Exhausted` where that ends, unless its docstring has what it returns
then.

Roles (`statements.language.Roles`) come with each statement: its parameters with their domains,
and its scales.
"""

import os

os.environ.setdefault(
    "OPENBLAS_NUM_THREADS", "1"
)  # before NumPy is loaded: sums in one order, whatever the number of cores
