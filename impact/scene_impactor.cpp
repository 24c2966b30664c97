// The impactor of a case: its shape and mass, how it comes, how it touches.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "impact/impactors/stl.h"
#include "impact/scene_checks.h"
#include "impact/scene_parts.h"
#include "libdem/core/sha256.h"
#include "libdem/law/cohesive_link.h"

namespace impact {
namespace {

using dem::Quantity;
using dem::TomlTable;

struct Measure {
  const char* key;
  const char* shape;
};

/// Keys that belong to one shape only; a cylinder and a sphere share the diameter.
constexpr Measure measures[] = {{"size", "box"},        {"lead", "box"},      {"diameter", "sphere"},
                                {"length", "cylinder"}, {"nose", "cylinder"}, {"file", "mesh"},
                                {"unit", "mesh"}};

void refuse_other_measures(const TomlTable& table, const std::string& shape) {
  for (const auto& [key, owner] : measures) {
    const bool shared = std::string_view(key) == "diameter" && shape == "cylinder";
    if (table.has(key) && shape != owner && !shared)
      table.fail(
          key, fmt::format("a {} has none", shape),
          "a box has size and lead, a sphere diameter, a cylinder diameter, length and nose, a mesh file "
          "and unit");
  }
}

Shape read_shape(const TomlTable& table, const std::string& shape, std::vector<dem::InputFile>& inputs) {
  if (shape == "box") {
    const Vec3 size = read_lengths(table, "size", "0.3x0.3x0.3 m");
    return make_box(size, table.where("size"));
  }
  if (shape == "sphere")
    return make_sphere(read_positive(table, "diameter", Quantity::length), table.where("diameter"));
  if (shape == "cylinder") {
    const double diameter = read_positive(table, "diameter", Quantity::length);
    const double length = read_positive(table, "length", Quantity::length);
    const Nose nose =
        table.choice("nose", {"flat", "hemisphere"}, "flat") == "flat" ? Nose::flat : Nose::hemisphere;
    return make_cylinder(diameter, length, nose, table.where("length"));
  }
  const std::filesystem::path file = read_path(table, "file");
  const double unit = read_length_unit(table);
  return told_about(table, "file", [&] {
    inputs.push_back({"impactor", file, dem::sha256_of_file(file)});
    return make_mesh(read_stl(file, unit));
  });
}

MassProperties read_mass(const TomlTable& table, const Shape& shape) {
  if (table.has("mass") && table.has("density"))
    table.fail("density", "stands beside mass", "give one of both, the other follows from the shape");
  if (!table.has("mass") && !table.has("density"))
    table.fail("density", "the key is missing", "write density = \"2500 kg/m3\", or mass = \"67.5 kg\"");
  if (table.has("mass"))
    return from_mass(shape, read_positive(table, "mass", Quantity::mass), table.where("mass"));
  return from_density(shape, read_positive(table, "density", Quantity::density), table.where("density"));
}

/// How it would lie if nothing were turned: a box leads with `lead`, a cylinder with its nose, a mesh lies as
/// in its file.
Eigen::Quaterniond read_posture(const TomlTable& table, const Shape& shape, const Vec3& direction) {
  if (const Box* box = std::get_if<Box>(&shape)) {
    const std::string lead = table.choice("lead", {"face", "edge", "corner"}, "face");
    // Straight down there is no shortest way to turn; this one keeps the box's x along the structure's.
    if (lead == "face" && direction == Vec3(-Vec3::UnitZ())) return {0, 1, 0, 0};
    return leading(lead == "face"   ? Lead::face
                   : lead == "edge" ? Lead::edge
                                    : Lead::corner,
                   box->half_size, direction);
  }
  if (std::holds_alternative<Cylinder>(shape)) return leading(Lead::face, Vec3::Ones(), direction);
  return Eigen::Quaterniond::Identity();
}

Vec3 read_axis(const TomlTable& table) {
  if (!table.has("axis")) table.fail("axis", "the key is missing", "write it as in axis = [0, 0, 1]");
  return read_direction(table, "axis", Vec3::UnitZ());
}

Approach read_approach(const TomlTable& table, const Shape& shape, const Vec3& low, const Vec3& high) {
  Approach approach;
  approach.direction = read_direction(table, "direction", -Vec3::UnitZ());
  approach.speed = read_positive(table, "speed", Quantity::velocity);
  approach.aim = table.has("aim") ? read_lengths(table, "aim", "1.25,1.0,0.14 m") : Vec3(0.5 * (low + high));
  approach.orientation = read_posture(table, shape, approach.direction);
  if (const auto turn = table.optional_table("turn")) {
    turn->allow_only({"axis", "angle"});
    const Eigen::AngleAxisd rotation(turn->quantity("angle", Quantity::angle), read_axis(*turn));
    approach.orientation = (rotation * approach.orientation).normalized();
  }
  if (const auto spin = table.optional_table("spin")) {
    spin->allow_only({"axis", "period"});
    approach.spin = 2 * std::numbers::pi / read_positive(*spin, "period", Quantity::time) * read_axis(*spin);
  }
  return approach;
}

/// A stiffness is a force over a length; the units know that as an energy over an area.
double read_stiffness(const TomlTable& table) {
  const std::string text = table.text("stiffness");
  double value = 0;
  try {
    value = dem::parse_quantity(text, Quantity::fracture_energy, "");
  } catch (const dem::InputError&) {
    table.fail("stiffness", fmt::format("\"{}\" is no stiffness", text),
               "write it as in stiffness = \"5e8 N/m\"");
  }
  if (!(value > 0)) table.fail("stiffness", fmt::format("is {:g} N/m", value), "it must be above 0");
  return value;
}

ContactLaw read_contact(const std::optional<TomlTable>& given, const dem::MaterialCard& card) {
  const TomlTable table = given ? *given : TomlTable::parse("spring = \"linear\"", "contact");
  table.allow_only({"spring", "modulus", "stiffness", "shear_ratio", "friction", "damping_ratio"});
  const dem::LinkLaw link = dem::make_link_law(card);
  ContactLaw law;
  if (table.choice("spring", {"linear", "hertz"}, "linear") == "hertz") law.spring = NormalSpring::hertz;
  law.modulus = law.spring == NormalSpring::linear
                    ? link.normal_modulus
                    : card.young_modulus / (1 - card.poisson_ratio * card.poisson_ratio);
  if (table.has("modulus")) law.modulus = read_positive(table, "modulus", Quantity::stress);
  if (table.has("stiffness")) {
    if (law.spring == NormalSpring::hertz)
      table.fail("stiffness", "is that of a linear spring", "spring = \"hertz\" takes a modulus");
    if (table.has("modulus"))
      table.fail("stiffness", "stands beside modulus", "give one of both, or neither for the card's");
    law.stiffness = read_stiffness(table);
  }
  const auto from_zero = [](double value) { return value >= 0; };
  law.shear_ratio = read_number(table, "shear_ratio", link.shear_ratio, from_zero, "0 or more");
  law.friction =
      read_number(table, "friction", link.contact_slope, from_zero, "0 or more, the angle's tangent");
  law.damping_ratio = read_number(
      table, "damping_ratio", 0, [](double value) { return value >= 0 && value <= 1; }, "0 to 1");
  law.validate(given ? table.where("spring") : "contact");
  return law;
}

}  // namespace

void read_impactor(const TomlTable& table, Scene& scene) {
  table.allow_only({"shape", "size", "diameter", "length", "nose", "file", "unit", "density", "mass", "speed",
                    "direction", "aim", "lead", "turn", "spin", "contact"});
  const std::string name = table.choice("shape", {"box", "sphere", "cylinder", "mesh"});
  refuse_other_measures(table, name);
  Impactor impactor;
  impactor.shape = read_shape(table, name, scene.inputs);
  impactor.body = RigidBody(read_mass(table, impactor.shape), {}, table.where("shape"));
  impactor.law = read_contact(table.optional_table("contact"), scene.card);
  scene.approach = read_approach(table, impactor.shape, Vec3::Zero(), scene.size);
  const bool coupled = scene.model == Model::coupled;
  const Vec3 low = coupled ? scene.surroundings->zone_low : Vec3(Vec3::Zero());
  const Vec3 high = coupled ? scene.surroundings->zone_high : scene.size;
  if (const double past = distance_past(impactor.shape, scene.approach, low, high); past > 0)
    table.fail(
        "aim", fmt::format("the impactor passes the {} by {:.3g} m", coupled ? "zone" : "structure", past),
        coupled ? "it must meet the zone: only discrete elements feel it"
                : "aim is a point on its path, as in \"1.25,1.0,0.14 m\", inside the structure for instance");
  scene.impactor = std::move(impactor);
}

}  // namespace impact
