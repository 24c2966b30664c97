// A test's options out of a TOML table, by the catalogue's description of them.
#pragma once
#include <string>
#include <vector>

#include "libdem/config/toml_reader.h"
#include "specimens/virtual_tests/catalogue.h"

namespace virtual_tests {

/// The keys of one test's options; of all tests'.
std::vector<std::string> option_keys(const TestDescription& test);
std::vector<std::string> all_option_keys();

/// The test's defaults with what the table gives. Keys in `beside` are the caller's own. Throws InputError for
/// a value that is out of bounds, or an option that only other tests have.
TestOptions read_options(const dem::TomlTable& table, const TestDescription& test,
                         const std::vector<std::string>& beside);

}  // namespace virtual_tests
