"""Programs that a benchmark runs, each in a session of its own, so that it is ended with its
children when its seconds are over, or when its caller is.
"""

from __future__ import annotations

import os
import signal
import subprocess
import time

GRACE = 2.0  # seconds that a process has to end its own children


class Clock:
    """The seconds that are left for one statement, however many questions it asks."""

    def __init__(self, seconds: float) -> None:
        self.end = time.monotonic() + seconds

    def output_of(self, command: list[str], text: str) -> str | None:
        """What the program writes when it reads the text; None where it is not done in time."""
        process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        try:
            return process.communicate(text, timeout=max(0.0, self.end - time.monotonic()))[0]
        except subprocess.TimeoutExpired:
            return None
        finally:
            kill_with_children(process)


def kill_with_children(process: subprocess.Popen[str] | subprocess.Popen[bytes]) -> None:
    """Kills a process that leads a session, and those that it started in that session; nothing
    where it has ended.
    """
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


def end_with_children(process: subprocess.Popen[str] | subprocess.Popen[bytes]) -> None:
    """Asks a process to end, which gives it time to end what it started; kills it where it does
    not.
    """
    if process.poll() is None:
        process.terminate()
        try:
            process.wait(GRACE)
        except subprocess.TimeoutExpired:
            kill_with_children(process)
    for stream in (process.stdin, process.stdout, process.stderr):
        if stream is not None:
            stream.close()
