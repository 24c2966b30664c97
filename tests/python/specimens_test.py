"""Specimens: the command's own, and views of them that cost nothing and never dangle."""
import copy
import gc
import json
import pickle

import numpy
import pytest

import spall


def test_is_the_one_that_the_command_makes(specimen, command, tmp_path):
    file = tmp_path / "s.h5"
    made = json.loads(command("specimen", "make", "--size", "0.4x0.2x0.2 m", "--elements", 1400, "--seed", 1, "-o", file,
                              "--json"))
    assert specimen.sha256() == made["sha256"]
    assert spall.read_specimen(file) == specimen
    ours = specimen.inspect()
    assert {key: ours[key] for key in made} == made


def test_number_of_threads_does_not_change_it(specimen):
    assert spall.make_specimen((0.4, 0.2, 0.2), 1400, seed=1, threads=2).sha256() == specimen.sha256()


def test_is_read_back_as_it_was_written(specimen, tmp_path):
    specimen.write(tmp_path / "s.h5")
    assert spall.read_specimen(str(tmp_path / "s.h5")).sha256() == specimen.sha256()


def test_arrays_have_their_shapes_and_meanings(specimen):
    n, links = specimen.elements, specimen.link_count
    assert specimen.positions.shape == (n, 3) and specimen.positions.dtype == numpy.float64
    assert specimen.radii.shape == (n,) and specimen.radii.dtype == numpy.float64
    assert specimen.links.shape == (links, 2) and specimen.links.dtype == numpy.int32
    assert specimen.link_lengths.shape == (links,)
    a, b = specimen.links.T
    assert (a < b).all() and a.min() >= 0 and b.max() < n
    distance = numpy.linalg.norm(specimen.positions[a] - specimen.positions[b], axis=1)
    numpy.testing.assert_allclose(distance, specimen.link_lengths, rtol=1e-14)
    assert ((specimen.positions >= 0) & (specimen.positions <= specimen.size)).all()


@pytest.mark.parametrize("name", ["positions", "radii", "links", "link_lengths"])
def test_views_share_memory_and_cannot_be_written(specimen, name):
    first, second = getattr(specimen, name), getattr(specimen, name)
    assert first is not second and numpy.shares_memory(first, second)
    assert first.base is specimen and not first.flags.owndata
    assert not first.flags.writeable
    with pytest.raises(ValueError):
        first.flags.writeable = True
    with pytest.raises(ValueError):
        first[0] = 0


def test_links_and_their_lengths_lie_in_one_block_of_memory(specimen):
    start = specimen.links.__array_interface__["data"][0]
    assert specimen.link_lengths.__array_interface__["data"][0] == start + 8
    assert specimen.links.strides == (16, 4) and specimen.link_lengths.strides == (16,)


def test_a_view_outlives_its_specimen():
    made = spall.make_specimen("0.2x0.2x0.2 m", 1200, seed=3, threads=1)
    positions, kept = made.positions, made.positions.copy()
    tail = made.link_lengths[5:]
    del made
    gc.collect()
    ballast = [numpy.full(100_000, -1.0) for _ in range(20)]  # would take the memory if it had been given back
    assert (positions == kept).all() and (tail > 0).all() and len(ballast) == 20


def test_a_part_cut_out_is_the_commands(command, tmp_path):
    slab = spall.make_specimen("0.5x0.5x0.28 m", 6000, seed=1, threads=1)
    slab.write(tmp_path / "slab.h5")
    cube = slab.extract("0.25,0.25,0.14 m", (0.28, 0.28, 0.28))
    told = json.loads(command("specimen", "extract", tmp_path / "slab.h5", "--centre", "0.25,0.25,0.14 m", "--size",
                              "0.28x0.28x0.28 m", "-o", tmp_path / "cube.h5", "--json"))
    assert cube.sha256() == told["sha256"]


def test_a_cylinder_takes_diameter_and_length():
    made = spall.make_specimen("0.15x0.3 m", 1400, seed=2, shape="cylinder", threads=1)
    assert made.shape == "cylinder" and made.size == (0.15, 0.15, 0.3)
    assert "cylinder" in repr(made) and "1,400 elements" in repr(made)


def test_arrays_become_a_specimen_with_the_same_links(specimen):
    again = spall.specimen_from_arrays(specimen.size, specimen.positions, specimen.radii)
    assert (again.links == specimen.links).all() and (again.link_lengths == specimen.link_lengths).all()
    assert not numpy.shares_memory(again.positions, specimen.positions)
    with pytest.raises(spall.InputError, match="radii: has not one number for each element"):
        spall.specimen_from_arrays(specimen.size, specimen.positions, specimen.radii[1:])
    with pytest.raises(spall.InputError, match="element 0 is no sphere with its centre inside"):
        spall.specimen_from_arrays(specimen.size, specimen.positions - 1, specimen.radii)


def test_pickles_and_copies_are_the_same_specimen(specimen):
    assert pickle.loads(pickle.dumps(specimen)).sha256() == specimen.sha256()
    assert copy.deepcopy(specimen).sha256() == specimen.sha256()
    assert len({specimen, copy.copy(specimen)}) == 1
