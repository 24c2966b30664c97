// The part of a study's page that says what its rows show together.
#pragma once
#include <string>
#include <vector>

#include "app/report_words.h"
#include "report/page.h"

namespace app {

/// "ft" -> tensile strength, "tension.peak_strain" -> strain at the peak (tension).
Label label_of_quantity(const std::string& name);

/// From the `statistics`, `rows` and `summary` of a study's result.json: scatter drawn specimen by specimen,
/// tests of effects in words, E and nu against the card, Fig. 4, Sobol indices. Only what is there.
std::vector<report::Section> statistics_sections(const Json& result);

}  // namespace app
