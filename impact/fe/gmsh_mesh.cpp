#include "impact/fe/gmsh_mesh.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <gmshc.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <mutex>
#include <numeric>
#include <span>
#include <unordered_map>

#include "libdem/core/error.h"

namespace fe {
namespace {

constexpr int eight_node_hexahedron = 5;  // Gmsh's number of the type

/// The functions of Gmsh that are used here, looked up in the library when it is first needed.
struct Gmsh {
  decltype(&gmshInitialize) initialize = nullptr;
  decltype(&gmshClear) clear = nullptr;
  decltype(&gmshFree) release = nullptr;
  decltype(&gmshOptionSetNumber) set_number = nullptr;
  decltype(&gmshMerge) merge = nullptr;
  decltype(&gmshModelMeshGetNodes) nodes = nullptr;
  decltype(&gmshModelMeshGetElementTypes) element_types = nullptr;
  decltype(&gmshModelMeshGetElementProperties) element_properties = nullptr;
  decltype(&gmshModelMeshGetElementsByType) elements_by_type = nullptr;
  decltype(&gmshModelGetPhysicalGroups) physical_groups = nullptr;
  decltype(&gmshModelGetPhysicalName) physical_name = nullptr;
  decltype(&gmshModelMeshGetNodesForPhysicalGroup) group_nodes = nullptr;

