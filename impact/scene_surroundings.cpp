// The finite elements of a coupled case: the zone that they surround, their mesh, how both are tied.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "impact/fe/gmsh_mesh.h"
#include "impact/scene_parts.h"
#include "libdem/core/sha256.h"

namespace impact {
namespace {

using dem::Quantity;
using dem::TomlTable;

constexpr const char* one_kind_of_mesh =
    "a mesh is even, as in elements = [38, 30, 4], or grows away from the zone, as in zone_elements = [16, 16, "
    "4], or comes from a file = \"slab.msh\"";

TomlTable need(const TomlTable& root, const char* name) {
  if (!root.has(name))
    root.fail(name, "the table is missing",
              "a coupled case has [zone] and [mesh]; model = \"de\" needs neither");
  return root.table(name);
}

/// The zone inside the structure. A face within rounding of the structure's is on it: whether finite elements
/// go on behind a face is told by exactly that.
void read_zone(const TomlTable& zone, const Vec3& size, Surroundings& result) {
  const Region region = read_region(zone);
  result.zone_low = region.low, result.zone_high = region.high;
  const double rounding = 1e-9 * size.norm();
  bool surrounded = false;
  for (int k = 0; k < 3; ++k) {
    double &low = result.zone_low[k], &high = result.zone_high[k];
    if (std::abs(low) <= rounding) low = 0;
    if (std::abs(high - size[k]) <= rounding) high = size[k];
    if (low < 0 || high > size[k])
      zone.fail(low < 0 ? region.low_key : region.high_key,
                fmt::format("the zone reaches from {:g} to {:g} m along {}", low, high, axis_name[k]),
                fmt::format("it must lie inside the structure, from 0 to {:g} m", size[k]));
    surrounded = surrounded || low > 0 || high < size[k];
  }
  if (!surrounded)
    zone.fail(region.low_key, "the zone fills the whole structure, no finite element would remain",
              "make it smaller, or take model = \"de\"");
}

/// Whether finite elements go on behind one of the zone's faces across `axis`.
bool coupled_along(const Surroundings& s, const Vec3& size, int axis) {
  return s.zone_low[axis] > 0 || s.zone_high[axis] < size[axis];
}

/// The overlap has one thickness, so the layers must have about the same along all axes that are coupled. `key`
/// is that which the sizes come from.
double thickness_of_layers(const TomlTable& mesh, const char* key, const Vec3& element, const Surroundings& s,
                           const Vec3& size) {
  double least = 0, most = 0;
  int least_axis = 0, most_axis = 0;
  for (int k = 0; k < 3; ++k) {
    if (!coupled_along(s, size, k)) continue;
    if (least == 0 || element[k] < least) least = element[k], least_axis = k;
    if (element[k] > most) most = element[k], most_axis = k;
  }
  if (most > 1.1 * least)
    mesh.fail(key,
              fmt::format("an element measures {:.4g} m along {} and {:.4g} m along {}", least,
                          axis_name[least_axis], most, axis_name[most_axis]),
              "across the zone's coupled faces they may differ by a tenth: the overlap has one thickness");
  return s.box.zone->overlap_layers * least;
}

std::array<int, 3> read_counts(const TomlTable& mesh, const char* key, const char* example) {
  const std::vector<std::int64_t> counts = mesh.integers(key);
  if (counts.size() != 3)
    mesh.fail(key, fmt::format("has {} number{}, not three", counts.size(), counts.size() == 1 ? "" : "s"),
              fmt::format("write it as in {} = {}", key, example));
  std::array<int, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (counts[k] < 1 || counts[k] > 10'000)
      mesh.fail(key, fmt::format("{} along {}", counts[k], axis_name[k]), "allowed: 1 to 10000");
    result[k] = static_cast<int>(counts[k]);
  }
  // What a large machine holds; the product of three counts of 10000 is beyond any.
  constexpr double most = 50e6;
  const double product =
      static_cast<double>(result[0]) * static_cast<double>(result[1]) * static_cast<double>(result[2]);
  if (product > most)
    mesh.fail(key, fmt::format("makes {:.3g} elements", product), fmt::format("allowed: at most {:g}", most));
  return result;
}

/// Elements of the box: everywhere the same, or small at the zone and larger away from it. Returns their size
/// in the zone [m].
Vec3 read_elements(const TomlTable& mesh, const Vec3& size, Surroundings& result) {
  if (mesh.has("elements")) {
    for (const char* key : {"growth", "largest"})
      if (mesh.has(key))
        mesh.fail(key, "elements that fill the structure evenly do not grow",
                  "write zone_elements in place of elements, or leave this key out");
    result.box.elements = read_counts(mesh, "elements", "[38, 30, 4]");
    return size.cwiseQuotient(Vec3(result.box.elements[0], result.box.elements[1], result.box.elements[2]));
  }
  const std::array<int, 3> counts = read_counts(mesh, "zone_elements", "[16, 16, 4]");
  fe::Grading grading;
  if (mesh.has("growth"))
    grading.growth = read_number(
        mesh, "growth", grading.growth, [](double growth) { return growth >= 1 && growth <= 3; }, "1 to 3");
  if (mesh.has("largest")) grading.largest = read_positive(mesh, "largest", Quantity::length);
  Vec3 element;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    grading.zone_elements = counts[axis];
    element[k] = (result.zone_high[k] - result.zone_low[k]) / counts[axis];
    // The bound is for elements that are to grow: along an axis that the zone fills there are none.
    fe::Grading here = grading;
    if (!coupled_along(result, size, k)) here.largest = 0;
    told_about(mesh, mesh.has("largest") ? "largest" : "zone_elements", [&] {
      result.box.planes[axis] = fe::graded_planes(0, size[k], result.zone_low[k], result.zone_high[k], here);
    });
    result.box.elements[axis] = static_cast<int>(result.box.planes[axis].size()) - 1;
  }
  return element;
}

void read_structured(const TomlTable& zone, const TomlTable& mesh, const Vec3& size, Surroundings& result) {
  if (zone.has("overlap"))
    zone.fail("overlap", "is the thickness of an overlap with a mesh from a file",
              "a structured mesh counts its overlap in elements, as in layers = 3");
  const char* key = mesh.has("elements") ? "elements" : "zone_elements";
  const Vec3 element = read_elements(mesh, size, result);
  result.box.size = size;
  const auto layers = static_cast<int>(zone.optional_integer("layers", 1, 1000).value_or(3));
  result.box.zone = fe::DiscreteZone{result.zone_low, result.zone_high, layers};
  told_about(mesh, key, [&] { result.box.validate(); });
  result.overlap = thickness_of_layers(mesh, key, element, result, size);
}

void read_mesh_file(const TomlTable& zone, const TomlTable& mesh, const Vec3& size, Surroundings& result,
                    std::vector<dem::InputFile>& inputs) {
  if (zone.has("layers"))
    zone.fail("layers", "counts the elements of a structured mesh",
              "an overlap with a mesh from a file has a thickness, as in overlap = \"0.2 m\"");
  result.overlap = read_positive(zone, "overlap", Quantity::length);
  for (int k = 0; k < 3; ++k) {
    const int faces = (result.zone_low[k] > 0 ? 1 : 0) + (result.zone_high[k] < size[k] ? 1 : 0);
    const double side = result.zone_high[k] - result.zone_low[k];
    if (faces * result.overlap >= side)
      zone.fail("overlap",
                fmt::format("{} of {:g} m leave nothing of the zone's {:g} m along {}",
                            faces == 1 ? "an overlap" : "two overlaps", result.overlap, side, axis_name[k]),
                "make the zone larger or the overlap thinner");
  }
  const std::filesystem::path file = read_path(mesh, "file");
  result.mesh_unit = read_length_unit(mesh);
  // Read now, so that whatever is wrong with it is told before anything is packed.
  const fe::Mesh read = told_about(mesh, "file", [&] {
    inputs.push_back({"mesh", file, dem::sha256_of_file(file)});
    return fe::read_gmsh(file.string(), result.mesh_unit);
  });
  Vec3 low = read.nodes.front(), high = low;
  for (const Vec3& node : read.nodes) low = low.cwiseMin(node), high = high.cwiseMax(node);
  for (int k = 0; k < 3; ++k)
    if (std::abs(low[k]) > 1e-6 * size.norm() || std::abs(high[k] - size[k]) > 1e-6 * size.norm())
      mesh.fail("file",
                fmt::format("the mesh reaches from {:g} to {:g} m along {}", low[k], high[k], axis_name[k]),
                fmt::format("it must be as large as the structure, from 0 to {:g} m", size[k]));
  result.mesh_file = file;
}

void read_coupling(const TomlTable& table, Surroundings& result) {
  table.allow_only({"ties", "solve", "relaxation_time", "interval"});
  if (table.choice("ties", {"displacements", "displacements_and_rotations"}, "displacements") !=
      "displacements")
    result.ties = coupling::Ties::displacements_and_rotations;
  if (table.choice("solve", {"consistent", "lumped"}, "consistent") == "lumped") {
    if (result.ties != coupling::Ties::displacements)
      table.fail("solve", "lumped multipliers cannot tie rotations",
                 "take solve = \"consistent\", or ties = \"displacements\"");
    result.solve = coupling::MultiplierSolve::lumped;
  }
  result.relaxation_time = table.quantity("relaxation_time", Quantity::time, 0);
  if (!(result.relaxation_time >= 0))
    table.fail("relaxation_time", fmt::format("is {:g} s", result.relaxation_time),
               "it must be 0 (a strict tie) or more");
  result.interval = static_cast<int>(table.optional_integer("interval", 1, 10'000).value_or(0));
}

}  // namespace

Surroundings read_surroundings(const TomlTable& root, const Vec3& size, std::vector<dem::InputFile>& inputs) {
  const TomlTable zone = need(root, "zone"), mesh = need(root, "mesh");
  zone.allow_only({"low", "high", "centre", "size", "layers", "overlap", "cut_from_whole"});
  mesh.allow_only({"elements", "zone_elements", "growth", "largest", "file", "unit", "young_modulus",
                   "poisson_ratio", "modulus"});
  Surroundings result;
  read_zone(zone, size, result);
  result.cut_from_whole = zone.boolean("cut_from_whole", false);
  constexpr std::array<const char*, 3> kinds = {"elements", "zone_elements", "file"};
  const char* kind = nullptr;
  for (const char* key : kinds) {
    if (!mesh.has(key)) continue;
    if (kind != nullptr) mesh.fail(key, fmt::format("stands beside {}", kind), one_kind_of_mesh);
    kind = key;
  }
  if (kind == nullptr) mesh.fail("elements", "the key is missing", one_kind_of_mesh);
  if (mesh.has("file")) {
    for (const char* key : {"growth", "largest"})
      if (mesh.has(key))
        mesh.fail(key, "has no meaning beside file", "the mesh has its elements already; leave this key out");
    read_mesh_file(zone, mesh, size, result, inputs);
  } else {
    if (mesh.has("unit")) mesh.fail("unit", "is that of a mesh file", "leave it out beside elements");
    read_structured(zone, mesh, size, result);
  }
  const std::string modulus = mesh.choice("modulus", {"flexural", "membrane", "bulk"}, "flexural");
  result.modulus = modulus == "flexural"   ? PackModulus::flexural
                   : modulus == "membrane" ? PackModulus::membrane
                                           : PackModulus::bulk;
  if (mesh.has("young_modulus") && mesh.has("modulus"))
    mesh.fail("modulus", "says which modulus is measured, and young_modulus is given", "leave one of both out");
  if (mesh.has("young_modulus")) result.young_modulus = read_positive(mesh, "young_modulus", Quantity::stress);
  if (mesh.has("poisson_ratio"))
    result.poisson_ratio = read_number(
        mesh, "poisson_ratio", 0, [](double nu) { return nu > -1 && nu < 0.5; }, "above -1 to below 0.5");
  if (const auto coupling = root.optional_table("coupling")) read_coupling(*coupling, result);
  return result;
}

}  // namespace impact
