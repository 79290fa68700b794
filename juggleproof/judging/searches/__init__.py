"""The searches for claims: certificates, votes, sharp ranges; the checker believes none of them.

- `unproved_premises`: the reason why a premise of a map rule has no proof;
- `range_search`: the search for a sharp range, and the text of a certified one;
- `claim_search`: certificates and votes for the statements of one claim.

A name loads its file when first used (PEP 562), so that a judgement by stored certificates loads no
search.
"""

from typing import TYPE_CHECKING

from juggleproof.lazy import lazy_names

if TYPE_CHECKING:
    from juggleproof.judging.searches.claim_search import ClaimSearch as ClaimSearch
    from juggleproof.judging.searches.range_search import ends_inside as ends_inside
    from juggleproof.judging.searches.range_search import search_sharp_range as search_sharp_range
    from juggleproof.judging.searches.range_search import text_of_range as text_of_range
else:
    LAZY = {
        ".claim_search": "ClaimSearch",
        ".range_search": "ends_inside search_sharp_range text_of_range",
    }
    __all__, __getattr__, __dir__ = lazy_names(__name__, LAZY)
