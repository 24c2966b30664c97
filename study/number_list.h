// "1-10, 12": lists of whole numbers as people write them, for seeds and for task numbers.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace study {

/// Numbers and ranges (both ends belong to it), separated by commas, in the order given. Throws InputError that
/// begins with `where` for anything else, a number outside [low, high], a range that runs down, one that
/// stands twice, or more than a million numbers.
std::vector<std::uint64_t> parse_number_list(std::string_view text, std::uint64_t low, std::uint64_t high,
                                             const std::string& where);

}  // namespace study
