#include "report/picture_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace report {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Towards the light, of length 1.
constexpr PicturePoint light_from{-0.36, -0.48, 0.8};

double dot(const PicturePoint& a, const PicturePoint& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Brightness of a face whose unit normal looks to the viewer.
double brightness(const PicturePoint& normal) { return 0.42 + 0.58 * std::max(0.0, dot(normal, light_from)); }

std::uint8_t byte(double value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

}  // namespace

Raster::Raster(int wide, int high, int finer)
    : width(wide),
      height(high),
      samples(finer),
      columns(wide * finer),
      rows(high * finer),
      depth(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
            -std::numeric_limits<float>::infinity()),
      rgb(3 * depth.size(), 255) {}

double Raster::nearest_kept(double x, double y) const {
  if (!plane_cut) return infinite;
  const PicturePoint& n = plane_cut->normal;
  const double left = plane_cut->offset - n.x * x - n.y * y;
  if (n.z > 1e-9) return left / n.z;
  return left >= 0 ? infinite : -infinite;  // along the line of sight
}

void Raster::put(int column, int row, double z, const Colour& colour, double light) {
  const std::size_t at =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  const auto near = static_cast<float>(z);
  if (!(near > depth[at])) return;
  depth[at] = near;
  rgb[3 * at] = byte(light * colour.red);
  rgb[3 * at + 1] = byte(light * colour.green);
  rgb[3 * at + 2] = byte(light * colour.blue);
}

void Raster::sphere(const PicturePoint& centre, double radius, const Colour& colour) {
  const auto first = [&](double low) { return std::max(0, static_cast<int>(std::floor(samples * low))); };
  const int left = first(centre.x - radius), top = first(centre.y - radius);
  const int right = std::min(columns - 1, static_cast<int>(std::ceil(samples * (centre.x + radius))));
  const int bottom = std::min(rows - 1, static_cast<int>(std::ceil(samples * (centre.y + radius))));
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column) {
      const double x = (column + 0.5) / samples, y = (row + 0.5) / samples;
      const double dx = x - centre.x, dy = y - centre.y;
      const double square = radius * radius - dx * dx - dy * dy;
      if (!(square > 0)) continue;
      const double half = std::sqrt(square), kept = nearest_kept(x, y);
      if (kept <= centre.z - half) continue;
      if (kept < centre.z + half)
        put(column, row, kept, colour, brightness(plane_cut->normal));
      else
        put(column, row, centre.z + half, colour, brightness({dx / radius, dy / radius, half / radius}));
    }
}

void Raster::triangle(const PicturePoint& a, const PicturePoint& b, const PicturePoint& c,
                      const Colour& colour) {
  const PicturePoint u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
  PicturePoint normal{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  const double length = std::sqrt(dot(normal, normal));
  if (!(std::abs(normal.z) > 1e-12 * length)) return;  // seen edge-on
  const double turn = (normal.z > 0 ? 1 : -1) / length;
  normal = {normal.x * turn, normal.y * turn, normal.z * turn};
  const double light = brightness(normal);
  const auto column_of = [&](double x) {
    return static_cast<int>(std::floor(samples * std::clamp(x, 0.0, static_cast<double>(width))));
  };
  const auto row_of = [&](double y) {
    return static_cast<int>(std::floor(samples * std::clamp(y, 0.0, static_cast<double>(height))));
  };
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  const auto side = [](const PicturePoint& p, const PicturePoint& q, double x, double y) {
    return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
  };
  for (int row = row_of(top); row <= std::min(rows - 1, row_of(bottom)); ++row)
    for (int column = column_of(left); column <= std::min(columns - 1, column_of(right)); ++column) {
      const double x = (column + 0.5) / samples, y = (row + 0.5) / samples;
      const double s = side(a, b, x, y), t = side(b, c, x, y), w = side(c, a, x, y);
      if (!((s >= 0 && t >= 0 && w >= 0) || (s <= 0 && t <= 0 && w <= 0))) continue;
      const double z = a.z - (normal.x * (x - a.x) + normal.y * (y - a.y)) / normal.z;
      if (z <= nearest_kept(x, y)) put(column, row, z, colour, light);
    }
}

void Raster::line(const PicturePoint& a, const PicturePoint& b, double thick, const Colour& colour) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const auto points = static_cast<int>(std::ceil(length * samples)) + 1;
  const double half = 0.5 * thick * samples;
  for (int k = 0; k <= points; ++k) {
    const double part = static_cast<double>(k) / points;
    const double x = a.x + part * (b.x - a.x), y = a.y + part * (b.y - a.y), z = a.z + part * (b.z - a.z);
    if (!(x > -thick && x < width + thick && y > -thick && y < height + thick) || z > nearest_kept(x, y))
      continue;
    const auto reach = [half](double middle, int end) {
      return std::pair(std::max(0, static_cast<int>(std::ceil(middle - half - 0.5))),
                       std::min(end - 1, static_cast<int>(std::floor(middle + half - 0.5))));
    };
    const auto [left, right] = reach(samples * x, columns);
    const auto [top, bottom] = reach(samples * y, rows);
    for (int row = top; row <= bottom; ++row)
      for (int column = left; column <= right; ++column) put(column, row, z + 1, colour, 1);
  }
}

Image Raster::finished() const {
  Image image{width, height, {}};
  image.rgb.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const unsigned all = static_cast<unsigned>(samples * samples);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        unsigned sum = 0;
        for (int row = y * samples; row < (y + 1) * samples; ++row)
          for (int column = x * samples; column < (x + 1) * samples; ++column)
            sum += rgb[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                            static_cast<std::size_t>(column)) +
                       c];
        image.rgb.push_back(static_cast<std::uint8_t>((sum + all / 2) / all));
      }
  return image;
}

}  // namespace report
