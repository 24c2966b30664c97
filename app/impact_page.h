// The page of `spall impact`.
#pragma once
#include <filesystem>

#include "app/report_words.h"
#include "report/page.h"

namespace app {

/// From what the run left in `folder`: result.json, curves.csv and frames alone; everything but the provenance.
report::Page impact_page(const Json& result, const std::filesystem::path& folder);

}  // namespace app
