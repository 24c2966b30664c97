#include "report/scene_pack.h"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "report/html.h"

namespace report {
namespace {

using Codes = std::vector<std::uint32_t>;

// low + code * quantum is the value.
struct Quantiser {
  double low = 0, quantum = 0;

  double code(double value) const { return quantum > 0 ? std::round((value - low) / quantum) : 0; }
};

struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void take(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  Quantiser over(int codes) const {
    return low <= high ? Quantiser{low, (high - low) / (codes - 1)} : Quantiser{};
  }
};

// Columns of small integers, as bytes.
class Bytes {
 public:
  std::string bytes;

  // Each difference of `codes` from `before` (modulo the width), in `width` bytes.
  void add(const Codes& codes, const Codes& before, int width) {
    const std::size_t begin = bytes.size(), count = codes.size();
    bytes.resize(begin + count * static_cast<std::size_t>(width));
    const int unused = 32 - 8 * width;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t shifted = (codes[k] - before[k]) << unused;
      const auto difference = static_cast<std::int32_t>(shifted) >> unused;
      const std::uint32_t folded = difference < 0 ? 2 * static_cast<std::uint32_t>(-(difference + 1)) + 1
                                                  : 2 * static_cast<std::uint32_t>(difference);
      for (int rank = 0; rank < width; ++rank)
        bytes[begin + static_cast<std::size_t>(rank) * count + k] =
            static_cast<char>(folded >> (8 * rank) & 0xff);
    }
  }

  void add_along(const Codes& codes, int width) {
    Codes before(codes.size(), 0);
    std::copy(codes.begin(), codes.empty() ? codes.end() : codes.end() - 1,
              before.empty() ? before.begin() : before.begin() + 1);
    add(codes, before, width);
  }

  // The same column, frame after frame.
  void add_next(Codes codes, Codes& last, int width) {
    last.resize(codes.size(), 0);
    add(codes, last, width);
    last = std::move(codes);
  }
};

std::array<Quantiser, 3> boxes(const std::vector<const std::vector<float>*>& lists) {
  std::array<Span, 3> spans;
  for (const auto* list : lists)
    for (std::size_t k = 0; k < list->size(); ++k) spans[k % 3].take((*list)[k]);
  return {spans[0].over(65536), spans[1].over(65536), spans[2].over(65536)};
}

Quantiser about_zero(const std::vector<const std::vector<float>*>& lists) {
  double largest = 0;
  for (const auto* list : lists)
    for (const float value : *list) largest = std::max(largest, std::abs(static_cast<double>(value)));
  return {0, largest / 32767};
}

Codes column(const std::vector<float>& vectors, std::size_t axis, const Quantiser& by) {
  Codes codes(vectors.size() / 3);
  for (std::size_t k = 0; k < codes.size(); ++k)
    codes[k] = static_cast<std::uint32_t>(static_cast<std::int32_t>(by.code(vectors[3 * k + axis])));
  return codes;
}

Codes value_codes(const std::vector<float>& values, const Quantiser& by) {
  Codes codes(values.size());
  for (std::size_t k = 0; k < codes.size(); ++k)
    codes[k] =
        std::isfinite(values[k]) ? static_cast<std::uint32_t>(by.code(values[k])) : std::uint32_t{no_value};
  return codes;
}

nlohmann::json json_of(const std::array<Quantiser, 3>& by) {
  return {{"low", {by[0].low, by[1].low, by[2].low}},
          {"quantum", {by[0].quantum, by[1].quantum, by[2].quantum}}};
}

class Check {
 public:
  explicit Check(const Scene& scene) : scene_(scene) {}

  void all() const {
    const std::size_t n = scene_.elements(), nodes = scene_.mesh_nodes.size() / 3;
    length("centres", scene_.centres.size(), 3 * n);
    finite("centres", scene_.centres);
    finite("radii", scene_.radii);
    length("mesh nodes", scene_.mesh_nodes.size() % 3, 0);
    finite("mesh nodes", scene_.mesh_nodes);
    length("mesh faces", scene_.mesh_faces.size() % 4, 0);
    length("body triangles", scene_.body_triangles.size() % 3, 0);
    if (scene_.frames.empty()) fail("it has no frames");
    const std::size_t points = scene_.frames.front().body_points.size();
    for (const std::uint32_t node : scene_.mesh_faces) index("a mesh face", node, nodes);
    for (const std::uint32_t point : scene_.body_triangles) index("a body triangle", point, points / 3);
    for (const Scene::BrokenLink& link : scene_.broken_links) {
      index("a broken link", link.first, n);
      index("a broken link", link.second, n);
    }
    for (const Scene::Frame& frame : scene_.frames) {
      length("displacements of a frame", frame.displacements.size(), 3 * n);
      finite("displacements", frame.displacements);
      length("fields of a frame", frame.values.size(), scene_.fields.size());
      for (const auto& values : frame.values) length("values of a field", values.size(), n);
      length("displacements of the mesh", frame.mesh_displacements.size(), 3 * nodes);
      finite("displacements of the mesh", frame.mesh_displacements);
      length("points of the body", frame.body_points.size(), points);
      finite("points of the body", frame.body_points);
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument(fmt::format("scene '{}': {}", scene_.title, what));
  }
  void length(const char* what, std::size_t is, std::size_t should) const {
    if (is != should) fail(fmt::format("{}: {} numbers instead of {}", what, is, should));
  }
  void finite(const char* what, const std::vector<float>& values) const {
    for (const float value : values)
      if (!std::isfinite(value)) fail(fmt::format("{}: a number is not finite", what));
  }
  void index(const char* what, std::size_t is, std::size_t count) const {
    if (is >= count) fail(fmt::format("{} names number {} of {}", what, is, count));
  }
  const Scene& scene_;
};

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  // Fails only without memory: the room is what zlib asks for.
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), 6) != Z_OK)
    throw std::bad_alloc();
  out.resize(size);
  return out;
}

}  // namespace

