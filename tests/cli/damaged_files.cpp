#include "tests/cli/damaged_files.h"

#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "libdem/io/hdf5.h"
#include "specimens/packing.h"
#include "specimens/specimen_file.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using Numbers = std::vector<double>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// What stands in a specimen's file. The hash that it names of itself is left out, so that what is wrong is
/// found and not only that something is.
struct Columns {
  std::string format = "spall-specimen", shape = "box";
  int version = specimens::specimen_format_version;
  Numbers size, centres, radii, distances;
  double interaction_radius_factor = 0;
  std::size_t centre_columns = 3, link_columns = 2;
  std::vector<std::int32_t> links;
  std::set<std::string> left_out;
  bool whole_radii = false;  ///< radii written as integers
  std::optional<std::string> sha256;
};

const specimens::Specimen& sound_specimen() {
  static const specimens::Specimen made = [] {
    specimens::PackingOptions options;
    options.size = dem::Vec3(0.3, 0.2, 0.2);
    options.elements = 1000;
    options.threads = 1;
    return specimens::make_specimen(options);
  }();
  return made;
}

Columns sound_columns() {
  const specimens::Specimen& specimen = sound_specimen();
  Columns columns;
  columns.size = {0.3, 0.2, 0.2};
  columns.radii = specimen.radii;
  columns.interaction_radius_factor = specimen.interaction_radius_factor;
  for (const dem::Vec3& c : specimen.centres)
    columns.centres.insert(columns.centres.end(), {c.x(), c.y(), c.z()});
  for (const specimens::Link& link : specimen.links) {
    columns.links.insert(columns.links.end(), {link.a, link.b});
    columns.distances.push_back(link.initial_distance);
  }
  return columns;
}

void write(const fs::path& file, const Columns& columns) {
  dem::Hdf5File out = dem::Hdf5File::create(file);
  const auto with = [&](const char* name) { return !columns.left_out.contains(name); };
  if (with("format")) out.set_attribute("/", "format", columns.format);
  if (with("format_version")) out.set_attribute("/", "format_version", std::int32_t{columns.version});
  out.set_attribute("/", "shape", columns.shape);
  out.set_attribute("/", "size", std::span<const double>(columns.size));
  out.set_attribute("/", "seed", std::uint64_t{1});
  out.set_attribute("/", "interaction_radius_factor", columns.interaction_radius_factor);
  out.set_attribute("/", "origin", std::string("packed"));
  if (columns.sha256) out.set_attribute("/", "sha256", *columns.sha256);
  if (with("elements/centre")) out.write("elements/centre", columns.centres, columns.centre_columns);
  if (columns.whole_radii)
    out.write("elements/radius", std::vector<std::int32_t>(columns.radii.size(), 1));
  else if (with("elements/radius"))
    out.write("elements/radius", columns.radii);
  if (with("links/elements")) out.write("links/elements", columns.links, columns.link_columns);
  if (with("links/initial_distance")) out.write("links/initial_distance", columns.distances);
  out.close();
}

using Edit = std::function<void(Columns&)>;

