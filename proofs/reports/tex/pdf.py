"""Compiles the LaTeX report: latexmk in a folder of its own, with dates and ids left out so that
equal sources make equal bytes.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

from certificates.terms import ClaimError

TOO_WIDE = 5.0  # points that a line may stick out


def compiled(files: Mapping[str, bytes], document: str) -> tuple[bytes, list[str]]:
    """The PDF of a document among the files, and what the log complains of: undefined references,
    lines too wide.

    Raises ClaimError, one line, where latexmk is absent or finds an error.
    """
    if not shutil.which("latexmk") or not shutil.which("pdflatex"):
        raise ClaimError(
            "latexmk and pdflatex are needed for the PDF; Debian's packages are latexmk,"
            " texlive-latex-recommended and lmodern"
        )
    with tempfile.TemporaryDirectory() as folder:
        for name, content in files.items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        done = subprocess.run(
            ["latexmk", "-pdf", "-interaction=nonstopmode", "-halt-on-error", f"{document}.tex"],
            cwd=folder,
            capture_output=True,
            check=False,
            env={
                **os.environ,
                "SOURCE_DATE_EPOCH": "0",
                "FORCE_SOURCE_DATE": "1",
                "max_print_line": "10000",
            },
        )
        log_file, made = Path(folder) / f"{document}.log", Path(folder) / f"{document}.pdf"
        log = log_file.read_text(encoding="latin-1") if log_file.exists() else ""
        if done.returncode or not made.exists():
            errors = (
                re.findall(r"^! .*", log, re.MULTILINE)
                or done.stderr.decode("utf-8", "replace").splitlines()[-1:]
            )
            raise ClaimError(
                f"{document}.tex: LaTeX stops: {' '.join(errors[:1]) or 'no reason is given'}; the"
                " .tex files are written"
            )
        return made.read_bytes(), complaints(log)


def complaints(log: str) -> list[str]:
    """What a log complains of that a reader would see.

    >>> log = "LaTeX Warning: Reference `a' on page 1 undefined on input line 2.\\n"
    >>> log += "Overfull \\\\hbox (7.3pt too wide) in paragraph\\n"
    >>> print(*complaints(log), sep="\\n")
    LaTeX Warning: Reference `a' on page 1 undefined on input line 2.
    Overfull \\hbox (7.3pt too wide) in paragraph
    """
    found = re.findall(
        r"^LaTeX Warning: (?:Reference|Citation|Label).*|^.*multiply[- ]defined.*|^.*undefined"
        r" references.*",
        log,
        re.MULTILINE,
    )
    wide = re.findall(r"^Overfull \\[hv]box \(([\d.]+)pt too (?:wide|high)\).*", log, re.MULTILINE)
    lines = re.findall(r"^(Overfull \\[hv]box \([\d.]+pt too (?:wide|high)\).*)", log, re.MULTILINE)
    return [
        *dict.fromkeys(found),
        *(line for width, line in zip(wide, lines) if float(width) > TOO_WIDE),
    ]
