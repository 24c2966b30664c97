// The rooms of read_scene, and the readers that they share. Only the scene_*.cpp files include it.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "impact/scene.h"
#include "libdem/config/toml_reader.h"
#include "libdem/core/error.h"

namespace impact {

/// The letters of the axes, as keys and messages write them.
inline constexpr const char* axis_name[3] = {"x", "y", "z"};

// scene_values.cpp

/// What a room below says about `key` gets the file and the line in front.
template <class Action>
auto told_about(const dem::TomlTable& table, std::string_view key, Action&& action) {
  try {
    return action();
  } catch (const dem::InputError& error) {
    throw dem::InputError(table.where(key), error.what(), "");
  }
}
/// Three lengths [m]; `example` shows how they are written.
Vec3 read_lengths(const dem::TomlTable& table, std::string_view key, const std::string& example);
/// Three numbers of one direction, made a unit vector.
Vec3 read_direction(const dem::TomlTable& table, std::string_view key, const Vec3& fallback);
/// Above 0.
double read_positive(const dem::TomlTable& table, std::string_view key, dem::Quantity kind);
/// A number with `allowed` in words, such as "0 to below 1", if it does not lie within.
double read_number(const dem::TomlTable& table, std::string_view key, double fallback, bool (*holds)(double),
                   const char* allowed);
/// A file that is there, relative to the case.
std::filesystem::path read_path(const dem::TomlTable& table, std::string_view key);
/// The length of the unit that a mesh or an STL file is in [m].
double read_length_unit(const dem::TomlTable& table);
/// The name of a support or a probe: it becomes a column's title and a key of result.json.
std::string read_name(const dem::TomlTable& table, const std::vector<std::string>& taken);

/// A box given by low and high, or by centre and size.
struct Region {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();     ///< [m]
  const char *low_key = "low", *high_key = "high";  ///< to name when something is wrong with one of them
};
Region read_region(const dem::TomlTable& table);

// scene_surroundings.cpp

/// [zone], [mesh] and [coupling]. `size` is the structure's.
Surroundings read_surroundings(const dem::TomlTable& root, const Vec3& size,
                               std::vector<dem::InputFile>& inputs);

// scene_impactor.cpp

/// [impactor]: fills scene.impactor and scene.approach. Size, card and surroundings are known by now.
void read_impactor(const dem::TomlTable& impactor, Scene& scene);

}  // namespace impact
