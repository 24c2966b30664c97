// spall test elastic | tension | compression | splitting | ...: every test of the catalogue.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>

#include "app/console.h"
#include "app/finished_run.h"
#include "app/output.h"
#include "app/report_page.h"
#include "app/report_words.h"
#include "app/verbs.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/core/units.h"
#include "libdem/material/card_table.h"
#include "libdem/run/checkpoint_interval.h"
#include "specimens/specimen_file.h"
#include "specimens/virtual_tests/catalogue.h"
#include "specimens/virtual_tests/fields.h"

namespace app {
namespace {

using virtual_tests::TestDescription;
using virtual_tests::TestOption;

/// What was typed.
struct TestCommand {
  CommonOptions common;
  std::string specimen, card, output;
  bool resume = false, rate_check = false;
  int pictures = 12;
  std::map<std::string, std::string> words;  ///< by the option's key
  std::map<std::string, bool> flags;
};

std::string long_name(const TestOption& option) {
  std::string name = "--" + option.key;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

virtual_tests::Value value_of(const TestOption& option, const std::string& text) {
  if (option.kind == TestOption::Kind::choice) return text;
  if (option.kind == TestOption::Kind::number) return std::strtod(text.c_str(), nullptr);
  const std::string where = long_name(option);
  const double value = dem::parse_quantity(text, option.quantity, where);
  if (!(value > option.low))
    throw dem::InputError(where,
                          option.low == 0 ? fmt::format("\"{}\" is not positive", text)
                                          : fmt::format("\"{}\" is not above {:.4g}", text, option.low),
                          fmt::format("write it as in \"{}\"", dem::example(option.quantity)));
  if (!(value <= option.high))
    throw dem::InputError(where, fmt::format("\"{}\" is too much", text),
                          fmt::format("allowed: up to {:.4g} {}", option.high, dem::si_unit(option.quantity)));
  return value;
}

virtual_tests::TestOptions options_of(const TestDescription& test, const TestCommand& command) {
  virtual_tests::TestOptions options = test.defaults;
  for (const TestOption& option : test.options) {
    if (const auto flag = command.flags.find(option.key); flag != command.flags.end() && flag->second)
      option.set(options, true);
    if (const auto word = command.words.find(option.key); word != command.words.end() && !word->second.empty())
      option.set(options, value_of(option, word->second));
  }
  virtual_tests::set_threads(options, command.common.thread_count());
  return options;
}

/// The two inputs of every test, and the folder for what comes out: everything that can be refused before
/// computing.
struct Inputs {
  specimens::Specimen specimen;
  dem::MaterialCard card;
  RunFolder folder;
};

Inputs read_inputs(const TestCommand& command, const TestDescription& test,
                   const virtual_tests::TestOptions& options, const Invocation& invocation) {
  use_threads(command.common);
  const dem::TomlTable table = dem::TomlTable::read(command.card);
  dem::MaterialCard card = dem::card_of(table);
  specimens::Specimen specimen = specimens::read_specimen(command.specimen);
  test.check(specimen, card, options);
  Inputs inputs{std::move(specimen), std::move(card), RunFolder(command.output, invocation, command.common)};
  inputs.folder.add_input(command.specimen);
  inputs.folder.add_input({"card", command.card, table.sha256()});
  inputs.folder.add_seed(inputs.specimen.seed);
  return inputs;
}

Json result_of(const TestDescription& test, const virtual_tests::TestOutcome& found, const TestCommand& command,
               const Inputs& inputs) {
  Json result;
  result["test"] = test.name;
  for (const auto& [key, value] : virtual_tests::values_of(found))
    result[key] = std::visit([](const auto& held) { return Json(held); }, value);
  result["elements"] = found.tested ? found.tested->elements() : inputs.specimen.elements();
  result["threads"] = command.common.thread_count();
  if (found.run) result["step_loop_seconds"] = found.run->step_loop_seconds;
  result["wall_seconds"] = found.wall_seconds;
  return result;
}

/// Keeps the state of a test in `file`, and goes on from there if that is wanted.
virtual_tests::CheckpointPolicy kept_in(const std::filesystem::path& file, const TestCommand& command) {
  return {
      .file = file,
      .seconds_between = dem::seconds_between_checkpoints(virtual_tests::CheckpointPolicy().seconds_between),
      .resume = command.resume};
}

/// Runs it from the checkpoint if that is wanted; a stop leaves a checkpoint and says how to go on.
virtual_tests::TestOutcome run_or_stop(const TestCommand& command, const Invocation& invocation,
                                       const Inputs& inputs, const virtual_tests::TestOptions& options,
                                       Console& console) {
  const std::filesystem::path checkpoint = inputs.folder.checkpoint();
  // What an earlier run at half the speed left must not be met by the second test of this one, hours later.
  std::error_code ignored;
  if (!command.resume) std::filesystem::remove(inputs.folder.half_speed_checkpoint(), ignored);
  if (command.resume && !std::filesystem::exists(checkpoint))
    console.remark(fmt::format("{}: there is nothing to go on from; starting anew", checkpoint.string()));
  try {
    virtual_tests::CheckpointPolicy policy = kept_in(checkpoint, command);
    policy.pictures = command.pictures;
    return virtual_tests::run_test(inputs.specimen, inputs.card, options, console.progress(), policy);
  } catch (const dem::Interrupted& stop) {
    // A static solve keeps none.
    if (!std::filesystem::exists(checkpoint)) throw;
    throw dem::Interrupted(fmt::format("{}; its state is kept in {}: go on with {}", stop.what(),
                                       checkpoint.string(), command_to_go_on(invocation)));
  }
}

/// A stop leaves a checkpoint of its own and says how to go on: what the first test kept serves again, too.
std::optional<virtual_tests::RateCheck> check_rate_or_stop(const TestCommand& command,
                                                           const Invocation& invocation, const Inputs& inputs,
                                                           const virtual_tests::TestOptions& options,
                                                           const virtual_tests::TestOutcome& found,
                                                           Console& console) {
  try {
    return virtual_tests::check_rate(inputs.specimen, inputs.card, options, found, console.progress(),
                                     kept_in(inputs.folder.half_speed_checkpoint(), command));
  } catch (const dem::Interrupted& stop) {
    throw dem::Interrupted(fmt::format("{} while the test ran once more at half the speed: go on with {}",
                                       stop.what(), command_to_go_on(invocation)));
  }
}

void say_what_came_out(const TestDescription& test, const virtual_tests::TestOutcome& found,
                       const dem::MaterialCard& card, Console& console) {
  if (!found.run) {
    console.say(fmt::format("E = {:.4g} GPa ({:+.2f}% of the card's), nu = {:.4f} (card: {:.4f}), {:.2f} s",
                            found.value("E") / 1e9, 100 * (found.value("E") / card.young_modulus - 1),
                            found.value("nu"), card.poisson_ratio, found.wall_seconds));
    return;
  }
  std::string line;
  for (const auto& [key, value] : found.measured)
    line += fmt::format("{}{} {}", line.empty() ? "" : ", ", label_of(key).words, value_words(key, value));
  console.say(fmt::format("{}; {} of {} links broken, {} steps in {}", line, found.run->broken_links,
                          found.run->links, found.run->steps, duration(found.wall_seconds)));
  if (!found.run->passed_peak && test.dynamic)
    console.remark("the bar did not break; raise --pulse-stress, or strike it for longer");
  else if (!found.run->passed_peak)
    console.remark(fmt::format(
        "the largest {} came before the end of the post-peak; raise it to see more",
        test.name == "tension" || test.name == "compression" ? "strain (--max-strain)" : "displacement"));
  if (!found.run->energy_balanced())
    console.remark(
        fmt::format("the energy balance is open by {:.1f}% of the work done; lower --time-step-fraction to see "
                    "whether results change",
                    100 * found.run->energy_balance_error));
  if (!found.run->quasi_static())
    console.remark(
        fmt::format("not quasi-static: the forces that balance differ by {:.1f}%; lower --velocity (it was "
                    "{:.3g} m/s)",
                    100 * found.run->unbalanced_force_ratio, found.run->velocity));
}

int run_test(const TestDescription& test, const TestCommand& command, const Invocation& invocation) {
  const virtual_tests::TestOptions options = options_of(test, command);
  Inputs inputs = read_inputs(command, test, options, invocation);
  Console console(command.common);
  inputs.folder.claim();
  if (command.resume && inputs.folder.is_finished()) {
    leave_as_it_is(inputs.folder, console);
    return done;
  }
  const virtual_tests::TestOutcome found =
      inputs.folder.compute_anew({"curves.csv", "fields.h5", "links.h5"}, false,
                                 [&] { return run_or_stop(command, invocation, inputs, options, console); });
  const specimens::Specimen& tested = found.tested ? *found.tested : inputs.specimen;
  if (!found.curve.empty())
    dem::write_file_atomically(inputs.folder.file("curves.csv"), virtual_tests::to_csv(found.curve));
  if (!found.fields.damage.empty()) {
    virtual_tests::write_element_fields(inputs.folder.file("fields.h5"), tested, found.fields);
    virtual_tests::write_link_fields(inputs.folder.file("links.h5"), tested, found.fields);
  }
  if (found.fields.film.is_wanted())
    virtual_tests::write_frames(inputs.folder.file("frames"), tested, found.fields.film, found.curve);
  say_what_came_out(test, found, inputs.card, console);
  Json result = result_of(test, found, command, inputs);
  if (command.rate_check) {
    const auto check = check_rate_or_stop(command, invocation, inputs, options, found, console);
    if (check) {
      result["rate_check"] = {{"quantity", check->quantity},
                              {"velocity", check->velocity},
                              {"value", check->value},
                              {"change", check->change}};
      console.say(fmt::format("at half the speed {} is {}: {:+.2f}%", label_of(check->quantity).words,
                              value_words(check->quantity, check->value), 100 * check->change));
    }
  }
  inputs.folder.write(result);
  write_report(inputs.folder.path());
  console.say(fmt::format("wrote {} and report.html", inputs.folder.file("result.json").string()));
  console.result(result);
  inputs.folder.remove_checkpoints();
  return done;
}

void add_option(CLI::App& verb, const TestOption& option, TestCommand& command) {
  const std::string name = long_name(option);
  switch (option.kind) {
    case TestOption::Kind::flag:
      verb.add_flag(name, command.flags[option.key], option.help);
      return;
    case TestOption::Kind::quantity:
      verb.add_option(name, command.words[option.key],
                      fmt::format("{}, as \"{}\" (default: {})", option.help, dem::example(option.quantity),
                                  option.fallback));
      return;
    case TestOption::Kind::number:
      verb.add_option(name, command.words[option.key],
                      fmt::format("{} (default: {})", option.help, option.fallback))
          ->check(number_between(option.low, option.high));
      return;
    case TestOption::Kind::choice:
      verb.add_option(name, command.words[option.key],
                      fmt::format("{} (default: {})", option.help, option.fallback))
          ->check(CLI::IsMember(option.choices));
  }
}

void add_one(CLI::App& parent, const TestDescription& test, Invocation& invocation) {
  const auto command = std::make_shared<TestCommand>();
  const std::string example = fmt::format(
      "spall card example -o card.toml\nspall specimen make {} -o s1.h5\n"
      "spall test {} --specimen s1.h5 --card card.toml{} -o out/{}",
      test.example_specimen, test.name, test.example_options, test.name);
  CLI::App* verb = add_verb(parent, test.name, test.summary, example, command->common);
  verb->add_option("--specimen", command->specimen, "Specimen (HDF5)")->required();
  verb->add_option("--card", command->card, "Material card (TOML)")->required();
  const bool steps = test.usual_rate > 0 || test.dynamic;
  verb->add_option(
          "-o,--output", command->output,
          steps ? "Folder for result.json, run.json, curves.csv, report.html, fields.h5, links.h5, frames/"
                : "Folder for result.json, run.json, report.html")
      ->required();
  for (const TestOption& option : test.options) add_option(*verb, option, *command);
  const auto has = [&](const char* key) {
    return std::any_of(test.options.begin(), test.options.end(),
                       [&](const TestOption& option) { return option.key == key; });
  };
  if (has("velocity") && has("rate")) verb->get_option("--velocity")->excludes("--rate");
  if (steps) {
    verb->add_flag("--resume", command->resume, "Go on from the checkpoint in the output folder");
    verb->add_option(
            "--frames", command->pictures,
            "Pictures of the test's course for report and ParaView, this many to twice as many; 0: none")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    if (!test.dynamic)
      verb->add_flag("--rate-check", command->rate_check,
                     "Run once more at half the speed and say what the main quantity does");
  }
  verb->callback([command, &test, &invocation] {
    invocation.action = [command, &test, &invocation] { return run_test(test, *command, invocation); };
  });
}

}  // namespace

void add_test(CLI::App& root, Invocation& invocation) {
  CLI::App* test = root.add_subcommand("test", "Run a virtual laboratory test on a specimen");
  test->require_subcommand(1);
  test->add_flag_callback(
      "--list",
      [] {
        for (const TestDescription& one : virtual_tests::catalogue())
          fmt::print("{:<12} {}\n", one.name, one.summary);
        throw CLI::Success();
      },
      "Print the tests, one a line");
  for (const TestDescription& one : virtual_tests::catalogue()) add_one(*test, one, invocation);
}

}  // namespace app
