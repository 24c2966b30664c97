#include "app/command.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "libdem/config/nearest_name.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"

namespace app {

int CommonOptions::thread_count() const {
  // Asked once: what use_threads() sets is no default.
  static const int usual = omp_get_max_threads();
  return threads > 0 ? threads : usual;
}

CLI::App* add_verb(CLI::App& parent, const std::string& name, const std::string& description,
                   const std::string& example, CommonOptions& common) {
  CLI::App* verb = parent.add_subcommand(name, description);
  std::string footer = "Example:";
  for (std::size_t begin = 0; begin < example.size();) {
    const std::size_t end = std::min(example.find('\n', begin), example.size());
    footer += "\n  " + example.substr(begin, end - begin);
    begin = end + 1;
  }
  verb->footer(footer);
  verb->add_option("--threads", common.threads,
                   "Threads of the computation (default: OMP_NUM_THREADS, or one a core)")
      ->check(CLI::Range(1, 1024));
  verb->add_flag("--json", common.json, "Print the result as JSON on standard output, and nothing else there");
  verb->add_flag("--quiet", common.quiet, "Print nothing but errors");
  return verb;
}

void use_threads(const CommonOptions& common) { omp_set_num_threads(common.thread_count()); }

CLI::Validator number_between(double low, double high) {
  return CLI::Validator(
      [low, high](std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= low && value <= high)
          return std::string();
        return fmt::format("{} is not a number from {} to {}", text, low, high);
      },
      fmt::format("{} to {}", low, high));
}

namespace {

std::vector<std::string> names_of_verbs(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> names_of_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

}  // namespace

std::string explain(const CLI::App& root, const CLI::ParseError& error,
                    const std::vector<std::string>& arguments) {
  const CLI::App* verb = &root;
  std::string path = "spall";
  std::size_t next = 1;
  while (next < arguments.size()) {
    const auto names = names_of_verbs(*verb);
    if (std::find(names.begin(), names.end(), arguments[next]) == names.end()) break;
    verb = verb->get_subcommand(arguments[next]);
    path += " " + arguments[next++];
  }
  // A verb that also works by itself takes other words than verbs.
  if (const auto names = names_of_verbs(*verb); !names.empty() && verb->get_require_subcommand_min() > 0) {
    if (next < arguments.size() && !arguments[next].starts_with('-'))
      return fmt::format("{}: \"{}\" is no verb; {}", path, arguments[next],
                         dem::suggestion(arguments[next], names));
    if (next >= arguments.size())
      return fmt::format("{}: a verb is missing; allowed: {}", path, fmt::join(names, ", "));
  }
  const auto options = names_of_options(*verb);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
    for (; next < arguments.size(); ++next) {
      const std::string name = arguments[next].substr(0, arguments[next].find('='));
      if (name.rfind("--", 0) == 0 && std::find(options.begin(), options.end(), name) == options.end())
        return fmt::format("{}: {}: unknown option; {}", path, name, dem::suggestion(name, options));
    }
  return fmt::format("{}: {}; see {} --help", path, error.what(), path);
}

void require_writable_file(const std::string& file, bool by_a_library) {
  const std::filesystem::path path(file);
  std::error_code ignored;
  if (!path.has_filename() || std::filesystem::is_directory(path, ignored))
    throw dem::RunError(fmt::format("{}: this is a folder; give the name of a file", file));
  dem::require_writable_file(path, by_a_library);
}

}  // namespace app
