#include "impact/impactors/impactor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libdem/core/error.h"

namespace impact {
namespace {

/// The only place that knows how elements are stored.
struct Element {
  Vec3 position, velocity, spin;
  double radius, mass;
};

Element element_of(const dem::Particles& particles, std::int32_t number) {
  const auto i = static_cast<std::size_t>(number);
  const dem::Kinematics& k = particles.kinematics[i];
  return {k.position(), k.velocity(), k.spin(), k.radius, particles.element_mass(i)};
}

double distance_outside(const Eigen::AlignedBox3d& box, const Vec3& p) {
  return (p - p.cwiseMax(box.min()).cwiseMin(box.max())).norm();
}

/// Half-way and final pose of a step.
struct Path {
  Pose middle, end;
};

void make_list(const Impactor& impactor, const ImpactorState& state, const Pose& pose,
               const dem::Particles& particles, double time_step, ImpactorRoom& room) {
  const Eigen::AlignedBox3d box = bounding_box(impactor.shape);
  if (room.skin == 0) {
    double sum = 0;
    for (std::size_t i = 0; i < particles.count; ++i) sum += particles.kinematics[i].radius;
    room.skin = 2 * sum / static_cast<double>(std::max<std::size_t>(1, particles.count));
    room.reach = std::sqrt(box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).squaredNorm());
  }
  room.candidates.clear();
  room.travel = 0;
  ++room.rebuilds;
  auto contact = state.contacts.begin();
  const Mat3 to_body = pose.orientation.conjugate().toRotationMatrix();
  for (std::size_t i = 0; i < particles.count; ++i) {
    const dem::Kinematics& k = particles.kinematics[i];
    const Vec3 local = to_body * (k.position() + time_step * k.velocity() - pose.position);
    const auto number = static_cast<std::int32_t>(i);
    const bool touched = contact != state.contacts.end() && contact->element == number;
    if (touched) ++contact;
    if (touched || distance_outside(box, local) <= k.radius + room.skin) room.candidates.push_back({number, 0});
  }
}

ContactGeometry meet(const Impactor& impactor, const Motion& motion, const Path& path, const Element& element,
                     const Nearest& now, const Vec3& middle_position) {
  const Nearest before = nearest(impactor.shape, path.middle.to_body(middle_position));
  ContactGeometry geometry;
  geometry.overlap = element.radius - now.distance;
  geometry.normal = path.end.orientation * now.normal;
  geometry.middle_normal = path.middle.orientation * before.normal;
  // Velocities belong to the mid-step, so they are compared where the bodies are then: at t_n a rigid rotation
  // of both would show as sliding.
  const Vec3 arm = -0.5 * (element.radius + before.distance) * geometry.middle_normal;
  const Vec3 from_body = middle_position + arm - path.middle.position;
  geometry.velocity =
      element.velocity + element.spin.cross(arm) - motion.velocity - motion.spin.cross(from_body);
  geometry.twist_rate = 0.5 * (element.spin + motion.spin).dot(geometry.middle_normal);
  geometry.radius = element.radius;
  double inverse_mass = 1 / element.mass;
  for (int k = 0; k < 3; ++k)
    if (!impactor.body.keeps_velocity(k))
      inverse_mass += geometry.normal[k] * geometry.normal[k] / impactor.body.mass;
  geometry.reduced_mass = 1 / inverse_mass;
  return geometry;
}

}  // namespace

