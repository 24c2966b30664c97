#include "libdem/io/frame_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <nlohmann/json.hpp>

#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/core/scratch_files.h"

namespace dem {
namespace {

/// The weakest: files shrink to less than half, at a speed that a run does not notice.
constexpr int compression = 1;

std::string file_name(const std::string& kind, int number) { return fmt::format("{}_{:04}.hdf", kind, number); }
std::string index_name(const std::string& kind) { return kind + ".hdf.series"; }

int number_of(const std::string& file) { return std::stoi(file.substr(file.rfind('_') + 1)); }

/// Whether a file of that name is a frame of `kind`.
bool is_frame(const std::string& name, const std::string& kind) {
  if (!name.starts_with(kind + "_") || !name.ends_with(".hdf")) return false;
  const std::string number = name.substr(kind.size() + 1, name.size() - kind.size() - 5);
  return number.size() >= 4 && number.size() <= 9 &&
         std::all_of(number.begin(), number.end(),
                     [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

}  // namespace

std::vector<std::pair<std::filesystem::path, FrameMoment>> read_frame_series(
    const std::filesystem::path& folder, const std::string& kind) {
  const std::filesystem::path index = folder / index_name(kind);
  std::vector<std::pair<std::filesystem::path, FrameMoment>> found;
  std::ifstream in(index);
  if (!in) return found;
  try {
    const nlohmann::json series = nlohmann::json::parse(in);
    for (const auto& entry : series.at("files")) {
      const auto name = entry.at("name").get<std::string>();
      if (is_frame(name, kind) && std::filesystem::exists(folder / name))
        found.emplace_back(folder / name,
                           FrameMoment{entry.at("time").get<double>(), entry.value("label", std::string())});
    }
  } catch (const nlohmann::json::exception&) {
    throw InputError(index.string(), "this is no index of frames",
                     "remove it to go on without the frames that were there");
  }
  return found;
}

FrameSeries::FrameSeries(std::filesystem::path where, std::vector<std::string> which, bool resume)
    : folder(std::move(where)), kinds(std::move(which)) {
  require_writable_folder(folder);
  sweep_scratch(folder);
  for (const std::string& kind : kinds) {
    auto& its = moments[kind];
    if (!resume) continue;
    for (auto& [file, moment] : read_frame_series(folder, kind))
      its[number_of(file.filename().string())] = std::move(moment);
  }
  if (resume) return;
  // A former run may have left more frames than this one will make.
  std::error_code ignored;
  std::vector<std::filesystem::path> former;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
    if (is_ours(entry.path().filename().string())) former.push_back(entry.path());
  for (const std::filesystem::path& file : former) std::filesystem::remove(file, ignored);
}

bool FrameSeries::is_ours(const std::string& name) const {
  return std::any_of(kinds.begin(), kinds.end(),
                     [&](const std::string& kind) { return name == index_name(kind) || is_frame(name, kind); });
}

void FrameSeries::write(int number, const FrameMoment& moment, const std::string& kind, const VtkGrid& grid) {
  write_vtkhdf(folder / file_name(kind, number), grid, compression);
  moments.at(kind)[number] = moment;
}

void FrameSeries::write_indexes() const {
  for (const auto& [kind, its] : moments) {
    if (its.empty()) continue;
    nlohmann::ordered_json series = {{"file-series-version", "1.0"},
                                     {"files", nlohmann::ordered_json::array()}};
    for (const auto& [number, at] : its) {
      nlohmann::ordered_json entry = {{"name", file_name(kind, number)}, {"time", at.time}};
      if (!at.label.empty()) entry["label"] = at.label;
      series["files"].push_back(std::move(entry));
    }
    write_file_atomically(folder / index_name(kind), series.dump(1) + "\n");
  }
}

}  // namespace dem
