// [[specimen]]: groups of specimens, packed from seeds or read from files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "libdem/core/sha256.h"
#include "libdem/core/units.h"
#include "specimens/representative.h"
#include "specimens/specimen_file.h"
#include "study/number_list.h"
#include "study/plan_key.h"
#include "study/study_parts.h"

namespace study {
namespace {

using dem::TomlTable;
using Kind = TomlTable::Kind;

constexpr auto largest_seed = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());

dem::Vec3 parse_size(const TomlTable& table, const std::string& text, bool cylinder) {
  const std::vector<double> size = dem::parse_quantities(text, dem::Quantity::length, table.where("size"));
  const char* remedy = cylinder ? "a cylinder's size is diameter x length, as in \"98.6x300 mm\""
                                : "a box has three sides, as in \"0.5x0.25x0.25 m\"";
  if (size.size() != (cylinder ? 2U : 3U))
    table.fail("size", fmt::format("\"{}\" has {} length{}", text, size.size(), size.size() == 1 ? "" : "s"),
               remedy);
  dem::Vec3 sides = cylinder ? dem::Vec3(size[0], size[0], size[1]) : dem::Vec3(size[0], size[1], size[2]);
  for (int axis = 0; axis < 3; ++axis)
    if (!(sides[axis] > 1e-3 && sides[axis] < 100))
      table.fail("size", fmt::format("has a side of {:.4g} m", sides[axis]), "allowed: 1 mm to 100 m");
  return sides;
}

/// One number, a list of numbers, or text such as "1-10, 12".
std::vector<std::uint64_t> read_seeds(const TomlTable& table) {
  if (!table.has("seeds"))
    table.fail("seeds", "the key is missing", "write it as in seeds = \"1-10\" or seeds = [1, 2, 3]");
  if (table.kind("seeds") == Kind::text)
    return parse_number_list(table.text("seeds"), 0, largest_seed, table.where("seeds"));
  const std::vector<std::int64_t> numbers = table.kind("seeds") == Kind::number
                                                ? std::vector<std::int64_t>{table.integer("seeds")}
                                                : table.integers("seeds");
  if (numbers.empty()) table.fail("seeds", "is empty", "name at least one seed");
  std::vector<std::uint64_t> seeds;
  for (const std::int64_t number : numbers) {
    if (number < 0) table.fail("seeds", fmt::format("{} is negative", number), "a seed is 0 or more");
    const auto seed = static_cast<std::uint64_t>(number);
    if (std::find(seeds.begin(), seeds.end(), seed) != seeds.end())
      table.fail("seeds", fmt::format("the seed {} stands twice", seed), "each specimen has its own seed");
    seeds.push_back(seed);
  }
  return seeds;
}

/// Element counts, one for each thing that was asked for: counts, or sizes of an element in this volume.
std::vector<std::size_t> read_counts(const TomlTable& table, double volume) {
  const bool by_count = table.has("elements");
  if (by_count == table.has("element_size"))
    table.fail(by_count ? "element_size" : "elements",
               by_count ? "stands beside elements" : "the key is missing",
               "give either elements = 2700 or element_size = \"22.6 mm\"");
  std::vector<std::size_t> counts;
  const auto add = [&](const char* key, double count) {
    if (!(count >= 1 && count <= 1e8))
      table.fail(key, fmt::format("asks for {:.4g} elements", count), "allowed: 1 to 100000000");
    const auto whole = static_cast<std::size_t>(std::llround(count));
    if (std::find(counts.begin(), counts.end(), whole) != counts.end())
      table.fail(key, fmt::format("asks twice for {} elements", whole), "name each count once");
    counts.push_back(whole);
  };
  if (by_count) {
    const std::vector<std::int64_t> given = table.kind("elements") == Kind::list
                                                ? table.integers("elements")
                                                : std::vector<std::int64_t>{table.integer("elements")};
    for (const std::int64_t count : given) add("elements", static_cast<double>(count));
    if (counts.empty()) table.fail("elements", "is empty", "write it as in elements = 2700");
  } else {
    const std::vector<double> given =
        table.kind("element_size") == Kind::list
            ? table.quantities("element_size", dem::Quantity::length)
            : std::vector<double>{table.quantity("element_size", dem::Quantity::length)};
    for (const double size : given) {
      if (!(size > 0))
        table.fail("element_size", fmt::format("is {:.4g} m", size), "it must be greater than 0");
      add("element_size", volume / (size * size * size));
    }
    if (counts.empty()) table.fail("element_size", "is empty", "write it as in element_size = \"22.6 mm\"");
  }
  return counts;
}

specimens::Grading read_grading(const TomlTable& table) {
  specimens::Grading grading;
  const std::string kind = table.choice("grading", {"uniform", "lognormal", "equal"}, "uniform");
  grading.kind = kind == "uniform"     ? specimens::Grading::Kind::uniform
                 : kind == "lognormal" ? specimens::Grading::Kind::lognormal
                                       : specimens::Grading::Kind::equal;
  if (table.has("size_ratio") && grading.kind != specimens::Grading::Kind::uniform)
    table.fail("size_ratio", fmt::format("has no meaning for {} elements", kind), "leave the key out");
  grading.size_ratio = table.number("size_ratio", grading.size_ratio);
  told_about(table, "size_ratio", [&] { grading.validate(); });
  return grading;
}

void add_packed(const TomlTable& table, const std::string& group, Study& study) {
  const bool cylinder = table.choice("shape", {"box", "cylinder"}, "box") == "cylinder";
  specimens::PackingOptions packing;
  packing.shape = cylinder ? specimens::Shape::cylinder : specimens::Shape::box;
  packing.grading = read_grading(table);
  packing.solid_fraction = table.number("solid_fraction", packing.solid_fraction);
  if (!table.has("size")) table.fail("size", "the key is missing", "write it as in size = \"0.5x0.25x0.25 m\"");
  const std::vector<std::uint64_t> seeds = read_seeds(table);
  for (const std::string& text : one_or_more_texts(table, "size")) {
    packing.size = parse_size(table, text, cylinder);
    specimens::Specimen nominal;
    nominal.shape = packing.shape, nominal.size = packing.size;
    for (const std::size_t count : read_counts(table, nominal.volume())) {
      packing.elements = count;
      told_about(table, table.has("elements") ? "elements" : "element_size", [&] {
        packing.validate();
        specimens::require_enough_elements(packing.shape, packing.size, packing.elements);
        specimens::require_enough_inside(packing.shape, packing.size, packing.elements);
      });
      for (const std::uint64_t seed : seeds) {
        packing.seed = seed;
        study.specimens.push_back({group, packing, {}, {}});
      }
    }
  }
}

void add_files(const TomlTable& table, const std::string& group, Study& study) {
  for (const char* key :
       {"shape", "size", "elements", "element_size", "seeds", "grading", "size_ratio", "solid_fraction"})
    if (table.has(key))
      table.fail(key, "has no meaning beside files", "a specimen in a file is what it is; leave this key out");
  for (const std::string& text : one_or_more_texts(table, "files")) {
    SpecimenRecipe recipe;
    recipe.group = group;
    recipe.file = std::filesystem::path(table.file()).parent_path() / text;
    const specimens::Specimen specimen =
        told_about(table, "files", [&] { return specimens::read_specimen(recipe.file); });
    recipe.packing.shape = specimen.shape;
    recipe.packing.size = specimen.size;
    recipe.packing.elements = specimen.elements();
    recipe.packing.seed = specimen.seed;
    recipe.sha256 = specimen.sha256();
    study.inputs.push_back({"specimen file", recipe.file, dem::sha256_of_file(recipe.file)});
    study.specimens.push_back(std::move(recipe));
  }
}

}  // namespace

