// From the files of a run to the page that people look at.
#pragma once
#include <filesystem>

namespace app {

/// Reads result.json, run.json and curves.csv in `folder` and writes report.html there. Throws InputError if
/// there is no result to show, RunError if the page cannot be written.
void write_report(const std::filesystem::path& folder);

}  // namespace app
