// A made-up run in space, of any size: a slab on a mesh, hit by a ball, cracking. For what draws it, not for
// physics.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "libdem/core/random.h"
#include "report/scene.h"

namespace scenes {

namespace report_detail {

inline void append(std::vector<float>& list, double x, double y, double z) {
  for (const double value : {x, y, z}) list.push_back(static_cast<float>(value));
}

/// A ball's points and triangles about the origin.
inline void ball(double radius, std::vector<float>& points, std::vector<std::uint32_t>& triangles) {
  constexpr std::uint32_t rings = 10, around = 20;
  for (std::uint32_t i = 0; i <= rings; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      const double polar = M_PI * i / rings, turn = 2 * M_PI * j / around;
      append(points, radius * std::sin(polar) * std::cos(turn), radius * std::sin(polar) * std::sin(turn),
             radius * std::cos(polar));
    }
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      const std::uint32_t a = i * around + j, b = i * around + (j + 1) % around, c = a + around, d = b + around;
      for (const std::uint32_t k : {a, c, b, b, c, d}) triangles.push_back(k);
    }
}

}  // namespace report_detail

/// `elements` on a shaken lattice in a slab of 0.5 x 0.5 x 0.1 m, damage growing as a cone from the centre, two
/// fields (damage, speed), links broken inside the cone, a mesh around it, a ball that comes down.
inline report::Scene report_scene(std::size_t elements, std::size_t frames) {
  using report_detail::append;
  report::Scene scene;
  scene.title = "Slab in space";
  scene.caption = "A made-up cone of damage under a ball.";
  scene.fields = {{"damage", "", 0, 1}, {"speed", "m/s", 0, 4}};
  const double spacing = std::cbrt(0.5 * 0.5 * 0.1 / static_cast<double>(elements));
  const auto across = static_cast<std::size_t>(std::max(1.0, std::floor(0.5 / spacing)));
  const auto layers = (elements + across * across - 1) / (across * across);
  dem::Random random(7);
  const auto at = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  for (std::size_t k = 0; k < elements; ++k) {
    // Back and forth, so that neighbours in number are neighbours in space, as in a specimen.
    const std::size_t layer = k / (across * across), row = k / across % across, column = k % across;
    const double shake = 0.15 * spacing;
    append(scene.centres,
           0.5 * (static_cast<double>(row % 2 == 0 ? column : across - 1 - column) + 0.5) /
                   static_cast<double>(across) +
               at(-shake, shake),
           0.5 * (static_cast<double>(layer % 2 == 0 ? row : across - 1 - row) + 0.5) /
                   static_cast<double>(across) +
               at(-shake, shake),
           0.1 * (static_cast<double>(layer) + 0.5) / static_cast<double>(layers) + at(-shake, shake));
    scene.radii.push_back(static_cast<float>(spacing * at(0.4, 0.6)));
  }
  constexpr std::uint32_t cells = 12;
  for (std::uint32_t i = 0; i <= cells; ++i)
    for (std::uint32_t j = 0; j <= cells; ++j) append(scene.mesh_nodes, -0.25 + i / 12.0, -0.25 + j / 12.0, 0);
  for (std::uint32_t i = 0; i < cells; ++i)
    for (std::uint32_t j = 0; j < cells; ++j)
      for (const std::uint32_t k : {i * (cells + 1) + j, (i + 1) * (cells + 1) + j,
                                    (i + 1) * (cells + 1) + j + 1, i * (cells + 1) + j + 1})
        scene.mesh_faces.push_back(k);
  std::vector<float> ball;
  report_detail::ball(0.03, ball, scene.body_triangles);

  std::vector<bool> broken(elements, false);
  for (std::size_t f = 0; f < frames; ++f) {
    report::Scene::Frame frame;
    const double part = frames > 1 ? static_cast<double>(f) / static_cast<double>(frames - 1) : 1;
    frame.time = 2e-3 * part;
    char label[32];
    std::snprintf(label, sizeof label, "t = %.3g ms", 2 * part);
    frame.label = label;
    frame.values.resize(2);
    for (std::size_t k = 0; k < elements; ++k) {
      const double x = scene.centres[3 * k] - 0.25, y = scene.centres[3 * k + 1] - 0.25,
                   z = scene.centres[3 * k + 2];
      const double r = std::hypot(x, y), cone = std::abs(r - 0.03 - (0.1 - z) * 0.9);
      const double damage =
          std::clamp(1.4 * part * std::exp(-std::pow(cone / 0.012, 2)) * (r < 0.16 ? 1 : 0), 0.0, 1.0);
      const double sink = 0.012 * part * std::exp(-r * r / 0.01) + 1e-6 * random.uniform();
      append(frame.displacements, 0.05 * sink * x / 0.1, 0.05 * sink * y / 0.1, -sink);
      frame.values[0].push_back(static_cast<float>(damage));
      frame.values[1].push_back(static_cast<float>(4 * (1 - part) * std::exp(-r * r / 0.01)));
      if (damage > 0.8 && !broken[k] && k + 1 < elements) {
        broken[k] = true;
        scene.broken_links.push_back(
            {static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(k + 1), static_cast<std::uint32_t>(f)});
      }
    }
    for (std::size_t k = 0; k < scene.mesh_nodes.size() / 3; ++k) {
      const double r = std::hypot(scene.mesh_nodes[3 * k] - 0.25, scene.mesh_nodes[3 * k + 1] - 0.25);
      append(frame.mesh_displacements, 0, 0, -0.012 * part * std::exp(-r * r / 0.02));
    }
    for (std::size_t k = 0; k < ball.size(); k += 3)
      append(frame.body_points, ball[k] + 0.25, ball[k + 1] + 0.25, ball[k + 2] + 0.15 - 0.025 * part);
    scene.frames.push_back(std::move(frame));
  }
  return scene;
}

}  // namespace scenes
