"""Problems written as SMT-LIB 2 scripts: read as statements, answered with certificates and exact
models.  In reading order:

    sexpr       S-expressions: words and lists, each with its line
    values      real terms in cases, and names for parts that are too large
    terms       values      real terms in cases, and names for parts that are too large
    terms of the theory of reals in our language
    script      commands, and the problem that each `check-sat` asks
    statements  the statement of a problem, where it divides too
    answering   its answer, and the certificates kept beside its script
"""
