#include "libdem/material/material_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "libdem/config/nearest_name.h"
#include "libdem/config/toml_reader.h"
#include "libdem/core/error.h"
#include "libdem/core/units.h"
#include "libdem/material/card_numbers.h"
#include "libdem/material/card_table.h"

namespace dem {
namespace {

/// What may be asked of a number by itself; nu < 1/alpha is checked apart.
enum class Bound { positive, from_zero, angle };

/// One number of the card: its key, its place, how it is written and what it must satisfy.
struct Field {
  const char* key;
  double MaterialCard::*value;
  Quantity kind;
  Bound bound;
  bool required;
  const char* comment;
  bool of_moments = false;  ///< belongs to the law that transfers moments
};

constexpr double degree = 3.14159265358979323846 / 180;

// A field that is not required has the default of MaterialCard.
constexpr std::array fields{
    Field{"E", &MaterialCard::young_modulus, Quantity::stress, Bound::positive, true, "Young's modulus"},
    Field{"nu", &MaterialCard::poisson_ratio, Quantity::ratio, Bound::from_zero, true,
          "Poisson's ratio, below 1/alpha"},
    Field{"density", &MaterialCard::density, Quantity::density, Bound::positive, false, "of the concrete"},
    Field{"T", &MaterialCard::tensile_strength, Quantity::stress, Bound::positive, true,
          "tensile strength of a link"},
    Field{"Co", &MaterialCard::cohesion, Quantity::stress, Bound::positive, true, "cohesion of a link"},
    Field{"zeta", &MaterialCard::softening, Quantity::ratio, Bound::positive, true,
          "softening slope is -Kn/zeta"},
    Field{"phi_i", &MaterialCard::internal_friction, Quantity::angle, Bound::angle, true,
          "friction of an intact link"},
    Field{"phi_c", &MaterialCard::contact_friction, Quantity::angle, Bound::angle, true,
          "friction of a contact"},
    Field{"alpha", &MaterialCard::alpha, Quantity::ratio, Bound::positive, true, "Eq. 1"},
    Field{"beta", &MaterialCard::beta, Quantity::ratio, Bound::positive, true, "Eq. 1"},
    Field{"gamma", &MaterialCard::gamma, Quantity::ratio, Bound::positive, true, "Eq. 1"},
    Field{"slip_softening", &MaterialCard::slip_softening, Quantity::ratio, Bound::from_zero, false,
          "cohesion is gone at a slip of so many Co S/Ks; 0: it stays", true},
    Field{"rolling_stiffness", &MaterialCard::rolling_stiffness, Quantity::ratio, Bound::from_zero, false,
          "over Kn R^2", true},
    Field{"rolling_limit", &MaterialCard::rolling_limit, Quantity::ratio, Bound::from_zero, false,
          "largest rolling moment over R Fn", true},
    Field{"twisting_stiffness", &MaterialCard::twisting_stiffness, Quantity::ratio, Bound::from_zero, false,
          "over Kn R^2", true},
    Field{"twisting_limit", &MaterialCard::twisting_limit, Quantity::ratio, Bound::from_zero, false,
          "largest twisting moment over R Fn", true},
};

bool counts(const Field& field, const MaterialCard& card) {
  return !field.of_moments || card.link_law == LinkLawKind::moment_transfer;
}

const std::vector<std::string> laws{"paper", "moment_transfer"};

const std::vector<std::string> unloadings{"secant", "elastic"};
const std::vector<std::string> cohesions{"constant", "proportional"};
const std::vector<std::string> contacts{"initial_distance", "radii"};

template <class Choice>
Choice chosen(const TomlTable& table, const char* key, const std::vector<std::string>& names, Choice fallback) {
  const std::string name = table.choice(key, names, name_of(fallback));
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == name) return static_cast<Choice>(k);
  return fallback;
}

struct Violation {
  std::string key, what_is_wrong, remedy;
};

std::optional<Violation> violation(const MaterialCard& card) {
  for (const Field& field : fields) {
    if (!counts(field, card)) continue;
    const double value = card.*field.value;
    const double shown = field.bound == Bound::angle ? value / degree : value;
    const char* allowed = nullptr;
    switch (field.bound) {
      case Bound::positive:
        allowed = value > 0 ? nullptr : "greater than 0";
        break;
      case Bound::from_zero:
        allowed = value >= 0 ? nullptr : "0 or more";
        break;
      // A hair above 89 degrees is the rounding of the conversion to radians.
      case Bound::angle:
        allowed = value >= 0 && shown <= 89 + 1e-9 ? nullptr : "from 0 to 89 degrees";
        break;
    }
    const std::string_view unit = field.bound == Bound::angle       ? " degrees"
                                  : field.kind == Quantity::density ? " kg/m3"
                                  : field.kind == Quantity::stress  ? " Pa"
                                                                    : "";
    if (!std::isfinite(value))
      return Violation{field.key, fmt::format("{} is not a finite number", value),
                       fmt::format("write it as in {} = \"{}\"", field.key, example(field.kind))};
    if (allowed != nullptr)
      return Violation{field.key, fmt::format("{:.6g}{} is out of bounds", shown, unit),
                       fmt::format("{} must be {}", field.key, allowed)};
    // Far above any material: a slip of the pen, that would end in numbers which are none.
    const double most = field.kind == Quantity::stress ? 1e15 : 1e6;
    if (value > most)
      return Violation{field.key, fmt::format("{:.6g}{} is out of bounds", shown, unit),
                       fmt::format("{} must be at most {:g}{}", field.key, most, unit)};
  }
  if (card.poisson_ratio >= 1 / card.alpha || card.poisson_ratio * card.alpha >= 1)
    return Violation{
        "nu", fmt::format("{:.6g} would give links a shear stiffness that is not positive", card.poisson_ratio),
        fmt::format("nu must stay below 1/alpha = {:.4g}", 1 / card.alpha)};
  if (card.poisson_ratio >= 0.5)
    return Violation{"nu", fmt::format("{:.6g} is that of no solid", card.poisson_ratio),
                     "nu must be below 0.5"};
  return std::nullopt;
}

/// The shortest text that reads back as the same bits, in a unit that people use if that is exact, in SI if
/// not.
std::string quantity_text(double value, Quantity kind) {
  // fmt writes the fewest digits (17 at most) that read back as the same double.
  if (kind == Quantity::ratio) return fmt::format("{}", value);
  std::vector<std::pair<double, const char*>> units;
  if (kind == Quantity::stress) units = {{1e9, "GPa"}, {1e6, "MPa"}};
  if (kind == Quantity::angle) units = {{degree, "degree"}};
  for (const auto& [factor, unit] : units) {
    // Twelve digits rid "6 degree" of the dust of its conversion; the comparison of bits then decides.
    const double scaled = value / factor;
    std::string text = fmt::format("{:.12g} {}", scaled, unit);
    if (std::abs(scaled) >= 1 && parse_quantity(text, kind, "material card") == value) return text;
  }
  return fmt::format("{} {}", value, si_unit(kind));
}

std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') result += '\\';
    if (letter == '\n')
      result += "\\n";
    else if (static_cast<unsigned char>(letter) < 32 || letter == 127)
      result += fmt::format("\\u{:04X}", static_cast<unsigned char>(letter));
    else
      result += letter;
  }
  return result + "\"";
}

