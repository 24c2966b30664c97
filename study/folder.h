// The folder of a study: one file a result, named by its hash.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "study/claims.h"
#include "study/task_result.h"

namespace study {

/// tasks/KEY.json results, tasks/KEY.failed messages of those that failed, times/KEY.json how long they took
/// (apart, so that results have the same bits however they came about), specimens/KEY.h5 packed specimens,
/// checkpoints/KEY.h5 of tests that were stopped, claims. Nothing is made before `make`.
class StudyFolder {
 public:
  explicit StudyFolder(std::filesystem::path folder) : root(std::move(folder)) {}

  /// Makes what is missing and checks that it can be written. Throws RunError.
  void make() const;
  /// Throws RunError, with the system's reason, if nothing can be written any more (a full disk).
  void require_space() const;
  /// Whether an error's message names one of the folder's own files: then the folder is at fault, not the task.
  bool concerns(const std::string& message) const;
  /// Removes what a killed process left half written. Throws nothing.
  void sweep(Claims& claims) const;

  const std::filesystem::path& path() const { return root; }
  std::filesystem::path claims() const { return root / ".claims"; }
  std::filesystem::path specimen(const std::string& key) const { return root / "specimens" / (key + ".h5"); }
  std::filesystem::path checkpoint(const std::string& key) const {
    return root / "checkpoints" / (key + ".h5");
  }

  bool has_result(const std::string& key) const;
  bool has_failure(const std::string& key) const;
  /// Throws InputError, naming the file, if it holds something else; RunError if it cannot be read.
  TaskResult read_result(const std::string& key) const;
  void write_result(const std::string& key, const TaskResult& result) const;
  std::string read_failure(const std::string& key) const;
  void write_failure(const std::string& key, const std::string& message) const;
  void forget_failure(const std::string& key) const;
  /// Nothing if nobody knows.
  std::optional<TaskTime> read_time(const std::string& key) const;
  void write_time(const std::string& key, const TaskTime& time) const;

 private:
  std::filesystem::path result_file(const std::string& key) const { return root / "tasks" / (key + ".json"); }
  std::filesystem::path failure_file(const std::string& key) const {
    return root / "tasks" / (key + ".failed");
  }
  std::filesystem::path time_file(const std::string& key) const { return root / "times" / (key + ".json"); }

  std::filesystem::path root;
};

}  // namespace study
