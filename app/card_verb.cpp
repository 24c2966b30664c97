// spall card show | check | export | example
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/console.h"
#include "app/streams.h"
#include "app/verbs.h"
#include "app/version.h"
#include "exchange/export.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/material/element_size_rule.h"
#include "libdem/material/material_card.h"
#include "libdem/material/micro_macro.h"
#include "specimens/specimen_file.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

struct CardOptions {
  CommonOptions common;
  std::string card, format, specimen, from, to, output;
};

Json to_json(const dem::MaterialCard& card) {
  Json json;
  json["name"] = card.name;
  for (const dem::CardNumber& number : dem::numbers_of(card)) json[number.key] = number.value;
  for (const auto& [key, value] : dem::choices_of(card)) json[key] = value;
  json["provenance"] = Json::object();
  for (const auto& [key, value] : card.provenance) json["provenance"][key] = value;
  return json;
}

int show(const CardOptions& options) {
  const dem::MaterialCard card = dem::read_card(options.card);
  const dem::LinkStiffness link =
      dem::link_stiffness(card.young_modulus, card.poisson_ratio, card.alpha, card.beta, card.gamma);
  Console console(options.common);
  console.say(dem::to_toml(card));
  console.say(fmt::format("# A link then has (Eq. 1): Ks/Kn = {:.5g}, Kn D_init / S_int = {:.5g} GPa",
                          link.shear_ratio, link.normal_modulus / 1e9));
  Json json = to_json(card);
  json["link"] = {{"shear_ratio", link.shear_ratio}, {"normal_modulus", link.normal_modulus}};
  console.result(json);
  return done;
}

int check(const CardOptions& options) {
  const dem::MaterialCard card = dem::read_card(options.card);
  Console console(options.common);
  console.say(fmt::format("{}: a valid material card ({})", options.card, card.name));
  console.result(Json{{"card", options.card}, {"valid", true}});
  return done;
}

/// Writes `text` to -o, or to standard output if there is no -o.
int deliver(const CardOptions& options, const std::string& text, const Json& json) {
  if (options.output.empty()) {
    if (options.common.json)
      Console(options.common).result(json);
    else
      put(stdout, text);
    return done;
  }
  require_writable_file(options.output);
  dem::write_file_atomically(options.output, text);
  Console console(options.common);
  console.say(fmt::format("wrote {}", options.output));
  console.result(Json{{"output", options.output}});
  return done;
}

int export_card(const CardOptions& options) {
  const exchange::Format format = exchange::format_named(options.format);
  const dem::MaterialCard card = dem::read_card(options.card);
  std::optional<specimens::Specimen> specimen;
  if (!options.specimen.empty()) {
    if (options.output.empty())
      throw dem::InputError("-o", "is missing",
                            "a specimen takes files of its own beside the card's: name one with -o");
    specimen = specimens::read_specimen(options.specimen);
  }
  const std::filesystem::path output = options.output;
  const exchange::Exported exported = exchange::export_card(
      format,
      {card, specimen ? &*specimen : nullptr, fmt::format("Spall {}", version), output.filename().string()});

  Console console(options.common);
  if (options.output.empty()) {
    if (options.common.json && format == exchange::Format::csv)
      console.result(to_json(card));
    else if (options.common.json)
      console.result(Json{{"format", options.format}, {"text", exported.text}, {"lost", exported.lost}});
    else
      put(stdout, exported.text);
    return done;
  }
  require_writable_file(options.output);
  Json files = Json::array();
  for (const exchange::Companion& file : exported.beside) {
    const std::filesystem::path path = output.parent_path() / file.name;
    if (path == output)
      throw dem::InputError(options.output, "is the name of the file that goes beside it",
                            "give -o another ending");
    dem::write_file_atomically(path, file.text);
    console.say(fmt::format("wrote {}", path.string()));
    files.push_back(path.string());
  }
  dem::write_file_atomically(output, exported.text);
  console.say(fmt::format("wrote {}", options.output));
  if (!exported.lost.empty()) console.say(fmt::format("What {} does otherwise than the card:", options.format));
  for (const std::string& loss : exported.lost) console.say("- " + loss);
  console.result(Json{{"output", options.output}, {"beside", files}, {"lost", exported.lost}});
  return done;
}

