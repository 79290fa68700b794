"""Every stored statement by our search, by our check, and by every peer, side by side in one run:
`python -m juggleproof.benchmarks.peers`.  In reading order:

    notation  questions in the notation of Coq and of QEPCAD B
    routes    the ways to decide a statement
    table     what was measured, as text and as a plot
    __main__  the whole run
"""
