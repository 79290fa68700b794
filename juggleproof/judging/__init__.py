"""Claims, how they are judged, and what is registered of them.

In reading order, each importing those before it only:

- `evaluating`, `strength`: terms and formulas at rational values; counterexamples at simple ones,
  and how strong they are.
- `claims`, `forms`: an assertion with its place and print, the statements that it makes, verdicts.
- `correcting`: prints that may mend a refuted one.
- `conclusions`, `orbit_rules`: what a certified rule for orbits says; rules as a claim writes them.
- `searches`: certificates, votes and sharp ranges are searched, which loads when first asked.
- `rule_ranges`: the parameters for which the conclusion of a rule is proved.
- `judgement`, `judge`: one claim, stated, settled by the checker, corrected, with its sharp range.
- `register`: the verdicts that stand.
- `checked`, `run`: the checker's outcomes of what is stored; many claims over processes.
- `bounds`: certified enclosures of minima.
- `report_cache`, `extras`: reports kept between runs; libraries of the optional extras.
"""
