#!/usr/bin/env python3
"""A steel ball strikes a slab; then the pictures that the run left are read with numpy.

    python3 impact_and_read.py --speed "40 m/s" -o impact

The frames in the folder are VTKHDF: ParaView opens frames/elements.hdf.series as it is, and h5py reads each file.
Spall's own reader needs neither.
"""
import argparse
import pathlib

import numpy

import spall


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--speed", default="40 m/s")
    parser.add_argument("--duration", default="1 ms")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("impact"))
    arguments = parser.parse_args()

    scene = {
        "model": "de",
        "card": spall.example_card(),
        "structure": {"size": "0.3x0.3x0.08 m", "elements": 3000},
        "support": [
            {"name": "left", "low": "0,0,0 m", "high": "0.03,0.3,0.08 m", "lock": ["z"]},
            {"name": "right", "low": "0.27,0,0 m", "high": "0.3,0.3,0.08 m", "lock": ["z"]},
        ],
        "impactor": {"shape": "sphere", "diameter": "40 mm", "density": "7850 kg/m3", "speed": arguments.speed,
                     "aim": "0.15,0.15,0.04 m"},
        "probe": [{"name": "under", "point": "0.15,0.15,0 m"}],
        "run": {"duration": arguments.duration, "samples": 200},
        "output": {"frames": 5},
    }
    result = spall.run_impact(scene, frames=arguments.output / "frames", progress=True)
    result.write(arguments.output)  # result.json, curves.csv, history.h5, fragments.csv

    force = numpy.linalg.norm(result.history["force"], axis=1)
    when = result.history["time"][force.argmax()]
    print(f"peak force {force.max() / 1e3:.4g} kN at {1e3 * when:.3g} ms; {result.broken_links} of {result.links} links broken")

    frames = spall.read_frames(arguments.output / "frames")
    for time, grid in zip(frames.times, frames):
        damage = grid.point_data["damage"]
        speed = numpy.linalg.norm(grid.point_data["velocity"], axis=1)
        print(f"{1e3 * time:.3f} ms: {(damage > 0.5).sum()} elements have lost more than half their links, "
              f"the fastest goes at {speed.max():.3g} m/s")

    # The same file without Spall, where h5py is installed.
    try:
        import h5py
    except ImportError:
        return
    with h5py.File(frames.files[-1], "r") as file:
        radius, damage = file["VTKHDF/PointData/radius"][:], file["VTKHDF/PointData/damage"][:]
    volume = 4 / 3 * numpy.pi * radius**3
    print(f"{100 * volume[damage > 0.5].sum() / volume.sum():.3g}% of the solid volume is damaged by more than half")


if __name__ == "__main__":
    main()
