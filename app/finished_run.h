// --resume in the folder of a run that has ended.
#pragma once
#include "app/console.h"
#include "app/output.h"

namespace app {

/// Says that there is nothing to go on with, and returns the folder's result.json, which stays as it is; writes
/// report.html if the run was killed just before it.
nlohmann::ordered_json leave_as_it_is(const RunFolder& folder, Console& console);

}  // namespace app
