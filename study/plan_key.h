// What names a result: the SHA-256 of everything that it depends on, and of nothing else.
#pragma once
#include <string>

#include "study/study_file.h"

namespace study {

/// Raise it whenever the numbers of a test, or what is kept of it, change: results of before are then not taken
/// for results of now.
inline constexpr int result_version = 2;
/// Raise it whenever the same packing options give another specimen.
inline constexpr int packing_version = 1;

/// Everything that the specimen depends on, as text: the packing's options, or the hash of what a file holds.
std::string key_text(const SpecimenRecipe& recipe);
/// 64 hexadecimal digits: the name of the packed specimen's file.
std::string key_of(const SpecimenRecipe& recipe);

/// 64 hexadecimal digits: the name of the result. Names of groups, cards and tests do not enter, nor does the
/// number of threads. An elastic test depends on the card through the links' stiffness only, so settings that
/// differ in strength share one result.
std::string task_key(const SpecimenRecipe& recipe, const dem::MaterialCard& card, const VirtualTest& test);

}  // namespace study
