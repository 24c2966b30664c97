#include "impact/histories.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "libdem/io/hdf5.h"

namespace impact {
namespace {

/// A name that the user gave, without the letters to which CSV headers and HDF5 paths give a meaning.
std::string plain(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](char letter) {
        return std::string_view(",;[]/.\"'#").find(letter) != std::string_view::npos || letter < ' ';
      },
      '_');
  return name.empty() ? "unnamed" : name;
}

/// "displacement/<name>" of each probe; two names never become one.
std::vector<std::string> displacement_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Probe& probe : scene.probes) {
    std::string name = "displacement/" + plain(probe.name);
    while (std::find(names.begin(), names.end(), name) != names.end()) name += '_';
    names.push_back(std::move(name));
  }
  return names;
}

struct EnergyPart {
  const char *name, *meaning;
  double ImpactEnergy::*part;
};
constexpr std::array<EnergyPart, 12> energy_parts = {{
    {"elements", "kinetic, of the discrete elements", &ImpactEnergy::elements},
    {"impactor", "kinetic, of the impactor", &ImpactEnergy::impactor},
    {"nodes", "kinetic, of the finite elements", &ImpactEnergy::nodes},
    {"elastic", "elastic, in links and contacts", &ImpactEnergy::elastic},
    {"finite_elastic", "elastic, in the finite elements", &ImpactEnergy::finite_elastic},
    {"contact", "elastic, in the contacts with the impactor", &ImpactEnergy::contact},
    {"softening", "dissipated by links that soften and break", &ImpactEnergy::softening},
    {"sliding", "dissipated by sliding among the elements", &ImpactEnergy::sliding},
    {"damping", "dissipated by local damping", &ImpactEnergy::damping},
    {"contact_sliding", "dissipated by sliding at the impactor", &ImpactEnergy::contact_sliding},
    {"contact_damping", "dissipated by the dashpots at the impactor", &ImpactEnergy::contact_damping},
    {"ties", "dissipated by the ties of the overlap", &ImpactEnergy::ties},
}};

template <class Value>
HistoryColumn scalar(const std::string& name, const std::string& unit, const std::string& meaning,
                     std::span<const Sample> history, Value value) {
  HistoryColumn column{name, unit, meaning, 1, {}};
  for (const Sample& sample : history) column.values.push_back(static_cast<double>(value(sample)));
  return column;
}

template <class Value>
HistoryColumn vector(const std::string& name, const std::string& unit, const std::string& meaning,
                     std::span<const Sample> history, Value value) {
  HistoryColumn column{name, unit, meaning, 3, {}};
  for (const Sample& sample : history) {
    const Vec3 row = value(sample);
    column.values.insert(column.values.end(), {row.x(), row.y(), row.z()});
  }
  return column;
}

/// The force is a mean since the last sample, so its sum over the intervals is the impulse itself.
HistoryColumn impulse_of(std::span<const Sample> history) {
  Vec3 impulse = Vec3::Zero();
  double before = 0;
  return vector("impulse", "N s", "of the force, since the start", history, [&](const Sample& sample) {
    impulse += sample.force * (sample.time - before);
    before = sample.time;
    return impulse;
  });
}

}  // namespace

std::vector<HistoryColumn> history_columns(const Scene& scene, std::span<const Sample> history) {
  std::vector<HistoryColumn> columns;
  columns.push_back(scalar("time", "s", "", history, [](const Sample& s) { return s.time; }));
  const std::vector<std::string> names = displacement_names(scene);
  for (std::size_t p = 0; p < names.size(); ++p)
    columns.push_back(
        vector(names[p], "m", "of the probe", history, [p](const Sample& s) { return s.displacement.at(p); }));
  if (scene.impactor) {
    columns.push_back(vector("force", "N", "of the structure on the impactor, mean since the last sample",
                             history, [](const Sample& s) { return s.force; }));
    columns.push_back(impulse_of(history));
    columns.push_back(vector("impactor_position", "m", "of the centre of mass", history,
                             [](const Sample& s) { return s.impactor_position; }));
    columns.push_back(vector("impactor_velocity", "m/s", "of the centre of mass", history,
                             [](const Sample& s) { return s.impactor_velocity; }));
  }
  columns.push_back(
      scalar("broken_links", "-", "so far", history, [](const Sample& s) { return s.broken_links; }));
  for (const EnergyPart& part : energy_parts) {
    HistoryColumn column = scalar(fmt::format("energy/{}", part.name), "J", part.meaning, history,
                                  [&](const Sample& s) { return s.energy.*part.part; });
    // A part that never was anything is not of this scene (no finite elements, no damping).
    if (std::any_of(column.values.begin(), column.values.end(), [](double value) { return value != 0; }))
      columns.push_back(std::move(column));
  }
  return columns;
}

std::string curves_csv(const Scene& scene, std::span<const Sample> history) {
  const std::vector<HistoryColumn> columns = history_columns(scene, history);
  std::string text;
  const auto out = std::back_inserter(text);
  for (const HistoryColumn& column : columns) {
    std::string name = column.name;
    std::replace(name.begin(), name.end(), '/', '_');
    for (std::size_t c = 0; c < column.components; ++c)
      fmt::format_to(out, "{}{}{}[{}]", text.empty() ? "" : ",", name,
                     column.components == 3 ? std::string("_") + "xyz"[c] : "", column.unit);
  }
  text += '\n';
  for (std::size_t row = 0; row < history.size(); ++row) {
    for (const HistoryColumn& column : columns)
      for (std::size_t c = 0; c < column.components; ++c)
        fmt::format_to(out, "{}{:.9g}", &column == columns.data() ? "" : ",",
                       column.values[row * column.components + c]);
    text += '\n';
  }
  return text;
}

void write_history(const std::filesystem::path& file, const Scene& scene, std::span<const Sample> history) {
  dem::create_spall_file(file, "spall-impact-history", 1, [&](dem::Hdf5File& out) {
    for (const HistoryColumn& column : history_columns(scene, history)) {
      out.write(column.name, column.values, column.components > 1 ? column.components : 0);
      out.set_attribute(column.name, "unit", column.unit);
      if (!column.meaning.empty()) out.set_attribute(column.name, "meaning", column.meaning);
    }
    const std::vector<std::string> names = displacement_names(scene);
    for (std::size_t p = 0; p < names.size(); ++p) {
      const Vec3& point = scene.probes[p].point;
      out.set_attribute(names[p], "point", std::span<const double>(point.data(), 3));
    }
  });
}

}  // namespace impact
