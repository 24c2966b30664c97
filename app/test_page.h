// The page of `spall test`.
#pragma once
#include <filesystem>

#include "app/report_words.h"
#include "report/page.h"

namespace app {

/// From result.json and curves.csv, without title and provenance.
report::Page test_page(const Json& result, const std::filesystem::path& curves);

}  // namespace app
