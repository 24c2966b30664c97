// Colours for values: perceptually even, and as even in grey.
#pragma once
#include <cstddef>
#include <string>

namespace report {

/// Red, green, blue, each 0 to 1, as sRGB.
struct Colour {
  double red = 0, green = 0, blue = 0;
};

/// The colour of a value between 0 and 1 (what lies outside counts as the nearer end): light for small values,
/// dark for large ones, so that damage is dark on white paper. The map is viridis of Smith and van der Walt
/// (2015), from its end to its beginning; its lightness falls evenly. A value that is no number is grey.
Colour colour_of(double value);

/// "#1f9e89"
std::string hexadecimal(const Colour& colour);

/// The colour (0 to 7) of a series on white paper, as in the page's light style.
const char* series_colour(int colour);

}  // namespace report
