// The page of a study, from its result.json.
#pragma once
#include "app/report_words.h"

namespace app {

/// Summary, rows by test, settings where there are several, failures.
report::Page study_page(const Json& result);

}  // namespace app
