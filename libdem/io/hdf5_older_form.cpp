#include "libdem/io/hdf5_older_form.h"

#include <hdf5.h>
#include <sys/resource.h>

#include <array>
#include <fstream>
#include <string_view>
#include <vector>

#include "libdem/core/child_process.h"

namespace dem {
namespace {

// What follows is the child's: it ends after it, so nothing is closed, and failures are left to the parent.

constexpr hid_t everything = 0;  // H5S_ALL, without its old-style cast
constexpr hsize_t most_bytes = hsize_t{1} << 30;

/// The bytes of numbers with this type and space, or 0 for what is no number or too large to be true.
std::size_t plain_bytes(hid_t type, hid_t space) {
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_INTEGER && kind != H5T_FLOAT && kind != H5T_STRING) return 0;
  if (kind == H5T_STRING && H5Tis_variable_str(type) != 0) return 0;
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  const std::size_t each = H5Tget_size(type);
  if (count <= 0 || each == 0 || static_cast<hsize_t>(count) > most_bytes / each) return 0;
  return static_cast<std::size_t>(count) * each;
}

herr_t read_attribute(hid_t owner, const char* name, const H5A_info_t*, void*) {
  const hid_t attribute = H5Aopen(owner, name, H5P_DEFAULT);
  if (attribute < 0) return 0;
  const hid_t type = H5Aget_type(attribute);
  std::vector<char> value(plain_bytes(type, H5Aget_space(attribute)));
  if (!value.empty()) H5Aread(attribute, type, value.data());
  // A name that is not there is looked for as well: that is how readers ask for what may be missing.
  H5Aexists(owner, "no such attribute");
  return 0;
}

herr_t read_object(hid_t file, const char* name, const H5O_info_t* what, void*) {
  const hid_t object = H5Oopen(file, name, H5P_DEFAULT);
  if (object < 0) return 0;
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, read_attribute, nullptr);
  if (what->type != H5O_TYPE_DATASET) return 0;
  const hid_t type = H5Dget_type(object);
  std::vector<char> values(plain_bytes(type, H5Dget_space(object)));
  if (!values.empty()) H5Dread(object, type, everything, everything, H5P_DEFAULT, values.data());
  return 0;
}

/// A damaged list that runs in a circle makes the library ask for memory until there is none, or for ever.
struct TooMuchMemory {};
constexpr rlim_t most_memory = rlim_t{2} << 30;
constexpr ChildLimits limits{most_memory + most_bytes, 300};

rlim_t peak_memory() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return static_cast<rlim_t>(used.ru_maxrss) * 1024;
}

void read_whole(const std::string& file) {
  const rlim_t before = peak_memory();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (opened < 0) return;
  H5Ovisit2(opened, H5_INDEX_NAME, H5_ITER_INC, read_object, nullptr, H5O_INFO_BASIC);
  if (peak_memory() > before + most_memory) throw TooMuchMemory{};
}

bool of_newer_form(const std::filesystem::path& file) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::array<char, signature.size() + 1> start{};
  std::ifstream(file, std::ios::binary).read(start.data(), start.size());
  constexpr char first_with_checksums = 2;
  return std::string_view(start.data(), signature.size()) == signature && start.back() >= first_with_checksums;
}

}  // namespace

bool survives_older_form(const std::filesystem::path& file) {
  if (of_newer_form(file)) return true;
  return wait_for_child(start_child([&] { read_whole(file.string()); }, limits)).succeeded;
}

}  // namespace dem
