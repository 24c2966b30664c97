#include "impact/impactors/stl.h"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>

#include "libdem/core/error.h"
#include "libdem/core/input_file.h"

namespace impact {
namespace {

constexpr std::size_t header_size = 84, record_size = 50;
constexpr std::uint32_t most_triangles = 100'000'000;

/// Corners as they stand in the file, three to a triangle.
using Soup = std::vector<Vec3>;

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (int k = 3; k >= 0; --k) value = value << 8 | static_cast<unsigned char>(bytes[k]);
  return value;
}

Soup read_binary(std::string_view bytes) {
  const std::size_t count = little_endian(bytes.data() + 80);
  Soup soup;
  soup.reserve(3 * count);
  for (std::size_t t = 0; t < count; ++t) {
    const char* corner = bytes.data() + header_size + record_size * t + 12;  // after the normal
    for (int k = 0; k < 3; ++k, corner += 12)
      soup.emplace_back(std::bit_cast<float>(little_endian(corner)),
                        std::bit_cast<float>(little_endian(corner + 4)),
                        std::bit_cast<float>(little_endian(corner + 8)));
  }
  return soup;
}

/// Words of a text file with the line that each stands on.
class Words {
 public:
  Words(std::string_view all, const std::string& file) : text(all), name(file) {}

  /// The next word, "" at the end.
  std::string_view next() {
    while (position < text.size() && is_space(text[position])) line_number += text[position++] == '\n';
    const std::size_t begin = position;
    while (position < text.size() && !is_space(text[position])) ++position;
    return text.substr(begin, position - begin);
  }
  /// Passes over the rest of the line: the name of a solid may hold anything.
  void skip_line() {
    while (position < text.size() && text[position] != '\n') ++position;
  }
  void expect(std::string_view word) {
    if (const std::string_view found = next(); found != word) fail(found, fmt::format("'{}'", word));
  }
  double number() {
    std::string_view found = next();
    const std::string_view whole = found;
    if (found.starts_with('+')) found.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), value);
    if (error != std::errc() || end != found.data() + found.size() || found.empty()) fail(whole, "a number");
    return value;
  }
  [[noreturn]] void fail(std::string_view found, const std::string& wanted) const {
    const std::string what = found.empty() ? "the file ends" : fmt::format("'{}' stands", found.substr(0, 40));
    throw dem::InputError(fmt::format("{}:{}", name, line_number),
                          fmt::format("{} where {} should be", what, wanted),
                          "the file is no whole STL text: export it again");
  }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  std::string_view text;
  const std::string& name;
  std::size_t position = 0, line_number = 1;
};

Soup read_text(std::string_view text, const std::string& name) {
  Words words(text, name);
  Soup soup;
  std::string_view word = words.next();
  while (word == "solid") {  // a file may hold several, one after the other
    words.skip_line();
    word = words.next();
    while (word == "facet") {
      words.expect("normal");
      for (int k = 0; k < 3; ++k) words.next();  // ignored: some programs write nan here
      words.expect("outer");
      words.expect("loop");
      for (int k = 0; k < 3; ++k) {
        words.expect("vertex");
        const double x = words.number(), y = words.number(), z = words.number();
        soup.emplace_back(x, y, z);
      }
      words.expect("endloop");
      words.expect("endfacet");
      word = words.next();
    }
    if (word != "endsolid") words.fail(word, "'facet' or 'endsolid'");
    words.skip_line();
    word = words.next();
  }
  if (!word.empty()) words.fail(word, "'solid'");
  return soup;
}

}  // namespace

TriangleMesh parse_stl(std::string_view bytes, const std::string& name, double metres_per_unit) {
  if (!(metres_per_unit > 0 && std::isfinite(metres_per_unit)))
    throw dem::InputError(name, fmt::format("a unit of {} m", metres_per_unit),
                          "the unit of an STL file must be positive and finite, such as 0.001 for millimetres");
  if (bytes.empty()) throw dem::InputError(name, "the file is empty", "an STL file holds a closed surface");
  // A binary header may begin with "solid" too, so the size decides first.
  const std::size_t count = bytes.size() >= header_size ? little_endian(bytes.data() + 80) : 0;
  const bool binary = bytes.size() >= header_size && bytes.size() == header_size + record_size * count;
  if (!binary && !bytes.starts_with("solid"))
    throw dem::InputError(name,
                          bytes.size() < header_size
                              ? fmt::format("{} bytes are no STL file", bytes.size())
                              : fmt::format("{} bytes do not fit the {} triangles that it announces ({} bytes)",
                                            bytes.size(), count, header_size + record_size * count),
                          "the file is truncated or no STL: export it again");
  if (count > most_triangles && binary)
    throw dem::InputError(name, fmt::format("{} triangles", count),
                          fmt::format("at most {} are read: simplify the mesh", most_triangles));
  const Soup soup = binary ? read_binary(bytes) : read_text(bytes, name);
  std::vector<Vec3> vertices;
  vertices.reserve(soup.size());
  for (const Vec3& p : soup) vertices.emplace_back(metres_per_unit * p);
  std::vector<Triangle> triangles(soup.size() / 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) triangles[t][k] = static_cast<std::int32_t>(3 * t + k);
  return {vertices, triangles, name};
}

TriangleMesh read_stl(const std::filesystem::path& file, double metres_per_unit) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw dem::InputError(file.string(), "this is a folder", "name an STL file");
  constexpr std::size_t most = std::size_t{8} << 30;
  return parse_stl(dem::content_of_input(file, most, "name an STL file to read"), file.string(),
                   metres_per_unit);
}

}  // namespace impact
