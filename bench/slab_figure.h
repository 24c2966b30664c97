// Figs. 16 to 18 of the paper as one picture: two displacements over time, two maps of damage.
#pragma once
#include <array>
#include <string>
#include <vector>

namespace bench {

/// Mean damage of the elements by column of the slab's plane.
struct DamagePlan {
  double cell = 0;            ///< side of a column [m]
  int columns = 0, rows = 0;  ///< along x and y
  std::vector<double> mean;   ///< x fastest; negative where there is no element
};

struct SlabCurves {
  std::vector<double> time;                  ///< [s]
  std::array<std::vector<double>, 2> probe;  ///< displacement along z under the rock and far from it [m]
};

/// One model, drawn with a solid line (the first) or a dashed one.
struct SlabPicture {
  std::string name;
  SlabCurves curves;
  DamagePlan damage;
};

/// A self-contained SVG.
std::string slab_figure(const std::string& title, const std::array<SlabPicture, 2>& models);

}  // namespace bench
