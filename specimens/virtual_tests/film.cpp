#include "specimens/virtual_tests/film.h"

#include <algorithm>

#include "libdem/core/error.h"
#include "libdem/probe/damage.h"

namespace virtual_tests {

bool Film::is_due() {
  if (!is_wanted()) return false;
  if (taken.size() >= 2 * wanted) drop_every_second();
  return calls++ % stride == 0;
}

void Film::drop_every_second() {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < taken.size(); k += 2, ++kept) {
    if (k != kept) taken[kept] = std::move(taken[k]);
    taken_at[kept] = taken_at[k];
  }
  taken.resize(kept);
  taken_at.resize(kept);
  stride *= 2;
}

void Film::take(const dem::Assembly& assembly, double time, double control, double stress) {
  if (!is_wanted()) return;
  const std::int64_t call = std::max<std::int64_t>(calls - 1, 0);
  if (!taken_at.empty() && taken_at.back() == call) taken.pop_back(), taken_at.pop_back();
  const dem::Particles& particles = assembly.particles;
  Picture picture{time, control, stress, {}, {}};
  for (std::size_t i = 0; i < particles.count; ++i) {
    const dem::Vec3 u = particles.displacement(i);
    for (int c = 0; c < 3; ++c) picture.displacement.push_back(static_cast<float>(u[c]));
  }
  for (const double damage : dem::element_damage(assembly.law, assembly.links, particles.count))
    picture.damage.push_back(static_cast<float>(damage));
  broken_since.resize(assembly.links.count, -1);
  for (std::size_t k = 0; k < assembly.links.count; ++k)
    if (broken_since[k] < 0 && assembly.law.is_broken(assembly.links.max_strain[k])) broken_since[k] = call;
  taken.push_back(std::move(picture));
  taken_at.push_back(call);
}

std::vector<std::int32_t> Film::first_broken() const {
  std::vector<std::int32_t> first;
  for (const std::int64_t call : broken_since) {
    const auto shown = std::lower_bound(taken_at.begin(), taken_at.end(), call);
    first.push_back(call < 0 || shown == taken_at.end() ? -1
                                                        : static_cast<std::int32_t>(shown - taken_at.begin()));
  }
  return first;
}

void Film::keep_in(dem::NamedNumbers& numbers) const {
  if (!is_wanted()) return;
  const auto put = [&](const char* name, const auto& values) {
    std::vector<double>& column = numbers[name];
    column.insert(column.end(), values.begin(), values.end());
  };
  numbers["film_calls"] = {static_cast<double>(calls), static_cast<double>(stride)};
  for (const char* name : {"film_moments", "film_displacement", "film_damage"}) numbers[name] = {};
  for (std::size_t k = 0; k < taken.size(); ++k) {
    const Picture& p = taken[k];
    put("film_moments", std::vector{static_cast<double>(taken_at[k]), p.time, p.control, p.stress});
    put("film_displacement", p.displacement);
    put("film_damage", p.damage);
  }
  put("film_broken_since", broken_since);
}

void Film::restore(const dem::NamedNumbers& numbers, const std::filesystem::path& file) {
  if (!is_wanted()) return;
  if (!numbers.contains("film_calls"))
    throw dem::InputError(file.string(),
                          "was made without pictures, and pictures of the whole course are wanted",
                          "go on with --frames 0 as before, or start anew without --resume");
  const auto column = [&](const char* name) {
    const auto found = numbers.find(name);
    return found == numbers.end() ? std::vector<double>{} : found->second;
  };
  const std::vector<double> so_far = column("film_calls"), moments = column("film_moments"),
                            displacement = column("film_displacement"), damage = column("film_damage");
  const std::size_t pictures = moments.size() / 4;
  const std::size_t elements = pictures == 0 ? 0 : damage.size() / pictures;
  if (so_far.size() != 2 || !(so_far[1] >= 1) || moments.size() != 4 * pictures ||
      damage.size() != pictures * elements || displacement.size() != 3 * damage.size())
    throw dem::InputError(file.string(), "the pictures in it do not fit together", "start without --resume");
  calls = static_cast<std::int64_t>(so_far[0]);
  stride = static_cast<std::int64_t>(so_far[1]);
  taken.clear(), taken_at.clear(), broken_since.clear();
  for (std::size_t k = 0; k < pictures; ++k) {
    taken_at.push_back(static_cast<std::int64_t>(moments[4 * k]));
    Picture picture{moments[4 * k + 1], moments[4 * k + 2], moments[4 * k + 3], {}, {}};
    for (std::size_t i = 0; i < 3 * elements; ++i)
      picture.displacement.push_back(static_cast<float>(displacement[3 * elements * k + i]));
    for (std::size_t i = 0; i < elements; ++i)
      picture.damage.push_back(static_cast<float>(damage[elements * k + i]));
    taken.push_back(std::move(picture));
  }
  for (const double call : column("film_broken_since")) broken_since.push_back(static_cast<std::int64_t>(call));
}

}  // namespace virtual_tests
