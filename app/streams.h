// The three standard streams of the command, any of which may be closed, full or gone.
#pragma once
#include <cstdio>
#include <string_view>

namespace app {

/// Opens /dev/null in place of a standard stream that is closed, so that no file of the run gets its number;
/// a pipe that nobody reads any more, or a file past the allowed size, becomes an error of writing. Call it
/// first of all.
void prepare_standard_streams();

/// Writes the text and throws nothing: a console that is gone ends no run.
void put(std::FILE* stream, std::string_view text) noexcept;

/// Flushes standard output. Throws RunError if anything written to it since the start was lost.
void require_output_whole();

}  // namespace app
