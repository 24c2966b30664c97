// The page of `spall impact`.
#pragma once
#include <filesystem>

#include "app/report_words.h"
#include "report/page.h"

namespace app {

/// From result.json and curves.csv alone; everything but the provenance.
report::Page impact_page(const Json& result, const std::filesystem::path& curves);

}  // namespace app
