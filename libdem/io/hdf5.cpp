#include "libdem/io/hdf5.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <mutex>
#include <system_error>
#include <utility>

#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/io/hdf5_older_form.h"

namespace dem {
namespace {

// Debian's library is built without thread safety. Recursive, because public functions use each other.
std::recursive_mutex& library_mutex() {
  // A file that could not be closed, on a full disk, stays open in the library, which would try again at exit
  // and crash. Nothing else is left to do then: every file is closed by its owner.
  static const herr_t left_alone_at_exit = H5dont_atexit();
  static_cast<void>(left_alone_at_exit);
  static std::recursive_mutex mutex;
  return mutex;
}

class Lock {
 public:
  Lock() : guard(library_mutex()) {
    // Where the library is thread safe, each thread has error stacks of its own.
    static thread_local const herr_t silenced = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    static_cast<void>(silenced);
  }
  // What a call complained of would else outlive a thread that ends, and the library counts it at exit.
  ~Lock() { H5Eclear2(H5E_DEFAULT); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  std::lock_guard<std::recursive_mutex> guard;
};

// Owns an identifier of the library; negative means that the call which made it failed.
class Handle {
 public:
  Handle(hid_t made, herr_t (*closer)(hid_t)) : id(made), close_it(closer) {}
  Handle(Handle&& other) noexcept : id(std::exchange(other.id, -1)), close_it(other.close_it) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() { close(); }
  herr_t close() { return id >= 0 ? close_it(std::exchange(id, -1)) : 0; }
  operator hid_t() const { return id; }
  explicit operator bool() const { return id >= 0; }

 private:
  hid_t id;
  herr_t (*close_it)(hid_t);
};

template <class T>
hid_t memory_type() {
  if constexpr (std::same_as<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::same_as<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::same_as<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::same_as<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::same_as<T, std::uint64_t>) return H5T_NATIVE_UINT64;
  if constexpr (std::same_as<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

// Whether values of `stored` type fit into T without loss of meaning (the library would clip silently).
template <class T>
bool fits(hid_t stored) {
  const H5T_class_t kind = H5Tget_class(stored);
  if constexpr (std::floating_point<T>) return kind == H5T_FLOAT && H5Tget_size(stored) <= sizeof(T);
  if (kind != H5T_INTEGER) return false;
  const bool is_signed = H5Tget_sign(stored) == H5T_SGN_2;
  if (is_signed == std::signed_integral<T>) return H5Tget_size(stored) <= sizeof(T);
  return !is_signed && H5Tget_size(stored) < sizeof(T);
}

constexpr hid_t everything = 0;  // H5S_ALL, without its old-style cast

constexpr const char* make_again = "the file may be damaged, or made by other means: make it again";

std::vector<hsize_t> dimensions_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> dimensions(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space, dimensions.data(), nullptr);
  return dimensions;
}

}  // namespace

struct Hdf5File::Implementation {
  std::filesystem::path path;
  Handle file;

  [[noreturn]] void wrong(const std::string& what, const std::string& found, const std::string& remedy) const {
    throw InputError(fmt::format("{}: {}", path.string(), what), found, remedy);
  }
  [[noreturn]] void cannot_write(const std::string& what) const {
    throw RunError(fmt::format("{}: cannot write {}; is the disk full?", path.string(), what));
  }

  bool exists(const std::string& name) const {
    if (name == "/") return true;
    for (std::size_t at = name.find('/', 1);;
         at = name.find('/', at + 1)) {  // each group on the way must exist too
      const std::string part = name.substr(0, at);
      if (!part.empty() && H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0) return false;
      if (at == std::string::npos) return H5Oexists_by_name(file, name.c_str(), H5P_DEFAULT) > 0;
    }
  }

  Handle dataset(const std::string& name) const {
    Handle found(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!found)
      wrong("dataset " + name, exists(name) ? "cannot be opened as a dataset" : "is missing", make_again);
    return found;
  }

  Handle object(const std::string& name) const {
    Handle found(H5Oopen(file, name.c_str(), H5P_DEFAULT), H5Oclose);
    if (!found) wrong(name, "is missing", make_again);
    return found;
  }

