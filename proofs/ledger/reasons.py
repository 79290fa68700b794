"""Why an item of the paper may need no claim: a closed list, and the claims that no item of the paper carries."""

from __future__ import annotations

# An item that asserts something about the juggler has claims; only what asserts nothing may give one of these.
REASONS = {
    "heading": "names a section, a proof or a part of a table",
    "names": "gives or recalls a name or notation, or is a formula that only names a thing",
    "narrative": "says what the text does or hopes, or judges without stating anything exact",
    "modelling-assumption": "sets up the model and cannot follow from anything",
    "figure-or-table": "says what a figure or table shows",
    "reference": "only points to another place",
    "connective": "joins two formulas and adds nothing to them",
}
# These two are followed by the key of another item.
REASONS_WITH_KEY = {
    "part-of": "is a piece of that item, which carries the claims",
    "repeats": "the transcription prints that earlier item again at the same place",
}

# Claims about the paper's system that the paper itself does not print.
UNPRINTED = {
    "region-scaling": "the change to the normal form, through which every other claim is judged",
    "region-trap": "the trap of the theorem's proof, which stands in for the paper's last invariant set",
}
