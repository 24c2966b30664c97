#include "impact/impactor_surface.h"

#include <cmath>
#include <numbers>

namespace impact {
namespace {

constexpr int around = 48;        // vertices of a ring
constexpr int quarter_arcs = 12;  // chords of a quarter circle along the axis

struct ProfilePoint {
  double rho, z;
};

/// The circle of `radius` about (0, z_middle), from the angle `from` above the horizontal plane up to the pole.
void add_arc(std::vector<ProfilePoint>& profile, double radius, double z_middle, double from) {
  const int chords =
      static_cast<int>(std::lround((std::numbers::pi / 2 - from) / (std::numbers::pi / 2 / quarter_arcs)));
  for (int k = 0; k < chords; ++k) {
    const double angle = from + (std::numbers::pi / 2 - from) * k / chords;
    profile.push_back({radius * std::cos(angle), z_middle + radius * std::sin(angle)});
  }
  profile.push_back({0, z_middle + radius});
}

/// The profile runs from the back's middle to the front's, both on the axis, with rings between them.
Surface revolve(const std::vector<ProfilePoint>& profile) {
  Surface surface;
  const auto rings = static_cast<std::int32_t>(profile.size()) - 2;
  surface.vertices.emplace_back(0, 0, profile.front().z);
  for (std::int32_t ring = 1; ring <= rings; ++ring)
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      const ProfilePoint& p = profile[static_cast<std::size_t>(ring)];
      surface.vertices.emplace_back(p.rho * std::cos(angle), p.rho * std::sin(angle), p.z);
    }
  surface.vertices.emplace_back(0, 0, profile.back().z);
  const auto vertex = [&](std::int32_t ring, int k) { return 1 + (ring - 1) * around + k % around; };
  const auto last = static_cast<std::int32_t>(surface.vertices.size()) - 1;
  for (int k = 0; k < around; ++k) {
    surface.triangles.push_back({0, vertex(1, k + 1), vertex(1, k)});
    for (std::int32_t ring = 1; ring < rings; ++ring) {
      surface.triangles.push_back({vertex(ring, k), vertex(ring, k + 1), vertex(ring + 1, k + 1)});
      surface.triangles.push_back({vertex(ring, k), vertex(ring + 1, k + 1), vertex(ring + 1, k)});
    }
    surface.triangles.push_back({vertex(rings, k), vertex(rings, k + 1), last});
  }
  return surface;
}

Surface surface_of_one(const Box& box) {
  Surface surface;
  for (int corner = 0; corner < 8; ++corner)
    surface.vertices.emplace_back(
        box.half_size.cwiseProduct(Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1)));
  // Each face as a ring of corners, anticlockwise from outside: -z, +z, -y, +y, -x, +x.
  constexpr std::array<std::array<std::int32_t, 4>, 6> faces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : faces) {
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a, c, d});
  }
  return surface;
}

Surface surface_of_one(const Sphere& sphere) {
  std::vector<ProfilePoint> profile = {{0, -sphere.radius}};
  add_arc(profile, sphere.radius, 0, -std::numbers::pi / 2 * (quarter_arcs - 1) / quarter_arcs);
  return revolve(profile);
}

Surface surface_of_one(const Cylinder& cylinder) {
  std::vector<ProfilePoint> profile = {{0, cylinder.back}, {cylinder.radius, cylinder.back}};
  const bool round = cylinder.nose == Nose::hemisphere;
  const double shoulder = round ? cylinder.front - cylinder.radius : cylinder.front;
  if (!round) {
    profile.push_back({cylinder.radius, cylinder.front});
    profile.push_back({0, cylinder.front});
    return revolve(profile);
  }
  // A nose as long as the body: its shoulder is the back's edge, which must not be there twice.
  if (shoulder - cylinder.back < 1e-9 * cylinder.radius) profile.pop_back();
  add_arc(profile, cylinder.radius, shoulder, 0);
  return revolve(profile);
}

Surface surface_of_one(const Mesh& mesh) { return {mesh.surface->vertices(), mesh.surface->triangles()}; }

}  // namespace

Surface surface_of(const Shape& shape) {
  return std::visit([](const auto& one) { return surface_of_one(one); }, shape);
}

}  // namespace impact
