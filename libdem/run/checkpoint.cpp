#include "libdem/run/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>

#include "libdem/core/error.h"
#include "libdem/io/content.h"

namespace dem {
namespace {

constexpr const char* format = "spall-checkpoint";
constexpr int version = 1;
constexpr const char* start_anew = "go on with what it was made with, or start anew without --resume";

constexpr std::size_t numbers_per_row = sizeof(Kinematics) / sizeof(double);

/// Which degrees of freedom are prescribed, six per element: where the inverse mass is zero.
std::vector<std::uint8_t> held_dofs(const Particles& particles) {
  std::vector<std::uint8_t> held;
  held.reserve(6 * particles.count);
  for (std::size_t i = 0; i < particles.count; ++i)
    for (int dof = 0; dof < 6; ++dof) held.push_back(particles.is_prescribed(i, dof) ? 1 : 0);
  return held;
}

std::vector<double> flat(std::span<const Vec3> vectors) {
  std::vector<double> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) numbers.insert(numbers.end(), {v.x(), v.y(), v.z()});
  return numbers;
}

std::vector<Vec3> vectors_of(std::span<const double> numbers) {
  std::vector<Vec3> vectors;
  for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
    vectors.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
  return vectors;
}

template <class T>
Column<T> column(const std::vector<T>& values) {
  return Column<T>(values.begin(), values.end());
}

void put_contacts(ContentWriter& out, const Links& contacts) {
  const std::vector<std::uint64_t> count{contacts.count};
  out.put("contacts/count", count);
  out.put("contacts/a", contacts.a);
  out.put("contacts/b", contacts.b);
  out.put("contacts/inverse_initial_distance", contacts.inverse_initial_distance);
  out.put("contacts/area", contacts.area);
  for (const HistoryColumn& history : history_columns(contacts.remembers_moments))
    out.put(fmt::format("contacts/{}", history.name), contacts.*history.values);
}

Links get_contacts(ContentReader& in, bool remember_moments) {
  Links contacts;
  contacts.remembers_moments = remember_moments;
  contacts.count = in.get<std::uint64_t>("contacts/count", 1)[0];
  contacts.a = column(in.get<std::int32_t>("contacts/a"));
  const std::size_t padded = contacts.a.size();
  contacts.b = column(in.get<std::int32_t>("contacts/b", padded));
  contacts.inverse_initial_distance = column(in.get<double>("contacts/inverse_initial_distance", padded));
  contacts.area = column(in.get<double>("contacts/area", padded));
  for (const HistoryColumn& history : history_columns(remember_moments))
    contacts.*history.values = column(in.get<double>(fmt::format("contacts/{}", history.name), padded));
  return contacts;
}

/// Whether the columns are those of so many pairs of elements that are there: they are used as indices.
void require_contacts(const std::filesystem::path& file, const Links& contacts, std::size_t elements) {
  const auto refuse = [&](const std::string& wrong) { throw InputError(file.string(), wrong, start_anew); };
  const std::size_t padded = contacts.padded();
  if (padded % link_padding != 0 || contacts.count > padded || padded - contacts.count >= link_padding)
    refuse(fmt::format("is damaged: {} contacts in columns of {}", contacts.count, padded));
  for (std::size_t k = 0; k < padded; ++k) {
    // The padding joins ghosts.
    const auto known = static_cast<std::int64_t>(elements + (k < contacts.count ? 0 : ghost_elements));
    if (contacts.a[k] < 0 || contacts.b[k] < 0 || contacts.a[k] >= known || contacts.b[k] >= known ||
        contacts.a[k] == contacts.b[k])
      refuse(fmt::format("is damaged: contact {} joins elements {} and {}, of {}", k, contacts.a[k],
                         contacts.b[k], elements));
  }
}

void put_state(ContentWriter& out, const Assembly& assembly, const StepRoom& room) {
  const Particles& particles = assembly.particles;
  out.put("particles/kinematics", &particles.kinematics[0].x, numbers_per_row * particles.count);
  out.put("particles/rotation", flat(particles.rotation));
  out.put("particles/held", held_dofs(particles));
  for (const HistoryColumn& history : history_columns(assembly.links.remembers_moments))
    out.put(fmt::format("links/{}", history.name), assembly.links.*history.values);
  put_contacts(out, assembly.contacts);
  const ContactDetector::Memory memory = room.detector.memory();
  out.put("detector/built_at", flat(memory.built_at));
  out.put("detector/moved_at_most", std::vector{memory.moved_at_most});
  out.put("max_speed", std::vector{room.max_speed});
}

/// What `put_state` wrote, read but not yet believed.
struct StateRead {
  std::vector<double> kinematics, rotation;
  std::vector<std::uint8_t> held;
  PairHistories link_histories;
  Links contacts;
  ContactDetector::Memory memory;
  double max_speed = 0;
};

StateRead get_state(ContentReader& in, const Assembly& assembly) {
  StateRead read;
  const std::size_t elements = assembly.particles.count;
  read.kinematics = in.get<double>("particles/kinematics", numbers_per_row * elements);
  read.rotation = in.get<double>("particles/rotation", 3 * elements);
  read.held = in.get<std::uint8_t>("particles/held", 6 * elements);
  const bool moments = assembly.links.remembers_moments;
  for (const HistoryColumn& history : history_columns(moments))
    read.link_histories.*history.values =
        column(in.get<double>(fmt::format("links/{}", history.name), assembly.links.padded()));
  read.contacts = get_contacts(in, moments);
  read.memory.built_at = vectors_of(in.get<double>("detector/built_at"));
  read.memory.moved_at_most = in.get<double>("detector/moved_at_most", 1)[0];
  read.max_speed = in.get<double>("max_speed", 1)[0];
  return read;
}

void apply(StateRead&& read, Assembly& assembly, StepRoom& room) {
  Particles& particles = assembly.particles;
  for (std::size_t i = 0; i < particles.count; ++i)
    for (int dof = 0; dof < 6; ++dof) {
      if (read.held[6 * i + static_cast<std::size_t>(dof)] != 0)
        particles.prescribe(i, dof, 0);
      else
        particles.release(i, dof);
    }
  std::copy(read.kinematics.begin(), read.kinematics.end(), &particles.kinematics[0].x);
  particles.rotation = vectors_of(read.rotation);
  static_cast<PairHistories&>(assembly.links) = std::move(read.link_histories);
  room.link_blocks.take_histories(assembly.links);
  assembly.contacts = std::move(read.contacts);
  room.detector.restore(std::move(read.memory));
  room.max_speed = read.max_speed;
  room.contact_incidence = Incidence(assembly.contacts, particles.count);
}

/// Refuses a checkpoint of something else, and names what differs.
void require_same(const Hdf5File& file, const Belonging& belongs_to) {
  for (const auto& [what, sha256] : belongs_to)
    if (!file.has_attribute("belongs_to", what) || file.text_attribute("belongs_to", what) != sha256)
      throw InputError(
          file.path().string(),
          fmt::format("belongs to a run with {} {}", what.ends_with('s') ? "other" : "another", what),
          start_anew);
}

}  // namespace

