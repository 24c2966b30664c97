// spall report
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/console.h"
#include "app/report_page.h"
#include "app/verbs.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"

namespace app {
namespace {

struct ReportOptions {
  CommonOptions common;
  std::string folder;
};

int report(const ReportOptions& options) {
  // A mistyped folder must not be made by the check below.
  if (!std::filesystem::is_directory(options.folder))
    throw dem::InputError(options.folder, "there is no such folder", "give the folder of a finished run");
  dem::require_writable_folder(options.folder);
  write_report(options.folder);
  const std::string page = (std::filesystem::path(options.folder) / "report.html").string();
  Console console(options.common);
  console.say(fmt::format("wrote {}", page));
  console.result(nlohmann::ordered_json{{"report", page}}.dump(2));
  return done;
}

}  // namespace

void add_report(CLI::App& root, Invocation& invocation) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* verb =
      add_verb(root, "report", "Write the page of a finished run, report.html, anew from its files",
               "spall card example -o card.toml\n"
               "spall specimen make --size \"0.4x0.2x0.2 m\" --elements 1400 --seed 1 -o s1.h5\n"
               "spall test elastic --specimen s1.h5 --card card.toml -o out/elastic\n"
               "spall report out/elastic",
               options->common);
  verb->add_option("folder", options->folder, "Folder of the run")->required();
  verb->callback([options, &invocation] { invocation.action = [options] { return report(*options); }; });
}

}  // namespace app
