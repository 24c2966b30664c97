// Still pictures, read back pixel by pixel with libpng, and charts as SVG.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <sstream>

#include "libdem/core/error.h"
#include "report/picture_chart.h"
#include "report/picture_colours.h"
#include "report/picture_raster.h"
#include "report/picture_scene.h"

using report::Colour;
using report::Image;
using report::PicturePoint;
using report::Raster;
using testing::HasSubstr;

namespace {

/// Decodes a PNG file's bytes by libpng.
Image decoded(const std::string& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0)
    throw std::runtime_error(png.message);
  png.format = PNG_FORMAT_RGB;
  Image image{static_cast<int>(png.width), static_cast<int>(png.height),
              std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
  if (png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr) == 0)
    throw std::runtime_error(png.message);
  return image;
}

using Pixel = std::array<int, 3>;
constexpr Pixel white{255, 255, 255};

Pixel pixel(const Image& image, double x, double y) {
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

/// Which of the three channels is the brightest; -1 for white and grey.
int hue(const Pixel& p) {
  if (p[0] == p[1] && p[1] == p[2]) return -1;
  return static_cast<int>(std::max_element(p.begin(), p.end()) - p.begin());
}

constexpr Colour red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1};

/// Two spheres of 10 mm along y, the one in front (for a viewer before the x-z plane) damaged, in a box of 0.1
/// m.
report::Scene two_spheres() {
  report::Scene scene;
  scene.title = "two";
  scene.centres = {0.05F, 0.02F, 0.05F, 0.05F, 0.08F, 0.05F, 0.01F, 0.05F, 0.09F};
  scene.radii = {0.01F, 0.02F, 0.005F};
  scene.fields = {{"damage", "", 0, 1}, {"speed", "m/s", 0, 10}};
  report::Scene::Frame rest;
  rest.label = "rest";
  rest.displacements.assign(9, 0);
  rest.values = {{0, 0, 0}, {0, 0, 0}};
  report::Scene::Frame later = rest;
  later.label = "later";
  later.displacements[0] = 0.03F;  // the front one has moved aside
  later.values = {{1, 0, 0}, {10, 0, 0}};
  scene.frames = {rest, later};
  return scene;
}

/// The pixel where this point of the box is, seen along y.
Pixel seen_along_y(const report::ScenePicture& picture, double x, double z) {
  return pixel(picture.image, picture.origin_x + picture.scale * x, picture.origin_y - picture.scale * z);
}

Pixel shade_of(double value) {
  const Colour colour = report::colour_of(value);
  return {static_cast<int>(std::lround(255 * colour.red)), static_cast<int>(std::lround(255 * colour.green)),
          static_cast<int>(std::lround(255 * colour.blue))};
}

/// Same colour up to its brightness.
void expect_colour(const Pixel& found, const Pixel& wanted) {
  double dot = 0, a = 0, b = 0;
  for (std::size_t c = 0; c < 3; ++c)
    dot += found[c] * wanted[c], a += found[c] * found[c], b += wanted[c] * wanted[c];
  EXPECT_GT(dot / std::sqrt(a * b), 0.9995) << found[0] << " " << found[1] << " " << found[2];
  EXPECT_LE(a, b * 1.01);
}

report::Chart chart_of_three() {
  report::Chart chart;
  chart.title = "Stress & strain <1>";
  chart.x = {"strain", "permil"};
  chart.y = {"stress", "MPa"};
  chart.series = {{"band", report::Series::Kind::band, {0, 1, 2}, {0, 1, 2}, {1, 2, 3}},
                  {"line", report::Series::Kind::line, {0, 0.5, 2}, {0, 2, 1}},
                  {"points", report::Series::Kind::points, {0, 2}, {0, 3}}};
  return chart;
}

}  // namespace

TEST(PictureColours, GrowDarkerEvenly) {
  double last = 1e9, widest = 0, narrowest = 1e9;
  for (int k = 0; k <= 16; ++k) {
    const Colour c = report::colour_of(k / 16.0);
    const auto linear = [](double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); };
    const double light =
        116 * std::cbrt(0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue)) -
        16;  // CIE L*
    if (k > 0) widest = std::max(widest, last - light), narrowest = std::min(narrowest, last - light);
    last = light;
  }
  EXPECT_GT(narrowest, 0.6 * widest) << "readable in grey: every step is a step in lightness";
  EXPECT_EQ(report::hexadecimal(report::colour_of(-3)), report::hexadecimal(report::colour_of(0)));
  EXPECT_EQ(report::hexadecimal(report::colour_of(std::nan(""))), "#999999");
}

TEST(PictureRaster, TheNearerSphereHidesTheOtherWhateverTheOrder) {
  for (const bool red_first : {true, false}) {
    Raster raster(60, 40);
    const auto draw_red = [&] { raster.sphere({30, 20, 10}, 8, red); };
    if (red_first) draw_red();
    raster.sphere({30, 20, -10}, 16, green);
    if (!red_first) draw_red();
    const Image image = raster.finished();
    EXPECT_EQ(hue(pixel(image, 30, 20)), 0);
    EXPECT_EQ(hue(pixel(image, 30, 8)), 1);
    EXPECT_EQ(pixel(image, 30, 2), white);
    EXPECT_EQ(pixel(image, 5, 20), white);
  }
}

