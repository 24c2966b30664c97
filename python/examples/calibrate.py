#!/usr/bin/env python3
"""From laboratory curves to a material card, and a picture of how well it fits.

    python3 calibrate.py my_curves/*.csv --strength-class C40/50 -o fit

Each CSV is one specimen of a compression test with units in its header, as strain[-],stress[MPa]. Without files the
curves of data/curves/bam-m7 are taken. The tensile strength is that of the strength class, since nobody measured it.
"""
import argparse
import pathlib

import spall

DATA = pathlib.Path(__file__).resolve().parents[2] / "data" / "curves" / "bam-m7"


def case_of(arguments):
    """The case: the keys are those of a case.toml, see docs/cases.md."""
    compression = {"curves": [str(file) for file in arguments.curves], "ends": "fixed"}
    if not arguments.curves:
        # Gauges lose their meaning once cracks run past them: after the peak the machine's strain takes over.
        compression.update(curves=[str(DATA / "bam_thiele_M7_*_uniaxial_compression.csv")], strain="strain_gauge_mean",
                           post_peak_strain="strain_platen", only_rows={"column": "phase", "equals": 1})
    if arguments.quick:
        compression["rate"] = 0.05
    return {
        "name": "example",
        "specimen": {"shape": "cylinder", "size": arguments.size, "elements": arguments.elements, "fit_seeds": [1],
                     "check_seeds": [] if arguments.quick else [101]},
        "compression": compression,
        "tension": {"rate": 0.1} if arguments.quick else {},
        "code": {"strength_class": arguments.strength_class, "use": ["ft"]},
        "fixed": {"Co": "60 MPa"},
    }


def plot(fit, file):
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6, 4), layout="constrained")
    measured = fit.laboratory("compression")
    axes.fill_between(1e3 * measured["strain"], measured["low"] / 1e6, measured["high"] / 1e6, alpha=0.3, label="laboratory")
    axes.plot(1e3 * measured["strain"], measured["stress"] / 1e6, label="laboratory, mean")
    for curve in fit.curves("compression"):
        axes.plot(1e3 * curve["strain"], curve["stress"] / 1e6, linestyle="-" if curve["seen"] else "--",
                  label=f"virtual, {curve['label']}")
    axes.set(xlabel="strain [‰]", ylabel="stress [MPa]")
    axes.legend()
    figure.savefig(file, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("curves", nargs="*", type=pathlib.Path, help="CSV files, one a specimen")
    parser.add_argument("--strength-class", default="C40/50")
    parser.add_argument("--size", default="98.6x300 mm", help="diameter and length of the cylinders")
    parser.add_argument("--elements", type=int, default=2000)
    parser.add_argument("--quick", action="store_true", help="a rough fit, for a first look")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("fit"))
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)

    fit = spall.calibrate(case_of(arguments), journal=arguments.output / "journal.h5", resume=True, progress=True)
    for target in fit.targets:
        print(f"{target['words']:32} {target['achieved'] / target['scale']:.4g} {target['unit']} against "
              f"{target['target'] / target['scale']:.4g}: {'met' if target['met'] else 'MISSED'}")
    for warning in fit.warnings:
        print("warning:", warning)
    fit.write(arguments.output)  # card.toml, result.json, curves.csv
    plot(fit, arguments.output / "curves.png")
    print(f"card: {arguments.output / 'card.toml'}, picture: {arguments.output / 'curves.png'}")


if __name__ == "__main__":
    main()
