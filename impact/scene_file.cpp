// case.toml -> Scene. docs/cases.md is the reader's side of the scene_*.cpp files: keep them together.
#include "impact/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "impact/scene_parts.h"
#include "libdem/core/sha256.h"
#include "libdem/material/card_table.h"
#include "specimens/interaction_range.h"
#include "specimens/representative.h"
#include "specimens/specimen_file.h"

namespace impact {
namespace {

using dem::Quantity;
using dem::TomlTable;

TomlTable need(const TomlTable& root, const char* name) {
  if (!root.has(name))
    root.fail(name, "the table is missing",
              fmt::format("write it as [{}] with its keys on the lines below", name));
  return root.table(name);
}

void read_card_file(const std::filesystem::path& file, Scene& scene) {
  const TomlTable table = TomlTable::read(file);
  scene.card = dem::card_of(table);
  scene.inputs.push_back({"card", file, table.sha256()});
}

void read_card_of(const TomlTable& root, const std::optional<std::filesystem::path>& instead, Scene& scene) {
  if (instead) {
    if (root.has("card")) root.text("card");
    read_card_file(*instead, scene);
    return;
  }
  const std::filesystem::path file = read_path(root, "card");
  told_about(root, "card", [&] { read_card_file(file, scene); });
}

void read_size(const TomlTable& structure, Scene& scene) {
  scene.size = read_lengths(structure, "size", "2.5x2.0x0.28 m");
  for (int k = 0; k < 3; ++k)
    if (!(scene.size[k] > 1e-3 && scene.size[k] < 1000))
      structure.fail("size", fmt::format("has a side of {:g} m", scene.size[k]), "allowed: 1 mm to 1 km");
}

/// The interaction range is set where elements have neighbours on all sides; without such elements the run
/// would end after the packing.
void require_enough_inside(const TomlTable& structure, const specimens::PackingOptions& packing) {
  const double element = std::cbrt(packing.size.prod() / static_cast<double>(packing.elements));
  const Vec3 inside = (packing.size - Vec3::Constant(2 * specimens::internal_depth * element)).cwiseMax(0);
  const double count = inside.prod() / (element * element * element);
  if (count < static_cast<double>(specimens::least_internal_elements))
    structure.fail(
        "elements",
        fmt::format("of {} in {:.4g} x {:.4g} x {:.4g} m, {:.0f} are deeper than two element sizes",
                    packing.elements, packing.size.x(), packing.size.y(), packing.size.z(), count),
        fmt::format("at least {} are needed, take more elements", specimens::least_internal_elements));
}

/// Elements of the whole structure or, in a coupled case whose zone is packed by itself, the zone's share of
/// them by volume: an element has the same size in both models.
void read_packing(const TomlTable& structure, const Vec3& size, Scene& scene) {
  specimens::PackingOptions& packing = scene.structure.packing;
  packing.size = size;
  const std::int64_t whole = structure.integer("elements", 1, 10'000'000);
  const double share = size.prod() / scene.size.prod();
  packing.elements = static_cast<std::size_t>(std::llround(share * static_cast<double>(whole)));
  scene.seed = static_cast<std::uint64_t>(structure.optional_integer("seed", 0).value_or(1));
  packing.seed = scene.seed;
  if (const auto ratio = structure.optional_number("size_ratio")) packing.grading.size_ratio = *ratio;
  told_about(structure, "size_ratio", [&] { packing.grading.validate(); });
  require_enough_inside(structure, packing);
  if (!scene.surroundings || !scene.surroundings->cut_from_whole) return;
  packing.size = scene.size;
  packing.elements = static_cast<std::size_t>(whole);
}

void read_specimen_file(const TomlTable& structure, const Vec3& size, Scene& scene) {
  for (const char* key : {"elements", "seed", "size_ratio"})
    if (structure.has(key))
      structure.fail(key, "has no meaning beside specimen",
                     "the specimen has its elements already; leave this key out");
  const std::filesystem::path file = read_path(structure, "specimen");
  const specimens::Specimen specimen = told_about(structure, "specimen", [&] {
    scene.inputs.push_back({"specimen file", file, dem::sha256_of_file(file)});
    return specimens::read_specimen(file);
  });
  const bool zone = scene.model == Model::coupled;
  const auto is_box_of = [&](const Vec3& wanted) {
    return specimen.shape == specimens::Shape::box && (specimen.size - wanted).norm() <= 1e-6 * wanted.norm();
  };
  // A coupled case takes either: what is as large as the structure has the zone in it.
  const bool whole = is_box_of(scene.size);
  if (zone) scene.surroundings->cut_from_whole = whole;
  if (!whole && !is_box_of(size))
    structure.fail(
        "specimen",
        fmt::format("it is a {} of {:g} x {:g} x {:g} m", specimens::name_of(specimen.shape), specimen.size.x(),
                    specimen.size.y(), specimen.size.z()),
        fmt::format(
            "it must be a box of the structure's size, {:g} x {:g} x {:g} m{}", scene.size.x(), scene.size.y(),
            scene.size.z(),
            zone ? fmt::format(", or of the zone's, {:g} x {:g} x {:g} m", size.x(), size.y(), size.z()) : ""));
  scene.structure.specimen = file;
  scene.structure.packing.size = specimen.size;
  scene.structure.packing.elements = specimen.elements();
  scene.seed = scene.structure.packing.seed = specimen.seed;
}

std::vector<Support> read_supports(const TomlTable& root, const Vec3& size) {
  std::vector<Support> supports;
  std::vector<std::string> names;
  for (const TomlTable& table : root.tables("support")) {
    table.allow_only({"name", "low", "high", "centre", "size", "lock"});
    Support support;
    support.name = read_name(table, names);
    names.push_back(support.name);
    const Region region = read_region(table);
    support.low = region.low, support.high = region.high;
    for (int k = 0; k < 3; ++k)
      if (!(region.low[k] < size[k] && region.high[k] > 0))
        table.fail(region.low[k] < size[k] ? region.high_key : region.low_key,
                   fmt::format("from {:g} to {:g} m along {} there is no structure", region.low[k],
                               region.high[k], axis_name[k]),
                   fmt::format("it reaches from 0 to {:g} m", size[k]));
    const std::vector<std::string> locked =
        table.has("lock") ? table.texts("lock") : std::vector<std::string>{};
    if (locked.empty()) table.fail("lock", "locks nothing", "name axes, as in lock = [\"z\"]");
    for (const std::string& axis : locked) {
      if (axis != "x" && axis != "y" && axis != "z")
        table.fail("lock", fmt::format("\"{}\" is no axis", axis), "allowed: x, y, z");
      support.locked[static_cast<std::size_t>(axis[0] - 'x')] = true;
    }
    supports.push_back(support);
  }
  return supports;
}

std::vector<Probe> read_probes(const TomlTable& root, const Vec3& size) {
  std::vector<Probe> probes;
  std::vector<std::string> names;
  for (const TomlTable& table : root.tables("probe")) {
    table.allow_only({"name", "point"});
    Probe probe;
    probe.name = read_name(table, names);
    names.push_back(probe.name);
    probe.point = read_lengths(table, "point", "1.25,1.0,0 m");
    for (int k = 0; k < 3; ++k)
      if (!(probe.point[k] >= 0 && probe.point[k] <= size[k]))
        table.fail("point", fmt::format("{} = {:g} m lies outside the structure", axis_name[k], probe.point[k]),
                   fmt::format("it reaches from 0 to {:g} m", size[k]));
    probes.push_back(probe);
  }
  return probes;
}

void read_run(const TomlTable& run, Scene& scene) {
  run.allow_only({"duration", "time_step_fraction", "damping", "samples"});
  scene.duration = read_positive(run, "duration", Quantity::time);
  // Steps are some microseconds at most: an hour of them would take years.
  constexpr double longest = 3600;
  if (scene.duration > longest)
    run.fail("duration", fmt::format("is {:g} s", scene.duration), fmt::format("at most {:g} s", longest));
  scene.time_step_fraction = read_number(
      run, "time_step_fraction", scene.time_step_fraction, [](double value) { return value > 0 && value < 1; },
      "above 0 to below 1, of the critical step");
  scene.damping = read_number(
      run, "damping", 0, [](double value) { return value >= 0 && value < 1; }, "0 to below 1");
  scene.sample_interval =
      scene.duration / static_cast<double>(run.optional_integer("samples", 1, 1'000'000).value_or(2000));
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::optional<std::filesystem::path>& card) {
  const TomlTable table = TomlTable::read(file);
  Scene scene = scene_of(table, card);
  scene.inputs.insert(scene.inputs.begin(), {"case", file, table.sha256()});
  return scene;
}

Scene scene_of(const TomlTable& root, const std::optional<std::filesystem::path>& card) {
  const std::filesystem::path file = root.file();
  root.allow_only({"title", "model", "card", "structure", "zone", "mesh", "coupling", "support", "impactor",
                   "probe", "run", "output"});
  Scene scene;
  scene.title = root.text("title", file.stem().string());
  scene.model = root.choice("model", {"de", "coupled"}) == "de" ? Model::de : Model::coupled;
  read_card_of(root, card, scene);

  const TomlTable structure = need(root, "structure");
  structure.allow_only({"size", "elements", "seed", "size_ratio", "specimen", "compressive_strength"});
  read_size(structure, scene);
  // One word switches between the models: what the coupled one needs may stay in a case of discrete elements,
  // and is checked all the same.
  if (scene.model == Model::coupled || root.has("zone") || root.has("mesh") || root.has("coupling")) {
    std::vector<dem::InputFile> mesh_files;
    const Surroundings surroundings = read_surroundings(root, scene.size, mesh_files);
    if (scene.model == Model::coupled) {
      scene.surroundings = surroundings;
      scene.inputs.insert(scene.inputs.end(), mesh_files.begin(), mesh_files.end());
    }
  }
  const Vec3 discrete =
      scene.surroundings ? Vec3(scene.surroundings->zone_high - scene.surroundings->zone_low) : scene.size;
  if (structure.has("specimen"))
    read_specimen_file(structure, discrete, scene);
  else
    read_packing(structure, discrete, scene);
  if (structure.has("compressive_strength"))
    scene.compressive_strength = read_positive(structure, "compressive_strength", Quantity::stress);

  scene.supports = read_supports(root, scene.size);
  read_impactor(need(root, "impactor"), scene);
  scene.probes = read_probes(root, scene.size);
  read_run(need(root, "run"), scene);
  if (const auto output = root.optional_table("output")) {
    output->allow_only({"frames"});
    scene.frames = static_cast<int>(output->optional_integer("frames", 0, 100'000).value_or(scene.frames));
  }
  root.finish();
  return scene;
}

}  // namespace impact