Hdf5File open_checkpoint(const std::filesystem::path& path, const std::string& format_wanted, int newest) {
  try {
    return open_spall_file(path, format_wanted, newest);
  } catch (const InputError& error) {
    throw InputError(error.where(), error.what_is_wrong(), "start anew without --resume");
  }
}

void write_checkpoint(const std::filesystem::path& path, const Belonging& belongs_to, Assembly& assembly,
                      const StepRoom& room, const NamedNumbers& numbers) {
  settle(assembly, room);
  create_spall_file(path, format, version, [&](Hdf5File& file) {
    file.make_group("belongs_to");
    for (const auto& [what, sha256] : belongs_to) file.set_attribute("belongs_to", what, sha256);
    file.make_group("numbers");
    ContentWriter out(file);
    put_state(out, assembly, room);
    for (const auto& [name, values] : numbers) out.put("numbers/" + name, values);
    out.seal();
  });
}

NamedNumbers read_checkpoint(const std::filesystem::path& path, const Belonging& belongs_to, Assembly& assembly,
                             StepRoom& room) {
  return read_checkpoint(open_checkpoint(path, format, version), belongs_to, assembly, room);
}

NamedNumbers read_checkpoint(const Hdf5File& file, const Belonging& belongs_to, Assembly& assembly,
                             StepRoom& room) {
  require_spall_file(file, format, version);
  require_same(file, belongs_to);
  ContentReader in(file);
  StateRead state = get_state(in, assembly);
  NamedNumbers numbers;
  for (const std::string& name : file.names_in("numbers")) numbers[name] = in.get<double>("numbers/" + name);
  in.require_seal();
  require_contacts(file.path(), state.contacts, assembly.particles.count);
  apply(std::move(state), assembly, room);
  return numbers;
}

}  // namespace dem
