#include "impact/fe/gmsh_library.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <gmshc.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <type_traits>

#include "libdem/core/child_process.h"
#include "libdem/core/error.h"

namespace fe {
namespace {

constexpr int eight_node_hexahedron = 5;  // Gmsh's number of the type

/// The functions of Gmsh that are used here, looked up in the library when it is first needed.
struct Gmsh {
  decltype(&gmshInitialize) initialize = nullptr;
  decltype(&gmshFree) release = nullptr;
  decltype(&gmshClear) forget = nullptr;
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
    find(release, "gmshFree");
    find(forget, "gmshClear");
    find(set_number, "gmshOptionSetNumber");
    find(merge, "gmshMerge");
    find(nodes, "gmshModelMeshGetNodes");
    find(element_types, "gmshModelMeshGetElementTypes");
    find(element_properties, "gmshModelMeshGetElementProperties");
    find(elements_by_type, "gmshModelMeshGetElementsByType");
    find(physical_groups, "gmshModelGetPhysicalGroups");
    find(physical_name, "gmshModelGetPhysicalName");
    find(group_nodes, "gmshModelMeshGetNodesForPhysicalGroup");
    // Once: it takes far longer than a small mesh. No file is read here, so it stays as it is for the next
    // child.
    int error = 0;
    initialize(0, nullptr, 0, &error);
    set_number("General.Terminal", 0, &error);
    // Partitions mean nothing here.
    set_number("Mesh.PartitionConvertMsh2", 0, &error);
  }
};

/// What ends the child in failure.
struct CannotRead {};

/// In the child: reads the file and sends what it holds through the pipe.
class Child {
 public:
  Child(const Gmsh& library, int out) : gmsh(library), pipe(out) {}

  void read(const std::string& file) {
    int error = 0;
    gmsh.forget(&error);
    gmsh.merge(file.c_str(), &error);
    leave_if(error != 0);
    send_nodes();
    send_elements(eight_node_hexahedron);
    send_groups();
    send_other_solids();
  }

 private:
  static void leave_if(bool failed) {
    if (failed) throw CannotRead{};
  }

  template <class Item>
  void send(const Item* items, std::size_t count) const {
    write(&count, sizeof count);
    write(items, count * sizeof(Item));
  }
  void write(const void* data, std::size_t bytes) const {
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
      const ssize_t written = ::write(pipe, from, bytes);
      if (written < 0 && errno == EINTR) continue;
      leave_if(written <= 0);
      from += written;
      bytes -= static_cast<std::size_t>(written);
    }
  }

  void send_nodes() const {
    std::size_t *tags = nullptr, count = 0, length = 0, unused = 0;
    double *places = nullptr, *parameters = nullptr;
    int error = 0;
    gmsh.nodes(&tags, &count, &places, &length, &parameters, &unused, -1, -1, 0, 0, &error);
    leave_if(error != 0 || length != 3 * count);
    send(tags, count);
    send(places, length);
  }

  void send_elements(int type) const {
    std::size_t *tags = nullptr, count = 0, *nodes = nullptr, node_count = 0;
    int error = 0;
    gmsh.elements_by_type(type, &tags, &count, &nodes, &node_count, -1, 0, 1, &error);
    leave_if(error != 0 || node_count != 8 * count);
    send(tags, count);
    send(nodes, node_count);
  }

  void send_groups() const {
    int *groups = nullptr, error = 0;
    std::size_t count = 0;
    gmsh.physical_groups(&groups, &count, -1, &error);
    leave_if(error != 0);
    const std::size_t pairs = count / 2;
    write(&pairs, sizeof pairs);
    for (std::size_t g = 0; g + 1 < count; g += 2) {
      char* text = nullptr;
      gmsh.physical_name(groups[g], groups[g + 1], &text, &error);
      const std::string name = error == 0 && text != nullptr && *text != '\0'
                                   ? std::string(text)
                                   : fmt::format("{}:{}", groups[g], groups[g + 1]);
      send(name.data(), name.size());
      std::size_t *tags = nullptr, tag_count = 0, length = 0;
      double* places = nullptr;
      gmsh.group_nodes(groups[g], groups[g + 1], &tags, &tag_count, &places, &length, &error);
      leave_if(error != 0);
      send(tags, tag_count);
      gmsh.release(text);
      gmsh.release(tags);
      gmsh.release(places);
    }
  }

