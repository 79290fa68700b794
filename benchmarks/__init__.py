"""Comparisons of proof engines, and speed against error; may import everything, and nothing imports
it but `juggleproof bench`.

    bench      the paper's bounds and orbits by every method: `juggleproof bench`
    processes  programs in processes of their own, which are ended in time
    figures    plots as SVG
    problems   our set of SMT-LIB problems, twelve scripts
    classes    random SMT-LIB problems by classes: Z3, cvc5 and ours
    bounds     minima of the literature, enclosed and checked
    stability  the maps in examples: what is proved, and by a semidefinite program
    sine       the table that moves as a sine: growth with width, distance to the edges, processes
    feeder     drives and amplitudes that the certificates of that table hold for
    wedge      the share of the area between its curves that they cover
    words      words of flights that no ball follows, for `settles`
    commands   whole commands: seconds and memory

Each but `bench`, `processes` and `figures` is run as `python -m juggleproof.benchmarks.NAME`.
"""