TEST(PictureRaster, SpheresPierceEachOtherWhereTheyMeet) {
  Raster raster(60, 40);
  raster.sphere({24, 20, 0}, 10, red);
  raster.sphere({36, 20, 0}, 10, green);
  const Image image = raster.finished();
  EXPECT_EQ(hue(pixel(image, 28, 20)), 0);
  EXPECT_EQ(hue(pixel(image, 31, 20)), 1);
}

TEST(PictureRaster, ACutShowsTheSectionAndWhatIsBehind) {
  Raster raster(60, 40);
  raster.cut({{0, 0, 1}, 0});              // all with z > 0 is gone
  raster.sphere({30, 20, 12}, 6, red);     // in front: gone
  raster.sphere({30, 20, -4}, 9, green);   // cut at z = 0: a disc of radius sqrt(81 - 16) = 8.06
  raster.sphere({30, 20, -40}, 18, blue);  // behind
  const Image image = raster.finished();
  EXPECT_EQ(hue(pixel(image, 30, 20)), 1);
  EXPECT_EQ(pixel(image, 30, 20), pixel(image, 35, 24)) << "the section is flat";
  EXPECT_NE(pixel(image, 30, 20), pixel(image, 38.6, 20)) << "beyond the section it is round";
  EXPECT_EQ(hue(pixel(image, 30, 8)), 2);
}

TEST(PictureRaster, ATriangleIsFilledAndCutAndALineLiesOnIt) {
  Raster raster(60, 40);
  raster.cut({{1, 0, 0}, 40});  // along the line of sight: x > 40 is gone
  raster.triangle({5, 5, 0}, {55, 5, 0}, {5, 35, 0}, green);
  raster.line({5, 10, 0}, {55, 10, 0}, 2, red);
  const Image image = raster.finished();
  EXPECT_EQ(hue(pixel(image, 10, 20)), 1);
  EXPECT_EQ(hue(pixel(image, 20, 10)), 0);
  EXPECT_EQ(pixel(image, 50, 30), white);
  EXPECT_EQ(pixel(image, 45, 6), white);
  EXPECT_EQ(pixel(image, 45, 10), white);
}

TEST(PictureRaster, EdgesAreSmooth) {
  Raster raster(40, 40);
  raster.sphere({20, 20, 0}, 12.4, blue);
  const Image image = raster.finished();
  std::set<int> levels;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 40; ++x) levels.insert(pixel(image, x, y)[0]);
  EXPECT_GE(levels.size(), 5u) << "between white and blue there is something";
}

TEST(PictureScene, SpheresAreWhereTheyShouldBe) {
  const report::Scene scene = two_spheres();
  report::ScenePictureOptions options;
  options.view = report::View::y;
  options.frame = 0;
  options.width = 100;
  options.dots_per_inch = 127;  // 5 pixels a millimetre
  const auto rest = report::scene_picture(scene, options);
  EXPECT_EQ(rest.image.width, 500);
  EXPECT_EQ(rest.image.rgb.size(), 3u * 500u * static_cast<std::size_t>(rest.image.height));
  // At rest the small sphere stands before the large one; both are undamaged.
  expect_colour(seen_along_y(rest, 0.05, 0.05), shade_of(0));
  expect_colour(seen_along_y(rest, 0.01, 0.09), shade_of(0));
  EXPECT_EQ(seen_along_y(rest, 0.01, 0.05), white);
  EXPECT_EQ(seen_along_y(rest, 0.05, 0.075), white) << "beyond the large sphere";

  options.frame = std::nullopt;  // the last: the damaged one has moved 30 mm
  const auto last = report::scene_picture(scene, options);
  expect_colour(seen_along_y(last, 0.08, 0.05), shade_of(1));
  expect_colour(seen_along_y(last, 0.05, 0.05), shade_of(0));
  EXPECT_THAT(last.words, HasSubstr("later"));

  options.cut = report::SceneCut{1, 0.05};  // takes away what is nearer than y = 0.05: the small one, moved
  const auto cut = report::scene_picture(scene, options);
  EXPECT_EQ(seen_along_y(cut, 0.08, 0.05), white);
  expect_colour(seen_along_y(cut, 0.05, 0.05), shade_of(0));
}

TEST(PictureScene, FieldsColourAndTheirScaleIsWritten) {
  report::ScenePictureOptions options;
  options.view = report::View::y;
  options.field = 1;
  const auto picture = report::scene_picture(two_spheres(), options);
  expect_colour(seen_along_y(picture, 0.08, 0.05), shade_of(1));
  EXPECT_THAT(picture.words, testing::AllOf(HasSubstr("speed [m/s]"), HasSubstr(">7.5<"), HasSubstr(">10<")));
  options.field = 2;
  EXPECT_THROW(report::scene_picture(two_spheres(), options), std::invalid_argument);
  options.field = 0;
  options.frame = 2;
  EXPECT_THROW(report::scene_picture(two_spheres(), options), std::invalid_argument);
}