  Gmsh() {
    void* library = ::dlopen(SPALL_GMSH_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr) library = ::dlopen("libgmsh.so", RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr)
      throw dem::RunError(
          fmt::format("reading a .msh needs the Gmsh library ({}), which this machine lacks: install "
                      "Gmsh (Debian: libgmsh4.8), or describe a structured mesh in the case file",
                      SPALL_GMSH_LIBRARY));
    const auto find = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(::dlsym(library, name));
      if (function == nullptr)
        throw dem::RunError(
            fmt::format("the Gmsh library has no function {}: install Gmsh 4.8 or later", name));
    };
    find(initialize, "gmshInitialize");
    find(clear, "gmshClear");
    find(release, "gmshFree");
    find(set_number, "gmshOptionSetNumber");
    find(merge, "gmshMerge");
    find(nodes, "gmshModelMeshGetNodes");
    find(element_types, "gmshModelMeshGetElementTypes");
    find(element_properties, "gmshModelMeshGetElementProperties");
    find(elements_by_type, "gmshModelMeshGetElementsByType");
    find(physical_groups, "gmshModelGetPhysicalGroups");
    find(physical_name, "gmshModelGetPhysicalName");
    find(group_nodes, "gmshModelMeshGetNodesForPhysicalGroup");
    // Once: it takes far longer than a small mesh, and leaves memory behind each time.
    int error = 0;
    initialize(0, nullptr, 0, &error);
    set_number("General.Terminal", 0, &error);
    // Partitions mean nothing here, and Gmsh 4.8 crashes where an old file's are damaged.
    set_number("Mesh.PartitionConvertMsh2", 0, &error);
  }
};

/// Gmsh keeps its models for the whole process: one is opened here, under a lock, and cleared whatever happens.
class Session {
 public:
  explicit Session(const std::string& file) : lock(mutex()), gmsh(library()), name(file) {
    int error = 0;
    // Not gmshOpen: after a file that it could not read it is locked, and reads nothing more.
    gmsh.merge(file.c_str(), &error);
    if (error != 0) {
      close();
      refuse();
    }
  }
  ~Session() { close(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// What a call of Gmsh fills, copied out; `call` gets the array, its length and the error.
  template <class Item, class Call>
  std::vector<Item> fetch(Call call) const {
    Item* items = nullptr;
    std::size_t count = 0;
    int error = 0;
    call(&items, &count, &error);
    if (error != 0) refuse();
    std::vector<Item> result(items, items + count);
    gmsh.release(items);
    return result;
  }
  [[noreturn]] void refuse() const {
    throw dem::InputError(name, "Gmsh cannot read it", "it must be a .msh mesh file that `gmsh` opens");
  }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  static const Gmsh& library() {
    static const Gmsh loaded;
    return loaded;
  }
  void close() const {
    int error = 0;
    gmsh.clear(&error);
  }

  std::lock_guard<std::mutex> lock;

 public:
  const Gmsh& gmsh;

 private:
  std::string name;
};

void check_file(const std::string& file, double unit) {
  if (!(unit > 0) || !std::isfinite(unit))
    throw dem::InputError(file, fmt::format("the length unit is {:g} m", unit), "it must be above 0");
  std::ifstream in(file);
  if (!in) throw dem::InputError(file, "cannot be opened", "name an existing .msh file");
  // Gmsh would run a script as readily as read a mesh, so only a mesh is let through.
  if (in.get() != '$')
    throw dem::InputError(file, "it is no Gmsh mesh", "a .msh file begins with $MeshFormat or $Comments");
}

/// "Hexahedron 20" and the like.
std::string type_name(const Session& session, int type, int& dimension) {
  char* text = nullptr;
  double* coordinates = nullptr;
  std::size_t count = 0;
  int order = 0, nodes = 0, primary = 0, error = 0;
  session.gmsh.element_properties(type, &text, &dimension, &order, &nodes, &coordinates, &count, &primary,
                                  &error);
  if (error != 0) session.refuse();
  std::string name = text;
  session.gmsh.release(text);
  session.gmsh.release(coordinates);
  return name;
}

std::vector<std::size_t> elements_of_type(const Session& session, int type,
                                          std::vector<std::size_t>& node_tags) {
  return session.fetch<std::size_t>([&](std::size_t** tags, std::size_t* count, int* error) {
    std::size_t* nodes = nullptr;
    std::size_t node_count = 0;
    session.gmsh.elements_by_type(type, tags, count, &nodes, &node_count, -1, 0, 1, error);
    node_tags.assign(nodes, nodes + node_count);
    session.gmsh.release(nodes);
  });
}

void refuse_other_solids(const Session& session, const std::string& file) {
  const auto types = session.fetch<int>([&](int** items, std::size_t* count, int* error) {
    session.gmsh.element_types(items, count, -1, -1, error);
  });
  for (const int type : types) {
    int dimension = 0;
    const std::string name = type_name(session, type, dimension);
    if (dimension < 3 || type == eight_node_hexahedron) continue;
    std::vector<std::size_t> nodes;
    const std::vector<std::size_t> tags = elements_of_type(session, type, nodes);
    throw dem::InputError(
        file, fmt::format("element {} is a {}", tags.empty() ? 0 : tags.front(), name),
        "solid elements must be hexahedra of eight nodes (Gmsh: transfinite or recombined volumes, "
        "first order)");
  }
}

void read_groups(const Session& session, const std::unordered_map<std::size_t, std::int32_t>& number,
                 Mesh& mesh) {
  const auto groups = session.fetch<int>([&](int** items, std::size_t* count, int* error) {
    session.gmsh.physical_groups(items, count, -1, error);
  });
  for (std::size_t g = 0; g + 1 < groups.size(); g += 2) {
    char* text = nullptr;
    int error = 0;
    session.gmsh.physical_name(groups[g], groups[g + 1], &text, &error);
    std::string name = text != nullptr ? text : "";
    session.gmsh.release(text);
    if (name.empty()) name = fmt::format("{}:{}", groups[g], groups[g + 1]);
    const auto tags = session.fetch<std::size_t>([&](std::size_t** items, std::size_t* count, int* failed) {
      double* coordinates = nullptr;
      std::size_t length = 0;
      session.gmsh.group_nodes(groups[g], groups[g + 1], items, count, &coordinates, &length, failed);
      session.gmsh.release(coordinates);
    });
    std::vector<std::int32_t>& members = mesh.groups[name];
    for (const std::size_t tag : tags) members.push_back(number.at(tag));
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
  }
}

}  // namespace

Mesh read_gmsh(const std::string& file, double unit) {
  check_file(file, unit);
  Mesh mesh;
  mesh.origin = file;
  {
    const Session session(file);
    refuse_other_solids(session, file);
    std::vector<double> coordinates;
    mesh.node_tags = session.fetch<std::size_t>([&](std::size_t** tags, std::size_t* count, int* error) {
      double *places = nullptr, *parameters = nullptr;
      std::size_t length = 0, unused = 0;
      session.gmsh.nodes(tags, count, &places, &length, &parameters, &unused, -1, -1, 0, 0, error);
      coordinates.assign(places, places + length);
      session.gmsh.release(places);
      session.gmsh.release(parameters);
    });
    // Gmsh hands nodes out by geometric entity; here they come in the order of their own numbers.
    std::vector<std::size_t> order(mesh.node_tags.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return mesh.node_tags[i] < mesh.node_tags[j]; });
    std::unordered_map<std::size_t, std::int32_t> number;
    for (const std::size_t i : order) {
      number[mesh.node_tags[i]] = static_cast<std::int32_t>(mesh.nodes.size());
      mesh.nodes.emplace_back(unit * Vec3(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]));
    }
    std::sort(mesh.node_tags.begin(), mesh.node_tags.end());
    std::vector<std::size_t> corner_tags;
    mesh.element_tags = elements_of_type(session, eight_node_hexahedron, corner_tags);
    for (std::size_t e = 0; e < mesh.element_tags.size(); ++e) {
      Hexahedron element{};
      for (std::size_t a = 0; a < 8; ++a) {
        const auto found = number.find(corner_tags[8 * e + a]);
        if (found == number.end())
          throw dem::InputError(
              file, fmt::format("element {} names node {}", mesh.element_tags[e], corner_tags[8 * e + a]),
              "the file holds no such node");
        element[a] = found->second;
      }
      mesh.elements.push_back(element);
    }
    read_groups(session, number, mesh);
  }
  check(mesh);
  return mesh;
}

}  // namespace fe
