#include "report/picture_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "report/html.h"
#include "report/picture_raster.h"

namespace report {
namespace {

using Vector = std::array<double, 3>;

constexpr Colour mesh_colour{0.87, 0.89, 0.91}, edge_colour{0.45, 0.49, 0.53}, body_colour{0.55, 0.6, 0.68};

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Orthogonal projection: unit vectors to the right, up, and towards the viewer.
struct Camera {
  Vector right, up, towards;
};

Camera camera_of(View view) {
  switch (view) {
    case View::x:
      return {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
    case View::y:
      return {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    case View::z:
      return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    case View::iso:
      break;
  }
  constexpr double around = 0.62, above = 0.46;  // [rad]
  const double s = std::sin(around), c = std::cos(around), t = std::sin(above), u = std::cos(above);
  return {{c, s, 0}, {-t * s, t * c, u}, {u * s, -u * c, t}};
}

Vector point(const std::vector<float>& values, std::size_t k) {
  return {static_cast<double>(values[3 * k]), static_cast<double>(values[3 * k + 1]),
          static_cast<double>(values[3 * k + 2])};
}

/// Where point k is in this frame.
Vector moved(const std::vector<float>& start, const std::vector<float>& displacement, std::size_t k) {
  Vector at = point(start, k);
  if (displacement.size() == start.size())
    for (std::size_t c = 0; c < 3; ++c) at[c] += static_cast<double>(displacement[3 * k + c]);
  return at;
}

/// What the picture has to hold, along the camera's right and up [m].
struct Bounds {
  double left = std::numeric_limits<double>::infinity(), right = -left, low = left, high = -left;

  void take(const Camera& camera, const Vector& at, double radius) {
    const double u = dot(camera.right, at), v = dot(camera.up, at);
    left = std::min(left, u - radius);
    right = std::max(right, u + radius);
    low = std::min(low, v - radius);
    high = std::max(high, v + radius);
  }
};

/// The scene at the start and some air for what moves; of a body as much as half the scene's size beside it.
Bounds bounds_of(const Scene& scene, const Scene::Frame& frame, const Camera& camera) {
  Bounds all;
  for (std::size_t k = 0; k < scene.elements(); ++k)
    all.take(camera, point(scene.centres, k), static_cast<double>(scene.radii[k]));
  for (std::size_t k = 0; 3 * k + 2 < scene.mesh_nodes.size(); ++k)
    all.take(camera, point(scene.mesh_nodes, k), 0);
  if (!(all.left < all.right)) all = {0, 1, 0, 1};
  const double size = std::max(all.right - all.left, all.high - all.low);
  Bounds with_body = all;
  for (std::size_t k = 0; 3 * k + 2 < frame.body_points.size(); ++k)
    with_body.take(camera, point(frame.body_points, k), 0);
  all.left = std::max(with_body.left, all.left - 0.5 * size) - 0.03 * size;
  all.right = std::min(with_body.right, all.right + 0.5 * size) + 0.03 * size;
  all.low = std::max(with_body.low, all.low - 0.5 * size) - 0.03 * size;
  all.high = std::min(with_body.high, all.high + 0.5 * size) + 0.03 * size;
  return all;
}

/// The picture's layout in pixels, and the way from metres to them.
struct Layout {
  double millimetre;               // pixels
  double top, bottom, left, side;  // margins: title, scale bar, air, colour bar
  int width, height;
  double scale, origin_x, origin_y;
  Camera camera;

  Layout(const ScenePictureOptions& options, const Bounds& bounds, const Camera& from) : camera(from) {
    millimetre = options.dots_per_inch / 25.4;
    top = 9 * millimetre, bottom = 9 * millimetre, left = 2 * millimetre, side = 24 * millimetre;
    width = static_cast<int>(std::lround(options.width * millimetre));
    const double room = std::max(1.0, width - left - side);
    const double wide = bounds.right - bounds.left, high = bounds.high - bounds.low;
    scale = std::min(room / wide, 1.1 * room / high);
    const double tall = std::max(scale * high, 30 * millimetre);
    height = static_cast<int>(std::lround(top + tall + bottom));
    origin_x = left + 0.5 * room - scale * 0.5 * (bounds.left + bounds.right);
    origin_y = top + 0.5 * tall + scale * 0.5 * (bounds.low + bounds.high);
  }

  PicturePoint operator()(const Vector& at) const {
    return {origin_x + scale * dot(camera.right, at), origin_y - scale * dot(camera.up, at),
            scale * dot(camera.towards, at)};
  }
};

CutPlane plane_of(const SceneCut& cut, const Layout& layout) {
  const auto axis = static_cast<std::size_t>(cut.axis);
  const double towards = layout.camera.towards[axis];
  const double sign = towards < -1e-9 ? -1 : 1;  // what is taken away is on the viewer's side
  const PicturePoint normal{sign * layout.camera.right[axis], -sign * layout.camera.up[axis], sign * towards};
  // A point's coordinate is (p - origin) . normal / scale times the sign.
  return {normal, sign * cut.at * layout.scale + normal.x * layout.origin_x + normal.y * layout.origin_y};
}

void draw_mesh(const Scene& scene, const Scene::Frame& frame, const Layout& layout, Raster& raster) {
  for (std::size_t face = 0; 4 * face + 3 < scene.mesh_faces.size(); ++face) {
    std::array<PicturePoint, 4> p;
    for (std::size_t c = 0; c < 4; ++c)
      p[c] = layout(moved(scene.mesh_nodes, frame.mesh_displacements, scene.mesh_faces[4 * face + c]));
    raster.triangle(p[0], p[1], p[2], mesh_colour);
    raster.triangle(p[0], p[2], p[3], mesh_colour);
    for (std::size_t c = 0; c < 4; ++c)
      raster.line(p[c], p[(c + 1) % 4], 0.18 * layout.millimetre, edge_colour);
  }
}

double round_length(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  return power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1);
}

/// Title, moment, colour bar, scale bar and axes, as an SVG of the picture's pixels.
std::string words_of(const Scene& scene, const Scene::Frame& frame, const ScenePictureOptions& options,
                     const Layout& layout) {
  const double mm = layout.millimetre;
  std::string body;
  const auto text = [&](double x, double y, const char* anchor, const std::string& words,
                        const char* more = "") {
    body += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor, more,
                        escape(words));
  };
  text(2 * mm, 5.5 * mm, "start", scene.title, " font-weight=\"bold\" font-size=\"115%\"");
  text(layout.width - 2 * mm, 5.5 * mm, "end", frame.label);

  if (!scene.fields.empty()) {
    const Scene::Field& field = scene.fields[options.field];
    const double x = layout.width - 20 * mm, wide = 4 * mm;
    const double low = layout.height - 14 * mm, high = std::max(layout.top + 8 * mm, low - 60 * mm);
    constexpr int steps = 64;
    for (int k = 0; k < steps; ++k) {
      const double y = low + (high - low) * (k + 1) / steps;
      body += fmt::format(
          "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
          "shape-rendering=\"crispEdges\"/>",
          x, y, wide, (low - high) / steps + 0.5, hexadecimal(colour_of((k + 0.5) / steps)));
    }
    body += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"none\" stroke=\"#3b444d\" "
        "stroke-width=\"{:.2f}\"/>",
        x, high, wide, low - high, 0.15 * mm);
    for (int k = 0; k <= 4; ++k)
      text(x + wide + 1.2 * mm, low + (high - low) * k / 4 + 1 * mm, "start",
           number_text(field.from + (field.to - field.from) * k / 4, 3));
    text(x, high - 2.5 * mm, "start",
         field.unit.empty() ? field.name : fmt::format("{} [{}]", field.name, field.unit));
  }

