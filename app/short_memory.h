// What the command does where memory or address space is short.
#pragma once

namespace app {

/// The line of a run that lacked memory.
inline constexpr char out_of_memory[] =
    "spall: out of memory; use fewer elements or a machine with more memory\n";

/// OpenBLAS, which Ceres brings along and Spall does not call, starts a thread a core when it is loaded. Each
/// tries for 130 MB of address space until it has them, and the program's end waits for it: under `ulimit -v`
/// perhaps for ever. There the program begins once more, with one; elsewhere nothing is done.
void begin_again_where_address_space_is_limited(char** arguments);

/// From here on a lack of memory that nobody can catch (in a loop of OpenMP, or while another exception is
/// under way) ends the process with that line and exit code 1; any other such exception as before.
void say_where_memory_lacked();

}  // namespace app
