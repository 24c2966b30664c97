#include "report/picture_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace report {

Colour colour_of(double value) {
  // Viridis at 0, 1/8 ... 1.
  constexpr std::array<std::array<int, 3>, 9> points{{{68, 1, 84},
                                                      {71, 44, 122},
                                                      {59, 81, 139},
                                                      {44, 113, 142},
                                                      {33, 144, 141},
                                                      {39, 173, 129},
                                                      {92, 200, 99},
                                                      {170, 220, 50},
                                                      {253, 231, 37}}};
  if (std::isnan(value)) return {0.6, 0.6, 0.6};
  const double along = (1 - std::clamp(value, 0.0, 1.0)) * (points.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(along), points.size() - 2);
  const double part = along - static_cast<double>(low);
  const auto channel = [&](std::size_t c) {
    return ((1 - part) * points[low][c] + part * points[low + 1][c]) / 255;
  };
  return {channel(0), channel(1), channel(2)};
}

std::string hexadecimal(const Colour& colour) {
  const auto byte = [](double value) {
    return static_cast<int>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.red), byte(colour.green), byte(colour.blue));
}

const char* series_colour(int colour) {
  constexpr std::array<const char*, 8> colours{"#0b5cad", "#c2480f", "#0f7a5a", "#8a3fa0",
                                               "#86690a", "#55606c", "#b0285e", "#2b8fa3"};
  return colours[static_cast<std::size_t>(colour) % colours.size()];
}

}  // namespace report
