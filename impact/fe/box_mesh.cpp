#include "impact/fe/box_mesh.h"

#include <fmt/format.h>

#include <cmath>

#include "libdem/core/error.h"

namespace fe {
namespace {

constexpr const char* where = "structured mesh";
constexpr char axis_name[3] = {'x', 'y', 'z'};

/// The zone in element planes: [low, high) along each axis, and what of it is left out.
struct Cut {
  std::array<int, 3> low{}, high{}, hole_low{}, hole_high{};
};

/// The number of the plane at `place`, which must be one to 1e-6 of an element.
int plane_at(const BoxMeshOptions& options, int axis, double place) {
  const double h = options.size[axis] / options.elements[static_cast<std::size_t>(axis)];
  const double exact = (place - options.origin[axis]) / h;
  const double nearest = std::round(exact);
  if (!(std::abs(exact - nearest) <= 1e-6))
    throw dem::InputError(
        where,
        fmt::format("the zone's face at {} = {:.6g} m cuts elements of {:.6g} m", axis_name[axis], place, h),
        fmt::format("it must lie between elements, for example at {:.9g} m",
                    options.origin[axis] + nearest * h));
  return static_cast<int>(nearest);
}

Cut cut_of(const BoxMeshOptions& options) {
  Cut cut;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    cut.low[axis] = plane_at(options, k, options.zone->low[k]);
    cut.high[axis] = plane_at(options, k, options.zone->high[k]);
    // Where the zone reaches the box's surface there is no finite element beyond it to couple to.
    const int layers = options.zone->overlap_layers;
    cut.hole_low[axis] = cut.low[axis] + (cut.low[axis] > 0 ? layers : 0);
    cut.hole_high[axis] = cut.high[axis] - (cut.high[axis] < options.elements[axis] ? layers : 0);
  }
  return cut;
}

}  // namespace

void BoxMeshOptions::validate() const {
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (!(size[k] > 0) || !std::isfinite(size[k]) || !std::isfinite(origin[k]))
      throw dem::InputError(where, fmt::format("the size along {} is {:g} m", axis_name[k], size[k]),
                            "every side must be above 0");
    if (elements[axis] < 1)
      throw dem::InputError(where, fmt::format("{} elements along {}", elements[axis], axis_name[k]),
                            "at least 1 along each axis");
  }
  if (!zone) return;
  if (zone->overlap_layers < 1)
    throw dem::InputError(where, fmt::format("{} overlap layers", zone->overlap_layers), "at least 1");
  const Cut cut = cut_of(*this);
  bool surrounded = false;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (cut.low[axis] < 0 || cut.high[axis] > elements[axis] || cut.low[axis] >= cut.high[axis])
      throw dem::InputError(
          where,
          fmt::format("the zone reaches from {:g} to {:g} m along {}", zone->low[k], zone->high[k],
                      axis_name[k]),
          fmt::format("it must lie within the box, from {:g} to {:g} m", origin[k], origin[k] + size[k]));
    surrounded = surrounded || cut.low[axis] > 0 || cut.high[axis] < elements[axis];
    if (cut.hole_low[axis] >= cut.hole_high[axis])
      throw dem::InputError(where,
                            fmt::format("{} overlap layers leave nothing of the zone's {} elements along {}",
                                        zone->overlap_layers, cut.high[axis] - cut.low[axis], axis_name[k]),
                            "make the zone larger, the elements smaller, or the layers fewer");
  }
  if (!surrounded)
    throw dem::InputError(where, "the zone fills the whole box, no finite element would remain",
                          "make the zone smaller than the box along one axis at least");
}

Mesh box_mesh(const BoxMeshOptions& options) {
  options.validate();
  Cut cut;
  if (options.zone) cut = cut_of(options);
  const auto& n = options.elements;
  const auto left_out = [&](const std::array<int, 3>& cell) {
    for (std::size_t k = 0; k < 3; ++k)
      if (cell[k] < cut.hole_low[k] || cell[k] >= cut.hole_high[k]) return false;
    return true;
  };
  const auto node_place = [&](int i, int j, int k) {
    return (static_cast<std::size_t>(i) * static_cast<std::size_t>(n[1] + 1) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(n[2] + 1) +
           static_cast<std::size_t>(k);
  };
  Mesh mesh;
  mesh.origin = where;
  std::vector<std::int32_t> number(node_place(n[0], n[1], n[2]) + 1, -1);
  std::vector<std::array<int, 3>> cells;
  static constexpr int offset[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k)
        if (!left_out({i, j, k})) {
          cells.push_back({i, j, k});
          for (const auto& o : offset) number[node_place(i + o[0], j + o[1], k + o[2])] = 0;
        }
  for (int i = 0; i <= n[0]; ++i)
    for (int j = 0; j <= n[1]; ++j)
      for (int k = 0; k <= n[2]; ++k)
        if (std::int32_t& node = number[node_place(i, j, k)]; node == 0) {
          node = static_cast<std::int32_t>(mesh.nodes.size());
          mesh.nodes.emplace_back(options.origin + Vec3(options.size.x() * i / n[0],
                                                        options.size.y() * j / n[1],
                                                        options.size.z() * k / n[2]));
        }
  mesh.elements.reserve(cells.size());
  for (const auto& [i, j, k] : cells) {
    Hexahedron element;
    for (std::size_t a = 0; a < 8; ++a)
      element[a] = number[node_place(i + offset[a][0], j + offset[a][1], k + offset[a][2])];
    mesh.elements.push_back(element);
  }
  return mesh;
}

}  // namespace fe
