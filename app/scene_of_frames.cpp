#include "app/scene_of_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "libdem/core/error.h"
#include "libdem/io/frame_series.h"
#include "libdem/io/hdf5.h"

namespace app {
namespace {

using Files = std::vector<std::pair<std::filesystem::path, dem::FrameMoment>>;

/// A frame of 120,808 elements is some 0.7 MB of a page.
constexpr std::size_t most_element_frames = 1'500'000;

std::vector<float> as_float(const std::vector<double>& values) { return {values.begin(), values.end()}; }

/// Every so many frames, counted back from the last.
Files thinned(const Files& all, std::size_t elements) {
  const std::size_t most = std::max<std::size_t>(2, most_element_frames / std::max<std::size_t>(elements, 1));
  const std::size_t every = (all.size() + most - 1) / most;
  Files kept;
  for (std::size_t k = (all.size() - 1) % every; k < all.size(); k += every) kept.push_back(all[k]);
  return kept;
}

/// The file of another kind that shows the same moment.
const std::filesystem::path* at_moment(const Files& files, double time) {
  for (const auto& [file, moment] : files)
    if (moment.time == time) return &file;
  return nullptr;
}

[[noreturn]] void refuse(const dem::Hdf5File& in, const std::string& wrong) {
  throw dem::InputError(in.path().string(), wrong, "remove the frames, or run once more");
}

/// Vectors, a row each.
std::vector<double> vectors_of(const dem::Hdf5File& in, const std::string& name,
                               std::size_t rows = dem::Hdf5File::any) {
  std::vector<double> numbers = in.read<double>(name, 3, rows);
  if (!std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); }))
    refuse(in, fmt::format("a number of {} is not finite", name));
  return numbers;
}

std::vector<double> points_of(const dem::Hdf5File& in) { return vectors_of(in, "VTKHDF/Points"); }

/// Which of so many points the cells join.
std::vector<std::int64_t> corners_of(const dem::Hdf5File& in, std::size_t points) {
  std::vector<std::int64_t> corners = in.read<std::int64_t>("VTKHDF/Connectivity");
  for (const std::int64_t corner : corners)
    if (corner < 0 || corner >= static_cast<std::int64_t>(points))
      refuse(in, fmt::format("it names point {}, of {}", corner, points));
  return corners;
}

/// Cells are read from the first frame alone.
void require_same_points(const dem::Hdf5File& in, std::size_t found, std::size_t before) {
  if (found != before) refuse(in, fmt::format("it shows {} points, and others {}", found / 3, before / 3));
}

double length(const std::vector<double>& vectors, std::size_t i) {
  return std::hypot(vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2]);
}

void add_elements(report::Scene& scene, report::Scene::Frame& frame, const dem::Hdf5File& in) {
  const std::vector<double> points = points_of(in);
  const std::size_t count = points.size() / 3;
  const std::vector<double> moved = vectors_of(in, "VTKHDF/PointData/displacement", count);
  if (scene.frames.empty()) {
    scene.radii = as_float(in.read<double>("VTKHDF/PointData/radius", 0, count));
    for (std::size_t k = 0; k < points.size(); ++k)
      scene.centres.push_back(static_cast<float>(points[k] - moved[k]));
    scene.fields = {{"damage", "", 0, 1}, {"displacement", "mm", 0, 0}};
    if (in.has("VTKHDF/PointData/velocity")) scene.fields.push_back({"speed", "m/s", 0, 0});
  } else if (count != scene.elements()) {
    refuse(in, fmt::format("it shows {} elements, and others {}", count, scene.elements()));
  }
  frame.displacements = as_float(moved);
  frame.values.push_back(as_float(in.read<double>("VTKHDF/PointData/damage", 0, count)));
  const auto add_length = [&](const std::vector<double>& vectors, double factor) {
    std::vector<float>& values = frame.values.emplace_back();
    for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<float>(factor * length(vectors, i)));
  };
  add_length(moved, 1e3);
  if (scene.fields.size() > 2) add_length(vectors_of(in, "VTKHDF/PointData/velocity", count), 1);
}

using Pair = std::pair<std::int64_t, std::int64_t>;

/// Notes the links that this frame is the first to show broken.
void add_broken_links(report::Scene& scene, std::set<Pair>& known, const dem::Hdf5File& in,
                      std::uint32_t frame) {
  const auto state = in.read<std::uint8_t>("VTKHDF/CellData/state");
  const auto ends = in.read<std::int64_t>("VTKHDF/Connectivity", 0, 2 * state.size());
  const auto count = static_cast<std::int64_t>(scene.elements());
  for (std::size_t k = 0; k < state.size(); ++k) {
    const Pair pair{ends[2 * k], ends[2 * k + 1]};
    if (state[k] != 2 || !known.insert(pair).second) continue;
    if (pair.first < 0 || pair.second < 0 || pair.first >= count || pair.second >= count)
      throw dem::InputError(in.path().string(), "a link names an element that is not there", "run once more");
    scene.broken_links.push_back(
        {static_cast<std::uint32_t>(pair.first), static_cast<std::uint32_t>(pair.second), frame});
  }
}

