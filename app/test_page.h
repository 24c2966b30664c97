// The page of `spall test`.
#pragma once
#include <filesystem>

#include "app/report_words.h"
#include "report/page.h"

namespace app {

/// From what the run left in `folder`: result.json, curves.csv and frames, without title and provenance.
report::Page test_page(const Json& result, const std::filesystem::path& folder);

}  // namespace app
