// From the files of a run to the page that people look at.
#pragma once
#include <filesystem>

#include "report/page.h"

namespace app {

/// What people see of the run in `folder`, from its result.json, run.json, curves.csv and frames. Throws
/// InputError if there is no result to show.
report::Page page_of_run(const std::filesystem::path& folder);

/// Writes that page to report.html in the folder. Throws InputError if
/// there is no result to show, RunError if the page cannot be written.
void write_report(const std::filesystem::path& folder);

}  // namespace app
