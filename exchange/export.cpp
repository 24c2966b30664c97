#include "exchange/export.h"

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "exchange/writers.h"
#include "libdem/config/nearest_name.h"
#include "libdem/core/error.h"

namespace exchange {

const std::vector<std::string>& format_names() {
  static const std::vector<std::string> names{"csv", "yade-jcfpm", "yade-cpm", "lammps-bpm"};
  return names;
}

std::string_view name_of(Format format) { return format_names()[static_cast<std::size_t>(format)]; }

Format format_named(const std::string& name) {
  const auto& names = format_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw dem::InputError("--to", "\"" + name + "\" is no format", dem::suggestion(name, names));
  return static_cast<Format>(found - names.begin());
}

std::string companion_name(const std::string& file_name, std::string_view ending) {
  std::filesystem::path path(file_name);
  const std::string extension = path.extension().string();
  const bool script = extension == ".py" || extension == ".in" || extension == ".lmp" || extension == ".csv";
  return (script ? path.stem().string() : file_name) + std::string(ending);
}

double density_factor(const specimens::Specimen& specimen) {
  double spheres = 0;
  for (const double radius : specimen.radii) spheres += 4. / 3 * std::numbers::pi * radius * radius * radius;
  return specimen.volume() / spheres;
}

std::string comment_list(const std::vector<std::string>& items) {
  constexpr std::size_t width = 110;
  std::string text;
  for (const std::string& item : items) {
    std::string line = "# -";
    std::istringstream words(item);
    for (std::string word; words >> word;) {
      if (line.size() + 1 + word.size() > width) {
        text += line + "\n";
        line = "#  ";
      }
      line += " " + word;
    }
    text += line + "\n";
  }
  return text;
}

Exported export_card(Format format, const Request& request) {
  request.card.validate(request.card.name);
  switch (format) {
    case Format::csv:
      return write_csv(request);
    case Format::yade_jcfpm:
      return write_yade_jcfpm(request);
    case Format::yade_cpm:
      return write_yade_cpm(request);
    case Format::lammps_bpm:
      break;
  }
  return write_lammps_bpm(request);
}

}  // namespace exchange