PackedScene pack(const Scene& scene) {
  Check(scene).all();
  std::vector<const std::vector<float>*> moves, mesh_moves, body;
  for (const Scene::Frame& frame : scene.frames) {
    moves.push_back(&frame.displacements);
    mesh_moves.push_back(&frame.mesh_displacements);
    body.push_back(&frame.body_points);
  }
  const auto by_centre = boxes({&scene.centres}), by_node = boxes({&scene.mesh_nodes}), by_point = boxes(body);
  const Quantiser by_move = about_zero(moves), by_mesh_move = about_zero(mesh_moves);
  Span radii;
  for (const float radius : scene.radii) radii.take(radius);
  const Quantiser by_radius = radii.over(256);

  nlohmann::json fields = nlohmann::json::array();
  std::vector<Quantiser> by_field;
  for (std::size_t f = 0; f < scene.fields.size(); ++f) {
    Span span;
    for (const Scene::Frame& frame : scene.frames)
      for (const float value : frame.values[f]) span.take(value);
    by_field.push_back(span.over(no_value));
    const Scene::Field& field = scene.fields[f];
    fields.push_back({{"name", field.name},
                      {"unit", field.unit},
                      {"from", field.from},
                      {"to", field.to},
                      {"low", by_field[f].low},
                      {"quantum", by_field[f].quantum}});
  }

  Bytes out;
  for (std::size_t axis = 0; axis < 3; ++axis) out.add_along(column(scene.centres, axis, by_centre[axis]), 2);
  for (const float radius : scene.radii)
    out.bytes += static_cast<char>(static_cast<unsigned char>(by_radius.code(radius)));
  for (std::size_t axis = 0; axis < 3; ++axis) out.add_along(column(scene.mesh_nodes, axis, by_node[axis]), 2);
  out.add_along(scene.mesh_faces, 4);
  out.add_along(scene.body_triangles, 4);
  Codes first, second, when;
  for (const Scene::BrokenLink& link : scene.broken_links) {
    first.push_back(link.first);
    second.push_back(link.second);
    when.push_back(link.frame);
  }
  for (const Codes* codes : {&first, &second, &when}) out.add_along(*codes, 4);
  std::array<Codes, 3> move, mesh_move, point;
  std::vector<Codes> value(scene.fields.size());
  nlohmann::json frames = nlohmann::json::array();
  for (const Scene::Frame& frame : scene.frames) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      out.add_next(column(frame.displacements, axis, by_move), move[axis], 2);
    for (std::size_t f = 0; f < by_field.size(); ++f)
      out.add_next(value_codes(frame.values[f], by_field[f]), value[f], 1);
    for (std::size_t axis = 0; axis < 3; ++axis)
      out.add_next(column(frame.mesh_displacements, axis, by_mesh_move), mesh_move[axis], 2);
    for (std::size_t axis = 0; axis < 3; ++axis)
      out.add_next(column(frame.body_points, axis, by_point[axis]), point[axis], 2);
    frames.push_back({{"time", frame.time}, {"label", frame.label}});
  }

  const nlohmann::json header = {{"title", scene.title},
                                 {"elements", scene.elements()},
                                 {"centres", json_of(by_centre)},
                                 {"radii", {{"low", by_radius.low}, {"quantum", by_radius.quantum}}},
                                 {"displacement_quantum", by_move.quantum},
                                 {"mesh",
                                  {{"nodes", scene.mesh_nodes.size() / 3},
                                   {"indices", scene.mesh_faces.size()},
                                   {"box", json_of(by_node)},
                                   {"displacement_quantum", by_mesh_move.quantum}}},
                                 {"body",
                                  {{"points", scene.frames.front().body_points.size() / 3},
                                   {"indices", scene.body_triangles.size()},
                                   {"box", json_of(by_point)}}},
                                 {"links", scene.broken_links.size()},
                                 {"fields", std::move(fields)},
                                 {"frames", std::move(frames)},
                                 {"raw_bytes", out.bytes.size()}};
  return {script_json(header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)),
          deflated(out.bytes), out.bytes.size()};
}

std::string base64(const std::string& bytes) {
  std::string out(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  // By pieces of whole triples: the library counts in int.
  constexpr std::size_t piece = 3 << 20;
  std::size_t length = 0;
  for (std::size_t begin = 0; begin < bytes.size(); begin += piece)
    length +=
        static_cast<std::size_t>(EVP_EncodeBlock(reinterpret_cast<unsigned char*>(out.data() + length),
                                                 reinterpret_cast<const unsigned char*>(bytes.data() + begin),
                                                 static_cast<int>(std::min(piece, bytes.size() - begin))));
  out.resize(length);
  return out;
}

}  // namespace report
