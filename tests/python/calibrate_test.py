"""Calibration: a case in Python is a case in a file, and its result is the command's."""
import json

import numpy
import pytest

import spall

CASE = {
    "name": "small",
    "targets": {"E": "30 GPa", "ft": "3 MPa"},
    "tension": {"rate": 0.1},
    "fixed": {"zeta": 5, "Co": "8 MPa"},
    "specimen": {"size": "0.4x0.2x0.2 m", "elements": 1400, "fit_seeds": [1], "check_seeds": []},
}


@pytest.fixture(scope="module")
def fit(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fit")
    heard = []
    found = spall.calibrate(CASE, journal=folder / "journal.h5", threads=1, progress=heard.append)
    return found, folder, heard


def test_a_dict_is_read_as_the_same_file_would_be():
    case = spall.read_case(CASE)
    assert case.name == "small" and repr(case) == '<spall.Case "small": 3 targets, 1 specimens>'
    assert {t["name"]: t["value"] for t in case.targets} == {"E": 30e9, "nu": 0.2, "ft": 3e6}
    assert all(0 < t["tolerance"] < 1 and t["source"] for t in case.targets)


def test_the_fit_meets_its_targets(fit):
    found = fit[0]
    assert found.complete and all(t["met"] for t in found.targets)
    named = {t["name"]: t for t in found.targets}
    assert abs(named["ft"]["achieved"] / 3e6 - 1) < 0.02
    assert found.card.name == "small" and "target_ft" in found.card.provenance
    assert found.virtual_tests > 0 and [step["stage"] for step in found.history][0] == "tension"
    assert {p["name"] for p in found.parameters} == {"T"}


def test_progress_names_the_stages(fit):
    stages = [p.stage for p in fit[2]]
    assert "tension" in stages and "check" in stages


def test_curves_are_views(fit):
    found = fit[0]
    (curve,) = found.curves("tension")
    assert curve["seen"] and curve["label"] == "seed 1"
    assert numpy.shares_memory(curve["stress"], found.curves("tension")[0]["stress"])
    assert curve["stress"].base is found and not curve["stress"].flags.writeable
    achieved = {t["name"]: t["achieved"] for t in found.targets}["ft"]
    numpy.testing.assert_allclose(curve["stress"].max(), achieved, rtol=1e-12)
    assert found.laboratory("compression") is None


def test_resumed_from_its_journal_it_comes_to_the_same_bits(fit):
    found, folder, _ = fit
    again = spall.calibrate(CASE, journal=folder / "journal.h5", resume=True, threads=1)
    assert again.card == found.card and again.wall_seconds < found.wall_seconds


def test_it_is_the_commands_result(fit, command, tmp_path):
    found = fit[0]
    (tmp_path / "case.toml").write_text("""
name = "small"
[targets]
E = "30 GPa"
ft = "3 MPa"
[tension]
rate = 0.1
[fixed]
zeta = 5
Co = "8 MPa"
[specimen]
size = "0.4x0.2x0.2 m"
elements = 1400
fit_seeds = [1]
check_seeds = []
""")
    command("calibrate", tmp_path / "case.toml", "-o", tmp_path / "out", "--threads", 1, "--quiet")
    assert spall.read_card(tmp_path / "out" / "card.toml") == found.card
    told, ours = json.loads((tmp_path / "out" / "result.json").read_text()), found.to_dict()
    for result in (told, ours):
        result.pop("wall_seconds")
    assert told == ours
    found.write(tmp_path / "ours")
    for name in ("card.toml", "curves.csv"):
        assert (tmp_path / "ours" / name).read_text() == (tmp_path / "out" / name).read_text()


def test_measured_curves_come_with_their_band(source):
    case = {
        "compression": {"curves": ["curves/*.csv"]},
        "code": {"strength_class": "C25/30", "use": ["ft"]},
        "fixed": {"Co": "60 MPa"},
    }
    folder = source / "no such folder"
    with pytest.raises(spall.InputError, match="no file matches"):
        spall.read_case(case, folder=folder)
