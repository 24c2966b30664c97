// Impactors against free elements, and meshes to make them of: scenes for the tests take a few lines.
#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "impact/impactors/impactor.h"
#include "libdem/core/random.h"

namespace impactor_scene {

using dem::Mat3;
using dem::Vec3;

struct Surface {
  std::vector<Vec3> vertices;
  std::vector<impact::Triangle> triangles;

  impact::TriangleMesh mesh() const { return {vertices, triangles, "test"}; }
};

/// A box about the origin, two triangles to a face.
inline Surface box_surface(const Vec3& half) {
  Surface s;
  for (int k = 0; k < 8; ++k)
    s.vertices.emplace_back((k & 1 ? 1 : -1) * half.x(), (k & 2 ? 1 : -1) * half.y(),
                            (k & 4 ? 1 : -1) * half.z());
  s.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return s;
}

/// An octahedron, each triangle split into four `levels` times, all vertices on the sphere.
inline Surface sphere_surface(double radius, int levels) {
  Surface s;
  s.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  s.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(s.vertices.size()));
      if (is_new)
        s.vertices.push_back(
            (s.vertices[static_cast<std::size_t>(a)] + s.vertices[static_cast<std::size_t>(b)]).normalized());
      return entry->second;
    };
    std::vector<impact::Triangle> finer;
    for (const auto& [a, b, c] : s.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    s.triangles = std::move(finer);
  }
  for (Vec3& v : s.vertices) v *= radius;
  return s;
}

inline void append_little_endian(std::string& bytes, std::uint32_t value) {
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xff);
}

inline std::string binary_stl(const Surface& s) {
  std::string bytes = "solid though binary";  // some programs begin so
  bytes.resize(80, ' ');
  append_little_endian(bytes, static_cast<std::uint32_t>(s.triangles.size()));
  for (const auto& t : s.triangles) {
    for (int k = 0; k < 3; ++k) append_little_endian(bytes, 0);
    for (const int v : t)
      for (const double x : s.vertices[static_cast<std::size_t>(v)])
        append_little_endian(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
    bytes += std::string(2, '\0');
  }
  return bytes;
}

inline std::string text_stl(const Surface& s) {
  std::string text = "solid a test\n";
  for (const auto& t : s.triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int v : t) {
      text += "   vertex";
      for (const double x : s.vertices[static_cast<std::size_t>(v)]) {
        char digits[40];
        std::snprintf(digits, sizeof digits, " %.17g", x);
        text += digits;
      }
      text += "\n";
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid a test\n";
}

inline Vec3 random_vector(dem::Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

inline Eigen::Quaterniond random_turn(dem::Random& random) {
  return Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
}

/// An impactor and elements that feel nothing but it, with their momenta and their ledger.
struct Collision {
  impact::Impactor impactor;
  impact::ImpactorState state;
  impact::ImpactorRoom room;
  dem::Particles particles;
  impact::ImpactorStep step_options;
  std::vector<dem::ElementLoad> loads;
  impact::ImpactorSums last;
  double kinetic = 0, sliding = 0, damped = 0;

  void step() {
    const double dt = step_options.time_step;
    step_options.max_speed = 0;
    for (std::size_t i = 0; i < particles.count; ++i)
      step_options.max_speed = std::max(step_options.max_speed, particles.kinematics[i].velocity().norm());
    last = impact::advance_impactor(impactor, state, room, particles, step_options, loads);
    kinetic = last.kinetic, sliding += last.sliding, damped += last.damped;
    auto load = loads.begin();
    for (std::size_t i = 0; i < particles.count; ++i) {
      dem::Kinematics& k = particles.kinematics[i];
      const Vec3 x = k.position() + dt * k.velocity();
      k.x = x.x(), k.y = x.y(), k.z = x.z();
      Vec3 v = k.velocity(), w = k.spin();
      if (load != loads.end() && static_cast<std::size_t>(load->element) == i) {
        v += dt / particles.element_mass(i) * load->force;
        w += dt / particles.element_inertia(i) * load->moment;
        ++load;
      }
      kinetic += 0.5 * particles.element_mass(i) * v.dot(k.velocity()) +
                 0.5 * particles.element_inertia(i) * w.dot(k.spin());
      particles.set_velocity(i, v, w);
    }
  }
  double energy() const { return kinetic + last.stored + sliding + damped; }

  Vec3 momentum() const {
    Vec3 sum = impactor.body.mass * state.motion.velocity;
    for (std::size_t i = 0; i < particles.count; ++i)
      sum += particles.element_mass(i) * particles.kinematics[i].velocity();
    return sum;
  }
  /// About the origin.
  Vec3 angular_momentum() const {
    Vec3 sum =
        impactor.body.mass * state.motion.position.cross(state.motion.velocity) + state.motion.angular_momentum;
    for (std::size_t i = 0; i < particles.count; ++i) {
      const dem::Kinematics& k = particles.kinematics[i];
      sum += particles.element_mass(i) * k.position().cross(k.velocity()) +
             particles.element_inertia(i) * k.spin();
    }
    return sum;
  }
};

/// An impactor of that shape and density at the origin; the law and the elements are left to the caller.
inline Collision collision(impact::Shape shape, double density, const Eigen::Quaterniond& orientation,
                           const std::array<bool, 6>& locked = {}) {
  Collision c;
  c.impactor.body = {impact::from_density(shape, density, "test"), locked, "test"};
  c.impactor.shape = std::move(shape);
  c.impactor.law.modulus = 40e9;
  c.state.motion = impact::start_motion(c.impactor.body, Vec3::Zero(), orientation, Vec3::Zero(), Vec3::Zero());
  return c;
}

}  // namespace impactor_scene
