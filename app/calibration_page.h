// The page of `spall calibrate`: what an engineer wants to know of a fit, from result.json, curves.csv and
// frames alone.
#pragma once
#include <filesystem>

#include "app/report_words.h"
#include "report/page.h"

namespace app {

/// Everything but the provenance. Throws Json::exception if a key holds something else than it should.
report::Page calibration_page(const Json& result, const std::filesystem::path& folder);

}  // namespace app
