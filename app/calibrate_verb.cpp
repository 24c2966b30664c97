// spall calibrate
#include <fmt/format.h>

#include "app/calibrate_output.h"
#include "app/console.h"
#include "app/finished_run.h"
#include "app/output.h"
#include "app/report_page.h"
#include "app/verbs.h"
#include "calibrate/film.h"
#include "calibrate/pipeline.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/run/checkpoint_interval.h"
#include "specimens/virtual_tests/fields.h"

namespace app {
namespace {

struct CalibrateOptions {
  CommonOptions common;
  std::string file, output;
  bool resume = false;
  int pictures = 8;
};

void tell(Console& console, const calibrate::CalibrationResult& found) {
  for (const calibrate::TargetResult& result : found.targets) {
    const calibrate::Display display = calibrate::display(result.target);
    const char* verdict = result.met() ? "met" : "MISSED";
    const std::string unit = display.unit == "-" ? "" : fmt::format("{} ", display.unit);
    if (calibrate::is_curve(result.target.quantity))
      console.say(fmt::format("  {:<28} {:.2g}% of the peak off, allowed {:.2g}%: {}", display.words,
                              100 * result.achieved, 100 * result.target.tolerance, verdict));
    else
      console.say(fmt::format("  {:<28} {:.4g} {}against {:.4g} ({:+.1f}%, allowed {:.2g}%): {}", display.words,
                              result.achieved / display.scale, unit, result.target.value / display.scale,
                              100 * result.relative_error(), 100 * result.target.tolerance, verdict));
  }
  for (const std::string& warning : found.warnings) console.remark("warning: " + warning);
}

/// What the report shows in space.
void write_pictures(const CalibrateOptions& options, const calibrate::CalibrationCase& wanted,
                    const dem::MaterialCard& card, const RunFolder& folder, Console& console) {
  if (options.pictures == 0) return;
  const calibrate::FilmedTests filmed =
      calibrate::film_tests(wanted, card, options.pictures, options.common.thread_count(), console.progress());
  for (const auto& [name, test] :
       {std::pair("tension", &filmed.tension), std::pair("compression", &filmed.compression)})
    virtual_tests::write_frames(folder.file("frames") / name, filmed.specimen, test->fields.film, test->curve);
}

calibrate::CalibrationResult run(const CalibrateOptions& options, const Invocation& invocation,
                                 const calibrate::CalibrationCase& wanted, calibrate::TestJournal& journal,
                                 const RunFolder& folder, Console& console) {
  try {
    calibrate::CalibrationResult found =
        calibrate::calibrate(wanted, journal, options.common.thread_count(), console.progress());
    write_pictures(options, wanted, found.card, folder, console);
    return found;
  } catch (const dem::Interrupted& stop) {
    throw dem::Interrupted(fmt::format("{}; {} virtual tests are kept in {}/checkpoint.h5: go on with {}",
                                       stop.what(), journal.size(), options.output,
                                       command_to_go_on(invocation)));
  }
}

int calibrate_into_folder(const CalibrateOptions& options, const Invocation& invocation,
                          const calibrate::CalibrationCase& wanted) {
  RunFolder folder(options.output, invocation, options.common);
  for (const dem::InputFile& input : wanted.inputs) folder.add_input(input);
  for (const std::uint64_t seed : wanted.fit_seeds) folder.add_seed(seed);
  for (const std::uint64_t seed : wanted.check_seeds) folder.add_seed(seed);
  folder.claim();
  Console console(options.common);
  if (options.resume && folder.is_finished())
    return leave_as_it_is(folder, console).value("complete", false) ? done : tolerance_missed;
  calibrate::TestJournal journal(folder.checkpoint(), options.resume);
  if (options.resume && journal.size() == 0)
    console.remark(
        fmt::format("{}: there is nothing to go on from; starting anew", folder.checkpoint().string()));

  const calibrate::CalibrationResult found = folder.compute_anew({"card.toml", "curves.csv"}, false, [&] {
    return run(options, invocation, wanted, journal, folder, console);
  });
  const nlohmann::ordered_json result = result_of(wanted, found);
  dem::write_file_atomically(folder.file("card.toml"), dem::to_toml(found.card));
  dem::write_file_atomically(folder.file("curves.csv"), curves_csv(wanted, found));
  folder.write(result);
  write_report(folder.path());
  console.say(fmt::format("{}: {} virtual tests in {}", wanted.name, found.virtual_tests,
                          duration(found.wall_seconds)));
  tell(console, found);
  console.say(fmt::format("card:   {}", folder.file("card.toml").string()));
  console.say(fmt::format("report: {}", folder.file("report.html").string()));
  console.result(result);
  return found.complete() ? done : tolerance_missed;
}

int calibrate_case(const CalibrateOptions& options, const Invocation& invocation) {
  use_threads(options.common);
  dem::seconds_between_checkpoints(0);  // refused here it is not taken for the case's fault
  const calibrate::CalibrationCase wanted = calibrate::read_case(options.file);
  const bool was_there = std::filesystem::exists(options.output);
  try {
    return calibrate_into_folder(options, invocation, wanted);
  } catch (const dem::InputError& error) {
    // Some packings show only once they are made that they are too small: the case is wrong all the same, and
    // leaves nothing behind.
    if (!was_there) remove_if_empty(options.output);
    throw dem::InputError(options.file, error.what(), "");
  }
}

}  // namespace

void add_calibrate(CLI::App& root, Invocation& invocation) {
  const auto options = std::make_shared<CalibrateOptions>();
  CLI::App* verb = add_verb(root, "calibrate", "Fit a material card to targets and laboratory curves",
                            "printf '[targets]\\nE = \"30 GPa\"\\nft = \"3 MPa\"\\n' > case.toml\n"
                            "printf '[fixed]\\nzeta = 5\\nCo = \"8 MPa\"\\n' >> case.toml\n"
                            "printf '[specimen]\\nsize = \"0.4x0.2x0.2 m\"\\nelements = 1400\\n' >> case.toml\n"
                            "spall calibrate case.toml -o out/fit",
                            options->common);
  verb->add_option("case", options->file, "Case (TOML): targets, curves, specimens")->required();
  verb->add_option("-o,--output", options->output,
                   "Folder for card.toml, result.json, run.json, curves.csv, report.html, frames/")
      ->required();
  verb->add_flag("--resume", options->resume, "Go on from the checkpoint in the output folder");
  verb->add_option(
          "--frames", options->pictures,
          "Pictures of the first specimen's tests with the finished card, this many to twice as many; 0: none")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  verb->callback([options, &invocation] {
    invocation.action = [options, &invocation] { return calibrate_case(*options, invocation); };
  });
}

}  // namespace app