  const double length = round_length(0.25 * (layout.width - layout.left - layout.side) / layout.scale);
  const double y = layout.height - 3.5 * mm, x = 4 * mm, end = x + length * layout.scale;
  body += fmt::format(
      "<path d=\"M{:.2f} {:.2f}v{:.2f}H{:.2f}v{:.2f}\" fill=\"none\" stroke=\"#1d2126\" "
      "stroke-width=\"{:.2f}\"/>",
      x, y - mm, mm, end, -mm, 0.3 * mm);
  text(end + 1.5 * mm, y + 0.4 * mm, "start",
       length < 0.1 ? fmt::format("{:g} mm", 1000 * length) : fmt::format("{:g} m", length));

  // The axes, at the lower right.
  const double ax = layout.width - 17 * mm, ay = layout.height - 5.5 * mm;
  for (std::size_t c = 0; c < 3; ++c) {
    const double dx = 5 * mm * layout.camera.right[c], dy = -5 * mm * layout.camera.up[c];
    if (std::hypot(dx, dy) < 0.5 * mm) continue;
    body += fmt::format("<path d=\"M{:.2f} {:.2f}l{:.2f} {:.2f}\" stroke=\"#5b646e\" stroke-width=\"{:.2f}\"/>",
                        ax, ay, dx, dy, 0.25 * mm);
    text(ax + 1.35 * dx, ay + 1.35 * dy + 0.9 * mm, "middle", std::string(1, "xyz"[c]), " font-size=\"85%\"");
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" "
      "font-size=\"{2:.2f}\" fill=\"#1d2126\">{3}</svg>",
      layout.width, layout.height, 2.9 * mm, body);
}

}  // namespace

