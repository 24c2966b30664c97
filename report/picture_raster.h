// A small renderer: shaded spheres, triangles and lines into a depth buffer, smoothed by drawing it several
// times finer.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "report/picture_colours.h"
#include "report/picture_png.h"

namespace report {

/// Pixels of the finished picture: x to the right, y down, z towards the viewer.
struct PicturePoint {
  double x = 0, y = 0, z = 0;
};

/// What is seen: points with normal . p <= offset; the rest is taken away. Solid spheres show their section.
struct CutPlane {
  PicturePoint normal;
  double offset = 0;
};

/// A picture being drawn, white at first. The order of the calls does not matter but where two things are
/// exactly as near. A point hides what lies farther from the viewer. The light comes from the upper left.
class Raster {
 public:
  /// `samples`: so many subdivisions of a pixel along each side.
  Raster(int width, int height, int samples = 3);

  void cut(const CutPlane& plane) { plane_cut = plane; }
  void sphere(const PicturePoint& centre, double radius, const Colour& colour);
  /// Flat, seen from both sides.
  void triangle(const PicturePoint& a, const PicturePoint& b, const PicturePoint& c, const Colour& colour);
  /// Not shaded; drawn a little nearer to the viewer than it is, so that faces do not swallow their own edges.
  void line(const PicturePoint& a, const PicturePoint& b, double width, const Colour& colour);

  Image finished() const;

 private:
  /// The nearest z at (x, y) that the cut leaves; +infinity without a cut, -infinity where nothing is left.
  double nearest_kept(double x, double y) const;
  void put(int column, int row, double z, const Colour& colour, double light);

  int width, height, samples, columns, rows;
  std::vector<float> depth;
  std::vector<std::uint8_t> rgb;
  std::optional<CutPlane> plane_cut;
};

}  // namespace report
