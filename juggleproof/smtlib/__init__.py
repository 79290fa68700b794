"""Problems written as SMT-LIB 2 scripts: read as statements, answered with certificates and exact
models.  In reading order:

    sexpr       S-expressions: words and lists, each with its line
    values      real terms in cases, and names for parts that are too large
    terms       terms of the theory of reals in our language
    script      commands, and the problem of each `check-sat`
    statements  the statement of a problem, also where it has divisions
    answering   the answer to a problem, and the certificates kept beside its script
"""
