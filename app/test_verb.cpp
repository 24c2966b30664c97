// spall test elastic | tension | compression
#include <fmt/format.h>

#include "app/console.h"
#include "app/output.h"
#include "app/report_page.h"
#include "app/verbs.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/core/units.h"
#include "specimens/specimen_file.h"
#include "specimens/virtual_tests/elastic.h"
#include "specimens/virtual_tests/fields.h"
#include "specimens/virtual_tests/setup.h"
#include "specimens/virtual_tests/uniaxial.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

struct TestOptions {
  CommonOptions common;
  std::string specimen, card, output, axis, velocity, max_strain, ends = "free";
  bool resume = false;
  virtual_tests::UniaxialOptions uniaxial;
};

int axis_of(const TestOptions& options) { return options.axis.empty() ? -1 : options.axis[0] - 'x'; }

/// A quantity given as text on the command line; 0, "the test's own choice", if it was not given.
double positive(const std::string& text, dem::Quantity kind, const std::string& where) {
  if (text.empty()) return 0;
  const double value = dem::parse_quantity(text, kind, where);
  if (!(value > 0))
    throw dem::InputError(where, fmt::format("\"{}\" is not positive", text),
                          fmt::format("write it as in \"{}\"", dem::example(kind)));
  return value;
}

/// The two inputs of every test, and the folder for what comes out: everything that can be refused before
/// computing.
struct Inputs {
  specimens::Specimen specimen;
  dem::MaterialCard card;
  int axis;
  RunFolder folder;
};

Inputs read_inputs(const TestOptions& options, const Invocation& invocation) {
  use_threads(options.common);
  dem::MaterialCard card = dem::read_card(options.card);
  specimens::Specimen specimen = specimens::read_specimen(options.specimen);
  const int axis = virtual_tests::loading_axis(specimen, axis_of(options));
  virtual_tests::gauge_elements(specimen, axis);  // refuses a specimen that is too small
  Inputs inputs{std::move(specimen), std::move(card), axis,
                RunFolder(options.output, invocation, options.common)};
  inputs.folder.add_input(options.specimen);
  inputs.folder.add_input(options.card);
  inputs.folder.add_seed(inputs.specimen.seed);
  return inputs;
}

void finish(Console& console, const Inputs& inputs, const Json& result) {
  inputs.folder.write(result);
  write_report(inputs.folder.path());
  console.say(fmt::format("wrote {} and report.html", inputs.folder.file("result.json").string()));
  console.result(result.dump(2));
}

int run_elastic(const TestOptions& options, const Invocation& invocation) {
  const Inputs inputs = read_inputs(options, invocation);
  Console console(options.common);
  const auto found = virtual_tests::run_elastic(inputs.specimen, inputs.card, {.axis = inputs.axis});
  Json result;
  result["test"] = "elastic";
  result["E"] = found.young_modulus;
  result["nu"] = found.poisson_ratio;
  result["links"] = inputs.specimen.links.size();
  result["elements"] = inputs.specimen.elements();
  result["axis"] = std::string(1, "xyz"[inputs.axis]);
  result["iterations"] = found.iterations;
  result["threads"] = options.common.thread_count();
  result["wall_seconds"] = found.wall_seconds;
  console.say(fmt::format("E = {:.4g} GPa ({:+.2f}% of the card's), nu = {:.4f} (card: {:.4f}), {:.2f} s",
                          found.young_modulus / 1e9,
                          100 * (found.young_modulus / inputs.card.young_modulus - 1), found.poisson_ratio,
                          inputs.card.poisson_ratio, found.wall_seconds));
  finish(console, inputs, result);
  return done;
}

Json result_of(const virtual_tests::UniaxialResult& found, const virtual_tests::UniaxialOptions& asked,
               const specimens::Specimen& specimen) {
  Json result;
  result["test"] = virtual_tests::name_of(asked.loading);
  result["ends"] = dem::name_of(asked.ends);
  if (asked.ends == dem::EndCondition::rough) result["platen_friction"] = asked.platen_friction;
  result["axis"] = std::string(1, "xyz"[asked.axis]);
  result["peak_stress"] = found.peak_stress;
  result["peak_strain"] = found.peak_strain;
  result["E"] = found.young_modulus;
  result["nu"] = found.poisson_ratio;
  result["work_of_fracture"] = found.work_of_fracture;
  result["passed_peak"] = found.passed_peak;
  result["quasi_static"] = found.quasi_static();
  result["broken_links"] = found.broken_links;
  result["links"] = found.links;
  result["elements"] = specimen.elements();
  result["damage"] = found.damage_ratio();
  result["velocity"] = found.velocity;
  result["damping"] = asked.damping;
  result["steps"] = found.steps;
  result["time_step"] = found.time_step;
  result["critical_time_step"] = found.critical_time_step;
  result["threads"] = asked.threads;
  result["step_loop_seconds"] = found.step_loop_seconds;
  result["wall_seconds"] = found.wall_seconds;
  result["energy_balance_error"] = found.energy_balance_error;
  result["unbalanced_force_ratio"] = found.unbalanced_force_ratio;
  result["state_sha256"] = found.state_sha256;
  return result;
}

