"""A reader of every certificate that was written from two pages alone, docs/statement-language.md
and docs/certificates.md, and shares no code with the checker.  In reading order:

syntax: tokens, terms and formulas, definitions written out
statements: the file of statements
meaning: values of terms, licences and normal forms, over python-flint's polynomials
bernstein: Bernstein coefficients on a box
proofs: states, and the rules that close them
orbits: the premises of the rules on orbits
settling: proofs, found values, sharp ranges, and files of certificates
"""
