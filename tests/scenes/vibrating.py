"""Amplitude, phase and energy of a bar that has vibrated for ten periods."""

import csv
from math import atan2, cos, hypot, pi, sin

from driver import expect, run_scene

OMEGA = pi / 5
PERIOD = 10.
STATIC = 1 / pi**2  # amplitude of the centre's path [m]


def last_period():
    """Amplitude and phase of the centre's path, fitted to the tenth period."""
    with open("run/history.csv") as file:
        rows = [(float(row["time"]), float(row["centre path"]))
                for row in csv.DictReader(file)]
    rows = [row for row in rows if 9 * PERIOD + 1e-6 < row[0] < 10 * PERIOD + 1e-6]
    sine = sum(path * sin(OMEGA * time) for time, path in rows) * 2 / len(rows)
    cosine = sum(path * cos(OMEGA * time) for time, path in rows) * 2 / len(rows)
    return hypot(sine, cosine) / STATIC, atan2(cosine, sine)


def main():
    results = run_scene("beyond/vibrating-bar.prm", "run",
                        ["Output/Pictures every = 0"])["results"]
    amplitude, phase = last_period()
    # Newmark's period is too long by (w dt)^2/12.
    newmark = -OMEGA * 9.5 * PERIOD * (OMEGA * 0.05) ** 2 / 12
    energy = results["energy total"]["value"] / 0.03125 - 1
    print(f"amplitude {amplitude:.5f}, phase {phase:.4f} rad, of which "
          f"Newmark's {newmark:.4f}, energy {energy:.1e}")
    expect(abs(amplitude - 1) < 3e-3, "amplitude")
    expect(abs(phase - newmark) < 0.02, "phase")
    expect(-3e-3 < energy < 1e-6, "energy")


main()
