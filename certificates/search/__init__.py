"""The untrusted search: finds certificates that the checker then reads; nothing here has to be
believed.
"""

import os

os.environ.setdefault(
    "OPENBLAS_NUM_THREADS", "1"
)  # before NumPy is loaded: sums in one order, whatever the number of cores
