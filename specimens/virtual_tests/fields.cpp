#include "specimens/virtual_tests/fields.h"

#include <fmt/format.h>

#include <cmath>

#include "libdem/io/frame_series.h"
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

/// "strain 0.12 permil, 2.31 MPa"; "t = 35.0 us" where time is what is driven.
std::string label_of(const Picture& picture, const CurveTable& curve) {
  std::string label = fmt::format("t = {:.4g} ms", 1e3 * picture.time);
  if (!curve.columns.empty() && curve.columns.front().unit != "s") {
    const CurveColumn& control = curve.columns.front();
    label = fmt::format("{} {:.3f} {}", control.name, 1e3 * picture.control, control.unit == "m" ? "mm" : "‰");
  }
  if (std::isfinite(picture.stress)) label += fmt::format(", {:.2f} MPa", picture.stress / 1e6);
  return label;
}

dem::VtkGrid elements_of(const Picture& picture, const specimens::Specimen& specimen) {
  dem::VtkGrid grid;
  const std::vector<float>& u = picture.displacement;
  for (std::size_t i = 0; i < specimen.elements(); ++i) {
    const dem::Vec3& x = specimen.centres[i];
    grid.add_point(x.x() + u[3 * i], x.y() + u[3 * i + 1], x.z() + u[3 * i + 2]);
  }
  grid.add_vertices();
  grid.point_data = {{"radius", 1, specimen.radii},
                     {"damage", 1, std::vector<double>(picture.damage.begin(), picture.damage.end())},
                     {"displacement", 3, std::vector<double>(u.begin(), u.end())}};
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

void write_frames(const std::filesystem::path& folder, const specimens::Specimen& specimen, const Film& film,
                  const CurveTable& curve) {
  dem::FrameSeries series(folder, {"elements", "links"}, false);
  const std::vector<std::int32_t> first_broken = film.first_broken();
  for (std::size_t p = 0; p < film.pictures().size(); ++p) {
    const Picture& picture = film.pictures()[p];
    const dem::FrameMoment moment{picture.time, label_of(picture, curve)};
    const int number = static_cast<int>(p);
    dem::VtkGrid grid = elements_of(picture, specimen);
    series.write(number, moment, "elements", grid);
    dem::VtkGrid broken;
    broken.points = std::move(grid.points);
    for (std::size_t k = 0; k < specimen.links.size(); ++k)
      if (first_broken[k] >= 0 && first_broken[k] <= number)
        broken.add_cell(dem::VtkCell::line, {specimen.links[k].a, specimen.links[k].b});
    if (broken.cell_count() == 0) continue;  // an empty grid is nothing that ParaView opens
    broken.cell_data = {{"state", 1, std::vector<std::uint8_t>(broken.cell_count(), 2)}};
    series.write(number, moment, "links", broken);
  }
  series.write_indexes();
}

}  // namespace virtual_tests
