// A scene's way into a page: what is drawn is what was computed, to half a quantum, and it stays small.
#include "report/scene_pack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "report/page.h"
#include "report/scene_html.h"
#include "tests/scenes/report_scene.h"

using testing::HasSubstr;
using testing::Not;

namespace {

// The other side, written from the description in scene_pack.h alone.
struct Reader {
  std::string raw;
  std::size_t at = 0;

  // `width` bytes an integer, sign extended differences added to `codes`.
  void differences(std::vector<std::int64_t>& codes, int width) {
    const std::size_t n = codes.size();
    const std::int64_t modulus = std::int64_t{1} << (8 * width);
    for (std::size_t k = 0; k < n; ++k) {
      std::int64_t folded = 0;
      for (int rank = 0; rank < width; ++rank)
        folded += static_cast<std::int64_t>(
                      static_cast<unsigned char>(raw.at(at + static_cast<std::size_t>(rank) * n + k)))
                  << (8 * rank);
      codes[k] += folded % 2 == 1 ? -(folded + 1) / 2 : folded / 2;
      codes[k] = (codes[k] % modulus + modulus) % modulus;
    }
    at += n * static_cast<std::size_t>(width);
  }
  std::vector<std::int64_t> along(std::size_t n, int width) {
    std::vector<std::int64_t> steps(n, 0);
    differences(steps, width);
    const std::int64_t modulus = std::int64_t{1} << (8 * width);
    for (std::size_t k = 1; k < n; ++k) steps[k] = (steps[k] + steps[k - 1]) % modulus;
    return steps;
  }
};

std::int64_t as_signed(std::int64_t code) { return code >= 32768 ? code - 65536 : code; }

Reader inflated(const report::PackedScene& packed) {
  Reader reader;
  reader.raw.resize(packed.raw_bytes);
  uLongf size = reader.raw.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(reader.raw.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data.data()), packed.data.size()),
            Z_OK);
  EXPECT_EQ(size, packed.raw_bytes);
  return reader;
}

}  // namespace

TEST(ScenePack, GivesEveryNumberBackWithinHalfAQuantum) {
  report::Scene scene = scenes::report_scene(600, 7);
  scene.frames[3].values[0][17] = std::numeric_limits<float>::quiet_NaN();
  const report::PackedScene packed = report::pack(scene);
  const auto header = nlohmann::json::parse(packed.header);
  Reader reader = inflated(packed);
  const std::size_t n = scene.elements(), nodes = scene.mesh_nodes.size() / 3,
                    points = scene.frames[0].body_points.size() / 3;
  ASSERT_GT(nodes, 0u);
  ASSERT_GT(points, 0u);
  ASSERT_FALSE(scene.broken_links.empty());
  double largest_centre = 0, largest_move = 0, largest_value = 0;
  // |v - (low + code quantum)| over the quantum; single precision of the data itself comes on top.
  const auto miss = [](double value, double low, double quantum, std::int64_t code) {
    if (quantum == 0) return value == low ? 0.0 : INFINITY;  // all of them are one value
    return std::abs(value - (low + quantum * static_cast<double>(code))) / quantum;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto codes = reader.along(n, 2);
    for (std::size_t k = 0; k < n; ++k)
      largest_centre =
          std::max(largest_centre, miss(scene.centres[3 * k + axis], header["centres"]["low"][axis],
                                        header["centres"]["quantum"][axis], codes[k]));
  }
  for (std::size_t k = 0; k < n; ++k)
    EXPECT_LE(miss(scene.radii[k], header["radii"]["low"], header["radii"]["quantum"],
                   static_cast<unsigned char>(reader.raw[reader.at + k])),
              0.501);
  reader.at += n;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto codes = reader.along(nodes, 2);
    for (std::size_t k = 0; k < nodes; ++k)
      EXPECT_LE(miss(scene.mesh_nodes[3 * k + axis], header["mesh"]["box"]["low"][axis],
                     header["mesh"]["box"]["quantum"][axis], codes[k]),
                0.51);
  }
  const auto faces = reader.along(scene.mesh_faces.size(), 4);
  EXPECT_TRUE(std::equal(faces.begin(), faces.end(), scene.mesh_faces.begin()));
  const auto triangles = reader.along(scene.body_triangles.size(), 4);
  EXPECT_TRUE(std::equal(triangles.begin(), triangles.end(), scene.body_triangles.begin()));
  const std::size_t links = scene.broken_links.size();
  const auto first = reader.along(links, 4), second = reader.along(links, 4), when = reader.along(links, 4);
  for (std::size_t k = 0; k < links; ++k) {
    EXPECT_EQ(first[k], scene.broken_links[k].first);
    EXPECT_EQ(second[k], scene.broken_links[k].second);
    EXPECT_EQ(when[k], scene.broken_links[k].frame);
  }
  std::vector<std::vector<std::int64_t>> move(3, std::vector<std::int64_t>(n)),
      value(2, std::vector<std::int64_t>(n)), mesh_move(3, std::vector<std::int64_t>(nodes)),
      point(3, std::vector<std::int64_t>(points));
  for (std::size_t f = 0; f < scene.frames.size(); ++f) {
    const auto& frame = scene.frames[f];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      reader.differences(move[axis], 2);
      for (std::size_t k = 0; k < n; ++k)
        largest_move = std::max(largest_move, miss(frame.displacements[3 * k + axis], 0,
                                                   header["displacement_quantum"], as_signed(move[axis][k])));
    }
    for (std::size_t field = 0; field < 2; ++field) {
      reader.differences(value[field], 1);
      for (std::size_t k = 0; k < n; ++k) {
        if (std::isnan(frame.values[field][k]))
          EXPECT_EQ(value[field][k], report::no_value);
        else
          largest_value = std::max(largest_value, miss(frame.values[field][k], header["fields"][field]["low"],
                                                       header["fields"][field]["quantum"], value[field][k]));
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      reader.differences(mesh_move[axis], 2);
      for (std::size_t k = 0; k < nodes; ++k)
        EXPECT_LE(miss(frame.mesh_displacements[3 * k + axis], 0, header["mesh"]["displacement_quantum"],
                       as_signed(mesh_move[axis][k])),
                  0.51);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      reader.differences(point[axis], 2);
      for (std::size_t k = 0; k < points; ++k)
        EXPECT_LE(miss(frame.body_points[3 * k + axis], header["body"]["box"]["low"][axis],
                       header["body"]["box"]["quantum"][axis], point[axis][k]),
                  0.51);
    }
  }
  EXPECT_EQ(reader.at, reader.raw.size());
  for (const double largest : {largest_centre, largest_move, largest_value}) {
    EXPECT_LE(largest, 0.501);
    EXPECT_GT(largest, 0.25);
  }
}

