"""A proof checker for one dynamical-systems paper, and for inequalities and maps of one's own.

`symbolic` derives what the paper defines, `proofs` states what it says, `certificates` finds and
checks certificates, `scenes` iterates the maps, `benchmarks` measures.  The folders stand beside
this one in the checkout and are linked here, so that one import name holds all of them.
"""
