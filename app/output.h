// The folder that a run leaves: result.json and its provenance, run.json. Each is written whole or not at all.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/command.h"
#include "libdem/core/error.h"
#include "libdem/core/input_file.h"

namespace app {

/// The present time as ISO 8601 in UTC: "2026-01-31T09:15:02Z".
std::string utc_now();

/// The command that goes on with a stopped run: what was typed, quoted for a shell, with --resume.
std::string command_to_go_on(const Invocation& invocation);

/// Takes back a folder that a refused run has made; leaves one alone that holds something.
void remove_if_empty(const std::filesystem::path& folder);

/// Files and folders of an earlier run under hidden names, in the order given; removed in the end.
class EarlierResults {
 public:
  /// Throws RunError, and leaves all where they were, if one cannot be renamed.
  explicit EarlierResults(const std::vector<std::filesystem::path>& files);
  ~EarlierResults();
  EarlierResults(const EarlierResults&) = delete;
  EarlierResults& operator=(const EarlierResults&) = delete;
  /// Gives them their names again, the last first.
  void put_back() noexcept;

 private:
  std::vector<std::filesystem::path> files;  ///< the last first
};

/// The output folder of one run.
class RunFolder {
 public:
  /// Makes the folder and checks that files can be written in it. Throws RunError: construct it before any
  /// computing.
  RunFolder(const std::filesystem::path& folder, const Invocation& invocation, const CommonOptions& common);

  /// Keeps other runs out of the folder until this one ends, however it does. Throws InputError if another one
  /// is at work there.
  void claim();

  /// Records an input file with its SHA-256. Throws InputError if it cannot be read. Call it when the file is
  /// read: what counts is what the run saw.
  void add_input(const std::filesystem::path& file);
  /// The same of a file that was read before.
  void add_input(const dem::InputFile& input);
  void add_seed(std::uint64_t seed);

  /// Whether the folder already holds the result of this command with these inputs, however it was to be told
  /// and on how many threads. Call it once all inputs are added.
  bool is_finished() const;
  /// Removes what an earlier run ended with: result.json, run.json, report.html and the others that are named.
  /// Whoever computes calls it, or `compute_anew`, before anything is written, so that a run that is killed
  /// leaves no result of an earlier one. Throws RunError; InputError if one of these files is an input of this
  /// run, whose place the result would take.
  void remove_results(const std::vector<std::string>& others) const;
  /// What `compute` returns; the same files are out of its way, and frames/ where `goes_on` is false. They are
  /// removed when it ends, but stand in their places again if it throws InputError, or is stopped before it has
  /// written anything: that costs nobody an earlier result.
  template <class Compute>
  auto compute_anew(const std::vector<std::string>& others, bool goes_on, const Compute& compute) const {
    EarlierResults earlier(results_and_frames(others, !goes_on));
    try {
      return compute();
    } catch (const dem::InputError&) {
      earlier.put_back();
      throw;
    } catch (const dem::Interrupted&) {
      if (!has_begun()) earlier.put_back();
      throw;
    }
  }

  const std::filesystem::path& path() const { return folder; }
  std::filesystem::path file(const std::string& name) const { return folder / name; }
  /// Writes run.json, then result.json: where there is a result.json, everything else is there too. Throws
  /// RunError.
  void write(const nlohmann::ordered_json& result) const;

  /// What is enough to go on, of the run itself and of a test's second one at half the speed.
  std::filesystem::path checkpoint() const { return file("checkpoint.h5"); }
  std::filesystem::path half_speed_checkpoint() const { return file("checkpoint_half_speed.h5"); }
  /// A finished run needs none; one that stays does no harm.
  void remove_checkpoints() const noexcept;

 private:
  bool is_input(const std::filesystem::path& file) const;
  /// result.json first: where it is, everything else is there too.
  std::vector<std::filesystem::path> results(const std::vector<std::string>& others) const;
  std::vector<std::filesystem::path> results_and_frames(const std::vector<std::string>& others,
                                                        bool frames) const;
  /// Whether a checkpoint or frames are there.
  bool has_begun() const;

  std::filesystem::path folder;
  const Invocation& invocation;
  int threads;
  nlohmann::ordered_json inputs = nlohmann::ordered_json::array();
  std::vector<std::uint64_t> seeds;
  std::shared_ptr<const int> lock;  ///< a descriptor of the folder, closed with it
};

}  // namespace app
