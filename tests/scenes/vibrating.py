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


def bossak(radius, dt, n_steps):
    """Path of an oscillator of one mass that starts with a velocity, after each
    step of the scheme (its period is the bar's, its static path is 1)."""
    b = (radius - 1) / (radius + 1)
    gamma, beta = 0.5 - b, 0.25 * (1 - b) ** 2
    path, velocity, acceleration = 0, OMEGA, 0
    for _ in range(n_steps):
        guess = path + dt * velocity + dt**2 * (0.5 - beta) * acceleration
        new = -((OMEGA**2 * guess + b * acceleration)
                / (1 - b + OMEGA**2 * beta * dt**2))
        path = guess + dt**2 * beta * new
        velocity += dt * ((1 - gamma) * acceleration + gamma * new)
        acceleration = new
        yield path


def check_damping():
    """Steps of 0.5 s: what Bossak's scheme leaves of the vibration."""
    for radius in (0.8, 0):
        run_scene("beyond/vibrating-bar.prm", "damped",
                  ["Output/Pictures every = 0", "Time/Step = 0.5",
                   "Time/End time = 50", f"Time/Spectral radius = {radius}"])
        with open("damped/history.csv") as file:
            paths = [float(row["centre path"]) / STATIC
                     for row in csv.DictReader(file)]
        expected = list(bossak(radius, 0.5, len(paths)))
        error = max(abs(a - b) for a, b in zip(paths, expected))
        print(f"spectral radius {radius}: {max(expected[-20:]):.3f} left, "
              f"error {error:.1e}")
        expect(max(expected[-20:]) < 0.99, "nothing to damp")
        # the grid alone is 0.02 rad late, as above
        expect(error < 0.02, f"damping with spectral radius {radius}")


def check_start():
    """Load steps for a second, then motion: at rest under the same load; the
    opposite of the static path half a period after the load was taken away."""
    load, static = 1e-5, 1e-5 * 25**2 / (3 * 100)
    for left, end, expected in ((load, 3, static), (0, 6, -static)):
        results = run_scene(
            "beyond/vibrating-bar.prm", "started",
            ["Output/Pictures every = 0", "Time/Dynamic from = 1", "Time/Step = 0.05",
             f"Time/End time = {end}", "Bodies/bar/Initial velocity =",
             f"Bodies/bar/Body force = if(t < 1.01, {load}*min(1, t), {left}); 0"])["results"]
        path = results["centre path"]["value"]
        kinetic = results["energy kinetic"]["value"] / results["energy total"]["value"]
        print(f"from rest, load {left}: path {path / expected - 1:.1e}, "
              f"kinetic part of the energy {kinetic:.1e}")
        # (h / 2 L)^2 = 1e-4 is the grid's
        expect(abs(path / expected - 1) < (2e-3 if left == 0 else 2e-4), "path from rest")
        expect(left == 0 or kinetic < 1e-9, "at rest under the load of the start")


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
    check_damping()
    check_start()


main()
