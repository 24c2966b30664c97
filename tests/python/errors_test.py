"""Errors: Python's own kinds, one line, with the place, what is wrong there and what is allowed."""
import pickle

import pytest

import spall


def refusal(call, *arguments, **options):
    with pytest.raises(spall.InputError) as caught:
        call(*arguments, **options)
    error = caught.value
    assert isinstance(error, ValueError) and "\n" not in str(error)
    assert error.where in str(error) and error.what in str(error) and error.allowed in str(error)
    return error


def test_a_file_names_its_line_and_key(tmp_path):
    file = tmp_path / "card.toml"
    file.write_text(spall.example_card().to_toml().replace("zeta", "zetta"))
    error = refusal(spall.read_card, file)
    assert error.file == str(file) and error.line > 0 and error.key == "zetta"
    assert "zeta" in error.allowed


def test_no_such_file(tmp_path):
    error = refusal(spall.read_specimen, tmp_path / "none.h5")
    assert error.file == str(tmp_path / "none.h5") and error.what == "no such file"
    refusal(spall.read_case, tmp_path / "none.toml")
    refusal(spall.read_scene, tmp_path / "none.toml")
    refusal(spall.plan_study, tmp_path / "none.toml")
    refusal(spall.read_frames, tmp_path)


def test_options_name_their_bounds_and_the_nearest_word(specimen, card):
    assert refusal(spall.tension, specimen, card, rate=-1).key == "rate"
    assert 'did you mean "damping"' in str(refusal(spall.run_test, "tension", specimen, card, dampin=0.1))
    assert 'did you mean "tension"' in str(refusal(spall.run_test, "tenson", specimen, card))
    assert "free" in refusal(spall.tension, specimen, card, ends="loose").allowed
    assert "m/s" in str(refusal(spall.tension, specimen, card, velocity="3 MPa"))
    assert refusal(spall.tension, specimen, card, velocity=0).what == "0 is not positive"
    assert "beside velocity" in str(refusal(spall.tension, specimen, card, velocity=0.1, rate=0.1))
    assert refusal(spall.tension, specimen, card, rate="fast").key == "rate"
    assert refusal(spall.tension, specimen, card, rate=True).what == "True is no quantity"
    assert "1 to 1024" in str(refusal(spall.tension, specimen, card, threads=-1))
    assert "checkpoint=" in str(refusal(spall.tension, specimen, card, resume=True))


def test_specimens_name_what_is_wrong():
    assert refusal(spall.make_specimen, "0.4x0.2 m", 1400).key == "size"
    assert refusal(spall.make_specimen, (0.4, 0.2, -0.2), 1400).key == "size"
    assert refusal(spall.make_specimen, 0.4, 1400).key == "size"
    assert refusal(spall.make_specimen, "0.4x0.2x0.2 m", 0).key == "elements"
    assert "across" in str(refusal(spall.make_specimen, "0.4x0.2x0.2 m", 100))
    assert "cylinder" in refusal(spall.make_specimen, "0.4x0.2x0.2 m", 1400, shape="cone").allowed
    assert "out of range" not in str(refusal(spall.make_specimen, "0.4x0.2x0.2 m", 1400, solid_fraction=0.95))


def test_cards_name_the_key_and_the_bound(specimen, card):
    with pytest.raises(spall.InputError, match='card: Co: "parsec" is not a unit of stress'):
        card.cohesion = "36 parsec"
    with pytest.raises(spall.InputError, match="no quantity"):
        card.cohesion = None
    assert "Did you mean" not in str(refusal(card.replace, Tee=1))
    assert refusal(card.replace, nu=0.4).key == "nu"
    card.softening = -1
    assert refusal(spall.elastic, specimen, card).key == "zeta"
    with pytest.raises(KeyError):
        card["nothing"]
    with pytest.raises(AttributeError):
        card.zeta_of_nothing


def test_a_dict_is_refused_like_a_file_but_without_a_line():
    error = refusal(spall.read_case, {"targets": {"E": "30 GPa", "ft": "3 MPa", "fcc": "30 MPa"}})
    assert error.key == "targets.fcc" and "case: targets.fcc" in str(error) and ":1" not in str(error)
    assert "is missing" in str(refusal(spall.read_case, {"targets": {"ft": "3 MPa"}}))
    refusal(spall.plan_study, {"tests": ["elastic"]})
    refusal(spall.read_scene, {"model": "de"})
    refusal(spall.read_case, {})
    with pytest.raises(TypeError, match="cannot stand in a description"):
        spall.read_case({"targets": {"E": object()}})


def test_what_cannot_be_written_is_a_run_error(specimen, card, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(spall.RunError) as caught:
        specimen.write(tmp_path / "file" / "s.h5")
    assert isinstance(caught.value, RuntimeError) and str(tmp_path / "file") in str(caught.value)
    with pytest.raises(spall.RunError):
        card.write(tmp_path / "file" / "card.toml")


def test_errors_survive_a_pickle(tmp_path):
    error = refusal(spall.read_card, tmp_path / "none.toml")
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and (again.file, again.what) == (error.file, error.what)