std::string key_text(const std::string& key) {
  const bool bare = !key.empty() && key.find_first_not_of(
                                        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                        "0123456789_-") == std::string::npos;
  return bare ? key : toml_string(key);
}

std::string line(const std::string& key, const std::string& value, const char* comment) {
  return fmt::format("{:<46}# {}\n", fmt::format("{} = {}", key, value), comment);
}

}  // namespace

std::vector<CardNumber> numbers_of(const MaterialCard& card) {
  std::vector<CardNumber> numbers;
  for (const Field& field : fields)
    if (counts(field, card)) numbers.push_back({field.key, card.*field.value, field.kind, field.comment});
  return numbers;
}

std::vector<std::pair<std::string_view, std::string_view>> choices_of(const MaterialCard& card) {
  return {{"link_law", name_of(card.link_law)},
          {"unloading", name_of(card.unloading)},
          {"cohesion_during_softening", name_of(card.cohesion_during_softening)},
          {"broken_link_contact", name_of(card.broken_link_contact)}};
}

std::string identity_text(const MaterialCard& card) {
  std::string text;
  for (const CardNumber& number : numbers_of(card)) text += fmt::format("{}={:a}|", number.key, number.value);
  for (const auto& [key, value] : choices_of(card)) text += fmt::format("{}={}|", key, value);
  return text;
}

