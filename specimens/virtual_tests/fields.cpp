#include "specimens/virtual_tests/fields.h"

#include "libdem/io/vtkhdf.h"

namespace virtual_tests {
namespace {

dem::VtkField displacement_field(const FinalFields& fields) {
  std::vector<double> values;
  values.reserve(3 * fields.displacement.size());
  for (const dem::Vec3& u : fields.displacement) values.insert(values.end(), {u.x(), u.y(), u.z()});
  return {"displacement", 3, std::move(values)};
}

/// Links of each element that still hold.
std::vector<std::int32_t> coordination(const specimens::Specimen& specimen, const FinalFields& fields) {
  std::vector<std::int32_t> count(specimen.elements(), 0);
  for (std::size_t k = 0; k < specimen.links.size(); ++k)
    if (fields.link_state[k] != LinkState::broken)
      for (const std::int32_t i : {specimen.links[k].a, specimen.links[k].b})
        ++count[static_cast<std::size_t>(i)];
  return count;
}

dem::VtkGrid points_of(const specimens::Specimen& specimen) {
  dem::VtkGrid grid;
  for (const dem::Vec3& x : specimen.centres) grid.add_point(x.x(), x.y(), x.z());
  return grid;
}

}  // namespace

void write_element_fields(const std::filesystem::path& file, const specimens::Specimen& specimen,
                          const FinalFields& fields) {
  dem::VtkGrid grid = points_of(specimen);
  grid.add_vertices();
  grid.point_data = {{"radius", 1, specimen.radii},
                     {"damage", 1, fields.damage},
                     displacement_field(fields),
                     {"coordination", 1, coordination(specimen, fields)}};
  dem::write_vtkhdf(file, grid);
}

void write_link_fields(const std::filesystem::path& file, const specimens::Specimen& specimen,
                       const FinalFields& fields) {
  dem::VtkGrid grid = points_of(specimen);
  for (const specimens::Link& link : specimen.links) grid.add_cell(dem::VtkCell::line, {link.a, link.b});
  std::vector<std::uint8_t> states;
  for (const LinkState state : fields.link_state) states.push_back(static_cast<std::uint8_t>(state));
  grid.point_data = {displacement_field(fields)};
  grid.cell_data = {{"state", 1, std::move(states)}, {"strain", 1, fields.link_strain}};
  dem::write_vtkhdf(file, grid);
}

}  // namespace virtual_tests