const std::vector<std::string>& view_names() {
  static const std::vector<std::string> names{"iso", "x", "y", "z"};
  return names;
}

ScenePicture scene_picture(const Scene& scene, const ScenePictureOptions& options) {
  if (scene.frames.empty() || options.frame.value_or(0) >= scene.frames.size())
    throw std::invalid_argument(
        fmt::format("scene \"{}\": it has {} frames", scene.title, scene.frames.size()));
  if (options.field >= std::max<std::size_t>(scene.fields.size(), 1))
    throw std::invalid_argument(
        fmt::format("scene \"{}\": it has {} fields", scene.title, scene.fields.size()));
  const Scene::Frame& frame = scene.frames[options.frame.value_or(scene.frames.size() - 1)];
  const Camera camera = camera_of(options.view);
  const Layout layout(options, bounds_of(scene, frame, camera), camera);

  Raster raster(layout.width, layout.height);
  if (options.cut) raster.cut(plane_of(*options.cut, layout));
  const bool coloured = options.field < scene.fields.size() && options.field < frame.values.size() &&
                        frame.values[options.field].size() == scene.elements();
  for (std::size_t k = 0; k < scene.elements(); ++k) {
    Colour colour{0.75, 0.75, 0.75};
    if (coloured) {
      const Scene::Field& field = scene.fields[options.field];
      colour = colour_of((static_cast<double>(frame.values[options.field][k]) - field.from) /
                         (field.to - field.from));
    }
    raster.sphere(layout(moved(scene.centres, frame.displacements, k)),
                  layout.scale * static_cast<double>(scene.radii[k]), colour);
  }
  draw_mesh(scene, frame, layout, raster);
  for (std::size_t t = 0; 3 * t + 2 < scene.body_triangles.size() && !frame.body_points.empty(); ++t)
    raster.triangle(layout(point(frame.body_points, scene.body_triangles[3 * t])),
                    layout(point(frame.body_points, scene.body_triangles[3 * t + 1])),
                    layout(point(frame.body_points, scene.body_triangles[3 * t + 2])), body_colour);
  return {raster.finished(), words_of(scene, frame, options, layout), layout.scale, layout.origin_x,
          layout.origin_y};
}

}  // namespace report
