"""Material cards: units at the border, SI inside, nothing lost on the way."""
import copy
import json
import math
import pickle

import pytest

import spall


def test_quantities_are_text_with_a_unit_or_si_numbers(card):
    card.cohesion = "36 MPa"
    assert card.cohesion == 36e6 == card["Co"]
    card.cohesion = 40e6
    card["phi_i"] = "6 degree"
    assert card["Co"] == 40e6 and math.isclose(card.internal_friction, math.radians(6))
    assert spall.si("24 GPa", "stress") == 2.4e10 and spall.si(0.2, "ratio") == 0.2


def test_a_card_is_read_back_bit_for_bit(card, tmp_path):
    card.tensile_strength = 3.1e6 / 3
    card.provenance = {"source": "a test \"quoted\""}
    card.write(tmp_path / "card.toml")
    again = spall.read_card(tmp_path / "card.toml")
    assert again == card and again.tensile_strength == card.tensile_strength
    assert again.provenance == card.provenance
    assert str(again) == (tmp_path / "card.toml").read_text()


def test_says_what_the_command_says(card, command, tmp_path):
    card.write(tmp_path / "card.toml")
    told = json.loads(command("card", "show", tmp_path / "card.toml", "--json"))
    assert card.link == told.pop("link")
    assert told.pop("provenance") == card.provenance
    assert card.to_dict() == told and list(card.keys()) == list(told)


def test_the_example_is_the_commands(card, command, tmp_path):
    command("card", "example", "-o", tmp_path / "card.toml")
    assert spall.read_card(tmp_path / "card.toml") == card


def test_rescales_as_the_command_does(card, command, tmp_path):
    card.write(tmp_path / "card.toml")
    command("card", "rescale", tmp_path / "card.toml", "--from", "23 mm", "--to", "15 mm", "-o", tmp_path / "finer.toml")
    assert card.rescale("23 mm", 0.015) == spall.read_card(tmp_path / "finer.toml")


def test_replace_leaves_the_card_alone(card):
    changed = card.replace(T="4 MPa", softening=7, name="other")
    assert changed["T"] == 4e6 and changed.softening == 7 and changed.name == "other"
    assert card["T"] != 4e6 and card != changed


def test_made_by_its_keys():
    made = spall.Card(E="30 GPa", nu=0.2, link_law="moment_transfer", slip_softening=8)
    assert made.young_modulus == 30e9 and made.link_law == "moment_transfer"
    assert "slip_softening" in made.keys() and "slip_softening" not in spall.Card().keys()


def test_pickles_and_copies_keep_all_of_it(card):
    card.link_law, card.rolling_limit, card.provenance = "moment_transfer", 0.3, {"a": "b"}
    for again in (pickle.loads(pickle.dumps(card)), copy.copy(card), copy.deepcopy(card)):
        assert again == card and again.rolling_limit == 0.3 and again.provenance == {"a": "b"}
    with pytest.raises(TypeError):
        hash(card)


def test_shows_itself_in_a_notebook(card):
    card.name = "a <b> concrete"
    html = card._repr_html_()
    assert "a &lt;b&gt; concrete" in html and "<td>zeta</td>" in html


def test_all_numbers_of_a_card_file_have_an_attribute(card):
    card.link_law = "moment_transfer"
    documented = [text for name in dir(spall.Card) if (text := getattr(spall.Card, name).__doc__) and 'Key "' in text]
    keys = {text.split('Key "')[1].split('"')[0] for text in documented}
    choices = {"name", "link_law", "unloading", "cohesion_during_softening", "broken_link_contact"}
    assert keys == set(card.keys()) - choices
