"""Runs the checker alone, as `python -I -S certificates/checker [DIR]`.

What it runs is the package `checker`, the same files that others import under a longer name.
"""

# The standard library comes first, from its own place: no file beside this folder can stand in for
# a part of it.
import ast  # noqa: F401
import collections.abc  # noqa: F401
import enum  # noqa: F401
import fractions  # noqa: F401
import functools  # noqa: F401
import gc
import hashlib
import json  # noqa: F401
import keyword  # noqa: F401
import math  # noqa: F401
import os
import re  # noqa: F401
import stat  # noqa: F401
import sys
import typing  # noqa: F401

# What is run from here on is the text of the files: no compiled code that lies beside it, stale or
# forged.  This file alone can be replaced by such code, in __pycache__, before it says so: who
# fears that runs `python -I -S -X pycache_prefix=/dev/null certificates/checker`.
sys.dont_write_bytecode = True
sys.pycache_prefix = os.devnull
# The package is found as this folder, before any other of its name; nothing else is found there.
FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.dirname(FOLDER)]

from checker import main  # type: ignore[import-not-found]  # noqa: E402

del sys.path[0]
# A run says which text was believed in it.
for name in sorted(name for name in os.listdir(FOLDER) if name.endswith(".py")):
    with open(os.path.join(FOLDER, name), "rb") as file:
        print(f"{name:12} sha256 {hashlib.sha256(file.read()).hexdigest()}")

gc.disable()  # the checker makes no cycles: looking for them is a fifth of the time
sys.exit(main(sys.argv[1:]))