TEST(ScenePack, KeepsTwentyThousandElementsInTwentyFramesUnderThreeMegabytes) {
  const report::PackedScene packed = report::pack(scenes::report_scene(20000, 20));
  const std::size_t in_page = report::base64(packed.data).size() + packed.header.size();
  RecordProperty("raw_bytes", std::to_string(packed.raw_bytes));
  RecordProperty("bytes_in_page", std::to_string(in_page));
  std::printf("20,000 elements, 20 frames: %zu bytes raw, %zu in the page\n", packed.raw_bytes, in_page);
  EXPECT_LT(in_page, 3u << 20);
}

TEST(ScenePack, WritesBase64AsOthersReadIt) {
  EXPECT_EQ(report::base64(""), "");
  EXPECT_EQ(report::base64("f"), "Zg==");
  EXPECT_EQ(report::base64("fo"), "Zm8=");
  EXPECT_EQ(report::base64("foobar"), "Zm9vYmFy");
  const std::string large(5 << 20, 'x');
  const std::string encoded = report::base64(large);
  EXPECT_EQ(encoded.size(), 4 * ((large.size() + 2) / 3));
  EXPECT_EQ(encoded.find('\0'), std::string::npos);
}

TEST(ScenePack, RefusesWhatDoesNotFitTogether) {
  const auto refusal = [](auto spoil) -> std::string {
    report::Scene scene = scenes::report_scene(60, 3);
    scene.title = "slab";
    spoil(scene);
    try {
      report::pack(scene);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal([](auto&) {}), "");
  EXPECT_THAT(refusal([](auto& s) { s.centres.pop_back(); }), HasSubstr("scene 'slab': centres"));
  EXPECT_THAT(refusal([](auto& s) { s.frames.clear(); }), HasSubstr("no frames"));
  EXPECT_THAT(refusal([](auto& s) { s.frames[1].values.pop_back(); }), HasSubstr("fields of a frame"));
  EXPECT_THAT(refusal([](auto& s) { s.frames[1].values[0].pop_back(); }), HasSubstr("values of a field"));
  EXPECT_THAT(refusal([](auto& s) { s.frames[2].displacements[5] = std::numeric_limits<float>::infinity(); }),
              HasSubstr("displacements: a number is not finite"));
  EXPECT_THAT(refusal([](auto& s) { s.broken_links[0].second = 60; }),
              HasSubstr("a broken link names number 60 of 60"));
  EXPECT_THAT(refusal([](auto& s) { s.mesh_faces[0] = 99999; }), HasSubstr("a mesh face"));
}

TEST(SceneInAPage, SaysInWordsWhatItShowsAndBringsTheScriptAlong) {
  report::Scene scene = scenes::report_scene(1200, 3);
  scene.title = "Slab <1>";
  report::Page page;
  page.title = "Impact";
  EXPECT_THAT(report::to_html(page), Not(HasSubstr("spall_space")));
  page.sections = {{"In space", {scene}}};
  const std::string html = report::to_html(page);
  EXPECT_THAT(html, HasSubstr("<h3>Slab &lt;1&gt;</h3>"));
  EXPECT_THAT(html, HasSubstr("1,200 elements and a mesh of"));
  EXPECT_THAT(html, HasSubstr("in 3 frames, from t = 0 ms to t = "));
  EXPECT_THAT(html, HasSubstr("damage up to 1"));
  EXPECT_THAT(html, HasSubstr("links broken."));
  EXPECT_THAT(html, HasSubstr("needs scripts"));
}
