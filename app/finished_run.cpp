#include "app/finished_run.h"

#include <fmt/format.h>

#include <fstream>

#include "app/report_page.h"

namespace app {

nlohmann::ordered_json leave_as_it_is(const RunFolder& folder, Console& console) {
  if (!std::filesystem::exists(folder.file("report.html"))) write_report(folder.path());
  folder.remove_checkpoints();  // of a run that was killed just before it took them away
  console.remark(fmt::format("{}: the run is finished and stays as it is; without --resume it starts anew",
                             folder.file("result.json").string()));
  std::ifstream in(folder.file("result.json"));
  nlohmann::ordered_json result = nlohmann::ordered_json::parse(in);
  console.result(result);
  return result;
}

}  // namespace app
