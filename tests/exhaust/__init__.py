"""`make exhaust`: what is too long for every run, in stages that are run when what they depend on
has changed; the committed record says on what each was run.

sources    what a stage depends on
stages     all stages
record     the lines of record.tsv
lanes      stages run side by side, each timed
fresh      claims searched anew, against the register
wide       the wide cover of the sine from nothing
reports    a report twice
peers      the tests that need other solvers and engines
__main__   the command
"""
