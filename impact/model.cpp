#include "impact/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "impact/coupling/discrete_side.h"
#include "impact/coupling/pack_moduli.h"
#include "impact/fe/critical_step.h"
#include "impact/fe/gmsh_mesh.h"
#include "libdem/core/error.h"
#include "libdem/core/memory.h"
#include "libdem/core/sha256.h"
#include "libdem/motion/critical_step.h"
#include "specimens/extract.h"
#include "specimens/interaction_range.h"
#include "specimens/packing.h"
#include "specimens/representative.h"
#include "specimens/specimen_file.h"

namespace impact {
namespace {

constexpr double bytes_an_element = 2000;

bool inside(const Vec3& point, const Vec3& low, const Vec3& high) {
  return (point.array() >= low.array() - 1e-9).all() && (point.array() <= high.array() + 1e-9).all();
}

/// The scene keeps only the name of what is large, and reads it once more when it is needed.
void require_as_read(const Scene& scene, const std::filesystem::path& file) {
  for (const dem::InputFile& input : scene.inputs)
    if (input.file == file && dem::sha256_of_file(file) != input.sha256)
      throw dem::InputError(file.string(), "was changed since the case was read",
                            "start again, and leave it as it is until the run has begun");
}

/// The structure or the zone, packed and linked or read.
specimens::Specimen make_specimen(const Scene& scene, int threads, const dem::ProgressCallback& progress) {
  const bool cut = scene.surroundings && scene.surroundings->cut_from_whole;
  specimens::Specimen specimen;
  if (scene.structure.specimen) {
    require_as_read(scene, *scene.structure.specimen);
    specimen = specimens::read_specimen(*scene.structure.specimen);
  } else {
    specimens::PackingOptions packing = scene.structure.packing;
    packing.threads = threads;
    packing.validate();
    // Before it is packed for nothing: what the run itself will need, see docs/limits.md.
    dem::require_memory(bytes_an_element * static_cast<double>(packing.elements), "structure: elements",
                        fmt::format("an impact on {} elements", packing.elements));
    specimen = specimens::pack(packing, progress);
  }
  if (cut) {
    const Surroundings& around = *scene.surroundings;
    specimen = specimens::cut_out(specimen, specimens::Shape::box, 0.5 * (around.zone_low + around.zone_high),
                                  around.zone_high - around.zone_low);
  }
  if (cut || !scene.structure.specimen) {
    if (progress) progress({"linking", 0, 0, "links", ""});
    specimens::link(specimen, threads);
  }
  return specimen;
}

/// The size that the discrete elements must fill: the structure, or the zone.
void require_size(const Scene& scene, const specimens::Specimen& specimen) {
  const Vec3 wanted =
      scene.surroundings ? Vec3(scene.surroundings->zone_high - scene.surroundings->zone_low) : scene.size;
  if ((specimen.size - wanted).norm() <= 1e-6 * wanted.norm()) return;
  throw dem::InputError(
      scene.structure.specimen ? scene.structure.specimen->string() : "structure",
      fmt::format("is {:g} x {:g} x {:g} m", specimen.size.x(), specimen.size.y(), specimen.size.z()),
      fmt::format("the {} is {:g} x {:g} x {:g} m", scene.surroundings ? "zone" : "structure", wanted.x(),
                  wanted.y(), wanted.z()));
}

/// The zone's faces behind which the structure goes on.
coupling::Zone zone_of(const Scene& scene) {
  const Surroundings& around = *scene.surroundings;
  coupling::Zone zone;
  zone.centre = 0.5 * (around.zone_low + around.zone_high);
  zone.half_size = 0.5 * (around.zone_high - around.zone_low);
  zone.thickness = around.overlap;
  for (std::size_t side = 0; side < 6; side += 2) {
    const auto axis = static_cast<Eigen::Index>(side / 2);
    const double tolerance = 1e-6 * scene.size[axis];
    zone.coupled[side] = around.zone_low[axis] > tolerance;
    zone.coupled[side + 1] = around.zone_high[axis] < scene.size[axis] - tolerance;
  }
  zone.validate();
  return zone;
}

fe::Material material_of(const Scene& scene, const specimens::Specimen& specimen) {
  const Surroundings& around = *scene.surroundings;
  fe::Material material{0, 0, scene.card.density};
  if (around.young_modulus && around.poisson_ratio) {
    material.young_modulus = *around.young_modulus, material.poisson_ratio = *around.poisson_ratio;
    return material;
  }
  // The card's E is what Eq. 1 aims at; this pack has its own, and the interface reflects the difference.
  int through = 0, along = 0;
  scene.size.minCoeff(&through);
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (axis != through && specimen.size[axis] > longest) longest = specimen.size[axis], along = axis;
  const coupling::PackModuli moduli = coupling::measure_moduli(specimen, scene.card, through, along);
  if (around.modulus == PackModulus::bulk && !moduli.bulk && !around.young_modulus)
    throw dem::InputError("mesh.modulus", "the zone of discrete elements is too thin to have a bulk modulus",
                          "allowed here: membrane, flexural, or give mesh.young_modulus");
  const double measured = around.modulus == PackModulus::flexural   ? moduli.flexural
                          : around.modulus == PackModulus::membrane ? moduli.membrane
                                                                    : moduli.bulk.value_or(0);
  material.young_modulus = around.young_modulus.value_or(measured);
  material.poisson_ratio = around.poisson_ratio.value_or(moduli.poisson_ratio);
  return material;
}

std::unique_ptr<FiniteDomain> make_finite_domain(const Scene& scene, const specimens::Specimen& specimen,
                                                 dem::Assembly& assembly, std::vector<Held>& held,
                                                 double time_step, int threads) {
  const Surroundings& around = *scene.surroundings;
  const coupling::Zone zone = zone_of(scene);
  if (around.mesh_file) require_as_read(scene, *around.mesh_file);
  fe::Mesh mesh =
      around.mesh_file ? fe::read_gmsh(around.mesh_file->string(), around.mesh_unit) : fe::box_mesh(around.box);
  fe::BodyOptions body_options;
  body_options.weights = coupling::finite_weights(zone, mesh);
  const fe::Material material = material_of(scene, specimen);
  auto body = std::make_unique<fe::Body>(mesh, material, body_options);
  fe::State nodes(*body);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    Held here{static_cast<std::int32_t>(i), {}};
    for (const Support& support : scene.supports)
      if (inside(mesh.nodes[i], support.low, support.high))
        for (std::size_t axis = 0; axis < 3; ++axis) here.axes[axis] = here.axes[axis] || support.locked[axis];
    for (int axis = 0; axis < 3; ++axis)
      if (here.axes[static_cast<std::size_t>(axis)]) nodes.lock(std::span(&here.number, 1), axis);
    if (here.axes[0] || here.axes[1] || here.axes[2]) held.push_back(here);
  }

