"""Claims, their judgement, and the register of their verdicts."""
