"""Problems written as SMT-LIB 2 scripts: read as statements, answered with certificates and exact
models.
"""