  dem::Particles& particles = assembly.particles;
  coupling::weigh(zone, particles, assembly.links);
  const coupling::KinematicMap map =
      coupling::make_kinematic_map(zone, mesh, *body, particles.initial_position, around.ties);
  coupling::TieOptions options{around.solve, around.relaxation_time, threads};
  coupling::Multipliers ties(map, coupling::tied_masses(map, particles), nodes, options);
  const double critical = fe::critical_time_step(*body);
  const int interval = around.interval > 0 ? around.interval : coupling::largest_interval(time_step, critical);
  if (interval * time_step > critical)
    throw dem::InputError(
        "coupling.interval",
        fmt::format("{} steps of {:.3g} s exceed the finite elements' critical step, {:.3g} s", interval,
                    time_step, critical),
        fmt::format("allowed: up to {}", static_cast<int>(critical / time_step)));
  coupling::SubStepping sub_stepping(*body, map, interval);
  return std::make_unique<FiniteDomain>(FiniteDomain{std::move(mesh), zone, std::move(body), std::move(nodes),
                                                     std::move(ties), std::move(sub_stepping),
                                                     material.young_modulus, material.poisson_ratio});
}

/// Locks the discrete elements whose centres lie in a support.
std::vector<Held> hold_elements(const Scene& scene, dem::Particles& particles,
                                std::vector<std::size_t>& found) {
  std::vector<Held> held;
  for (std::size_t i = 0; i < particles.count; ++i) {
    Held here{static_cast<std::int32_t>(i), {}};
    for (std::size_t s = 0; s < scene.supports.size(); ++s) {
      const Support& support = scene.supports[s];
      if (!inside(particles.initial_position[i], support.low, support.high)) continue;
      ++found[s];
      for (std::size_t axis = 0; axis < 3; ++axis) here.axes[axis] = here.axes[axis] || support.locked[axis];
    }
    for (int axis = 0; axis < 3; ++axis)
      if (here.axes[static_cast<std::size_t>(axis)]) particles.prescribe(i, axis, 0);
    if (here.axes[0] || here.axes[1] || here.axes[2]) held.push_back(here);
  }
  return held;
}

void require_support(const Scene& scene, const ImpactModel& model, const std::vector<std::size_t>& elements) {
  for (std::size_t s = 0; s < scene.supports.size(); ++s) {
    const Support& support = scene.supports[s];
    std::size_t count = elements[s];
    if (model.finite)
      count += static_cast<std::size_t>(
          std::count_if(model.finite->mesh.nodes.begin(), model.finite->mesh.nodes.end(),
                        [&](const Vec3& node) { return inside(node, support.low, support.high); }));
    if (count == 0)
      throw dem::InputError(
          fmt::format("support \"{}\"", support.name), "holds nothing: no element and no node lies in it",
          "move or enlarge its region; it must reach at least one element size into the structure");
  }
}

std::vector<ProbePlace> place_probes(const Scene& scene, const ImpactModel& model) {
  const dem::Particles& particles = model.assembly.particles;
  std::vector<ProbePlace> places;
  for (const Probe& probe : scene.probes) {
    ProbePlace place;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < particles.count; ++i) {
      const double distance = (particles.initial_position[i] - probe.point).norm();
      if (distance < nearest) nearest = distance, place.element = static_cast<std::int32_t>(i);
    }
    if (model.finite && nearest > 2 * model.specimen.element_size()) {
      const auto point = fe::Locator(model.finite->mesh).find(probe.point, 1e-6);
      if (!point)
        throw dem::InputError(fmt::format("probe \"{}\"", probe.name),
                              "lies in no finite element and near no discrete one",
                              "put it inside the structure");
      place = {-1, *point};
    }
    places.push_back(place);
  }
  return places;
}

