// What memory there is, asked before work begins that could not be finished.
#pragma once
#include <string>

namespace dem {

/// Memory that the system can give without swapping, less a tenth [bytes]: MemAvailable of /proc/meminfo, or
/// what the control group of a container or a batch job leaves, whichever is less. 1e9 where neither can be
/// read.
double available_memory();

/// Throws InputError "where: what needs about ... GB of memory, ... GB are free; remedy" if `bytes` are more
/// than available_memory(), and more than 64 MB. Without it the system would kill the run later, without a
/// word.
void require_memory(double bytes, const std::string& where, const std::string& what);

}  // namespace dem
