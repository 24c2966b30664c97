#include "impact/fe/box_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "libdem/core/error.h"

namespace fe {
namespace {

constexpr const char* where = "structured mesh";
constexpr std::size_t most_elements = 10'000;  // along one axis on one side of the zone
constexpr char axis_name[3] = {'x', 'y', 'z'};

/// The zone in element planes: [low, high) along each axis, and what of it is left out.
struct Cut {
  std::array<int, 3> low{}, high{}, hole_low{}, hole_high{};
};

/// The number of the plane at `place`, which must be one to 1e-6 of an element; -1 or one too many if it lies
/// outside the box.
int plane_at(const BoxMeshOptions& options, int axis, double place) {
  const int last = options.elements[static_cast<std::size_t>(axis)];
  const double h = options.size[axis] / last;
  if (place < options.plane(axis, 0) - 1e-6 * h) return -1;
  if (place > options.plane(axis, last) + 1e-6 * h) return last + 1;
  int nearest = 0;
  for (int k = 1; k <= last; ++k)
    if (std::abs(options.plane(axis, k) - place) < std::abs(options.plane(axis, nearest) - place)) nearest = k;
  const double at = options.plane(axis, nearest);
  if (std::abs(at - place) <= 1e-6 * h) return nearest;
  const int other = place < at ? nearest - 1 : nearest + 1;
  throw dem::InputError(where,
                        fmt::format("the zone's face at {} = {:.6g} m cuts elements of {:.6g} m",
                                    axis_name[axis], place, std::abs(options.plane(axis, other) - at)),
                        fmt::format("it must lie between elements, for example at {:.9g} m", at));
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

/// Sizes of the elements from the zone outward that fill `length` [m].
std::vector<double> sizes_outside(double length, double inner, const Grading& grading) {
  // A zone's face within rounding of the box's lies on it.
  if (length <= 1e-9 * inner) return {};
  const double largest = grading.largest > 0 ? grading.largest : length + inner;
  const auto fill = [&](double growth, std::size_t count, std::vector<double>* sizes) {
    double sum = 0, size = inner;
    for (std::size_t k = 0; k < count; ++k) {
      size = std::min(size * growth, largest);
      if (sizes != nullptr) sizes->push_back(size);
      sum += size;
    }
    return sum;
  };
  std::size_t count = 0;
  double sum = 0, size = inner;
  while (sum < length * (1 - 1e-9)) {
    size = std::min(size * grading.growth, largest);
    sum += size;
    if (++count > most_elements)
      throw dem::InputError(
          where, fmt::format("more than {} elements between the zone and the box's face", most_elements),
          "let them grow faster or be larger");
  }
  double slow = 0, fast = grading.growth;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (slow + fast);
    (fill(middle, count, nullptr) < length ? slow : fast) = middle;
  }
  std::vector<double> sizes;
  fill(fast, count, &sizes);
  return sizes;
}

}  // namespace

double BoxMeshOptions::plane(int axis, int number) const {
  const auto k = static_cast<std::size_t>(axis);
  if (!planes[k].empty()) return planes[k][static_cast<std::size_t>(number)];
  return origin[axis] + size[axis] * number / elements[k];
}

void BoxMeshOptions::validate() const {
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (!(size[k] > 0) || !std::isfinite(size[k]) || !std::isfinite(origin[k]))
      throw dem::InputError(where, fmt::format("the size along {} is {:g} m", axis_name[k], size[k]),
                            "every side must be above 0");
    if (elements[axis] < 1)
      throw dem::InputError(where, fmt::format("{} elements along {}", elements[axis], axis_name[k]),
                            "at least 1 along each axis");
    if (planes[axis].empty()) continue;
    const double rounding = 1e-9 * size[k];
    if (planes[axis].size() != static_cast<std::size_t>(elements[axis]) + 1 ||
        !std::is_sorted(planes[axis].begin(), planes[axis].end(), std::less_equal<>()) ||
        std::abs(planes[axis].front() - origin[k]) > rounding ||
        std::abs(planes[axis].back() - origin[k] - size[k]) > rounding)
      throw dem::InputError(where, fmt::format("{} planes along {}", planes[axis].size(), axis_name[k]),
                            fmt::format("{} ascending ones are needed, from {:g} to {:g} m", elements[axis] + 1,
                                        origin[k], origin[k] + size[k]));
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

std::vector<double> graded_planes(double low, double high, double zone_low, double zone_high,
                                  const Grading& grading) {
  if (grading.zone_elements < 1)
    throw dem::InputError(where, fmt::format("{} elements in the zone", grading.zone_elements), "at least 1");
  if (!(grading.growth >= 1 && grading.growth <= 3))
    throw dem::InputError(where, fmt::format("elements grow by a factor of {:g}", grading.growth),
                          "allowed: 1 to 3");
  const double inner = (zone_high - zone_low) / grading.zone_elements;
  if (grading.largest != 0 && !(grading.largest >= inner))
    throw dem::InputError(where, fmt::format("elements of at most {:g} m", grading.largest),
                          fmt::format("allowed: not below those in the zone, {:g} m", inner));
  std::vector<double> planes;
  const std::vector<double> below = sizes_outside(zone_low - low, inner, grading);
  for (std::size_t k = below.size(); k-- > 0;)
    planes.push_back(k + 1 == below.size() ? low : planes.back() + below[k + 1]);
  for (int k = 0; k <= grading.zone_elements; ++k)
    planes.push_back(k < grading.zone_elements ? zone_low + inner * k : zone_high);
  const std::vector<double> above = sizes_outside(high - zone_high, inner, grading);
  for (std::size_t k = 0; k < above.size(); ++k)
    planes.push_back(k + 1 == above.size() ? high : planes.back() + above[k]);
  return planes;
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
          mesh.nodes.emplace_back(options.plane(0, i), options.plane(1, j), options.plane(2, k));
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