/// The highest frequencies of links and contacts add up to a bound of the two together.
double critical_step(const Scene& scene, const ImpactModel& model) {
  const dem::Particles& particles = model.assembly.particles;
  const dem::LinkNetwork network(particles.initial_position, particles.radius, model.specimen.links,
                                 model.assembly.law);
  const double links = 2 / dem::critical_time_step(network, particles);
  double square = links * links;
  if (scene.impactor) {
    double contact = 0;
    for (std::size_t i = 0; i < particles.count; ++i)
      contact =
          std::max(contact, contact_frequency_squared(scene.impactor->law, particles.radius[i],
                                                      particles.element_mass(i), particles.element_inertia(i)));
    square += contact;
  }
  return 2 / std::sqrt(square);
}

}  // namespace

Vec3 ImpactModel::displacement_at(const ProbePlace& place) const {
  if (place.element >= 0) return assembly.particles.displacement(static_cast<std::size_t>(place.element));
  const fe::ShapeValues shape = fe::shape_values(place.point.local);
  const fe::Hexahedron& corners = finite->body->connectivity[static_cast<std::size_t>(place.point.element)];
  Vec3 sum = Vec3::Zero();
  for (std::size_t c = 0; c < 8; ++c)
    sum +=
        shape[static_cast<Eigen::Index>(c)] * finite->nodes.displacement[static_cast<std::size_t>(corners[c])];
  return sum;
}

ImpactModel make_model(const Scene& scene, int threads, const dem::ProgressCallback& progress) {
  ImpactModel model;
  model.specimen = make_specimen(scene, threads, progress);
  require_size(scene, model.specimen);
  // A coarse structure can be struck all the same; its stiffness and strength are then its own.
  const std::string why = specimens::why_not_representative(model.specimen);
  if (!why.empty()) model.warnings.push_back("the discrete elements are not representative: " + why);
  if (scene.surroundings) model.origin = scene.surroundings->zone_low;
  std::vector<Vec3> centres = model.specimen.centres;
  for (Vec3& centre : centres) centre += model.origin;
  model.assembly = {dem::Particles(centres, model.specimen.radii, scene.card.density * model.specimen.volume()),
                    dem::make_links(model.specimen.links, model.specimen.radii),
                    {},
                    dem::make_link_law(scene.card)};
  double solid = 0;
  for (const double r : model.specimen.radii) solid += 4.0 / 3 * std::numbers::pi * r * r * r;
  model.solid_fraction = solid / model.specimen.volume();

  model.critical_time_step = critical_step(scene, model);
  model.time_step = scene.time_step_fraction * model.critical_time_step;
  std::vector<std::size_t> found(scene.supports.size(), 0);
  model.held_elements = hold_elements(scene, model.assembly.particles, found);
  if (scene.surroundings)
    model.finite =
        make_finite_domain(scene, model.specimen, model.assembly, model.held_nodes, model.time_step, threads);
  require_support(scene, model, found);
  model.probes = place_probes(scene, model);
  return model;
}

ImpactorState start_of(const Scene& scene, const ImpactModel& model) {
  const Impactor& impactor = *scene.impactor;
  const Approach& approach = scene.approach;
  // Far enough back to be clear of the structure, then forward until it touches.
  const double reach = bounding_box(impactor.shape).diagonal().norm();
  const double back = reach + (model.origin + model.specimen.size - model.origin).norm() + scene.size.norm();
  Pose pose{approach.aim - back * approach.direction, approach.orientation};
  const std::optional<double> way =
      distance_to_contact(impactor.shape, pose, approach.direction, model.assembly.particles);
  if (!way)
    throw dem::InputError("impactor", "its path never meets the structure's discrete elements",
                          "change impactor.aim or impactor.direction");
  pose.position += *way * approach.direction;
  ImpactorState state;
  state.motion = start_motion(impactor.body, pose.position, pose.orientation,
                              approach.speed * approach.direction, approach.spin);
  return state;
}

}  // namespace impact
