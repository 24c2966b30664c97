// Material cards in Python: numbers by attribute or by key, in SI units or as text with a unit.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>

#include "libdem/config/nearest_name.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/material/card_numbers.h"
#include "libdem/material/element_size_rule.h"
#include "libdem/material/material_card.h"
#include "libdem/material/micro_macro.h"
#include "python/parts.h"
#include "python/values.h"

namespace python {
namespace {

namespace py = pybind11;
using dem::MaterialCard;
using dem::Quantity;

/// One number of the card in Python's words.
struct Number {
  const char *attribute, *key;
  double MaterialCard::*value;
  Quantity kind;
  const char* doc;
};

constexpr Number numbers[] = {
    {"young_modulus", "E", &MaterialCard::young_modulus, Quantity::stress, "E [Pa], of the concrete."},
    {"poisson_ratio", "nu", &MaterialCard::poisson_ratio, Quantity::ratio,
     "nu [-], of the concrete; below 1/alpha."},
    {"density", "density", &MaterialCard::density, Quantity::density,
     "Mass per volume of the concrete [kg/m3]."},
    {"tensile_strength", "T", &MaterialCard::tensile_strength, Quantity::stress, "T [Pa], of a link."},
    {"cohesion", "Co", &MaterialCard::cohesion, Quantity::stress, "Co [Pa], of a link."},
    {"softening", "zeta", &MaterialCard::softening, Quantity::ratio,
     "zeta [-]: the softening slope of a link is -Kn/zeta."},
    {"internal_friction", "phi_i", &MaterialCard::internal_friction, Quantity::angle,
     "phi_i [rad], of an intact link."},
    {"contact_friction", "phi_c", &MaterialCard::contact_friction, Quantity::angle,
     "phi_c [rad], of a broken link or a new contact."},
    {"alpha", "alpha", &MaterialCard::alpha, Quantity::ratio, "Of Eq. 1 [-]."},
    {"beta", "beta", &MaterialCard::beta, Quantity::ratio, "Of Eq. 1 [-]."},
    {"gamma", "gamma", &MaterialCard::gamma, Quantity::ratio, "Of Eq. 1 [-]."},
    {"slip_softening", "slip_softening", &MaterialCard::slip_softening, Quantity::ratio,
     "zeta_s [-]: cohesion is gone at a slip of zeta_s Co S/Ks; 0: it stays. Law with moments."},
    {"rolling_stiffness", "rolling_stiffness", &MaterialCard::rolling_stiffness, Quantity::ratio,
     "Rolling stiffness over Kn R^2 [-]. Law with moments."},
    {"rolling_limit", "rolling_limit", &MaterialCard::rolling_limit, Quantity::ratio,
     "Largest rolling moment over R Fn [-]. Law with moments."},
    {"twisting_stiffness", "twisting_stiffness", &MaterialCard::twisting_stiffness, Quantity::ratio,
     "Twisting stiffness over Kn R^2 [-]. Law with moments."},
    {"twisting_limit", "twisting_limit", &MaterialCard::twisting_limit, Quantity::ratio,
     "Largest twisting moment over R Fn [-]. Law with moments."},
};

template <class Choice>
void set_choice(Choice& choice, const std::string& given, const std::string& key) {
  std::vector<std::string> names;
  for (int k = 0; k < 2; ++k) {
    names.emplace_back(dem::name_of(static_cast<Choice>(k)));
    if (names.back() == given) {
      choice = static_cast<Choice>(k);
      return;
    }
  }
  throw dem::InputError("card: " + key, fmt::format("\"{}\" is none", given), dem::suggestion(given, names));
}

/// Runs `action(key, member)` on each named choice of the card.
template <class Action>
void for_each_choice(MaterialCard& card, Action&& action) {
  action("link_law", card.link_law);
  action("unloading", card.unloading);
  action("cohesion_during_softening", card.cohesion_during_softening);
  action("broken_link_contact", card.broken_link_contact);
}

std::vector<std::string> keys_of() {
  std::vector<std::string> keys{"name"};
  for (const Number& number : numbers) keys.emplace_back(number.key);
  MaterialCard card;
  for_each_choice(card, [&](const char* key, auto&) { keys.emplace_back(key); });
  return keys;
}

void set(MaterialCard& card, const std::string& key, const py::handle& value) {
  if (key == "name") {
    card.name = value.cast<std::string>();
    return;
  }
  for (const Number& number : numbers)
    if (key == number.key || key == number.attribute) {
      card.*number.value = quantity(value, number.kind, "card: " + key);
      return;
    }
  bool found = false;
  for_each_choice(card, [&](const char* name, auto& choice) {
    if (key != name) return;
    set_choice(choice, value.cast<std::string>(), key);
    found = true;
  });
  if (!found)
    throw dem::InputError("card", fmt::format("there is no \"{}\"", key), dem::suggestion(key, keys_of()));
}

py::object get(MaterialCard& card, const std::string& key) {
  if (key == "name") return py::str(card.name);
  for (const Number& number : numbers)
    if (key == number.key) return py::float_(card.*number.value);
  py::object found = py::none();
  for_each_choice(card, [&](const char* name, auto& choice) {
    if (key == name) found = py::str(std::string(dem::name_of(choice)));
  });
  if (found.is_none()) throw py::key_error(key + ": " + dem::suggestion(key, keys_of()));
  return found;
}

py::dict to_dict(const MaterialCard& card) {
  py::dict dict;
  dict["name"] = card.name;
  for (const dem::CardNumber& number : dem::numbers_of(card))
    dict[py::str(std::string(number.key))] = number.value;
  for (const auto& [key, value] : dem::choices_of(card)) dict[py::str(std::string(key))] = std::string(value);
  return dict;
}

py::dict provenance_of(const MaterialCard& card) {
  py::dict dict;
  for (const auto& [key, text] : card.provenance) dict[py::str(key)] = text;
  return dict;
}

void set_provenance(MaterialCard& card, const py::dict& given) {
  card.provenance.clear();
  for (const auto& [key, text] : given)
    card.provenance.emplace_back(py::str(key).cast<std::string>(), py::str(text).cast<std::string>());
}

MaterialCard with_changes(const MaterialCard& card, const py::kwargs& changes) {
  MaterialCard changed = card;
  for (const auto& [key, value] : changes) set(changed, key.cast<std::string>(), value);
  changed.validate("card");
  return changed;
}

py::dict link_of(const MaterialCard& card) {
  const dem::LinkStiffness link =
      dem::link_stiffness(card.young_modulus, card.poisson_ratio, card.alpha, card.beta, card.gamma);
  py::dict dict;
  dict["shear_ratio"] = link.shear_ratio;
  dict["normal_modulus"] = link.normal_modulus;
  return dict;
}

/// All of a card, also what its law does not use.
py::tuple state_of(MaterialCard& card) {
  py::dict values;
  for (const std::string& key : keys_of()) values[py::str(key)] = get(card, key);
  return py::make_tuple(values, provenance_of(card));
}

MaterialCard from_state(const py::tuple& state) {
  MaterialCard card;
  for (const auto& [key, value] : state[0].cast<py::dict>()) set(card, key.cast<std::string>(), value);
  set_provenance(card, state[1].cast<py::dict>());
  return card;
}

std::string table_in_html(const MaterialCard& card) {
  const auto plain = [](const std::string& text) {
    return py::module_::import("html").attr("escape")(text).cast<std::string>();
  };
  std::string html = fmt::format(
      "<table><caption>{}</caption><tr><th>key</th><th>value</th><th>meaning</th></tr>", plain(card.name));
  for (const dem::CardNumber& number : dem::numbers_of(card))
    html += fmt::format("<tr><td>{}</td><td>{:.6g} {}</td><td>{}</td></tr>", number.key, number.value,
                        number.kind == Quantity::ratio ? "" : dem::si_unit(number.kind),
                        plain(std::string(number.meaning)));
  for (const auto& [key, value] : dem::choices_of(card))
    html += fmt::format("<tr><td>{}</td><td>{}</td><td></td></tr>", key, value);
  return html + "</table>";
}

}  // namespace

void add_cards(py::module_& module) {
  py::class_<MaterialCard> card(
      module, "Card",
      "A material card: all that a discrete-element concrete needs to know about itself.\n\n"
      "Numbers are in SI units, angles in radians. They can be set to text with a unit: card.cohesion = \"36 "
      "MPa\".\n"
      "Each also goes by its key in card.toml: card[\"Co\"]. Bounds are checked by validate() and by every "
      "run.");
  card.def(py::init([](const py::kwargs& values) { return with_changes(MaterialCard{}, values); }),
           "Card(E=\"30 GPa\", T=\"3 MPa\", ...): the example's values, with the given keys or attributes "
           "changed.\n"
           "Raises InputError for a key that there is not, a wrong unit or a violated bound.")
      .def_readwrite("name", &MaterialCard::name, "In words.")
      .def_property(
          "provenance", &provenance_of, &set_provenance,
          "Where the card comes from and how well it fits: text by key, as a dict (a copy; assign to change).");
  for (const Number& number : numbers) {
    const Number* const which = &number;
    card.def_property(
        number.attribute, [which](const MaterialCard& c) { return c.*which->value; },
        [which](MaterialCard& c, const py::object& value) {
          c.*which->value = quantity(value, which->kind, std::string("card: ") + which->key);
        },
        fmt::format("{} Key \"{}\".", number.doc, number.key).c_str());
  }
  const auto add_choice = [&](const char* name, auto MaterialCard::*member, const char* doc) {
    card.def_property(
        name, [member](const MaterialCard& c) { return std::string(dem::name_of(c.*member)); },
        [member, name](MaterialCard& c, const std::string& value) { set_choice(c.*member, value, name); }, doc);
  };
  add_choice("link_law", &MaterialCard::link_law, "\"paper\", or \"moment_transfer\".");
  add_choice("unloading", &MaterialCard::unloading,
             "How a link unloads from the softening branch: \"secant\", or \"elastic\".");
  add_choice("cohesion_during_softening", &MaterialCard::cohesion_during_softening,
             "Whether Co stays whole until the link breaks: \"constant\", or \"proportional\".");
  add_choice("broken_link_contact", &MaterialCard::broken_link_contact,
             "Below which distance broken links push: \"initial_distance\", or \"radii\".");
  card.def("__getitem__", &get, py::arg("key"), "By its key in card.toml: card[\"T\"].")
      .def("__setitem__", &set, py::arg("key"), py::arg("value"))
      .def(
          "keys", [](const MaterialCard& c) { return py::list(to_dict(c).attr("keys")()); },
          "The keys that the card's law uses, in the order of card.toml.")
      .def("to_dict", &to_dict, "Name, numbers (SI) and choices by key, without the provenance.")
      .def("to_toml", &dem::to_toml, "The text of card.toml; reading it back gives the same bits.")
      .def(
          "write",
          [](const MaterialCard& c, const std::filesystem::path& file) {
            c.validate("card");
            dem::write_file_atomically(file, dem::to_toml(c));
          },
          py::arg("file"), "Write card.toml, whole or not at all. Raises InputError, RunError.")
      .def(
          "validate", [](const MaterialCard& c) { c.validate("card"); },
          "Raises InputError that names the key and the bound which is violated.")
      .def("replace", &with_changes,
           "A copy with other values: card.replace(T=\"3.2 MPa\", zeta=6). Keys or attributes. Raises "
           "InputError.")
      .def_property_readonly(
          "link", &link_of,
          "What a link gets by Eq. 1: {\"shear_ratio\": Ks/Kn [-], \"normal_modulus\": Kn D/S [Pa]}.")
      .def(
          "rescale",
          [](const MaterialCard& c, const py::object& from, const py::object& to) {
            return dem::for_element_size(c, quantity(from, Quantity::length, "from_size"),
                                         quantity(to, Quantity::length, "to_size"));
          },
          py::arg("from_size"), py::arg("to_size"),
          "The card for elements of another size (\"23 mm\", or m): same tensile strength and fracture "
          "energy.\n"
          "A specimen's element size is Specimen.element_size. Raises InputError.")
      .def(
          "__eq__",
          [](const MaterialCard& a, const MaterialCard& b) { return dem::to_toml(a) == dem::to_toml(b); },
          py::is_operator())
      .def("__copy__", [](const MaterialCard& c) { return MaterialCard(c); })
      .def("__str__", &dem::to_toml)
      .def("__repr__",
           [](const MaterialCard& c) {
             return fmt::format(
                 "<spall.Card \"{}\": E {:.4g} GPa, nu {:.3g}, T {:.4g} MPa, Co {:.4g} MPa, zeta {:.4g}>",
                 c.name, c.young_modulus / 1e9, c.poisson_ratio, c.tensile_strength / 1e6, c.cohesion / 1e6,
                 c.softening);
           })
      .def("_repr_html_", &table_in_html)
      .def(py::pickle(&state_of, &from_state));
  card.attr("__hash__") = py::none();  // it can change
  module.def(
      "read_card", &dem::read_card, py::arg("file"),
      "The card in a card.toml. Raises InputError (unknown or missing key, wrong unit, bound violated).");
  module.def(
      "example_card",
      [] {
        MaterialCard c;
        c.name = "Table 2 of the paper";
        c.cohesion = 36e6;
        c.provenance = {{"source", "Table 2 and Eq. 3 of the paper; the density is an ordinary value"}};
        return c;
      },
      "A valid card to begin with: Table 2 of the paper.");
}

}  // namespace python
