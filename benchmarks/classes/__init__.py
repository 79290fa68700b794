"""Random problems of SMT-LIB by classes, from counted seeds, with and without a solution: how many
Z3, cvc5 and we decide, and the CPU seconds of each.

    writing      random polynomials, and scripts about them
    polynomials  few variables: boxes, forms, one variable, equations, several constraints
    scripts      divisions, size, many variables, commands
    classes      the classes and their problems
    measuring    the answers of each solver, and the table

Run as `python -m juggleproof.benchmarks.classes`.
"""
