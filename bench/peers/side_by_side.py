#!/usr/bin/env python3
"""Spall against Yade CpmMat on the same spheres and links, turn by turn on one core of the same machine.

    bench/peers/side_by_side.py --program build/release/bench/spall_performance --output out/bench

Both programs stay loaded, pinned to one core; one steps while the other waits for its turn. What counts is links times
steps over seconds of the loop, for both, in the process's own processor time: what other processes take of the core is in
neither. Writes yade.json, which spall_performance puts into its table, and prints one
line a size. `./dev bench peers` installs Yade (the Debian package) and runs this.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parent


class Peer:
    """A program that answers a line "steps" with the seconds that they took."""

    def __init__(self, name, command, core, environment=None):
        self.name = name
        self.process = subprocess.Popen(["taskset", "-c", str(core), *command], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                        env={**os.environ, "OMP_NUM_THREADS": "1", **(environment or {})})
        self.links = int(self.answer("ready"))

    def answer(self, word):
        """What follows `word`, in the next line that begins with it."""
        for line in self.process.stdout:
            if line.startswith(word):
                return line.split()[1]
        self.process.stdin.close()
        sys.exit(f"side_by_side.py: {self.name} stopped: {self.process.stderr.read().strip()[-400:]}")

    def seconds(self, steps):
        self.process.stdin.write(f"{steps}\n")
        self.process.stdin.flush()
        return float(self.answer("seconds"))

    def rate(self, steps):
        """Million link updates a second."""
        return 1e-6 * self.links * steps / self.seconds(steps)

    def close(self):
        self.process.stdin.close()
        self.process.stdout.read()
        self.process.wait()


def measure(elements, program, turns, turn_seconds, core):
    with tempfile.TemporaryDirectory() as folder:
        specimen = pathlib.Path(folder) / "specimen.txt"
        subprocess.run([program, "--export", str(elements), "--to", str(specimen)], check=True)
        yade = Peer("Yade", ["yade", "-j1", "-n", "-x", str(FOLDER / "yade_cpm.py")], core,
                    {"SPALL_PEER_SPECIMEN": str(specimen)})
    spall = Peer("Spall", [program, "--serve", str(elements)], core)
    if spall.links != yade.links:
        sys.exit(f"side_by_side.py: {spall.links} links here, {yade.links} in Yade")

    # The same steps for both: as many as Yade makes in a turn's time.
    steps = max(5, round(turn_seconds / (yade.seconds(5) / 5)))
    ours, theirs = [], []
    for _ in range(turns):
        theirs.append(yade.rate(steps))
        ours.append(spall.rate(steps))
    yade.close()
    spall.close()
    return {"elements": elements, "links": spall.links, "steps": steps, "spall": ours, "yade": theirs,
            "spall_million": statistics.median(ours), "yade_million": statistics.median(theirs),
            "ratio": [a / b for a, b in zip(ours, theirs)]}


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("elements", nargs="*", type=int, help="2700, 18672, 120808; all by default")
    options.add_argument("--program", required=True, help="the built spall_performance")
    options.add_argument("--output", default="out/bench", type=pathlib.Path)
    options.add_argument("--turns", default=7, type=int)
    options.add_argument("--turn-seconds", default=3.0, type=float, help="of Yade, in one turn")
    options.add_argument("--core", default=max(os.sched_getaffinity(0)), type=int)
    wanted = options.parse_args()

    sizes = []
    for elements in wanted.elements or (2700, 18672, 120808):
        one = measure(elements, wanted.program, wanted.turns, wanted.turn_seconds, wanted.core)
        sizes.append(one)
        print(f"{elements:>7} elements, {one['links']} links, {one['steps']} steps a turn: "
              f"Spall {one['spall_million']:.1f}, Yade {one['yade_million']:.2f} million link updates a second; "
              f"ratio {statistics.median(one['ratio']):.1f} "
              f"({min(one['ratio']):.1f} to {max(one['ratio']):.1f}, {wanted.turns} turns)", flush=True)
    wanted.output.mkdir(parents=True, exist_ok=True)
    aside = wanted.output / "yade.json.part"
    aside.write_text(json.dumps({"sizes": sizes}, indent=2) + "\n", encoding="ascii")
    aside.rename(wanted.output / "yade.json")


if __name__ == "__main__":
    main()