TEST(PictureScene, AMeshHidesAndIsCutAndABodyIsDrawn) {
  report::Scene scene = two_spheres();
  scene.mesh_nodes = {0, 0, 0, 0.1F, 0, 0, 0.1F, 0, 0.1F, 0, 0, 0.1F};  // a face at y = 0, before everything
  scene.mesh_faces = {0, 1, 2, 3};
  scene.body_triangles = {0, 1, 2};
  scene.frames[1].body_points = {0.02F, -0.01F, 0.02F, 0.04F, -0.01F, 0.02F, 0.02F, -0.01F, 0.04F};
  report::ScenePictureOptions options;
  options.view = report::View::y;
  const auto whole = report::scene_picture(scene, options);
  const Pixel face = seen_along_y(whole, 0.05, 0.05), body = seen_along_y(whole, 0.025, 0.025);
  EXPECT_LT(std::abs(face[0] - face[2]), 15) << "the mesh is grey";
  EXPECT_NE(face, white);
  EXPECT_NE(body, face);
  options.cut = report::SceneCut{1, 0.001};
  expect_colour(seen_along_y(report::scene_picture(scene, options), 0.05, 0.05), shade_of(0));
}

TEST(PicturePng, DecodesToTheSamePixelsAndHasWordsOnTop) {
  const auto picture = report::scene_picture(two_spheres(), {});
  const std::string bytes = report::png_of(picture.image, picture.words);
  const Image image = decoded(bytes);
  ASSERT_EQ(image.width, picture.image.width);
  ASSERT_EQ(image.height, picture.image.height);
  std::size_t others = 0;
  for (std::size_t k = 0; k < image.rgb.size(); ++k) others += image.rgb[k] != picture.image.rgb[k];
  EXPECT_GT(others, 1000u) << "the words are there";
  EXPECT_LT(others, image.rgb.size() / 4);
  const auto middle = static_cast<std::size_t>(image.height) / 2;
  EXPECT_EQ(std::memcmp(&image.rgb[3 * middle * static_cast<std::size_t>(image.width)],
                        &picture.image.rgb[3 * middle * static_cast<std::size_t>(image.width)], 900),
            0);
  EXPECT_EQ(bytes, report::png_of(picture.image, picture.words)) << "same input, same bytes";
  const auto again = report::scene_picture(two_spheres(), {});
  EXPECT_EQ(picture.image.rgb, again.image.rgb);
}

TEST(PictureChart, HasItsSizeInMillimetresAndInPixels) {
  const std::string svg = report::chart_picture(chart_of_three(), 120);
  EXPECT_THAT(svg, HasSubstr("width=\"120mm\""));
  EXPECT_THAT(svg, HasSubstr("Stress &amp; strain &lt;1&gt;"));
  EXPECT_THAT(svg, testing::Not(HasSubstr("var(")));
  const Image image = decoded(report::png_of(svg, 254));
  EXPECT_EQ(image.width, 1200);
  EXPECT_NEAR(image.height, 1200 * (430 + 50) / 860, 2);
  // Blue, orange and green of the three series are somewhere; the corner is paper.
  EXPECT_EQ(pixel(image, 1, 1), white);
  std::set<int> hues;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Pixel p = pixel(image, x, y);
      if (*std::max_element(p.begin(), p.end()) - *std::min_element(p.begin(), p.end()) > 22)
        hues.insert(hue(p));
    }
  EXPECT_EQ(hues, (std::set<int>{0, 1, 2}));
}

// librsvg takes well-formed XML only.
TEST(PictureChart, IsXmlThatHoldsTheCurvesPoints) {
  const std::string svg = report::chart_picture(chart_of_three(), 120);
  EXPECT_NO_THROW(report::png_of(svg, 50));
  EXPECT_THROW(report::png_of(svg.substr(0, svg.size() - 8), 50), dem::RunError);
  const std::string begin = "class=\"line c1\" d=\"M";
  const auto at = svg.rfind(begin);
  ASSERT_NE(at, std::string::npos);
  std::string path = svg.substr(at + begin.size(), svg.find('"', at + begin.size()) - at - begin.size());
  std::replace(path.begin(), path.end(), 'L', ' ');
  std::istringstream in(path);
  std::array<double, 6> p{};
  for (double& value : p) in >> value;
  ASSERT_TRUE(in) << path;
  EXPECT_NEAR((p[2] - p[0]) / (p[4] - p[0]), 0.5 / 2, 1e-3);
  EXPECT_NEAR((p[1] - p[5]) / (p[1] - p[3]), 1.0 / 2, 1e-3);
}

TEST(PictureChart, RefusesColumnsOfDifferentLengths) {
  report::Chart chart = chart_of_three();
  chart.series[1].y.pop_back();
  EXPECT_THROW(report::chart_picture(chart, 100), std::invalid_argument);
}
