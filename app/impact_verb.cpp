// spall impact
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "app/console.h"
#include "app/finished_run.h"
#include "app/output.h"
#include "app/report_page.h"
#include "app/verbs.h"
#include "impact/frames.h"
#include "impact/histories.h"
#include "impact/impact_output.h"
#include "impact/impact_run.h"
#include "impact/missile.h"
#include "impact/scene_file.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/run/checkpoint_interval.h"

namespace app {
namespace {

struct ImpactOptions {
  CommonOptions common;
  std::string file, card, output;
  bool resume = false;
};

/// Runs it from the checkpoint if that is wanted; a stop leaves a checkpoint and says how to go on.
impact::ImpactResult run_or_stop(const ImpactOptions& options, const Invocation& invocation,
                                 const impact::Scene& scene, const RunFolder& folder, Console& console) {
  const std::filesystem::path checkpoint = folder.checkpoint();
  const bool goes_on = options.resume && std::filesystem::exists(checkpoint);
  if (options.resume && !goes_on)
    console.remark(fmt::format("{}: there is nothing to go on from; starting anew", checkpoint.string()));
  // Made with the first frame: a scene that is refused before leaves nothing behind.
  std::optional<impact::FrameWriter> frames;
  const impact::FrameCallback picture = [&](const impact::Frame& frame) {
    if (!frames) {
      // A former run's state does not go with this one's pictures.
      std::error_code ignored;
      if (!goes_on) std::filesystem::remove(checkpoint, ignored);
      frames.emplace(scene, folder.file("frames"), goes_on);
    }
    frames->write(frame);
  };
  try {
    return impact::run_impact(
        scene, options.common.thread_count(), console.progress(),
        scene.frames > 0 ? picture : impact::FrameCallback(),
        {.file = checkpoint,
         .resume = options.resume,
         .interval = dem::seconds_between_checkpoints(impact::ImpactCheckpoint().interval)});
  } catch (const dem::Interrupted& stop) {
    // While the structure is packed there is nothing to keep yet.
    if (!std::filesystem::exists(checkpoint)) throw;
    throw dem::Interrupted(fmt::format("{}; its state is kept in {}: go on with {}", stop.what(),
                                       checkpoint.string(), command_to_go_on(invocation)));
  }
}

void tell_formulas(Console& console, const impact::Scene& scene) {
  const impact::FormulaCheck check = impact::check_formulas(scene);
  if (!check.misfit.empty()) {
    if (scene.impactor) console.say("NDRC and CEA-EDF do not apply: " + check.misfit);
    return;
  }
  const double thickness = check.missile.thickness;
  const auto range = [](const std::vector<impact::ValidityRange>& ranges) {
    return impact::applies(ranges) ? "" : " (outside its range)";
  };
  console.say(
      fmt::format("modified NDRC: {:.3g} mm deep; perforates up to {:.3g} mm{}, scabs up to {:.3g} mm{}",
                  1e3 * check.ndrc.penetration_depth, 1e3 * check.ndrc.perforation_thickness,
                  range(check.ndrc.perforation_ranges), 1e3 * check.ndrc.scabbing_thickness,
                  range(check.ndrc.scabbing_ranges)));
  if (check.cea_edf)
    console.say(fmt::format("CEA-EDF: {:.3g} mm are perforated from {:.3g} m/s on{}", 1e3 * thickness,
                            check.cea_edf->perforation_velocity, range(check.cea_edf->ranges)));
}

void tell(Console& console, const impact::Scene& scene, const impact::ImpactResult& found) {
  for (const auto& [probe, largest] : found.max_displacement)
    console.say(fmt::format("largest displacement at {}: {:.4g} mm", probe, 1e3 * largest));
  if (scene.impactor)
    console.say(fmt::format("peak force {:.4g} kN, impulse {:.4g} N s; the impactor goes at {:.4g} m/s: {}",
                            found.peak_force / 1e3, found.impulse.norm(), found.residual_velocity,
                            name_of(found.impactor.passage)));
  const impact::DetachedSum detached = sum_detached(found.fragments);
  console.say(fmt::format("{} of {} links broken; {} fragments of {:.3g} kg together came off",
                          found.broken_links, found.links, detached.fragments, detached.mass));
  tell_formulas(console, scene);
  console.say(fmt::format("{} steps in {}; energy balance {:.2g}%, momentum {:.1g}", found.steps,
                          duration(found.wall_seconds), 100 * found.energy_balance_error,
                          found.momentum_error));
  for (const std::string& warning : found.warnings) console.remark("warning: " + warning);
}

int run_into_folder(const ImpactOptions& options, const Invocation& invocation, const impact::Scene& scene) {
  RunFolder folder(options.output, invocation, options.common);
  for (const dem::InputFile& input : scene.inputs) folder.add_input(input);
  folder.add_seed(scene.seed);
  folder.claim();
  Console console(options.common);
  if (options.resume && folder.is_finished()) {
    leave_as_it_is(folder, console);
    return done;
  }
  const bool goes_on = options.resume && std::filesystem::exists(folder.checkpoint());
  const impact::ImpactResult found =
      folder.compute_anew({"curves.csv", "history.h5", "fragments.csv"}, goes_on,
                          [&] { return run_or_stop(options, invocation, scene, folder, console); });

  const nlohmann::ordered_json result = impact::result_of(scene, found, options.common.thread_count());
  dem::write_file_atomically(folder.file("curves.csv"), impact::curves_csv(scene, found.history));
  impact::write_history(folder.file("history.h5"), scene, found.history);
  dem::write_file_atomically(folder.file("fragments.csv"), impact::fragments_csv(found.fragments));
  folder.write(result);
  write_report(folder.path());
  tell(console, scene, found);
  if (scene.frames > 0)
    console.say(fmt::format("frames: {} and others beside it, for ParaView",
                            (folder.file("frames") / "elements.hdf.series").string()));
  console.say(fmt::format("wrote {} and report.html", folder.file("result.json").string()));
  console.result(result);
  folder.remove_checkpoints();
  return done;
}

int run_case(const ImpactOptions& options, const Invocation& invocation) {
  use_threads(options.common);
  const impact::Scene scene = impact::read_scene(
      options.file, options.card.empty() ? std::nullopt : std::optional<std::filesystem::path>(options.card));
  const bool was_there = std::filesystem::exists(options.output);
  try {
    return run_into_folder(options, invocation, scene);
  } catch (const dem::InputError&) {
    // Some of it shows only once the structure is packed: an impactor inside it, a support on nothing.
    if (!was_there) remove_if_empty(options.output);
    throw;
  }
}

}  // namespace

void add_impact(CLI::App& root, Invocation& invocation) {
  const auto options = std::make_shared<ImpactOptions>();
  CLI::App* verb = add_verb(
      root, "impact", "Let an impactor strike a structure of discrete elements, alone or tied to finite ones",
      "spall card example -o card.toml\n"
      "printf 'model = \"de\"\\ncard = \"card.toml\"\\n' > slab.toml\n"
      "printf '[structure]\\nsize = \"0.24x0.24x0.08 m\"\\nelements = 2000\\n' >> slab.toml\n"
      "printf '[[support]]\\nname = \"edge\"\\nlow = \"0,0,0 m\"\\nhigh = \"0.03,0.24,0.08 m\"\\n' >> "
      "slab.toml\n"
      "printf 'lock = [\"z\"]\\n[impactor]\\nshape = \"sphere\"\\ndiameter = \"40 mm\"\\n' >> slab.toml\n"
      "printf 'density = \"7850 kg/m3\"\\nspeed = \"20 m/s\"\\naim = \"0.12,0.12,0.04 m\"\\n' >> slab.toml\n"
      "printf '[run]\\nduration = \"0.5 ms\"\\n' >> slab.toml\n"
      "spall impact slab.toml -o out/impact",
      options->common);
  verb->add_option("case", options->file, "Case (TOML): structure, supports, impactor, duration")->required();
  verb->add_option("--card", options->card,
                   "Material card in place of the case's, for instance one that spall calibrate wrote");
  verb->add_option(
          "-o,--output", options->output,
          "Folder for result.json, run.json, curves.csv, history.h5, fragments.csv, report.html, frames/")
      ->required();
  verb->add_flag("--resume", options->resume, "Go on from the checkpoint in the output folder");
  verb->callback([options, &invocation] {
    invocation.action = [options, &invocation] { return run_case(*options, invocation); };
  });
}

}  // namespace app
