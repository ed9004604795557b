"""What "cmake --install" brings runs a scene that it brings, where it was brought."""

import os
import subprocess
from pathlib import Path

import driver
from driver import expect

PLACE = Path("installed").resolve()


def main():
    build = Path(driver.PROGRAM).parent
    environment = {name: value for name, value in os.environ.items()
                   if name != "DESTDIR"}
    subprocess.run(["cmake", "--install", str(build), "--prefix", str(PLACE)],
                   check=True, capture_output=True, env=environment)
    process = subprocess.run(
        [PLACE / "bin/impoint", PLACE / "share/impoint/prm/quickstart.prm",
         "--output", "results", "--overwrite"], capture_output=True, text=True)
    expect(process.returncode == 0 and "tip u_y" in process.stdout,
           process.stdout + process.stderr)
    for name in ("README.md", "LICENSE", "doc/intro.md"):
        expect((PLACE / "share/doc/impoint" / name).exists(), f"no {name}")
    scenes = {folder: {path.relative_to(folder) for path in folder.rglob("*.*")}
              for folder in (driver.SCENES, PLACE / "share/impoint/prm")}
    first, second = (set(path for path in files if "output" not in path.parts)
                     for files in scenes.values())
    expect(first == second, f"{first ^ second} is not installed")
    print(f"program and {len(second)} files of scenes: installed, run")


main()
