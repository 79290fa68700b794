"""Stored statements as lemmas of Coq, each proved by its certificate.

- `text`: polynomials and formulas as Coq text, and what every file begins with;
- `branch`: branches of a written proof, and signs of products as proof terms;
- `boxes`: box trees as tactics;
- `transfer`: statements as Coq text, and formulas at values;
- `rules`: the proof rules as tactics;
- `values`: points, witnesses and counterexamples as tactics;
- `lemmas`: the lemmas of a statement.
"""

from juggleproof.certificates.coq.lemmas import lemmas
from juggleproof.certificates.coq.text import PRELUDE, NotWritten

__all__ = ["PRELUDE", "NotWritten", "lemmas"]