/// Faces that only one hexahedron has, in VTK's order of corners.
std::vector<std::uint32_t> outer_faces(const std::vector<std::int64_t>& corners) {
  constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                               {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::map<std::array<std::int64_t, 4>, std::pair<int, std::array<std::int64_t, 4>>> seen;
  for (std::size_t element = 0; 8 * element + 7 < corners.size(); ++element)
    for (const auto& face : faces) {
      std::array<std::int64_t, 4> nodes{};
      for (std::size_t c = 0; c < 4; ++c) nodes[c] = corners[8 * element + static_cast<std::size_t>(face[c])];
      std::array<std::int64_t, 4> key = nodes;
      std::sort(key.begin(), key.end());
      auto& [times, kept] = seen[key];
      ++times;
      kept = nodes;
    }
  std::vector<std::uint32_t> outer;
  for (const auto& [key, face] : seen)
    if (face.first == 1)
      for (const std::int64_t node : face.second) outer.push_back(static_cast<std::uint32_t>(node));
  return outer;
}

void add_mesh(report::Scene& scene, report::Scene::Frame& frame, const dem::Hdf5File& in) {
  const std::vector<double> points = points_of(in);
  const std::vector<double> moved = vectors_of(in, "VTKHDF/PointData/displacement", points.size() / 3);
  if (scene.mesh_nodes.empty()) {
    for (std::size_t k = 0; k < points.size(); ++k)
      scene.mesh_nodes.push_back(static_cast<float>(points[k] - moved[k]));
    scene.mesh_faces = outer_faces(corners_of(in, points.size() / 3));
  }
  require_same_points(in, points.size(), scene.mesh_nodes.size());
  frame.mesh_displacements = as_float(moved);
}

/// Ends of the scales that are open yet: from zero to the largest value of all frames.
void close_scales(report::Scene& scene) {
  for (std::size_t f = 0; f < scene.fields.size(); ++f) {
    report::Scene::Field& field = scene.fields[f];
    if (field.to > field.from) continue;
    float largest = 0;
    for (const report::Scene::Frame& frame : scene.frames)
      for (const float value : frame.values[f]) largest = std::max(largest, value);
    field.to = largest > 0 ? static_cast<double>(largest) : 1;
  }
}

}  // namespace

std::optional<report::Scene> scene_of_frames(const std::filesystem::path& folder, const std::string& title) {
  const Files all = dem::read_frame_series(folder, "elements");
  if (all.empty()) return std::nullopt;
  const Files links = dem::read_frame_series(folder, "links"),
              meshes = dem::read_frame_series(folder, "finite_elements"),
              bodies = dem::read_frame_series(folder, "impactor");
  report::Scene scene;
  scene.title = title;
  std::set<Pair> broken;
  std::size_t body_numbers = 0;
  const std::size_t elements =
      dem::Hdf5File::open(all.front().first).read<double>("VTKHDF/Points", 3).size() / 3;
  for (const auto& [file, moment] : thinned(all, elements)) {
    report::Scene::Frame frame;
    frame.time = moment.time;
    frame.label = moment.label.empty() ? fmt::format("t = {:.2f} ms", 1e3 * moment.time) : moment.label;
    add_elements(scene, frame, dem::Hdf5File::open(file));
    if (const auto* other = at_moment(links, moment.time))
      add_broken_links(scene, broken, dem::Hdf5File::open(*other),
                       static_cast<std::uint32_t>(scene.frames.size()));
    if (const auto* other = at_moment(meshes, moment.time)) add_mesh(scene, frame, dem::Hdf5File::open(*other));
    if (const auto* other = at_moment(bodies, moment.time)) {
      const dem::Hdf5File in = dem::Hdf5File::open(*other);
      frame.body_points = as_float(points_of(in));
      if (scene.body_triangles.empty()) {
        for (const std::int64_t point : corners_of(in, frame.body_points.size() / 3))
          scene.body_triangles.push_back(static_cast<std::uint32_t>(point));
        body_numbers = frame.body_points.size();
      }
      require_same_points(in, frame.body_points.size(), body_numbers);
    }
    scene.frames.push_back(std::move(frame));
  }
  close_scales(scene);
  return scene;
}

}  // namespace app
