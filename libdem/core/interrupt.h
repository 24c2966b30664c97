// Ctrl-C and SIGTERM set a flag; long loops look at it and stop at a point from which they can go on.
#pragma once

namespace dem {

/// Installs handlers for SIGINT and SIGTERM that set the flag. A second signal ends the process at once.
void install_interrupt_handlers();
/// True once a signal asked for a stop.
bool interrupt_requested();
/// Sets or clears the flag by hand (for tests, and for embedding).
void set_interrupt(bool requested);

}  // namespace dem