  Handle attribute(const std::string& of, const std::string& name) const {
    Handle found(H5Aopen_by_name(file, of.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (!found && !exists(of)) wrong(of, "is missing", make_again);
    if (!found) wrong(fmt::format("attribute {} of {}", name, of), "is missing", make_again);
    return found;
  }

  void write_attribute(const std::string& of, const std::string& name, hid_t type, hid_t space,
                       const void* value) {
    const Handle owner(H5Oopen(file, of.c_str(), H5P_DEFAULT), H5Oclose);
    if (owner && H5Aexists(owner, name.c_str()) > 0) H5Adelete(owner, name.c_str());
    const Handle made(owner ? H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT) : -1,
                      H5Aclose);
    if (!made || H5Awrite(made, type, value) < 0) cannot_write(fmt::format("attribute {} of {}", name, of));
  }

  // A damaged header can claim any size: refuse what the bytes in the file cannot hold, however well
  // compressed.
  void require_plausible(const std::string& name, std::size_t values, std::size_t bytes_each) const {
    hsize_t file_bytes = 0;
    const bool known = H5Fget_filesize(file, &file_bytes) >= 0;
    constexpr double best_compression = 2000, always_allowed = 1 << 20;
    const double bytes = static_cast<double>(values) * static_cast<double>(bytes_each);
    if (known && bytes > always_allowed + best_compression * static_cast<double>(file_bytes))
      wrong("dataset " + name, fmt::format("claims {} values, more than the file can hold", values),
            make_again);
  }
};

Hdf5File::Hdf5File(std::unique_ptr<Implementation> implementation) : self(std::move(implementation)) {}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;

Hdf5File& Hdf5File::operator=(Hdf5File&& other) noexcept {
  const Lock lock;
  self = std::move(other.self);
  return *this;
}

Hdf5File::~Hdf5File() {
  const Lock lock;
  self.reset();
}

const std::filesystem::path& Hdf5File::path() const { return self->path; }

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  const Lock lock;
  const std::string name = path.string();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(name, "no such file", "check the path");
  if (!std::filesystem::is_regular_file(path, error)) throw InputError(name, "is not a file", "check the path");
  if (!survives_older_form(path))
    throw InputError(name, "is an HDF5 file so damaged that the library which reads it crashes",
                     "make it again, or fetch a whole copy");
  Handle file(H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file) {
    const htri_t is_hdf5 = H5Fis_hdf5(name.c_str());
    if (is_hdf5 > 0)
      throw InputError(name, "is an HDF5 file that is truncated, damaged or open elsewhere for writing",
                       "make it again, or fetch a whole copy");
    throw InputError(name, is_hdf5 == 0 ? "is not an HDF5 file" : "cannot be read",
                     "give a file that Spall wrote (*.h5)");
  }
  return Hdf5File(std::make_unique<Implementation>(Implementation{path, std::move(file)}));
}

Hdf5File Hdf5File::open_image(std::string_view bytes, const std::filesystem::path& path) {
  const Lock lock;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, 1 << 16, false);
  // The library copies the bytes.
  H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size());
  // To the library two images of one name that are open together would be the same file.
  static std::uint64_t opened = 0;
  const std::string name = path.string(), distinct = fmt::format("{}#{}", name, ++opened);
  Handle file(bytes.empty() ? -1 : H5Fopen(distinct.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!file)
    throw InputError(name, "is not an HDF5 file, or a damaged one", "give a file that Spall wrote (*.h5)");
  return Hdf5File(std::make_unique<Implementation>(Implementation{path, std::move(file)}));
}

Hdf5File Hdf5File::create(const std::filesystem::path& path, bool checked) {
  const Lock lock;
  const Handle how(H5Pcreate(H5P_FILE_CREATE), H5Pclose), access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_obj_track_times(how, false);  // the same content gives the same bytes
  if (checked) H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  // Written aside, under a name that nobody else knows: a lock would keep nobody out, but a process started
  // meanwhile inherits it, and the finished file would be refused until that process ends.
  H5Pset_file_locking(access, false, true);
  errno = 0;
  Handle file(H5Fcreate(path.string().c_str(), H5F_ACC_TRUNC, how, access), H5Fclose);
  if (!file) {
    const std::string reason =
        errno != 0 ? std::generic_category().message(errno) : std::string("no reason given");
    throw RunError(
        fmt::format("{}: cannot be created ({}); is the folder there and writable?", path.string(), reason));
  }
  return Hdf5File(std::make_unique<Implementation>(Implementation{path, std::move(file)}));
}

void Hdf5File::close() {
  const Lock lock;
  if (!self->file) return;
  const bool flushed = H5Fflush(self->file, H5F_SCOPE_GLOBAL) >= 0;
  if (self->file.close() < 0 || !flushed) self->cannot_write("its last part");
}

bool Hdf5File::has(const std::string& name) const {
  const Lock lock;
  return self->exists(name);
}

void Hdf5File::make_group(const std::string& name) {
  const Lock lock;
  const Handle how(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(how, false);
  for (std::size_t at = name.find('/', 1);; at = name.find('/', at + 1)) {
    const std::string part = name.substr(0, at);
    if (!self->exists(part)) {
      const Handle group(H5Gcreate2(self->file, part.c_str(), H5P_DEFAULT, how, H5P_DEFAULT), H5Gclose);
      if (!group) self->cannot_write("group " + part);
    }
    if (at == std::string::npos) return;
  }
}

std::vector<std::string> Hdf5File::names_in(const std::string& group) const {
  const Lock lock;
  const Handle opened = self->object(group);
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->emplace_back(name);
    return 0;
  };
  if (H5Literate(opened, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names) < 0)
    self->wrong(group, "cannot be listed", make_again);
  return names;
}

std::vector<std::size_t> Hdf5File::shape(const std::string& name) const {
  const Lock lock;
  const Handle dataset = self->dataset(name);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const std::vector<hsize_t> dimensions = dimensions_of(space);
  return {dimensions.begin(), dimensions.end()};
}

template <Hdf5Value T>
void Hdf5File::write(const std::string& name, std::span<const T> values, std::size_t columns,
                     const Hdf5Storage& storage) {
  const Lock lock;
  if (columns > 0 && values.size() % columns != 0)
    throw RunError(fmt::format("{}: dataset {}: {} values do not make whole rows of {}", self->path.string(),
                               name, values.size(), columns));
  std::array<hsize_t, 2> extent{columns > 0 ? values.size() / columns : values.size(), columns};
  const int rank = columns > 0 ? 2 : 1;
  const Handle space(H5Screate_simple(rank, extent.data(), nullptr), H5Sclose);
  if (const auto end = name.rfind('/'); end != std::string::npos && end > 0) make_group(name.substr(0, end));
  const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(how, false);
  if (storage.gzip > 0 && !values.empty()) {
    constexpr hsize_t chunk_rows = 16384;
    std::array<hsize_t, 2> chunk{std::min(extent[0], chunk_rows), columns};
    H5Pset_chunk(how, rank, chunk.data());
    H5Pset_shuffle(how);
    H5Pset_deflate(how, static_cast<unsigned>(std::min(storage.gzip, 9)));
  }
  const hid_t type = memory_type<T>();
  const Handle made(H5Dcreate2(self->file, name.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose);
  if (!made ||
      (!values.empty() && H5Dwrite(made, type, everything, everything, H5P_DEFAULT, values.data()) < 0))
    self->cannot_write("dataset " + name);
}

template <Hdf5Value T>
std::vector<T> Hdf5File::read(const std::string& name, std::size_t columns, std::size_t rows) const {
  const Lock lock;
  const Handle dataset = self->dataset(name);
  const Handle type(H5Dget_type(dataset), H5Tclose);
  if (!fits<T>(type)) self->wrong("dataset " + name, "holds another type of values than it should", make_again);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const std::vector<hsize_t> found = dimensions_of(space);
  const bool shaped = columns > 0 ? found.size() == 2 && found[1] == columns : found.size() == 1;
  if (!shaped || (rows != any && found[0] != rows))
    self->wrong("dataset " + name,
                fmt::format("has shape ({}) instead of ({}{})", fmt::join(found, ", "),
                            rows == any ? "any" : std::to_string(rows),
                            columns > 0 ? ", " + std::to_string(columns) : ""),
                make_again);
  const auto count = static_cast<double>(found[0]) * static_cast<double>(std::max<std::size_t>(columns, 1));
  self->require_plausible(name, count < 1e18 ? static_cast<std::size_t>(count) : any, sizeof(T));
  std::vector<T> values(found[0] * std::max<std::size_t>(columns, 1));
  if (!values.empty() &&
      H5Dread(dataset, memory_type<T>(), everything, everything, H5P_DEFAULT, values.data()) < 0)
    self->wrong("dataset " + name, "cannot be read (truncated or damaged)", make_again);
  return values;
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, const std::string& text) {
  const Lock lock;
  // Fixed length, which every reader knows (VTK among them).
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const bool ascii =
      std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; });
  H5Tset_cset(type, ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  self->write_attribute(object, name, type, space, text.c_str());
}

template <Hdf5Value T>
void Hdf5File::set_scalar(const std::string& object, const std::string& name, T value) {
  const Lock lock;
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  self->write_attribute(object, name, memory_type<T>(), space, &value);
}

template <Hdf5Value T>
void Hdf5File::set_attribute(const std::string& object, const std::string& name, std::span<const T> values) {
  const Lock lock;
  const hsize_t count = values.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  self->write_attribute(object, name, memory_type<T>(), space, values.data());
}

bool Hdf5File::has_attribute(const std::string& object, const std::string& name) const {
  const Lock lock;
  return H5Aexists_by_name(self->file, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5File::text_attribute(const std::string& object, const std::string& name) const {
  const Lock lock;
  const Handle attribute = self->attribute(object, name);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  const std::string what = fmt::format("attribute {} of {}", name, object);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1)
    self->wrong(what, "is not a text", make_again);
  if (H5Tis_variable_str(type) > 0) {  // as h5py writes them
    char* text = nullptr;
    const Handle memory(H5Tcopy(type), H5Tclose);
    if (H5Aread(attribute, memory, &text) < 0) self->wrong(what, "cannot be read", make_again);
    std::string copy = text != nullptr ? text : "";
    H5free_memory(text);
    return copy;
  }
  constexpr std::size_t most = 1 << 20;  // names and origins; a damaged file may claim anything
  if (H5Tget_size(type) > most) self->wrong(what, "is longer than any text that Spall writes", make_again);
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, text.data()) < 0) self->wrong(what, "cannot be read", make_again);
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

template <Hdf5Value T>
std::vector<T> Hdf5File::numbers_attribute(const std::string& object, const std::string& name) const {
  const Lock lock;
  const Handle attribute = self->attribute(object, name);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  const std::string what = fmt::format("attribute {} of {}", name, object);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  constexpr hssize_t most = 1 << 16;  // attributes are small; a damaged one may claim anything
  if (!fits<T>(type) || count < 0 || count > most)
    self->wrong(what, "is not the number that it should be", make_again);
  std::vector<T> values(static_cast<std::size_t>(count));
  if (count > 0 && H5Aread(attribute, memory_type<T>(), values.data()) < 0)
    self->wrong(what, "cannot be read", make_again);
  return values;
}

template <Hdf5Value T>
T Hdf5File::number_attribute(const std::string& object, const std::string& name) const {
  const std::vector<T> values = numbers_attribute<T>(object, name);
  if (values.size() != 1)
    self->wrong(fmt::format("attribute {} of {}", name, object), "is not one number", make_again);
  return values[0];
}

#define SPALL_INSTANTIATE(T)                                                                                 \
  template void Hdf5File::write<T>(const std::string&, std::span<const T>, std::size_t, const Hdf5Storage&); \
  template std::vector<T> Hdf5File::read<T>(const std::string&, std::size_t, std::size_t) const;             \
  template void Hdf5File::set_scalar<T>(const std::string&, const std::string&, T);                          \
  template void Hdf5File::set_attribute<T>(const std::string&, const std::string&, std::span<const T>);      \
  template T Hdf5File::number_attribute<T>(const std::string&, const std::string&) const;                    \
  template std::vector<T> Hdf5File::numbers_attribute<T>(const std::string&, const std::string&) const;
SPALL_INSTANTIATE(double)
SPALL_INSTANTIATE(float)
SPALL_INSTANTIATE(std::int32_t)
SPALL_INSTANTIATE(std::int64_t)
SPALL_INSTANTIATE(std::uint64_t)
SPALL_INSTANTIATE(std::uint8_t)
#undef SPALL_INSTANTIATE

void start_hdf5() {
  const Lock lock;
  if (H5open() < 0) throw RunError("the HDF5 library cannot be started; is there memory?");
}

void create_spall_file(const std::filesystem::path& file, const std::string& format, int version,
                       const std::function<void(Hdf5File&)>& write) {
  write_file_atomically(file, [&](const std::filesystem::path& part) {
    Hdf5File opened = Hdf5File::create(part, true);
    opened.set_attribute("/", "format", format);
    opened.set_attribute("/", "format_version", std::int32_t{version});
    write(opened);
    opened.close();
  });
}

Hdf5File open_spall_file(const std::filesystem::path& path, const std::string& format, int version) {
  Hdf5File file = Hdf5File::open(path);
  require_spall_file(file, format, version);
  return file;
}

void require_spall_file(const Hdf5File& file, const std::string& format, int version) {
  const std::filesystem::path& path = file.path();
  if (!file.has_attribute("/", "format"))
    throw InputError(path.string(), fmt::format("is an HDF5 file, but not a {} file", format),
                     "give a file that Spall wrote");
  const std::string found = file.text_attribute("/", "format");
  if (found != format)
    throw InputError(path.string(), fmt::format("is a {} file, not a {} file", found, format),
                     fmt::format("give a {} file", format));
  const auto found_version = file.number_attribute<std::int32_t>("/", "format_version");
  if (found_version < 1 || found_version > version)
    throw InputError(
        path.string(),
        fmt::format("has {} format version {}, this Spall reads 1 to {}", format, found_version, version),
        "read it with a newer Spall, or make it again with this one");
}

}  // namespace dem
