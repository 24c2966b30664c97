// A study's tasks as a job array of Slurm: which element runs which tasks, under which limits, and the script
// that says so. Nothing here talks to Slurm; see study/slurm_submission.h and study/slurm_queue.h.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "libdem/core/units.h"

namespace study {

/// One task as far as its place in a job array is concerned.
struct SlurmTask {
  std::size_t number = 0;  ///< in the plan, from 1
  double seconds = 0;      ///< estimated, on one core
  double bytes = 0;        ///< of memory, estimated
};

struct SlurmOptions {
  std::size_t chunk = 0;   ///< tasks of one element; 0: as many as make ten minutes
  double time_limit = 0;   ///< of one element [s]; 0: its estimate times `time_factor`
  double time_factor = 4;  ///< the estimate is good to a factor of two, and the cluster may be slower
  double memory = 0;       ///< of one element [bytes]; 0: from the estimate
  int threads = 1;         ///< cores of one element
  std::string partition;   ///< empty: the cluster's own choice, as for the account
  std::string account;
  std::vector<std::string> sbatch_options;  ///< words for sbatch, as they are ("--constraint=avx512")
};

/// Throws InputError, with `where` before it, for options of sbatch that this file has to set itself (--array,
/// --output, --wrap, ...), words that are no options, and text of more than one line.
void check(const SlurmOptions& options, const std::string& where);

/// The tasks of one element.
struct Chunk {
  std::vector<std::size_t> tasks;  ///< their numbers, rising
  double seconds = 0;              ///< estimated, on the element's cores
  double bytes = 0;                ///< estimated: what runs at once, and the command itself
};

/// Deals the tasks out in their order, so that tests on one specimen stay side by side: `options.chunk` each,
/// or as many as take ten minutes.
std::vector<Chunk> make_chunks(const std::vector<SlurmTask>& tasks, const SlurmOptions& options);

/// "1-4,7,9-10".
std::string range_text(const std::vector<std::size_t>& numbers);

/// The time that every element may take [s]: as asked for, or the longest estimate times the factor, in whole
/// minutes and five at the least.
double time_limit(const std::vector<Chunk>& chunks, const SlurmOptions& options);
/// The memory that every element is given [bytes]: as asked for, or twice the largest estimate.
double memory_limit(const std::vector<Chunk>& chunks, const SlurmOptions& options);

/// What the script runs and where.
struct SlurmPlace {
  std::string name;                    ///< of the study
  std::filesystem::path program;       ///< the `spall` that runs; absolute, as all of these
  std::filesystem::path study;         ///< study.toml
  std::filesystem::path output;        ///< the study's folder
  std::filesystem::path logs;          ///< the folder for what the elements say
  std::filesystem::path working;       ///< the folder that they work in
  std::vector<std::string> arguments;  ///< more for `spall study run` ("--retry")
};

/// The text for sbatch: an array of as many elements as chunks, each of which runs
/// `spall study run STUDY -o OUTPUT --tasks ... --threads N --memory M`. Given the same it is the same, letter
/// for letter. Throws InputError if a path has a line break in it, or that of the logs a backslash.
std::string batch_script(const SlurmPlace& place, const std::vector<Chunk>& chunks,
                         const SlurmOptions& options);

}  // namespace study
