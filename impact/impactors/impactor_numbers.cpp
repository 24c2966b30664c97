// The impactor's state as columns of numbers, for checkpoints.
#include <fmt/format.h>

#include "impact/impactors/impactor.h"
#include "libdem/core/error.h"

namespace impact {
namespace {

constexpr std::size_t contact_columns = 8, motion_numbers = 23;

void append(std::vector<double>& column, const Vec3& v) { column.insert(column.end(), v.data(), v.data() + 3); }

/// Hands out a column's numbers in turn.
struct Reader {
  const double* next;
  double number() { return *next++; }
  Vec3 vector() {
    next += 3;
    return {next[-3], next[-2], next[-1]};
  }
};

const std::vector<double>& column_of(const std::map<std::string, std::vector<double>>& numbers,
                                     const char* name, const std::string& where) {
  const auto found = numbers.find(name);
  if (found == numbers.end())
    throw dem::InputError(where, fmt::format("'{}' is missing", name), "this is no state of an impactor");
  return found->second;
}

}  // namespace

std::map<std::string, std::vector<double>> to_numbers(const ImpactorState& state) {
  std::map<std::string, std::vector<double>> numbers;
  const Motion& m = state.motion;
  std::vector<double>& motion = numbers["impactor_motion"];
  append(motion, m.position);
  motion.push_back(m.orientation.w());
  append(motion, m.orientation.vec());
  append(motion, m.velocity);
  append(motion, m.angular_momentum);
  append(motion, m.spin);
  append(motion, m.support_impulse);
  append(motion, m.support_angular_impulse);
  motion.push_back(m.support_work);
  std::vector<double>& contacts = numbers["impactor_contacts"];
  for (const ContactHistory& c : state.contacts) {
    contacts.push_back(c.element);
    append(contacts, c.shear);
    append(contacts, c.normal);
    contacts.push_back(c.dashpot);
  }
  return numbers;
}

ImpactorState from_numbers(const std::map<std::string, std::vector<double>>& numbers,
                           const std::string& where) {
  const std::vector<double>& motion = column_of(numbers, "impactor_motion", where);
  const std::vector<double>& contacts = column_of(numbers, "impactor_contacts", where);
  if (motion.size() != motion_numbers || contacts.size() % contact_columns != 0)
    throw dem::InputError(
        where, fmt::format("the impactor's state has {} and {} numbers", motion.size(), contacts.size()),
        fmt::format("{}, and a multiple of {}, are expected", motion_numbers, contact_columns));
  ImpactorState state;
  Reader read{motion.data()};
  Motion& m = state.motion;
  m.position = read.vector();
  m.orientation.w() = read.number();
  m.orientation.vec() = read.vector();
  m.velocity = read.vector();
  m.angular_momentum = read.vector();
  m.spin = read.vector();
  m.support_impulse = read.vector();
  m.support_angular_impulse = read.vector();
  m.support_work = read.number();
  read.next = contacts.data();
  state.contacts.resize(contacts.size() / contact_columns);
  for (ContactHistory& c : state.contacts) {
    c.element = static_cast<std::int32_t>(read.number());
    c.shear = read.vector();
    c.normal = read.vector();
    c.dashpot = read.number();
  }
  return state;
}

}  // namespace impact
