#include "impact/fe/body.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numeric>

#include "libdem/core/error.h"

namespace fe {
namespace {

/// What two elements must share to share a stiffness: corners about the first one over `unit`, and weights,
/// both rounded far below what matters (1e-10) and far above rounding.
using Key = std::array<std::int64_t, 29>;

Key key_of(const Corners& corners, const GaussWeights& weights, double unit) {
  Key key;
  std::size_t place = 0;
  for (int a = 1; a < 8; ++a)
    for (int k = 0; k < 3; ++k) key[place++] = std::llround((corners(a, k) - corners(0, k)) / unit * 1e10);
  for (const double weight : weights) key[place++] = std::llround(weight * 1e10);
  return key;
}

void check_options(const Mesh& mesh, const BodyOptions& options) {
  if (!options.weights.empty() && options.weights.size() != mesh.elements.size())
    throw dem::InputError(
        mesh.origin,
        fmt::format("energy weights for {} elements of {}", options.weights.size(), mesh.elements.size()),
        "one set for each element");
  for (std::size_t e = 0; e < options.weights.size(); ++e)
    for (const double weight : options.weights[e])
      if (!(weight > 0) || !std::isfinite(weight))
        throw dem::InputError(
            mesh.origin, fmt::format("an energy weight of element {} is {:g}", mesh.element_tag(e), weight),
            "weights must be above 0, or the mass vanishes");
  if (!options.representative.empty() && options.representative.size() != mesh.nodes.size())
    throw dem::InputError(
        mesh.origin,
        fmt::format("representatives for {} nodes of {}", options.representative.size(), mesh.nodes.size()),
        "one for each node");
}

}  // namespace

Body::Body(const Mesh& mesh, const Material& elastic, const BodyOptions& options)
    : material(elastic), connectivity(mesh.elements), node_mass(mesh.nodes.size(), 0) {
  check(mesh);
  material.validate(mesh.origin);
  check_options(mesh, options);
  if (!options.representative.empty())
    for (Hexahedron& element : connectivity)
      for (std::int32_t& node : element) node = options.representative[static_cast<std::size_t>(node)];

  const double unit = shortest_edge(mesh);
  std::map<Key, std::int32_t> classes;
  element_class.reserve(elements());
  for (std::size_t e = 0; e < elements(); ++e) {
    const Corners corners = mesh.corners(e);
    const GaussWeights& weights = options.weights.empty() ? unweighted : options.weights[e];
    const auto [known, is_new] =
        classes.try_emplace(key_of(corners, weights, unit), static_cast<std::int32_t>(stiffness.size()));
    if (is_new) {
      stiffness.push_back(fe::element_stiffness(corners, material, options.formulation, weights));
      corner_mass.push_back(lumped_mass(corners, material.density, weights));
    }
    element_class.push_back(known->second);
    for (std::size_t a = 0; a < 8; ++a)
      node_mass[static_cast<std::size_t>(connectivity[e][a])] +=
          corner_mass[static_cast<std::size_t>(known->second)][static_cast<Eigen::Index>(a)];
  }

  std::vector<std::int32_t> every(elements());
  std::iota(every.begin(), every.end(), 0);
  all = Portion(connectivity, std::move(every));
}

Portion::Portion(std::span<const Hexahedron> connectivity, std::vector<std::int32_t> chosen)
    : elements(std::move(chosen)) {
  std::map<std::int32_t, std::vector<std::int32_t>> touched;
  for (std::size_t place = 0; place < elements.size(); ++place)
    for (std::size_t a = 0; a < 8; ++a)
      touched[connectivity[static_cast<std::size_t>(elements[place])][a]].push_back(
          static_cast<std::int32_t>(8 * place + a));
  first.push_back(0);
  for (const auto& [node, entries] : touched) {
    nodes.push_back(node);
    entry.insert(entry.end(), entries.begin(), entries.end());
    first.push_back(static_cast<std::int32_t>(entry.size()));
  }
}

double Body::total_mass() const {
  double sum = 0;
  for (const double mass : node_mass) sum += mass;
  return sum;
}

}  // namespace fe
