#include "specimens/specimen_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "libdem/core/error.h"
#include "libdem/io/hdf5.h"

namespace specimens {
namespace {

constexpr const char* format = "spall-specimen";
constexpr const char* make_again = "make it again with `spall specimen make`";

void validate(const std::string& file, const Specimen& specimen) {
  const auto refuse = [&](const std::string& wrong) { throw dem::InputError(file, wrong, make_again); };
  if (!specimen.size.allFinite() || !(specimen.size.minCoeff() > 0)) refuse("its size is not positive");
  if (specimen.shape == Shape::cylinder && specimen.size.x() != specimen.size.y())
    refuse("its cylinder has two diameters");
  if (specimen.elements() == 0) refuse("it holds no element");
  if (specimen.elements() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    refuse("it holds more elements than can be numbered");
  const double factor = specimen.interaction_radius_factor;
  if (!std::isfinite(factor) || !(factor >= 0)) refuse(fmt::format("its interaction factor is {}", factor));
  const double hair = 1e-9 * specimen.size.maxCoeff();
  for (std::size_t k = 0; k < specimen.elements(); ++k) {
    const double radius = specimen.radii[k];
    if (!std::isfinite(radius) || !(radius > 0)) refuse(fmt::format("element {} has radius {} m", k, radius));
    const Vec3& centre = specimen.centres[k];
    if (!centre.allFinite() || specimen.depth(centre) < -hair)
      refuse(fmt::format("element {} is outside the shape", k));
  }
  double solid = 0;
  for (const double radius : specimen.radii) solid += 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  // Elements on a face reach out of the shape, so a small specimen may hold a little more than itself.
  if (const double part = solid / specimen.volume(); part < 1e-4 || part > 1.5)
    refuse(fmt::format("its elements fill {:.3g} of its volume", part));
  const auto elements = static_cast<std::int64_t>(specimen.elements());
  for (std::size_t k = 0; k < specimen.links.size(); ++k) {
    const Link& link = specimen.links[k];
    if (link.a < 0 || link.b >= elements || link.a >= link.b)
      refuse(fmt::format("link {} joins elements {} and {}, of {}", k, link.a, link.b, elements));
    if (!std::isfinite(link.initial_distance) || !(link.initial_distance > 0))
      refuse(fmt::format("link {} has initial distance {} m", k, link.initial_distance));
    if (k > 0) {
      const Link& before = specimen.links[k - 1];
      if (before.a > link.a || (before.a == link.a && before.b >= link.b))
        refuse(fmt::format("link {} is doubled or out of order", k));
    }
    const double apart = (specimen.centres[static_cast<std::size_t>(link.a)] -
                          specimen.centres[static_cast<std::size_t>(link.b)])
                             .norm();
    if (std::abs(link.initial_distance - apart) > 1e-6 * apart)
      refuse(fmt::format("link {} is {:.6g} m long, and its elements are {:.6g} m apart", k,
                         link.initial_distance, apart));
  }
}

}  // namespace

void write_specimen(const std::filesystem::path& file, const Specimen& specimen) {
  dem::create_spall_file(file, format, specimen_format_version, [&](dem::Hdf5File& out) {
    out.set_attribute("/", "shape", std::string(name_of(specimen.shape)));
    out.set_attribute("/", "size", std::span<const double>(specimen.size.data(), 3));
    out.set_attribute("/", "seed", specimen.seed);
    out.set_attribute("/", "interaction_radius_factor", specimen.interaction_radius_factor);
    out.set_attribute("/", "origin", specimen.origin);
    out.set_attribute("/", "sha256", specimen.sha256());
    static_assert(sizeof(Vec3) == 3 * sizeof(double), "written as rows of three");
    const double* const first = specimen.centres.empty() ? nullptr : specimen.centres.front().data();
    out.write("elements/centre", std::span<const double>(first, 3 * specimen.elements()), 3);
    out.write("elements/radius", specimen.radii);
    std::vector<std::int32_t> ends;
    std::vector<double> distances;
    for (const Link& link : specimen.links) {
      ends.insert(ends.end(), {link.a, link.b});
      distances.push_back(link.initial_distance);
    }
    out.write("links/elements", ends, 2);
    out.write("links/initial_distance", distances);
  });
}

Specimen read_specimen(const std::filesystem::path& path) { return read_specimen(dem::Hdf5File::open(path)); }

Specimen read_specimen(const dem::Hdf5File& file) {
  dem::require_spall_file(file, format, specimen_format_version);
  const std::filesystem::path& path = file.path();
  Specimen specimen;
  const std::string shape = file.text_attribute("/", "shape");
  if (shape != name_of(Shape::box) && shape != name_of(Shape::cylinder))
    throw dem::InputError(path.string(), fmt::format("its shape is \"{}\"", shape),
                          "box and cylinder are known");
  specimen.shape = shape == name_of(Shape::box) ? Shape::box : Shape::cylinder;
  const std::vector<double> size = file.numbers_attribute<double>("/", "size");
  if (size.size() != 3) throw dem::InputError(path.string(), "its size is not three lengths", make_again);
  specimen.size = Vec3(size[0], size[1], size[2]);
  specimen.seed = file.number_attribute<std::uint64_t>("/", "seed");
  specimen.interaction_radius_factor = file.number_attribute<double>("/", "interaction_radius_factor");
  specimen.origin = file.text_attribute("/", "origin");

  specimen.radii = file.read<double>("elements/radius");
  const std::vector<double> centres = file.read<double>("elements/centre", 3, specimen.radii.size());
  specimen.centres.reserve(specimen.radii.size());
  for (std::size_t k = 0; k + 2 < centres.size(); k += 3)
    specimen.centres.emplace_back(centres[k], centres[k + 1], centres[k + 2]);
  const std::vector<double> distances = file.read<double>("links/initial_distance");
  const std::vector<std::int32_t> ends = file.read<std::int32_t>("links/elements", 2, distances.size());
  specimen.links.reserve(distances.size());
  for (std::size_t k = 0; k < distances.size(); ++k)
    specimen.links.push_back({ends[2 * k], ends[2 * k + 1], distances[k]});

  validate(path.string(), specimen);
  if (file.has_attribute("/", "sha256") && file.text_attribute("/", "sha256") != specimen.sha256())
    throw dem::InputError(path.string(),
                          "its content does not have the SHA-256 that it names: it is damaged or edited",
                          make_again);
  return specimen;
}

}  // namespace specimens
