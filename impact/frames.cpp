#include "impact/frames.h"

#include <utility>

#include "libdem/probe/damage.h"

namespace impact {
namespace {

void append(std::vector<double>& values, const Vec3& vector) {
  values.insert(values.end(), {vector.x(), vector.y(), vector.z()});
}

/// One vector a row of `count`.
template <class Value>
dem::VtkField vectors(const std::string& name, std::size_t count, Value value) {
  std::vector<double> values;
  values.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) append(values, value(i));
  return {name, 3, std::move(values)};
}

Fragments fragments_of(const dem::Assembly& assembly) {
  const dem::Particles& particles = assembly.particles;
  std::vector<Vec3> position, velocity;
  std::vector<double> mass;
  for (std::size_t i = 0; i < particles.count; ++i) {
    position.push_back(particles.kinematics[i].position());
    velocity.push_back(particles.kinematics[i].velocity());
    mass.push_back(particles.element_mass(i));
  }
  const dem::Links& links = assembly.links;
  std::vector<std::uint8_t> broken;
  for (std::size_t k = 0; k < links.count; ++k) broken.push_back(assembly.law.is_broken(links.max_strain[k]));
  return find_fragments(
      {position, velocity, std::span(particles.radius).first(particles.count), mass},
      {std::span(links.a.data(), links.count), std::span(links.b.data(), links.count), broken});
}

dem::VtkGrid elements_grid(const dem::Assembly& assembly) {
  const dem::Particles& particles = assembly.particles;
  const std::size_t count = particles.count;
  dem::VtkGrid grid;
  for (std::size_t i = 0; i < count; ++i) append(grid.points, particles.kinematics[i].position());
  grid.add_vertices();
  std::vector<double> radius(particles.radius.begin(),
                             particles.radius.begin() + static_cast<std::ptrdiff_t>(count));
  grid.point_data = {
      {"radius", 1, std::move(radius)},
      {"damage", 1, dem::element_damage(assembly.law, assembly.links, count)},
      vectors("displacement", count, [&](std::size_t i) { return particles.displacement(i); }),
      vectors("velocity", count, [&](std::size_t i) { return particles.kinematics[i].velocity(); }),
      {"fragment", 1, fragments_of(assembly).of_element}};
  return grid;
}

dem::VtkGrid links_grid(const dem::Assembly& assembly) {
  const dem::Particles& particles = assembly.particles;
  const dem::Links& links = assembly.links;
  dem::VtkGrid grid;
  for (std::size_t i = 0; i < particles.count; ++i) append(grid.points, particles.kinematics[i].position());
  std::vector<std::uint8_t> state;
  std::vector<double> strain;
  for (std::size_t k = 0; k < links.count; ++k) {
    grid.add_cell(dem::VtkCell::line, {links.a[k], links.b[k]});
    const bool broken = assembly.law.is_broken(links.max_strain[k]);
    state.push_back(broken ? 2 : links.max_strain[k] > assembly.law.yield_strain() ? 1 : 0);
    const auto position = [&](std::int32_t i) {
      return particles.kinematics[static_cast<std::size_t>(i)].position();
    };
    strain.push_back((position(links.a[k]) - position(links.b[k])).norm() * links.inverse_initial_distance[k] -
                     1);
  }
  grid.cell_data = {{"state", 1, std::move(state)}, {"strain", 1, std::move(strain)}};
  return grid;
}

dem::VtkGrid nodes_grid(const fe::Mesh& mesh, const fe::State& nodes) {
  dem::VtkGrid grid;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    append(grid.points, mesh.nodes[i] + nodes.displacement[i]);
  for (const fe::Hexahedron& element : mesh.elements) {
    const std::vector<std::int64_t> corners(element.begin(), element.end());
    grid.add_cell(dem::VtkCell::hexahedron, corners);
  }
  grid.point_data = {
      vectors("displacement", mesh.nodes.size(), [&](std::size_t i) { return nodes.displacement[i]; }),
      vectors("velocity", mesh.nodes.size(), [&](std::size_t i) { return nodes.velocity[i]; })};
  return grid;
}

dem::VtkGrid impactor_grid(const Surface& surface, const Pose& pose) {
  dem::VtkGrid grid;
  for (const Vec3& vertex : surface.vertices) append(grid.points, pose.to_space(vertex));
  for (const auto& [a, b, c] : surface.triangles) grid.add_cell(dem::VtkCell::triangle, {a, b, c});
  return grid;
}

}  // namespace

FrameWriter::FrameWriter(const Scene& scene, std::filesystem::path folder, bool resume)
    : series(std::move(folder), {"elements", "links", "finite_elements", "impactor"}, resume) {
  if (scene.impactor) impactor = surface_of(scene.impactor->shape);
}

void FrameWriter::write(const Frame& frame) {
  const auto put = [&](const char* kind, const dem::VtkGrid& grid) {
    series.write(frame.number, {frame.time}, kind, grid);
  };
  put("elements", elements_grid(*frame.assembly));
  put("links", links_grid(*frame.assembly));
  if (frame.mesh != nullptr && frame.nodes != nullptr)
    put("finite_elements", nodes_grid(*frame.mesh, *frame.nodes));
  if (!impactor.triangles.empty()) put("impactor", impactor_grid(impactor, frame.impactor));
  series.write_indexes();
}

}  // namespace impact
