"""Stored statements as lemmas of Coq, each proved by its certificate.

- `text`: polynomials and formulas as Coq text, and what every file begins with;
- `branch`: branches of a written proof, and signs of products as proof terms;
- `boxes`: box trees as tactics;
- `transfer`: statements as Coq text, and formulas at values;
- `rules`: the proof rules as tactics;
- `values`: points, witnesses and counterexamples as tactics;
- `roots`: the lemma that a polynomial has one root in an interval;
- `lemmas`: the lemmas of a statement;
- `files`: a whole store as files of Coq, and which statements are written.
"""

from juggleproof.coq_store.files import export, share_of, write
from juggleproof.coq_store.lemmas import lemmas
from juggleproof.coq_store.text import PRELUDE, NotWritten

__all__ = ["PRELUDE", "NotWritten", "export", "lemmas", "share_of", "write"]
