// spall specimen make | extract | inspect
#include <fmt/format.h>

#include <charconv>

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/console.h"
#include "app/verbs.h"
#include "libdem/core/error.h"
#include "libdem/core/units.h"
#include "specimens/extract.h"
#include "specimens/inspect.h"
#include "specimens/packing.h"
#include "specimens/representative.h"
#include "specimens/specimen_file.h"

namespace app {
namespace {

struct SpecimenOptions {
  CommonOptions common;
  std::string file, size, centre, shape = "box", grading = "uniform", output;
  specimens::PackingOptions packing;
};

specimens::Shape shape_of(const SpecimenOptions& options) {
  return options.shape == "box" ? specimens::Shape::box : specimens::Shape::cylinder;
}

dem::Vec3 three_lengths(const std::string& text, const std::string& where, const std::string& shown) {
  const std::vector<double> lengths = dem::parse_quantities(text, dem::Quantity::length, where);
  if (lengths.size() != 3)
    throw dem::InputError(where, fmt::format("\"{}\" has {} number(s) instead of 3", text, lengths.size()),
                          fmt::format("write it as in \"{}\"", shown));
  return {lengths[0], lengths[1], lengths[2]};
}

/// Three sides of a box, or diameter and length of a cylinder.
dem::Vec3 size_of(const SpecimenOptions& options) {
  dem::Vec3 size;
  if (shape_of(options) == specimens::Shape::cylinder) {
    const std::vector<double> lengths = dem::parse_quantities(options.size, dem::Quantity::length, "--size");
    if (lengths.size() != 2)
      throw dem::InputError("--size",
                            fmt::format("\"{}\" has {} number(s) instead of 2", options.size, lengths.size()),
                            "write a cylinder's diameter and length as in \"0.11x0.22 m\"");
    size = {lengths[0], lengths[0], lengths[1]};
  } else {
    size = three_lengths(options.size, "--size", "0.5x0.25x0.25 m");
  }
  if (!(size.minCoeff() > 0))
    throw dem::InputError("--size", fmt::format("\"{}\" has a length that is not positive", options.size),
                          "every length must be greater than 0");
  return size;
}

void tell(Console& console, const std::string& file, const specimens::Inspection& found) {
  console.say(fmt::format("{}: {} elements, {} links, {:.4g} x {:.4g} x {:.4g} m", file, found.elements,
                          found.links, found.size.x(), found.size.y(), found.size.z()));
  console.say(fmt::format(
      "  mean interior coordination {:.4f}, interaction radius factor {:.4f}, solid fraction {:.4f}",
      found.mean_interior_coordination, found.interaction_radius_factor, found.solid_fraction));
  console.say(fmt::format("  radii {:.4g} to {:.4g} mm", 1e3 * found.radius_min, 1e3 * found.radius_max));
  console.say(fmt::format("  fabric eigenvalues {:.4f} {:.4f} {:.4f}: {}", found.fabric_eigenvalues[0],
                          found.fabric_eigenvalues[1], found.fabric_eigenvalues[2],
                          found.isotropic ? "isotropic" : "not isotropic"));
  console.say(fmt::format("  SHA-256 {}", found.sha256));
  console.result(specimens::to_json(found));
}

int make(SpecimenOptions& options) {
  options.packing.shape = shape_of(options);
  options.packing.size = size_of(options);
  options.packing.grading.kind = options.grading == "uniform"     ? specimens::Grading::Kind::uniform
                                 : options.grading == "lognormal" ? specimens::Grading::Kind::lognormal
                                                                  : specimens::Grading::Kind::equal;
  options.packing.threads = options.common.thread_count();
  options.packing.validate();
  told_about("--elements", [&] {
    specimens::require_enough_elements(options.packing.shape, options.packing.size, options.packing.elements);
  });
  require_writable_file(options.output, true);
  use_threads(options.common);
  Console console(options.common);
  const specimens::Specimen specimen = specimens::make_specimen(options.packing, console.progress());
  specimens::write_specimen(options.output, specimen);
  tell(console, options.output, specimens::inspect(specimen));
  return done;
}

int extract(SpecimenOptions& options) {
  const dem::Vec3 size = size_of(options);
  const dem::Vec3 centre = three_lengths(options.centre, "--centre", "1.25,1.0,0.14 m");
  use_threads(options.common);
  const specimens::Specimen whole = specimens::read_specimen(options.file);
  require_writable_file(options.output, true);
  Console console(options.common);
  specimens::Specimen part = told_about(
      "--centre and --size", [&] { return specimens::extract(whole, shape_of(options), centre, size); });
  specimens::write_specimen(options.output, part);
  tell(console, options.output, specimens::inspect(part));
  return done;
}

int inspect(SpecimenOptions& options) {
  use_threads(options.common);
  const specimens::Specimen specimen = specimens::read_specimen(options.file);
  Console console(options.common);
  tell(console, options.file, specimens::inspect(specimen));
  return done;
}

}  // namespace

void add_specimen(CLI::App& root, Invocation& invocation) {
  CLI::App* specimen = root.add_subcommand("specimen", "Make, extract or inspect a numerical specimen");
  specimen->require_subcommand(1);
  const auto options = std::make_shared<SpecimenOptions>();
  const auto add = [&](const std::string& name, const std::string& description, const std::string& example,
                       int (*action)(SpecimenOptions&)) {
    CLI::App* verb = add_verb(*specimen, name, description, example, options->common);
    verb->callback([options, action, &invocation] { invocation.action = [=] { return action(*options); }; });
    return verb;
  };
  const auto add_shape = [&](CLI::App* verb) {
    verb->add_option("--shape", options->shape, "Shape of the specimen, default box")
        ->check(CLI::IsMember({"box", "cylinder"}));
    verb->add_option(
            "--size", options->size,
            "Sides of a box, as \"0.5x0.25x0.25 m\"; diameter and length of a cylinder, as \"0.11x0.22 m\"")
        ->required();
  };
  const std::string example =
      "spall specimen make --size \"0.5x0.25x0.25 m\" --elements 2700 --seed 1 -o s1.h5\n";

  CLI::App* maker = add("make", "Pack elements into a shape and link them (mean interior coordination 12)",
                        example.substr(0, example.size() - 1), make);
  add_shape(maker);
  maker->add_option("--elements", options->packing.elements, "Number of elements")
      ->required()
      ->check(CLI::Range(1, 100'000'000));
  maker
      ->add_option("--seed", options->packing.seed, "Seed of the disorder, default 1: same seed, same specimen")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()).description("0 or more"))
      ->check(CLI::Validator(
          [](const std::string& word) {  // CLI11 reads what is too large as the largest number
            std::int64_t seed = 0;
            const bool fits = std::from_chars(word.data(), word.data() + word.size(), seed).ec !=
                              std::errc::result_out_of_range;
            return fits ? std::string()
                        : fmt::format("Value {} not in range 0 to {}", word,
                                      std::numeric_limits<std::int64_t>::max());
          },
          ""));
  maker->add_option("--grading", options->grading, "Distribution of the radii, default uniform")
      ->check(CLI::IsMember({"uniform", "lognormal", "equal"}));
  maker
      ->add_option("--size-ratio", options->packing.grading.size_ratio,
                   "Largest over smallest radius, default 2")
      ->check(number_between(1, 10));
  maker
      ->add_option("--solid-fraction", options->packing.solid_fraction,
                   "Volume of the elements over that of the specimen, default 0.41")
      ->check(number_between(0.1, 0.57));
  maker->add_option("-o,--output", options->output, "Specimen to write (HDF5)")->required();

  CLI::App* extractor =
      add("extract", "Cut a specimen out of a larger one, and link it anew",
          "spall specimen make --size \"0.5x0.5x0.28 m\" --elements 6000 --seed 1 -o slab.h5\n"
          "spall specimen extract slab.h5 --centre \"0.25,0.25,0.14 m\" --size \"0.28x0.28x0.28 m\" -o cube.h5",
          extract);
  extractor->add_option("from", options->file, "Specimen to cut from (HDF5)")->required();
  extractor->add_option("--centre", options->centre, "Centre of the part, as \"1.25,1.0,0.14 m\"")->required();
  add_shape(extractor);
  extractor->add_option("-o,--output", options->output, "Specimen to write (HDF5)")->required();

  add("inspect", "Say what a specimen is: elements, links, coordination, isotropy",
      example + "spall specimen inspect s1.h5", inspect)
      ->add_option("specimen", options->file, "Specimen (HDF5)")
      ->required();
}

}  // namespace app
