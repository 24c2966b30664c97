// The `spall` command: parses the command line, runs the verb, and turns failures into exit codes and one line
// each.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <new>
#include <string_view>
#include <system_error>

#include "app/output.h"
#include "app/short_memory.h"
#include "app/streams.h"
#include "app/verbs.h"
#include "app/version.h"
#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/io/hdf5.h"

namespace {

int tell(int code, std::string message) {
  // One line and no escapes to the terminal, whatever a library or a file put into its message.
  std::replace_if(
      message.begin(), message.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; }, ' ');
  app::put(stderr, message + "\n");
  return code;
}

int fail(int code, const char* message) { return tell(code, std::string("spall: ") + message); }

int run(const std::function<int()>& action) {
  try {
    const int code = action();
    app::require_output_whole();
    return code;
  } catch (const dem::InputError& error) {
    return fail(app::input_wrong, error.what());
  } catch (const dem::Interrupted& error) {
    return fail(app::stopped, error.what());
  } catch (const std::bad_alloc&) {
    app::put(stderr, app::out_of_memory);
    return app::run_failed;
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::resource_unavailable_try_again) return fail(app::run_failed, error.what());
    return fail(app::run_failed,
                "no thread can be started; look at the limits that ulimit -v and ulimit -u print");
  } catch (const std::exception& error) {
    return fail(app::run_failed, error.what());
  }
}

}  // namespace

int main(int count, char** values) {
  app::begin_again_where_address_space_is_limited(values);
  app::prepare_standard_streams();
  app::say_where_memory_lacked();
  app::Invocation invocation;
  invocation.arguments.assign(values, values + count);
  invocation.started = app::utc_now();

  CLI::App root("Calibration and virtual testing of concrete modelled by discrete elements", "spall");
  root.require_subcommand(1);
  root.set_version_flag("--version", fmt::format("spall {} ({})", app::version, app::commit));
  root.footer(
      "Exit codes: 0 done, 1 the run failed, 2 the input is wrong, 3 stopped by a signal (go on with "
      "--resume),\n"
      "4 done, but a fit did not meet its tolerance.\n"
      "Each verb has its own --help, with an example.");
  app::add_specimen(root, invocation);
  app::add_test(root, invocation);
  app::add_calibrate(root, invocation);
  app::add_impact(root, invocation);
  app::add_study(root, invocation);
  app::add_card(root, invocation);
  app::add_report(root, invocation);

  // An option's empty value, of a variable that is not set, would be as if the option were not there.
  for (int k = 1; k < count; ++k)
    if (std::string_view word = values[k]; word.empty() || (word.starts_with("--") && word.ends_with('=')))
      return tell(app::input_wrong,
                  fmt::format("spall: {}: the value is empty; leave the option out, or give it one",
                              word.empty() && k > 1 ? values[k - 1] : values[k]));
  try {
    root.parse(count, values);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return root.exit(error);  // --help and --version
    return tell(app::input_wrong, app::explain(root, error, invocation.arguments));
  }
  dem::install_interrupt_handlers();
  return run([&] {
    // Later there may not be the memory, of whose lack the library crashes.
    dem::start_hdf5();
    return invocation.action();
  });
}
