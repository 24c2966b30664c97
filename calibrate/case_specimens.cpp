// Specimens of a case: packed from seeds, or cut out of a structure.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "calibrate/case_parts.h"
#include "libdem/core/error.h"
#include "libdem/core/sha256.h"
#include "specimens/extract.h"
#include "specimens/representative.h"
#include "specimens/specimen_file.h"

namespace calibrate {
namespace {

using dem::InputError;
using dem::TomlTable;

void refuse_keys(const TomlTable& table, std::initializer_list<const char*> keys, const char* wrong,
                 const char* remedy) {
  for (const char* key : keys)
    if (table.has(key)) table.fail(key, wrong, remedy);
}

/// What a room below says about `key` gets the file and the line in front.
template <class Action>
auto told_about(const TomlTable& table, const char* key, Action&& action) {
  try {
    return action();
  } catch (const InputError& error) {
    throw InputError(table.where(key), error.what(), "");
  }
}

dem::Vec3 read_size(const TomlTable& table, bool cylinder) {
  const char* remedy = cylinder ? "a cylinder's size is diameter x length, as in \"98.6x300 mm\""
                                : "a box has three sides, as in \"0.5x0.25x0.25 m\"";
  if (cylinder && !table.has("size")) table.fail("size", "is missing", remedy);
  const std::vector<double> size = table.has("size") ? table.quantities("size", dem::Quantity::length)
                                                     : std::vector<double>{0.5, 0.25, 0.25};
  if (size.size() != (cylinder ? 2U : 3U))
    table.fail("size", fmt::format("has {} length{}", size.size(), size.size() == 1 ? "" : "s"), remedy);
  dem::Vec3 sides = cylinder ? dem::Vec3(size[0], size[0], size[1]) : dem::Vec3(size[0], size[1], size[2]);
  for (int axis = 0; axis < 3; ++axis)
    if (!(sides[axis] > 1e-3 && sides[axis] < 100))
      table.fail("size", fmt::format("has a side of {:.4g} m", sides[axis]), "allowed: 1 mm to 100 m");
  return sides;
}

void read_shape(const TomlTable& table, specimens::PackingOptions& packing) {
  const bool cylinder = table.choice("shape", {"box", "cylinder"}, "box") == "cylinder";
  packing.shape = cylinder ? specimens::Shape::cylinder : specimens::Shape::box;
  packing.size = read_size(table, cylinder);
}

std::vector<std::uint64_t> read_seeds(const TomlTable& table, const char* key,
                                      std::vector<std::uint64_t> fallback) {
  if (!table.has(key)) return fallback;
  std::vector<std::uint64_t> list;
  for (const std::int64_t seed : table.integers(key)) {
    if (seed < 0) table.fail(key, fmt::format("{} is negative", seed), "a seed is 0 or more");
    list.push_back(static_cast<std::uint64_t>(seed));
  }
  return list;
}

std::vector<dem::Vec3> read_centres(const TomlTable& table, const char* key) {
  std::vector<dem::Vec3> list;
  for (const std::string& text : table.texts(key)) {
    const std::vector<double> c = dem::parse_quantities(text, dem::Quantity::length, table.where(key));
    if (c.size() != 3)
      table.fail(key, fmt::format("\"{}\" has {} number(s) instead of 3", text, c.size()),
                 "write a point as in \"1.25,1.0,0.14 m\"");
    list.emplace_back(c[0], c[1], c[2]);
  }
  return list;
}

void read_cuts(const TomlTable& table, CalibrationCase& result) {
  refuse_keys(table, {"elements", "size_ratio", "fit_seeds", "check_seeds"}, "has no meaning beside cut_from",
              "specimens that are cut out have fit_centres and check_centres; leave this key out");
  result.structure = table.file_path("cut_from");
  result.fit_centres = read_centres(table, "fit_centres");
  if (table.has("check_centres")) result.check_centres = read_centres(table, "check_centres");
  if (result.fit_centres.empty()) table.fail("fit_centres", "is empty", "name at least one place to cut from");
  std::vector<dem::Vec3> all = result.fit_centres;
  all.insert(all.end(), result.check_centres.begin(), result.check_centres.end());
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (all[a] == all[b])
        table.fail(a < result.fit_centres.size() ? "fit_centres" : "check_centres",
                   fmt::format("the place ({:.4g}, {:.4g}, {:.4g}) m stands twice", all[a].x(), all[a].y(),
                               all[a].z()),
                   "each specimen has its own place, and unseen ones are not among fit_centres");

  const specimens::Specimen structure =
      told_about(table, "cut_from", [&] { return specimens::read_specimen(result.structure); });
  for (std::size_t k = 0; k < all.size(); ++k)
    told_about(table, k < result.fit_centres.size() ? "fit_centres" : "check_centres", [&] {
      return specimens::extract(structure, result.packing.shape, all[k], result.packing.size);
    });
  result.inputs.push_back({"specimen file", result.structure, dem::sha256_of_file(result.structure)});
}

void read_seeded(const TomlTable& table, CalibrationCase& result) {
  refuse_keys(table, {"fit_centres", "check_centres"}, "says where to cut, but not from what",
              "name the structure with cut_from = \"slab.h5\", or give fit_seeds and check_seeds");
  result.packing = read_packing(table);
  result.fit_seeds = read_seeds(table, "fit_seeds", {1, 2, 3, 4});
  result.check_seeds = read_seeds(table, "check_seeds", {101, 102, 103});
  if (result.fit_seeds.empty()) table.fail("fit_seeds", "is empty", "name at least one seed");
  std::vector<std::uint64_t> all = result.fit_seeds;
  all.insert(all.end(), result.check_seeds.begin(), result.check_seeds.end());
  for (std::size_t k = 0; k < all.size(); ++k)
    if (std::find(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(k), all[k]) !=
        all.begin() + static_cast<std::ptrdiff_t>(k))
      table.fail(k < result.fit_seeds.size() ? "fit_seeds" : "check_seeds",
                 fmt::format("the seed {} stands twice", all[k]),
                 "each specimen has its own seed, and unseen ones are not among fit_seeds (check_seeds is "
                 "[101, 102, 103] unless it is given)");
}

}  // namespace

specimens::PackingOptions read_packing(const TomlTable& table) {
  specimens::PackingOptions packing;
  read_shape(table, packing);
  packing.elements =
      static_cast<std::size_t>(table.has("elements") ? table.integer("elements", 1, 10'000'000) : 2700);
  if (const auto ratio = table.optional_number("size_ratio")) packing.grading.size_ratio = *ratio;
  told_about(table, "size_ratio", [&] { packing.grading.validate(); });
  told_about(table, "elements", [&] {
    packing.validate();
    specimens::require_enough_elements(packing.shape, packing.size, packing.elements);
    specimens::require_enough_inside(packing.shape, packing.size, packing.elements);
  });
  return packing;
}

void read_specimens(const TomlTable& specimen, CalibrationCase& result) {
  read_shape(specimen, result.packing);
  if (specimen.has("cut_from"))
    read_cuts(specimen, result);
  else
    read_seeded(specimen, result);
}

}  // namespace calibrate
