#!/usr/bin/env python3
"""What one parameter of the card does to the strengths: a study over its values, plotted.

    python3 sweep_and_plot.py --parameter zeta --from 2 --to 12 --points 5 -o sweep.png

The study is kept in a folder: the same call again computes nothing, another with more points only what is new.
"""
import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")  # to a file, with or without a screen

import numpy
from matplotlib import pyplot

import spall


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--parameter", default="zeta", help="a number of the card that has no unit: zeta, nu, ...")
    parser.add_argument("--from", dest="low", type=float, default=2)
    parser.add_argument("--to", dest="high", type=float, default=12)
    parser.add_argument("--points", type=int, default=5)
    parser.add_argument("--folder", default="sweep", help="keeps the results")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("sweep.png"))
    arguments = parser.parse_args()

    study = {
        "name": "sweep",
        "card": spall.example_card(),
        "vary": {arguments.parameter: numpy.linspace(arguments.low, arguments.high, arguments.points)},
        "specimen": [{"name": "prism", "size": "0.4x0.2x0.2 m", "elements": 1400, "seeds": [1]}],
        # Fast, and over soon after the peak: what a look needs.
        "test": [{"kind": "tension", "rate": 0.1, "stop_at": 0.8}],
    }
    table = spall.run_study(study, arguments.folder, progress=True)
    rows = table.columns(test="tension")
    value, strength = rows["card." + arguments.parameter], rows["peak_stress"] / 1e6
    for pair in zip(value, strength):
        print("{} = {:.4g}: ft = {:.4g} MPa".format(arguments.parameter, *pair))

    figure, axes = pyplot.subplots(figsize=(6, 4), layout="constrained")
    axes.plot(value, strength, "o-")
    axes.set(xlabel=f"{arguments.parameter} [-]", ylabel="tensile strength [MPa]")
    figure.savefig(arguments.output, dpi=150)
    print("picture:", arguments.output)


if __name__ == "__main__":
    main()