const std::map<std::string, Edit>& edits() {
  static const std::map<std::string, Edit> all{
      {"no format", [](Columns& c) { c.left_out = {"format"}; }},
      {"other format", [](Columns& c) { c.format = "spall-checkpoint"; }},
      {"no version", [](Columns& c) { c.left_out = {"format_version"}; }},
      {"newer version", [](Columns& c) { c.version = 99; }},
      {"version zero", [](Columns& c) { c.version = 0; }},
      {"unknown shape", [](Columns& c) { c.shape = "sphere"; }},
      {"two sides", [](Columns& c) { c.size.pop_back(); }},
      {"negative side", [](Columns& c) { c.size[0] = -0.3; }},
      {"cylinder of two diameters", [](Columns& c) { c.shape = "cylinder"; }},
      {"interaction factor none", [](Columns& c) { c.interaction_radius_factor = none; }},
      {"no radii", [](Columns& c) { c.left_out = {"elements/radius"}; }},
      {"no links", [](Columns& c) { c.left_out = {"links/elements"}; }},
      {"NaN radius", [](Columns& c) { c.radii[7] = none; }},
      {"negative radius", [](Columns& c) { c.radii[7] = -0.01; }},
      {"whole radii", [](Columns& c) { c.whole_radii = true; }},
      {"one radius less", [](Columns& c) { c.radii.pop_back(); }},
      {"no element",
       [](Columns& c) { c.radii.clear(), c.centres.clear(), c.links.clear(), c.distances.clear(); }},
      {"element outside", [](Columns& c) { c.centres[3 * 7] = 1; }},
      {"NaN centre", [](Columns& c) { c.centres[3 * 7] = none; }},
      {"flat centres", [](Columns& c) { c.centre_columns = 2, c.centres.resize(2 * c.radii.size()); }},
      {"link to nothing", [](Columns& c) { c.links[2 * 7 + 1] = 100000; }},
      {"link to a negative number", [](Columns& c) { c.links[2 * 7] = -1; }},
      {"link to itself", [](Columns& c) { c.links[2 * 7 + 1] = c.links[2 * 7]; }},
      {"link twice",
       [](Columns& c) { c.links[2 * 8] = c.links[2 * 7], c.links[2 * 8 + 1] = c.links[2 * 7 + 1]; }},
      {"link of no length", [](Columns& c) { c.distances[7] = 0; }},
      {"link of NaN length", [](Columns& c) { c.distances[7] = none; }},
      {"link of another length", [](Columns& c) { c.distances[7] *= 1000; }},
      {"elements that fill nothing",
       [](Columns& c) {
         for (double& radius : c.radii) radius *= 1e-3;
       }},
      {"one length less", [](Columns& c) { c.distances.pop_back(); }},
      {"links of three", [](Columns& c) { c.link_columns = 3, c.links.resize(3 * c.distances.size()); }},
      {"edited", [](Columns& c) { c.radii[7] *= 1.001, c.sha256 = sound_specimen().sha256(); }},
      {"named after another", [](Columns& c) { c.sha256 = std::string(64, '0'); }},
  };
  return all;
}

std::string bytes_of_sound() {
  static const std::string bytes = [] {
    const fs::path file = fs::temp_directory_path() / ("spall-sound-" + std::to_string(::getpid()) + ".h5");
    specimens::write_specimen(file, sound_specimen());
    std::ifstream in(file, std::ios::binary);
    std::string all{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    fs::remove(file);
    return all;
  }();
  return bytes;
}

std::string turned_over(std::string bytes, std::size_t from, std::size_t count) {
  for (std::size_t k = from; k < from + count; ++k) bytes[k] = static_cast<char>(~bytes[k]);
  return bytes;
}

/// A checkpoint that belongs to inputs which nobody has.
void write_foreign_checkpoint(const fs::path& file, const std::string& format, int version) {
  dem::Hdf5File out = dem::Hdf5File::create(file);
  out.set_attribute("/", "format", format);
  out.set_attribute("/", "format_version", std::int32_t{version});
  out.set_attribute("/", "sha256", std::string(64, '0'));
  out.make_group("belongs_to");
  for (const char* what : {"specimen", "card", "case", "structure", "options", "test"})
    out.set_attribute("belongs_to", what, std::string(64, '0'));
  out.close();
}

}  // namespace

void make_damaged(const std::string& damage, const fs::path& file) {
  static std::mutex one_at_a_time;
  const std::lock_guard guard(one_at_a_time);
  const auto put = [&](const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; };
  const std::string sound = bytes_of_sound();
  if (damage == "whole") return put(sound);
  if (damage == "truncated") return put(sound.substr(0, sound.size() / 2));
  if (damage == "first bytes only") return put(sound.substr(0, 40));
  if (damage == "middle turned over") return put(turned_over(sound, sound.size() / 2, 16));
  if (damage == "checkpoint of another run") return write_foreign_checkpoint(file, "spall-checkpoint", 1);
  if (damage == "checkpoint of a newer Spall") return write_foreign_checkpoint(file, "spall-checkpoint", 99);
  Columns columns = sound_columns();
  edits().at(damage)(columns);
  write(file, columns);
}

}  // namespace cli
