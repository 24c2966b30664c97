"""Impacts: the command's numbers, histories as views, pictures by callback and from the folder."""
import json

import numpy
import pytest

import spall


def scene(card, **output):
    return {
        "model": "de",
        "title": "small",
        "card": card,
        "structure": {"size": "0.24x0.24x0.08 m", "elements": 2000},
        "support": [{"name": "edge", "low": "0,0,0 m", "high": "0.03,0.24,0.08 m", "lock": ["z"]}],
        "impactor": {"shape": "sphere", "diameter": "40 mm", "density": "7850 kg/m3", "speed": "20 m/s",
                     "aim": "0.12,0.12,0.04 m"},
        "probe": [{"name": "under", "point": "0.12,0.12,0 m"}],
        "run": {"duration": "0.2 ms", "samples": 50},
        "output": {"frames": 2},
    }


@pytest.fixture(scope="module")
def struck(tmp_path_factory):
    folder = tmp_path_factory.mktemp("impact")
    pictures = []
    found = spall.run_impact(scene(spall.example_card()), threads=1, frame=pictures.append, frames=folder / "frames")
    return found, pictures, folder


def test_numbers_are_the_commands(struck, command, tmp_path):
    found = struck[0]
    spall.example_card().write(tmp_path / "card.toml")
    (tmp_path / "slab.toml").write_text("""
model = "de"
title = "small"
card = "card.toml"
[structure]
size = "0.24x0.24x0.08 m"
elements = 2000
[[support]]
name = "edge"
low = "0,0,0 m"
high = "0.03,0.24,0.08 m"
lock = ["z"]
[impactor]
shape = "sphere"
diameter = "40 mm"
density = "7850 kg/m3"
speed = "20 m/s"
aim = "0.12,0.12,0.04 m"
[[probe]]
name = "under"
point = "0.12,0.12,0 m"
[run]
duration = "0.2 ms"
samples = 50
[output]
frames = 2
""")
    command("impact", tmp_path / "slab.toml", "-o", tmp_path / "out", "--threads", 1, "--quiet")
    told, ours = json.loads((tmp_path / "out" / "result.json").read_text()), found.values
    for result in (told, ours):
        for key in [key for key in result if key.endswith("_seconds")]:
            del result[key]
    assert told == ours
    assert found.state_sha256 == told["state_sha256"] and found["peak_force"] == told["peak_force"]
    found.write(tmp_path / "ours")
    for name in ("curves.csv", "fragments.csv"):
        assert (tmp_path / "ours" / name).read_text() == (tmp_path / "out" / name).read_text()


def test_histories_are_views(struck):
    found = struck[0]
    history = found.history
    rows = len(history["time"])
    assert rows >= 51 and history["time"].ndim == 1 and history["force"].shape == (rows, 3)
    assert history["displacement/under"].shape == (rows, 3) and found.history_units["force"] == "N"
    assert numpy.shares_memory(history["force"], found.history["force"]) and history["force"].base is found
    assert not history["time"].flags.writeable
    assert numpy.linalg.norm(history["force"], axis=1).max() == pytest.approx(found.peak_force, rel=0.1)  # its mean over a sample
    assert numpy.linalg.norm(history["displacement/under"], axis=1).max() <= found.max_displacement["under"]


def test_pictures_are_arrays_of_their_own(struck):
    found, pictures, _ = struck
    assert [picture["number"] for picture in pictures] == [0, 1, 2]
    first, last = pictures[0], pictures[-1]
    assert first["time"] == 0 and (first["displacement"] == 0).all() and (first["damage"] == 0).all()
    assert last["position"].shape == (found.elements, 3) and last["links"].shape == (found.links, 2)
    assert (last["link_state"] == 2).sum() == found.broken_links > 0
    numpy.testing.assert_allclose(last["position"], first["position"] + last["displacement"], atol=1e-15)
    assert last["position"].flags.owndata or last["position"].base is None


def test_pictures_in_the_folder_say_the_same(struck):
    _, pictures, folder = struck
    frames = spall.read_frames(folder / "frames")
    assert len(frames) == 3
    numpy.testing.assert_allclose(frames.times, [p["time"] for p in pictures])
    for picture, grid in zip(pictures, frames):
        numpy.testing.assert_array_equal(grid.points, picture["position"])
        numpy.testing.assert_array_equal(grid.point_data["damage"], picture["damage"])
    links = spall.read_frames(folder / "frames", "links")[-1]
    numpy.testing.assert_array_equal(links.cell_data["state"], pictures[-1]["link_state"])
    assert links.types.shape == pictures[-1]["link_state"].shape


def test_fragments_are_views_and_add_up(struck):
    found = struck[0]
    fragments = found.fragments
    assert (numpy.diff(fragments["mass"]) <= 0).all() and fragments["centre"].shape == (len(fragments["mass"]), 3)
    assert fragments["elements"].sum() == found.elements == len(fragments["of_element"])
    assert (numpy.bincount(fragments["of_element"]) == fragments["elements"]).all()


def test_a_picture_that_raises_ends_the_run():
    class Enough(Exception):
        pass

    def enough(picture):
        raise Enough

    with pytest.raises(Enough):
        spall.run_impact(scene(spall.example_card()), threads=1, frame=enough)


def test_a_scene_is_read_with_another_card(source):
    read = spall.read_scene(source / "data" / "cases" / "slab-small.toml", card=spall.example_card())
    assert read.card == spall.example_card() and read.model == "coupled" and read.duration == 2e-3
    with pytest.raises(spall.InputError, match="give it to read_scene"):
        spall.run_impact(read, card=spall.example_card())
