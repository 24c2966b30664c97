#!/usr/bin/env python3
"""Memory and time of the real commands for N elements: the table of docs/limits.md.

    ./dev bench limits [N ...]      or   bench/limits.py --program build/release/app/spall 10000 1000000

For each N: spall specimen make of a bar 2:1:1, then the first steps of spall test tension on it (--max-strain ends it), and from that
how long the whole test would take. Two threads. Prints a row a size, in Markdown.
"""
import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time

CARD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "cards", "paper-slab-co-3.6.toml")
# Elastic strain at the expected strength of this card is 8e-5; the whole test ends near 2e-4.
FIRST_STEPS = {"--max-strain": "1e-6"}


def run(words):
    """What it printed, its seconds and the peak of its memory in bytes."""
    start = time.monotonic()
    child = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    said, complaint = child.communicate()
    if child.returncode not in (0, 4):
        sys.exit(f"limits: {' '.join(words)}: exit code {child.returncode}: {complaint}")
    return said, time.monotonic() - start


def peak_of(words):
    """The same in a process of its own, so that its peak is known."""
    reader, writer = os.pipe()
    pid = os.fork()
    if pid == 0:
        os.close(reader)
        said, seconds = run(words)
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024
        with os.fdopen(writer, "w") as out:
            json.dump({"said": said, "seconds": seconds, "peak": peak}, out)
        os._exit(0)
    os.close(writer)
    with os.fdopen(reader) as what:
        text = what.read()
    _, status = os.waitpid(pid, 0)
    if status != 0 or not text:
        sys.exit(1)
    return json.loads(text)


def row(spall, elements, where):
    specimen = os.path.join(where, f"{elements}.h5")
    made = peak_of([spall, "specimen", "make", "--size", "0.5x0.25x0.25 m", "--elements", str(elements), "--seed", "1",
                    "--threads", "2", "--json", "-o", specimen])
    links = json.loads(made["said"])["links"]
    out = os.path.join(where, "out")
    words = [spall, "test", "tension", "--specimen", specimen, "--card", CARD, "--threads", "2", "--json", "--frames", "0", "-o", out]
    for name, value in FIRST_STEPS.items():
        words += [name, value]
    tested = peak_of(words)
    result = json.loads(tested["said"])
    steps = result["steps"]
    file_size = os.path.getsize(specimen)
    each = result["step_loop_seconds"] / steps
    os.remove(specimen)
    return [f"{elements:,}", f"{links:,}", f"{made['seconds']:.3g} s", f"{made['peak'] / 1e6:,.0f} MB", f"{file_size / 1e6:,.1f} MB",
            f"{tested['peak'] / 1e6:,.0f} MB", f"{1e3 * each:.3g} ms", f"{steps:,} in {tested['seconds']:.3g} s"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("elements", nargs="*", type=int, default=[2_700, 20_000, 120_808, 1_000_000])
    parser.add_argument("--program", default="build/release/app/spall")
    options = parser.parse_args()
    names = ["elements", "links", "made in", "peak", "file", "a test's peak", "a step", "steps, with reading and writing"]
    print("| " + " | ".join(names) + " |\n" + "|---" * len(names) + "|", flush=True)
    with tempfile.TemporaryDirectory(prefix="spall-limits-") as where:
        for elements in options.elements:
            print("| " + " | ".join(row(os.path.abspath(options.program), elements, where)) + " |", flush=True)


if __name__ == "__main__":
    main()
