"""Virtual tests: the same bits as the command, every test of the catalogue by name, results without copies."""
import gc
import inspect
import json

import numpy
import pytest

import spall

FAST = {"rate": 0.1, "stop_at": 0.7}


@pytest.fixture(scope="module")
def pulled(specimen):
    return spall.tension(specimen, spall.example_card(), threads=1, **FAST)


def test_tension_has_the_bits_of_the_command(specimen, pulled, command, tmp_path):
    specimen.write(tmp_path / "s.h5")
    spall.example_card().write(tmp_path / "card.toml")
    told = json.loads(command("test", "tension", "--specimen", tmp_path / "s.h5", "--card", tmp_path / "card.toml", "--rate",
                              0.1, "--stop-at", 0.7, "--threads", 1, "-o", tmp_path / "out", "--json"))
    for key, value in pulled.values.items():
        assert told[key] == value, key
    assert len(pulled.state_sha256) == 64
    assert (tmp_path / "out" / "curves.csv").read_text() == pulled.curve_csv()
    pulled.write(tmp_path / "ours")
    theirs, ours = (spall.read_fields(tmp_path / name / "fields.h5") for name in ("out", "ours"))
    for name, values in theirs.point_data.items():
        numpy.testing.assert_array_equal(values, ours.point_data[name])
    assert json.loads((tmp_path / "ours" / "result.json").read_text())["peak_stress"] == pulled.peak_stress


def test_number_of_threads_does_not_change_the_bits(specimen, pulled):
    again = spall.run_test("tension", specimen, spall.example_card(), threads=2, **FAST)
    assert again.state_sha256 == pulled.state_sha256


def test_elastic_constants_are_the_cards(specimen, card):
    found = spall.elastic(specimen, card, threads=1)
    assert abs(found.E / card.young_modulus - 1) < 0.1 and abs(found["nu"] - card.poisson_ratio) < 0.05
    assert found.curve == {} and found.fields == {}


def test_the_curve_is_made_of_views(pulled):
    curve = pulled.curve
    assert list(curve)[:2] == ["strain", "stress"] and pulled.curve_units["stress"] == "Pa"
    assert curve["stress"].max() == pulled.peak_stress
    for name, column in curve.items():
        assert numpy.shares_memory(column, pulled.curve[name]) and column.base is pulled
        assert not column.flags.writeable
        with pytest.raises(ValueError):
            column[0] = 1
    assert (numpy.diff(curve["strain"]) > 0).all()


def test_fields_are_views_of_the_specimens_elements_and_links(pulled):
    fields, tested = pulled.fields, pulled.specimen
    assert fields["damage"].shape == (tested.elements,)
    assert fields["displacement"].shape == (tested.elements, 3)
    assert fields["link_state"].shape == fields["link_strain"].shape == (tested.link_count,)
    assert fields["link_state"].dtype == numpy.uint8
    assert (fields["link_state"] == 2).sum() == pulled.broken_links > 0
    broken = numpy.bincount(tested.links[fields["link_state"] == 2].ravel(), minlength=tested.elements)
    all_of_them = numpy.bincount(tested.links.ravel(), minlength=tested.elements)
    numpy.testing.assert_allclose(fields["damage"], broken / numpy.maximum(all_of_them, 1))
    assert numpy.shares_memory(fields["displacement"], pulled.fields["displacement"])


def test_views_outlive_the_result(specimen, card):
    found = spall.tension(specimen, card, threads=1, rate=0.3, stop_at=0.95)
    stress, damage = found.curve["stress"], found.fields["damage"]
    kept = stress.copy(), damage.copy()
    del found
    gc.collect()
    ballast = [numpy.full(50_000, -1.0) for _ in range(20)]
    assert (stress == kept[0]).all() and (damage == kept[1]).all() and len(ballast) == 20


def test_the_card_is_copied_at_the_call(specimen, card, pulled):
    assert pulled.card == card
    pulled.card.cohesion = 1
    assert pulled.card.cohesion == card.cohesion


def test_options_are_text_with_units_or_si_numbers(specimen, card):
    text = spall.tension(specimen, card, threads=1, max_strain="0.02 permil", rate=0.3)
    number = spall.tension(specimen, card, threads=1, max_strain=2e-5, rate=0.3, damping=None)
    assert text.state_sha256 == number.state_sha256 and not text.passed_peak


def test_every_test_of_the_catalogue_is_a_function_with_its_options():
    for test in spall.catalogue():
        function = getattr(spall, test["name"])
        parameters = inspect.signature(function).parameters
        assert list(parameters)[:2] == ["specimen", "card"]
        for option in test["options"]:
            assert option["key"] in parameters and option["key"] in function.__doc__
        for measured in test["measured"]:
            assert measured["key"] in function.__doc__
        assert ("checkpoint" in parameters) == test["steps"]


def test_a_slow_test_runs_by_its_name(card):
    cube = spall.make_specimen("0.15x0.15x0.15 m", 1000, seed=1, threads=1)
    found = spall.splitting(cube, card, threads=1, rate=0.3, stop_at=0.95)
    assert found.test == "splitting" and found.splitting_strength > 0
    assert found.fields["damage"].shape == (found.specimen.elements,)


def test_a_result_says_what_it_is(pulled):
    assert "tension" in repr(pulled) and "peak_stress" in dir(pulled)
    with pytest.raises(AttributeError, match="the result of tension has no \"peak_stres\""):
        pulled.peak_stres
    with pytest.raises(KeyError):
        pulled["nothing"]


def test_half_the_speed_changes_little(specimen, card):
    found = spall.tension(specimen, card, threads=1, rate=0.2, stop_at=0.95)
    check = found.check_rate(threads=1)
    assert check["quantity"] == "peak_stress" and abs(check["change"]) < 0.2
    assert check["velocity"] == found.velocity / 2
    assert spall.elastic(specimen, card, threads=1).check_rate() is None
