// What Slurm says of the elements of a job array: squeue for those that it still has in mind, sacct, where
// there is accounting, for the others.
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace study {

/// What has become of one element of a job array.
enum class JobState {
  pending,    ///< waits, or is held
  running,    ///< runs, starts, ends, or is suspended
  finished,   ///< ended with exit code 0
  failed,     ///< ended with another one, ran out of memory, or lost its node
  timed_out,  ///< its time limit ended it
  cancelled,  ///< by scancel, or preempted for another job
  gone        ///< Slurm knows nothing of it (any more)
};
std::string_view name_of(JobState state);
/// Pending or running: its tasks may still get results.
bool in_flight(JobState state);
/// "CANCELLED by 1000" -> cancelled. A word that is not known counts as failed.
JobState job_state(std::string_view word);

struct ElementState {
  JobState state = JobState::gone;
  std::string word;    ///< Slurm's own: "OUT_OF_MEMORY"; empty if it knows nothing
  std::string reason;  ///< why it waits or failed: "Resources", "exit code 3"; may be empty
};

/// One element of an array: the array's job number and the index in it.
using ElementId = std::pair<std::string, std::size_t>;
using ElementStates = std::map<ElementId, ElementState>;

/// Reads lines of `squeue --noheader --array --format=%F|%K|%T|%r`. Other lines, such as the names of clusters,
/// and jobs that are no arrays are passed over.
ElementStates parse_squeue(std::string_view text);
/// Reads lines of `sacct --noheader --parsable2 --allocations --format=JobID,State,ExitCode`, in which elements
/// that never started share one line: "12_[3-9,20-40:2%4]".
ElementStates parse_sacct(std::string_view text);

/// One array job as `sbatch --parsable` names it.
struct JobName {
  std::string number;   ///< "123"
  std::string cluster;  ///< empty unless there are several
  bool operator<(const JobName& other) const {
    return std::pair(cluster, number) < std::pair(other.cluster, other.number);
  }
  bool operator==(const JobName& other) const = default;
};

struct QueueAnswer {
  std::map<JobName, std::map<std::size_t, ElementState>> jobs;
  std::string no_accounting;  ///< why sacct did not answer, in its words; empty if it did
};

/// Asks squeue for these jobs, and sacct for what squeue leaves open. Throws RunError, with Slurm's message, if
/// squeue is missing or fails; a sacct that does not answer is no error.
QueueAnswer ask_slurm(const std::vector<JobName>& jobs);

}  // namespace study
