"""A folder that looks to a script of the action as a runner of GitHub does."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
ACTION = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
SCRIPTS = [step for step in ACTION["runs"]["steps"] if "run" in step]


class Runner:
    """A folder that looks to a script as a runner of GitHub does; network and installation are
    stood in for.
    """

    def __init__(self, folder: Path) -> None:
        self.temp, self.work, self.tools = (
            folder / "temp dir",
            folder / "work dir",
            folder / "tools",
        )
        for one in (self.temp, self.work, self.tools):
            one.mkdir()
        self.calls, self.output, self.summary = (
            folder / "calls",
            folder / "output",
            folder / "summary",
        )
        self.venv = self.temp / "juggleproof-venv" / "bin"
        self.output.touch()
        self.summary.touch()

    def tool(self, name: str, script: str, folder: Path | None = None) -> None:
        path = (folder or self.tools) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"#!/bin/bash\n{script}\n", encoding="utf-8")
        path.chmod(0o755)

    def recorded(self, name: str, more: str = "") -> str:
        return f"printf '%s\\n' \"{name} $*\" >> '{self.calls}'\n{more}"

    def installed(self) -> None:
        """The command as it would be after the installation, from this tree."""
        self.tool("python", f"exec '{sys.executable}' \"$@\"", self.venv)
        self.tool(
            "juggleproof",
            f"PYTHONPATH='{ROOT}' exec '{sys.executable}' -P -m juggleproof.command.main \"$@\"",
            self.venv,
        )

    def run(
        self, name: str, path: str = "/usr/bin:/bin", **environment: str
    ) -> subprocess.CompletedProcess[str]:
        step = next(step for step in SCRIPTS if step["name"] == name)
        given = {
            key: ACTION["inputs"].get(key.lower(), {}).get("default", "")
            for key in step.get("env", {})
        }
        script = self.work.parent / "script.sh"
        script.write_text(step["run"], encoding="utf-8")
        of_github = {
            "RUNNER_TEMP": self.temp,
            "GITHUB_OUTPUT": self.output,
            "GITHUB_STEP_SUMMARY": self.summary,
            "GITHUB_ACTION_PATH": ROOT,
            "HOME": self.work,
        }
        return subprocess.run(
            ["bash", "--noprofile", "--norc", "-e", "-o", "pipefail", str(script)],
            cwd=self.work,
            capture_output=True,
            text=True,
            timeout=240,
            check=False,
            env={
                **given,
                "JUGGLEPROOF_CACHE": "off",
                "PATH": f"{self.tools}:{path}",
                **{name: str(value) for name, value in of_github.items()},
                **environment,
            },
        )

    def outputs(self) -> dict[str, str]:
        return dict(
            line.split("=", 1) for line in self.output.read_text(encoding="utf-8").splitlines()
        )

    def called(self) -> list[str]:
        return self.calls.read_text(encoding="utf-8").splitlines() if self.calls.exists() else []