/// Runs it from the checkpoint if that is wanted; a stop leaves a checkpoint and says how to go on.
virtual_tests::UniaxialResult run_or_stop(const TestOptions& options, const Invocation& invocation,
                                          const Inputs& inputs, const virtual_tests::UniaxialOptions& asked,
                                          Console& console) {
  const std::filesystem::path checkpoint = inputs.folder.file("checkpoint.h5");
  if (options.resume && !std::filesystem::exists(checkpoint))
    console.remark(fmt::format("{}: there is nothing to go on from; starting anew", checkpoint.string()));
  try {
    return virtual_tests::run_uniaxial(inputs.specimen, inputs.card, asked, console.progress(),
                                       {.file = checkpoint, .resume = options.resume});
  } catch (const dem::Interrupted& stop) {
    throw dem::Interrupted(fmt::format("{}; its state is kept in {}: go on with {}", stop.what(),
                                       checkpoint.string(), command_to_go_on(invocation)));
  }
}

int run_uniaxial(const TestOptions& options, const Invocation& invocation, virtual_tests::Loading loading) {
  virtual_tests::UniaxialOptions asked = options.uniaxial;
  asked.loading = loading;
  asked.ends = dem::end_condition(options.ends);
  asked.velocity = positive(options.velocity, dem::Quantity::velocity, "--velocity");
  asked.max_strain = positive(options.max_strain, dem::Quantity::ratio, "--max-strain");
  asked.threads = options.common.thread_count();
  asked.validate();
  const Inputs inputs = read_inputs(options, invocation);
  asked.axis = inputs.axis;
  Console console(options.common);
  const auto found = run_or_stop(options, invocation, inputs, asked, console);

  dem::write_file_atomically(inputs.folder.file("curves.csv"), virtual_tests::to_csv(found.curve));
  virtual_tests::write_element_fields(inputs.folder.file("fields.h5"), inputs.specimen, found);
  virtual_tests::write_link_fields(inputs.folder.file("links.h5"), inputs.specimen, found);
  console.say(fmt::format("peak {:.4g} MPa at {:.4g} permil, {} of {} links broken, {} steps in {}",
                          found.peak_stress / 1e6, found.peak_strain * 1e3, found.broken_links, found.links,
                          found.steps, duration(found.wall_seconds)));
  if (!found.passed_peak)
    console.remark("the largest strain came before the end of the post-peak; raise --max-strain to see more");
  if (!found.quasi_static())
    console.remark(
        fmt::format("not quasi-static: the platens differ by {:.1f}%; lower --velocity (it was {:.3g} m/s)",
                    100 * found.unbalanced_force_ratio, found.velocity));
  finish(console, inputs, result_of(found, asked, inputs.specimen));
  std::error_code ignored;  // a finished test needs none; one that stays does no harm
  std::filesystem::remove(inputs.folder.file("checkpoint.h5"), ignored);
  return done;
}

}  // namespace

void add_test(CLI::App& root, Invocation& invocation) {
  CLI::App* test = root.add_subcommand("test", "Run a virtual laboratory test on a specimen");
  test->require_subcommand(1);
  const auto options = std::make_shared<TestOptions>();
  const auto add = [&](const std::string& name, const std::string& description,
                       const std::function<int()>& action) {
    const std::string example =
        "spall card example -o card.toml\n"
        "spall specimen make --size \"0.4x0.2x0.2 m\" --elements 1400 --seed 1 -o s1.h5\n"
        "spall test " +
        name + " --specimen s1.h5 --card card.toml -o out/" + name;
    CLI::App* verb = add_verb(*test, name, description, example, options->common);
    verb->add_option("--specimen", options->specimen, "Specimen (HDF5)")->required();
    verb->add_option("--card", options->card, "Material card (TOML)")->required();
    verb->add_option("-o,--output", options->output,
                     name == "elastic"
                         ? "Folder for result.json, run.json, report.html"
                         : "Folder for result.json, run.json, curves.csv, report.html, fields.h5, links.h5")
        ->required();
    verb->add_option("--axis", options->axis, "Loading axis: x, y or z (default: the specimen's long axis)")
        ->check(CLI::IsMember({"x", "y", "z"}));
    verb->callback([action, &invocation] { invocation.action = action; });
    return verb;
  };
  add("elastic", "Young's modulus and Poisson's ratio, by one static solve",
      [options, &invocation] { return run_elastic(*options, invocation); });
  for (const auto loading : {virtual_tests::Loading::tension, virtual_tests::Loading::compression}) {
    const bool tension = loading == virtual_tests::Loading::tension;
    CLI::App* verb =
        add(tension ? "tension" : "compression",
            fmt::format("Uniaxial {} to past the peak, quasi-static", tension ? "tension" : "compression"),
            [options, &invocation, loading] { return run_uniaxial(*options, invocation, loading); });
    verb->add_option("--ends", options->ends,
                     tension ? "Ends: free or fixed laterally, default free"
                             : "Platens: free, fixed (glued) or rough (dry friction), default free")
        ->check(CLI::IsMember(dem::end_condition_names()));
    if (!tension)
      verb->add_option("--platen-friction", options->uniaxial.platen_friction,
                       "Coefficient of friction of rough platens, default 0.2")
          ->check(number_between(0, 2));
    verb->add_option(
        "--velocity", options->velocity,
        "Speed at which the platens approach or part, as \"0.02 m/s\" (default: slow enough for the card)");
    verb->add_option("--damping", options->uniaxial.damping, "Local damping, default 0.3")
        ->check(number_between(0, 0.99));
    verb->add_option("--stop-at", options->uniaxial.stop_at,
                     fmt::format("End when the stress has fallen to this part of the peak, default {}",
                                 tension ? "0.15" : "0.6"))
        ->check(number_between(0.001, 0.999));
    verb->add_option("--max-strain", options->max_strain, "End at this strain at the latest, as \"3 permil\"");
    verb->add_flag("--resume", options->resume, "Go on from the checkpoint in the output folder");
  }
}

}  // namespace app