  void send_other_solids() const {
    int *types = nullptr, error = 0;
    std::size_t count = 0;
    gmsh.element_types(&types, &count, -1, -1, &error);
    leave_if(error != 0);
    std::vector<GmshContent::Element> found;
    for (std::size_t k = 0; k < count; ++k) {
      char* name = nullptr;
      double* corners = nullptr;
      int dimension = 0, order = 0, nodes = 0, primary = 0;
      std::size_t length = 0;
      gmsh.element_properties(types[k], &name, &dimension, &order, &nodes, &corners, &length, &primary, &error);
      leave_if(error != 0);
      if (dimension < 3 || types[k] == eight_node_hexahedron) continue;
      std::size_t *tags = nullptr, tag_count = 0, *tag_nodes = nullptr, node_count = 0;
      gmsh.elements_by_type(types[k], &tags, &tag_count, &tag_nodes, &node_count, -1, 0, 1, &error);
      leave_if(error != 0);
      found.push_back({tag_count > 0 ? tags[0] : 0, name});
    }
    const std::size_t solids = found.size();
    write(&solids, sizeof solids);
    for (const GmshContent::Element& element : found) {
      write(&element.tag, sizeof element.tag);
      send(element.type.data(), element.type.size());
    }
  }

  const Gmsh& gmsh;
  int pipe;
};

dem::InputError cannot_read(const std::string& file) {
  return {file, "Gmsh cannot read it", "it must be a .msh mesh file that `gmsh` opens"};
}

/// In the parent: what the child sent.
class Sent {
 public:
  explicit Sent(std::string_view bytes) : rest(bytes) {}

  std::size_t number() {
    std::size_t value = 0;
    copy(&value, sizeof value);
    return value;
  }
  template <class Items>
  Items items() {
    const std::size_t count = number();
    if (count > rest.size() / sizeof(typename Items::value_type)) throw CutShort{};
    Items result(count, {});
    copy(result.data(), count * sizeof(typename Items::value_type));
    return result;
  }

  struct CutShort {};

 private:
  void copy(void* to, std::size_t bytes) {
    if (bytes > rest.size()) throw CutShort{};
    if (bytes > 0) std::memcpy(to, rest.data(), bytes);
    rest.remove_prefix(bytes);
  }
  std::string_view rest;
};

const Gmsh& gmsh_library() {
  static const Gmsh gmsh;
  return gmsh;
}

/// A few bytes can claim a thousand million nodes, for which Gmsh makes room.
dem::ChildLimits limits_for(const std::string& file) {
  constexpr std::uint64_t least_memory = std::uint64_t{1} << 30, memory_per_byte = 50;
  constexpr std::uint64_t least_seconds = 60, bytes_per_second = 100'000;
  std::error_code unknown;
  const std::uint64_t size = std::filesystem::file_size(file, unknown);
  if (unknown) return {};
  return {least_memory + memory_per_byte * size, least_seconds + size / bytes_per_second};
}

/// Starts the child and waits for its end; what it sent.
std::string hear_child(const std::string& file, dem::ChildEnd& end) {
  gmsh_library();  // loaded here, once
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw dem::RunError(
        fmt::format("{}: cannot make a pipe to read it through: {}", file, std::strerror(errno)));
  pid_t child = 0;
  try {
    child = dem::start_child([&] { send_by_gmsh(file, ends[1]); }, limits_for(file));
  } catch (...) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw;
  }
  ::close(ends[1]);
  std::string heard;
  std::array<char, 65536> part{};
  for (;;) {
    const ssize_t got = ::read(ends[0], part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    heard.append(part.data(), static_cast<std::size_t>(got));
  }
  ::close(ends[0]);
  end = dem::wait_for_child(child);
  return heard;
}

}  // namespace

void send_by_gmsh(const std::string& file, int out) { Child(gmsh_library(), out).read(file); }

GmshContent read_by_gmsh(const std::string& file) {
  dem::ChildEnd end;
  const std::string heard = hear_child(file, end);
  if (!end.crash.empty())
    throw dem::InputError(file, fmt::format("Gmsh cannot read it: its library crashes ({})", end.crash),
                          "it is damaged, or names a node that it does not hold: write it anew with Gmsh");
  if (!end.succeeded) throw cannot_read(file);
  return gmsh_content(heard, file);
}

GmshContent gmsh_content(std::string_view heard, const std::string& file) {
  try {
    Sent sent(heard);
    GmshContent content;
    content.node_tags = sent.items<std::vector<std::size_t>>();
    content.coordinates = sent.items<std::vector<double>>();
    content.hexahedron_tags = sent.items<std::vector<std::size_t>>();
    content.corner_tags = sent.items<std::vector<std::size_t>>();
    for (std::size_t g = sent.number(); g > 0; --g) {
      auto name = sent.items<std::string>();
      content.groups.push_back({std::move(name), sent.items<std::vector<std::size_t>>()});
    }
    for (std::size_t k = sent.number(); k > 0; --k) {
      const std::size_t tag = sent.number();
      content.other_solids.push_back({tag, sent.items<std::string>()});
    }
    if (content.coordinates.size() != 3 * content.node_tags.size() ||
        content.corner_tags.size() != 8 * content.hexahedron_tags.size())
      throw Sent::CutShort{};
    return content;
  } catch (const Sent::CutShort&) {
    throw cannot_read(file);
  }
}

}  // namespace fe
