"""The examples: they run as they stand, on small problems, and leave what they say."""
import pathlib
import runpy
import subprocess
import sys

import pytest


def run(source, tmp_path, name, *arguments):
    done = subprocess.run([sys.executable, str(source / "python" / "examples" / name), *map(str, arguments)], cwd=tmp_path,
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_calibrate(source, tmp_path):
    told = run(source, tmp_path, "calibrate.py", "--elements", 1400, "--quick", "-o", "fit")
    assert (tmp_path / "fit" / "card.toml").exists() and (tmp_path / "fit" / "curves.png").exists()
    assert "MPa" in told


def test_sweep_and_plot(source, tmp_path):
    pytest.importorskip("matplotlib")
    run(source, tmp_path, "sweep_and_plot.py", "--points", 2, "-o", "sweep.png")
    assert (tmp_path / "sweep.png").stat().st_size > 5000


def test_impact_and_read(source, tmp_path):
    told = run(source, tmp_path, "impact_and_read.py", "--duration", "0.3 ms", "-o", "impact")
    assert "peak force" in told and (tmp_path / "impact" / "frames" / "elements.hdf.series").exists()
