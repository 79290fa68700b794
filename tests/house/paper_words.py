"""Words of the paper of this project, which the tool does not know."""

from __future__ import annotations

import re

WORDS = re.compile(
    r"(?i:swanson|burridge|koditschek|\bjuggl(?:e|er|ers|ing)\b|restitution|\bbounc\w*|parts-feed"
    r"|\bpaddle|\bthe ball(?:'s|’s)|appendix b\b)"
    r"|\bB_?[12]\b|\\dot\\rho|\\mathcal\{?[BHR]|\\jugH\b|theorem-(?:by-hand|in-units|one-third|region)"
    r"|region-scaling|what-moves|part-scene|0 < alpha < 1"
)