void set_number(MaterialCard& card, std::string_view key, double value) {
  const auto field = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.key == key; });
  if (field == fields.end()) {
    std::vector<std::string> known;
    for (const Field& f : fields) known.emplace_back(f.key);
    throw InputError(std::string(key), "a card has no such number", suggestion(key, known));
  }
  if (!counts(*field, card))
    throw InputError(std::string(key), "has no meaning in the paper's law",
                     "take a card with link_law = \"moment_transfer\"");
  card.*field->value = value;
}

std::string_view name_of(LinkLawKind choice) { return laws[static_cast<std::size_t>(choice)]; }
std::string_view name_of(SofteningUnloading choice) { return unloadings[static_cast<std::size_t>(choice)]; }
std::string_view name_of(CohesionDuringSoftening choice) { return cohesions[static_cast<std::size_t>(choice)]; }
std::string_view name_of(BrokenLinkContact choice) { return contacts[static_cast<std::size_t>(choice)]; }

void MaterialCard::validate(const std::string& where) const {
  if (const auto found = violation(*this))
    throw InputError(fmt::format("{}: {}", where, found->key), found->what_is_wrong, found->remedy);
}

MaterialCard read_card(const std::filesystem::path& file) { return card_of(TomlTable::read(file)); }

MaterialCard card_of(const TomlTable& table) {
  std::vector<std::string> known{"name"};
  for (const Field& field : fields) known.emplace_back(field.key);
  for (const char* key :
       {"link_law", "unloading", "cohesion_during_softening", "broken_link_contact", "provenance"})
    known.emplace_back(key);
  table.allow_only(known);

  MaterialCard card;
  card.name = table.text("name", card.name);
  card.link_law = chosen(table, "link_law", laws, card.link_law);
  for (const Field& field : fields) {
    if (!counts(field, card) && table.has(field.key))
      table.fail(field.key, "has no meaning in the paper's law",
                 "write link_law = \"moment_transfer\" beside it, or leave it out");
    card.*field.value = field.required ? table.quantity(field.key, field.kind)
                                       : table.quantity(field.key, field.kind, card.*field.value);
  }
  card.unloading = chosen(table, "unloading", unloadings, card.unloading);
  card.cohesion_during_softening =
      chosen(table, "cohesion_during_softening", cohesions, card.cohesion_during_softening);
  card.broken_link_contact = chosen(table, "broken_link_contact", contacts, card.broken_link_contact);
  if (const auto provenance = table.optional_table("provenance"))
    for (const std::string& key : provenance->keys()) card.provenance.emplace_back(key, provenance->text(key));
  table.finish();
  // Here, not by validate(): this table knows the line.
  if (const auto found = violation(card)) table.fail(found->key, found->what_is_wrong, found->remedy);
  return card;
}

std::string to_toml(const MaterialCard& card) {
  std::string text =
      "# Material card of a discrete-element concrete. Angles of friction and local strengths are those of a "
      "link.\n";
  text += fmt::format("name = {}\n\n", toml_string(card.name));
  const bool moments = card.link_law == LinkLawKind::moment_transfer;
  if (moments)
    text +=
        line("link_law", toml_string(name_of(card.link_law)), "paper: elements roll freely; moment_transfer");
  for (const Field& field : fields) {
    if (!counts(field, card)) continue;
    const std::string value = quantity_text(card.*field.value, field.kind);
    text += line(field.key, field.kind == Quantity::ratio ? value : toml_string(value), field.comment);
  }
  text += "\n";
  text +=
      line("unloading", toml_string(name_of(card.unloading)), "from the softening branch: secant or elastic");
  text += line("cohesion_during_softening", toml_string(name_of(card.cohesion_during_softening)),
               "constant or proportional");
  text += line("broken_link_contact", toml_string(name_of(card.broken_link_contact)),
               "begins at initial_distance or radii");
  if (!card.provenance.empty()) text += "\n[provenance]\n";
  for (const auto& [key, value] : card.provenance)
    text += fmt::format("{} = {}\n", key_text(key), toml_string(value));
  return text;
}

}  // namespace dem
