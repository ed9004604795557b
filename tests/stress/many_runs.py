"""Runs in one process of many_runs, which spares their start-up."""

import json
import os
import subprocess
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("IMPOINT_MANY_RUNS",
                         SOURCE / "build/tests/stress/many_runs")


class Runs:
    """A call is a run; it gives status, message and summary."""

    def __init__(self):
        self.process = None

    def __call__(self, scene, settings):
        if self.process is None or self.process.poll() is not None:
            self.process = subprocess.Popen(
                [PROGRAM, str(Path("results").resolve())],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL, text=True)
        self.process.stdin.write("\t".join([str(scene), *settings]) + "\n")
        self.process.stdin.flush()
        while True:
            answer = self.process.stdout.readline()
            if not answer:
                return "crash", f"exit {self.process.wait()}", None
            if answer[:1] in "012" and answer[1:2] in (" ", "\n"):
                break
        if answer[0] == "0":
            return "done", "", json.loads(Path("results/summary.json").read_text())
        return "message", answer[2:].strip(), None
