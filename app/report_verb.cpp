// spall report
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "app/console.h"
#include "app/report_page.h"
#include "app/report_pictures.h"
#include "app/verbs.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"

namespace app {
namespace {

struct ReportOptions {
  CommonOptions common;
  std::string folder;
  PictureRequest pictures;
  std::string pictures_folder;
};

int draw(const ReportOptions& options) {
  options.pictures.check();
  const std::filesystem::path folder = options.pictures_folder.empty()
                                           ? std::filesystem::path(options.folder) / "pictures"
                                           : std::filesystem::path(options.pictures_folder);
  const auto files = draw_pictures(page_of_run(options.folder), options.pictures, folder);
  Console console(options.common);
  nlohmann::ordered_json names = nlohmann::ordered_json::array();
  for (const std::filesystem::path& file : files) {
    console.say(fmt::format("wrote {}", file.string()));
    names.push_back(file.string());
  }
  console.result(nlohmann::ordered_json{{"pictures", names}});
  return done;
}

int report(const ReportOptions& options) {
  // A mistyped folder must not be made by the check below.
  std::error_code error;
  if (!std::filesystem::is_directory(options.folder, error))
    throw dem::InputError(options.folder, "there is no such folder", "give the folder of a finished run");
  if (options.pictures.png || options.pictures.svg) return draw(options);
  dem::require_writable_folder(options.folder);
  write_report(options.folder);
  const std::string page = (std::filesystem::path(options.folder) / "report.html").string();
  Console console(options.common);
  console.say(fmt::format("wrote {}", page));
  console.result(nlohmann::ordered_json{{"report", page}});
  return done;
}

}  // namespace

void add_report(CLI::App& root, Invocation& invocation) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* verb = add_verb(
      root, "report",
      "Write the page of a finished run, report.html, anew from its files; or its pictures, one file each",
      "spall card example -o card.toml\n"
      "spall specimen make --size \"0.4x0.2x0.2 m\" --elements 1400 --seed 1 -o s1.h5\n"
      "spall test elastic --specimen s1.h5 --card card.toml -o out/elastic\n"
      "spall report out/elastic\n"
      "spall test tension --specimen s1.h5 --card card.toml -o out/tension\n"
      "spall report out/tension --png --svg --view y --width \"120 mm\"",
      options->common);
  verb->add_option("folder", options->folder, "Folder of the run")->required();
  PictureRequest& pictures = options->pictures;
  CLI::Option* png =
      verb->add_flag("--png", pictures.png, "Write charts and scenes as PNG, into its folder pictures/");
  verb->add_flag("--svg", pictures.svg, "Write charts as SVG, in millimetres, each complete in itself");
  verb->add_option("--pictures", options->pictures_folder,
                   "Folder for the pictures (default: pictures/ in the run's)");
  verb->add_option("--width", pictures.width, "Width of the pictures (default: 160 mm)");
  verb->add_option("--dpi", pictures.dots_per_inch, "Pixels an inch of PNG (default: 200)")
      ->check(number_between(20, 1200));
  verb->add_option("--view", pictures.view,
                   fmt::format("Scenes: seen from {} (default: iso)", fmt::join(report::view_names(), ", ")));
  verb->add_option("--frame", pictures.frame, "Scenes: number of the frame, from 1 (default: last)");
  verb->add_option("--field", pictures.field, "Scenes: what colours the elements (default: damage)");
  verb->add_option("--cut", pictures.cut, "Scenes: plane before which all is taken away, as \"y=0.1 m\"");
  for (const char* name : {"--dpi", "--view", "--frame", "--field", "--cut"})
    verb->get_option(name)->needs(png);
  verb->callback([options, &invocation] { invocation.action = [options] { return report(*options); }; });
}

}  // namespace app
