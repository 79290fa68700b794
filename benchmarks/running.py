"""A peer's program in a process of its own, killed with its children when the seconds of the statement are over."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from typing import Literal

Answer = Literal["holds", "fails", "unsettled", "not expressible"]


class Clock:
    """The seconds that are left for one statement, however many questions it asks."""

    def __init__(self, seconds: float) -> None:
        self.end = time.monotonic() + seconds

    def output_of(self, command: list[str], text: str) -> str | None:
        """What the program writes when it reads the text; None where it is not done in time."""
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   start_new_session=True)
        try:
            return process.communicate(text, timeout=max(0.0, self.end - time.monotonic()))[0]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return None
