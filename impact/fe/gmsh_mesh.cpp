#include "impact/fe/gmsh_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <unordered_map>

#include "impact/fe/gmsh_library.h"
#include "libdem/core/error.h"

namespace fe {
namespace {

void check_file(const std::string& file, double unit) {
  if (!(unit > 0) || !std::isfinite(unit))
    throw dem::InputError(file, fmt::format("the length unit is {:g} m", unit), "it must be above 0");
  std::ifstream in(file);
  if (!in) throw dem::InputError(file, "cannot be opened", "name an existing .msh file");
  // Gmsh would run a script as readily as read a mesh, so only a mesh is let through.
  if (in.get() != '$')
    throw dem::InputError(file, "it is no Gmsh mesh", "a .msh file begins with $MeshFormat or $Comments");
}

/// Places of the nodes in the order of their own numbers; Gmsh hands them out by geometric entity.
std::unordered_map<std::size_t, std::int32_t> add_nodes(const GmshContent& content, double unit, Mesh& mesh) {
  std::vector<std::size_t> order(content.node_tags.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return content.node_tags[i] < content.node_tags[j]; });
  std::unordered_map<std::size_t, std::int32_t> number;
  for (const std::size_t i : order) {
    number[content.node_tags[i]] = static_cast<std::int32_t>(mesh.nodes.size());
    mesh.node_tags.push_back(content.node_tags[i]);
    mesh.nodes.emplace_back(unit * Eigen::Map<const Vec3>(&content.coordinates[3 * i]));
  }
  return number;
}

}  // namespace

Mesh read_gmsh(const std::string& file, double unit) {
  check_file(file, unit);
  return mesh_of(read_by_gmsh(file), file, unit);
}

Mesh mesh_of(const GmshContent& content, const std::string& file, double unit) {
  Mesh mesh;
  mesh.origin = file;
  if (!content.other_solids.empty()) {
    const GmshContent::Element& other = content.other_solids.front();
    throw dem::InputError(file, fmt::format("element {} is a {}", other.tag, other.type),
                          "solid elements must be hexahedra of eight nodes (Gmsh: transfinite or recombined "
                          "volumes, first order)");
  }
  const std::unordered_map<std::size_t, std::int32_t> number = add_nodes(content, unit, mesh);
  const auto node = [&](std::size_t tag, const char* kind, const auto& name) {
    const auto found = number.find(tag);
    if (found == number.end())
      throw dem::InputError(file, fmt::format("{} {} names node {}", kind, name, tag),
                            "the file holds no such node");
    return found->second;
  };
  mesh.element_tags = content.hexahedron_tags;
  for (std::size_t e = 0; e < mesh.element_tags.size(); ++e) {
    Hexahedron& element = mesh.elements.emplace_back();
    for (std::size_t a = 0; a < 8; ++a)
      element[a] = node(content.corner_tags[8 * e + a], "element", mesh.element_tags[e]);
  }
  for (const GmshContent::Group& group : content.groups) {
    std::vector<std::int32_t>& members = mesh.groups[group.name];
    for (const std::size_t tag : group.node_tags) members.push_back(node(tag, "group", group.name));
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
  }
  check(mesh);
  return mesh;
}

}  // namespace fe
