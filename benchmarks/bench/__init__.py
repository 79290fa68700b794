"""`juggleproof bench`: the paper's bounds and orbits by every method in one run, error against
seconds.  In reading order:

    answers    questions to methods, and their answers
    questions  the questions about energy, from the derived expressions
    orbits     orbits and ensembles as work
    blocks     blocks that fall on the vibrating table as work
    numerics   methods in interval arithmetic
    floats     methods in floating point
    solvers    methods that ask Z3, cvc5, QEPCAD B or Coq
    qepcad     how QEPCAD B is asked
    methods    our method, and the table of all methods
    child      one method on one piece of work, in a process of its own
    table      the measurements, as text and as a plot
    run        the whole benchmark
"""