void read_specimen_groups(const TomlTable& root, Study& study) {
  const std::vector<TomlTable> groups = root.tables("specimen");
  if (groups.empty())
    root.fail("specimen", "there is none",
              "write [[specimen]] with size, elements and seeds on the lines below");
  std::set<std::string> names, known;
  for (const TomlTable& table : groups) {
    table.allow_only({"name", "shape", "size", "elements", "element_size", "seeds", "grading", "size_ratio",
                      "solid_fraction", "files"});
    const std::string name = table.text("name", fmt::format("specimen {}", names.size() + 1));
    if (name.empty() || !names.insert(name).second)
      table.fail("name", name.empty() ? "is empty" : fmt::format("two groups are called \"{}\"", name),
                 "give each [[specimen]] a name of its own, or leave the key out");
    const std::size_t before = study.specimens.size();
    if (table.has("files"))
      add_files(table, name, study);
    else
      add_packed(table, name, study);
    // Twice the same specimen would count as two in every mean.
    for (std::size_t k = before; k < study.specimens.size(); ++k)
      if (!known.insert(key_text(study.specimens[k])).second)
        table.fail(table.has("files") ? "files" : "seeds",
                   fmt::format("the specimen \"{}\" stands twice in this study", label_of(study.specimens[k])),
                   "give it another seed, or name it once");
  }
}

}  // namespace study