ImpactorSums advance_impactor(const Impactor& impactor, ImpactorState& state, ImpactorRoom& room,
                              const dem::Particles& particles, const ImpactorStep& step,
                              std::vector<dem::ElementLoad>& loads) {
  Motion& motion = state.motion;
  Path path;
  path.middle = drift(impactor.body, motion, step.time_step);
  path.end = pose_of(motion);

  room.travel += step.time_step * (step.max_speed + motion.velocity.norm() + motion.spin.norm() * room.reach);
  if (room.skin == 0 || !(room.travel <= room.skin))
    make_list(impactor, state, path.end, particles, step.time_step, room);

  ImpactorSums sums;
  loads.clear();
  std::vector<ContactHistory> contacts;
  contacts.reserve(state.contacts.size() + 16);
  auto known = state.contacts.begin();
  for (ImpactorRoom::Candidate& candidate : room.candidates) {
    if (room.travel < candidate.far_until) continue;
    const Element element = element_of(particles, candidate.element);
    const Vec3 position = element.position + step.time_step * element.velocity;
    const Nearest now = nearest(impactor.shape, path.end.to_body(position));
    ++room.looked_at;
    while (known != state.contacts.end() && known->element < candidate.element) ++known;
    const bool touched = known != state.contacts.end() && known->element == candidate.element;
    const double overlap = element.radius - now.distance;
    if (!(overlap > 0)) {
      // A little less than the gap, so that rounding cannot make a touch depend on the list.
      candidate.far_until = room.travel - 0.99 * overlap - 1e-9 * room.skin;
      if (!touched) continue;
    }
    ContactHistory history = touched ? *known : ContactHistory{candidate.element, {0, 0, 0}, {0, 0, 0}, 0};
    const Vec3 middle_position = element.position + 0.5 * step.time_step * element.velocity;
    const ContactGeometry geometry = meet(impactor, motion, path, element, now, middle_position);
    const ContactForce contact = evaluate(impactor.law, geometry, step.time_step, history);
    sums.stored += contact.stored;
    sums.sliding += contact.sliding;
    sums.damped += contact.damped;
    if (!(overlap > 0)) continue;
    contacts.push_back(history);
    ++sums.touching;
    sums.deepest_overlap = std::max(sums.deepest_overlap, overlap);
    const Vec3 arm = -0.5 * (element.radius + now.distance) * geometry.normal;
    loads.push_back({candidate.element, contact.force, arm.cross(contact.force)});
    sums.force -= contact.force;
    sums.moment -= (position + arm - path.end.position).cross(contact.force);
  }
  state.contacts = std::move(contacts);
  sums.kinetic = kick(impactor.body, motion, sums.force + step.other_force, sums.moment, step.time_step);
  return sums;
}

Gap nearest_gap(const Shape& shape, const Pose& pose, const dem::Particles& particles) {
  Gap least{std::numeric_limits<double>::infinity(), -1};
  const Eigen::AlignedBox3d box = bounding_box(shape);
  for (std::size_t i = 0; i < particles.count; ++i) {
    const dem::Kinematics& k = particles.kinematics[i];
    const Vec3 local = pose.to_body(k.position());
    // Outside the box the surface is no nearer than the box; inside nothing is known yet.
    if (const double outside = distance_outside(box, local); outside > 0 && outside - k.radius >= least.gap)
      continue;
    const double gap = nearest(shape, local).distance - k.radius;
    if (gap < least.gap) least = {gap, static_cast<std::int32_t>(i)};
  }
  return least;
}

std::optional<double> distance_to_contact(const Shape& shape, const Pose& pose, const Vec3& direction,
                                          const dem::Particles& particles) {
  if (particles.count == 0) return std::nullopt;
  const Eigen::AlignedBox3d box = bounding_box(shape);
  const double size = box.diagonal().norm();
  double farthest = 0;  // once it has gone so far it has left all elements behind
  for (std::size_t i = 0; i < particles.count; ++i) {
    const dem::Kinematics& k = particles.kinematics[i];
    farthest = std::max(farthest, (k.position() - pose.position).dot(direction) + k.radius + size);
  }
  // Moving by the gap can never pass through an element.
  double moved = 0;
  for (int round = 0; moved <= farthest; ++round) {
    if (round == 10000)
      throw dem::RunError(fmt::format(
          "the impactor grazes the elements over {:.3g} m without touching them; start it elsewhere, or "
          "in another direction",
          moved));
    const Gap here = nearest_gap(shape, {pose.position + moved * direction, pose.orientation}, particles);
    if (here.gap <= 1e-9 * size) return moved;
    moved += here.gap;
  }
  return std::nullopt;
}

double contact_frequency_squared(const ContactLaw& law, double radius, double mass, double inertia) {
  const double normal = law.spring == NormalSpring::linear ? law.normal_stiffness(radius)
                                                           : 2 * law.modulus * radius * std::sqrt(0.1);
  const double tangential =
      law.friction > 0 ? law.tangential_stiffness(radius) * (1 / mass + radius * radius / inertia) : 0;
  return std::max(normal / mass, tangential);
}

}  // namespace impact
