// The rooms of read_study. Only the study_*.cpp files include it.
#pragma once
#include "libdem/config/toml_reader.h"
#include "libdem/core/error.h"
#include "study/study_file.h"

namespace study {

/// What a room below says about `key` gets the file and the line in front.
template <class Action>
auto told_about(const dem::TomlTable& table, const char* key, Action&& action);

/// One text or a list of texts. Refuses an empty list.
std::vector<std::string> one_or_more_texts(const dem::TomlTable& table, const char* key);

/// [[specimen]] (study_specimens.cpp).
void read_specimen_groups(const dem::TomlTable& root, Study& study);
/// design, points, sensitivity and [vary] (study_parameters.cpp).
void read_design(const dem::TomlTable& root, Study& study);
/// tests = [...] or [[test]] (study_tests.cpp).
void read_tests(const dem::TomlTable& root, Study& study);

template <class Action>
auto told_about(const dem::TomlTable& table, const char* key, Action&& action) {
  try {
    return action();
  } catch (const dem::InputError& error) {
    throw dem::InputError(table.where(key), error.what(), "");
  }
}

}  // namespace study
