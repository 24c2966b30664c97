// HDF5 files without leaks and without its error stacks: every failure is one line that names the file and the
// dataset.
#pragma once
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dem {

/// What a dataset may hold.
template <class T>
concept Hdf5Value = std::same_as<T, double> || std::same_as<T, float> || std::same_as<T, std::int32_t> ||
    std::same_as<T, std::int64_t> || std::same_as<T, std::uint64_t> || std::same_as<T, std::uint8_t>;

/// How a dataset is stored.
struct Hdf5Storage {
  int gzip = 0;  ///< 0 (contiguous, as it is) to 9 (chunked, shuffled and compressed)
};

/// An open HDF5 file. Names are paths from the root ("links/a"); groups on the way are made when writing. May
/// be used from any thread: the library below is not thread safe, so one lock guards it all.
///
/// Throws InputError when opening or reading (no such file, not HDF5, truncated, missing, of another shape or
/// type), RunError when writing.
class Hdf5File {
 public:
  static Hdf5File open(const std::filesystem::path& file);
  /// Opens, for reading, the bytes of a file that are in memory; `name` stands for the file in messages.
  static Hdf5File open_image(std::string_view bytes, const std::filesystem::path& name);
  /// Replaces an existing file. Prefer `create_spall_file`, which leaves the old file alone until the new one
  /// is whole. `checked`: the library's own records carry checksums, so that it refuses damaged ones instead of
  /// believing them; HDF5 1.10 or later can read such files.
  static Hdf5File create(const std::filesystem::path& file, bool checked = false);
  Hdf5File(Hdf5File&&) noexcept;
  Hdf5File& operator=(Hdf5File&&) noexcept;
  /// Closes quietly. After writing call `close` instead, which reports what could not be flushed.
  ~Hdf5File();
  void close();
  /// The name used in messages.
  const std::filesystem::path& path() const;

  void make_group(const std::string& name);
  bool has(const std::string& name) const;
  /// The names inside a group ("/" for the root), sorted.
  std::vector<std::string> names_in(const std::string& group) const;
  /// The extent of a dataset along each of its dimensions.
  std::vector<std::size_t> shape(const std::string& dataset) const;

  /// Writes a dataset: one-dimensional if columns is 0, else of values.size() / columns rows.
  template <Hdf5Value T>
  void write(const std::string& dataset, std::span<const T> values, std::size_t columns = 0,
             const Hdf5Storage& storage = {});
  template <Hdf5Value T>
  void write(const std::string& dataset, const std::vector<T>& values, std::size_t columns = 0,
             const Hdf5Storage& storage = {}) {
    write(dataset, std::span<const T>(values), columns, storage);
  }

  /// Reads a dataset whose shape must be as `columns` says (as in `write`) and, unless `rows` is `any`, of that
  /// length.
  template <Hdf5Value T>
  std::vector<T> read(const std::string& dataset, std::size_t columns = 0, std::size_t rows = any) const;
  static constexpr std::size_t any = static_cast<std::size_t>(-1);

  /// Attributes of a group or dataset; "/" is the file itself. Setting replaces.
  void set_attribute(const std::string& object, const std::string& name, const std::string& text);
  void set_attribute(const std::string& object, const std::string& name, const char* text) {
    set_attribute(object, name, std::string(text));
  }
  template <Hdf5Value T>
  void set_attribute(const std::string& object, const std::string& name, T value) {
    set_scalar(object, name, value);
  }
  /// A one-dimensional attribute.
  template <Hdf5Value T>
  void set_attribute(const std::string& object, const std::string& name, std::span<const T> values);

  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  /// A scalar attribute, or a one-dimensional one of length 1.
  template <Hdf5Value T>
  T number_attribute(const std::string& object, const std::string& name) const;
  template <Hdf5Value T>
  std::vector<T> numbers_attribute(const std::string& object, const std::string& name) const;

 private:
  struct Implementation;
  explicit Hdf5File(std::unique_ptr<Implementation> implementation);
  template <Hdf5Value T>
  void set_scalar(const std::string& object, const std::string& name, T value);

  std::unique_ptr<Implementation> self;
};

/// Readies the library, which the first use would do, and crash where memory is short. Throws RunError.
void start_hdf5();

/// Writes a Spall file whole or not at all: `write` fills it; attributes `format` ("spall-specimen", ...) and
/// `format_version` are set here. Throws RunError.
void create_spall_file(const std::filesystem::path& file, const std::string& format, int version,
                       const std::function<void(Hdf5File&)>& write);

/// Opens a Spall file of that kind, written with format version 1 to `version`. Throws InputError if it is no
/// such file.
Hdf5File open_spall_file(const std::filesystem::path& file, const std::string& format, int version);
/// The same of a file that is open.
void require_spall_file(const Hdf5File& file, const std::string& format, int version);

}  // namespace dem
