// Pictures of pixels.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace report {

/// Rows from the top, red, green, blue for each pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// The bytes of a PNG file: `below`, and an SVG that fills it drawn on top. Same input, same bytes (text comes
/// from the machine's fonts). Throws dem::RunError if the SVG cannot be drawn.
std::string png_of(const Image& below, const std::string& svg);

/// An SVG that names its size in millimetres, on white, at so many pixels an inch.
std::string png_of(const std::string& svg, double dots_per_inch);

}  // namespace report
