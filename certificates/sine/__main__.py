"""Runs the second checker alone, as `python -I -S certificates/sine [DIR]`.

What it runs are the files that others import under a longer name.
"""

# The standard library comes first, from its own place, as in the first checker's `__main__`.
import array  # noqa: F401
import base64  # noqa: F401
import binascii  # noqa: F401
import collections.abc  # noqa: F401
import fractions  # noqa: F401
import functools  # noqa: F401
import gc
import hashlib
import json  # noqa: F401
import math  # noqa: F401
import os
import re  # noqa: F401
import stat  # noqa: F401
import sys
import typing  # noqa: F401
import zlib  # noqa: F401

sys.dont_write_bytecode = True
sys.pycache_prefix = os.devnull
FOLDER = os.path.dirname(os.path.abspath(__file__))
FIRST = os.path.join(os.path.dirname(FOLDER), "checker")
sys.path[:0] = [os.path.dirname(os.path.dirname(FOLDER))]

from certificates.sine.checker import main  # noqa: E402

del sys.path[0]
# A run says which text was believed in it: of the first checker, the meter of work and `load`.
OWN = "flights.py", "cells.py", "checker.py"
for folder, names in ("sine", OWN), ("checker", sorted(os.listdir(FIRST))):
    for name in names:
        if name.endswith(".py"):
            with open(os.path.join(os.path.dirname(FOLDER), folder, name), "rb") as file:
                print(f"{folder}/{name:12} sha256 {hashlib.sha256(file.read()).hexdigest()}")

gc.disable()
sys.exit(main(sys.argv[1:]))