int rescale(const CardOptions& options) {
  const dem::MaterialCard card = dem::read_card(options.card);
  const double from = dem::parse_quantity(options.from, dem::Quantity::length, "--from");
  const double to = dem::parse_quantity(options.to, dem::Quantity::length, "--to");
  const dem::MaterialCard made =
      told_about("--from and --to", [&] { return dem::for_element_size(card, from, to); });
  return deliver(options, dem::to_toml(made), to_json(made));
}

int write_example(const CardOptions& options) {
  dem::MaterialCard card;
  card.name = "Table 2 of the paper";
  card.cohesion = 36e6;
  card.provenance = {{"source", "Table 2 and Eq. 3 of the paper; the density is an ordinary value"}};
  return deliver(options, dem::to_toml(card), to_json(card));
}

}  // namespace

void add_card(CLI::App& root, Invocation& invocation) {
  CLI::App* card = root.add_subcommand("card", "Show, check or export a material card");
  card->require_subcommand(1);
  const auto options = std::make_shared<CardOptions>();
  const auto add = [&](const std::string& name, const std::string& description, const std::string& example,
                       int (*action)(const CardOptions&)) {
    CLI::App* verb = add_verb(*card, name, description, example, options->common);
    verb->callback([options, action, &invocation] { invocation.action = [=] { return action(*options); }; });
    return verb;
  };
  const std::string make_one = "spall card example -o card.toml\n";
  add("show", "Print a card with the link stiffness that follows from it",
      make_one + "spall card show card.toml", show)
      ->add_option("card", options->card, "Material card (TOML)")
      ->required();
  add("check", "Check a card: exit code 0 if it is valid, 2 and one line if not",
      make_one + "spall card check card.toml", check)
      ->add_option("card", options->card, "Material card (TOML)")
      ->required();
  CLI::App* exporter =
      add("export", "Write a card, and a specimen, for another code; says what that code's law does otherwise",
          make_one +
              "spall card export card.toml --to csv -o card.csv\n"
              "spall specimen make --size \"0.4x0.2x0.2 m\" --elements 1400 --seed 1 -o s1.h5\n"
              "spall card export card.toml --to yade-cpm --specimen s1.h5 -o concrete.py",
          export_card);
  exporter->add_option("card", options->card, "Material card (TOML)")->required();
  exporter
      ->add_option("--to", options->format,
                   fmt::format("Format: {}", fmt::join(exchange::format_names(), ", ")))
      ->required();
  exporter->add_option("--specimen", options->specimen,
                       "Specimen (HDF5) whose elements and links go along, in files beside the one of -o");
  exporter->add_option("-o,--output", options->output, "File to write (default: standard output)");
  CLI::App* scaler =
      add("rescale", "Bring a card to elements of another size: same tensile strength and fracture energy",
          make_one + "spall card rescale card.toml --from \"23 mm\" --to \"15 mm\" -o finer.toml", rescale);
  scaler->add_option("card", options->card, "Material card (TOML)")->required();
  scaler
      ->add_option("--from", options->from,
                   "Size of the elements that it was fitted to, as \"23 mm\"; see specimen inspect")
      ->required();
  scaler->add_option("--to", options->to, "Size of the elements that it is wanted for")->required();
  scaler->add_option("-o,--output", options->output, "File to write (default: standard output)");
  add("example", "Write a valid card to begin with: Table 2 of the paper", "spall card example -o card.toml",
      write_example)
      ->add_option("-o,--output", options->output, "File to write (default: standard output)");
}

}  // namespace app
