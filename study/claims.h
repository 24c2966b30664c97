// Who works on what: claims that the kernel gives back when a process ends, however it ends.
#pragma once
#include <filesystem>
#include <string_view>

namespace study {

/// Claims on keys (64 hexadecimal digits), held by this process. A claim is a lock on one byte of a shared file
/// (Linux open-file-description lock), at the place that the key's first digits name: nothing is left behind by
/// kill -9, and no claim can be stale. It works between the processes of one machine, and between machines
/// whose shared file system passes POSIX locks on (NFS 4, Lustre with -o flock, GPFS, BeeGFS when so
/// configured). Where a file system has no locks every claim succeeds: tasks may then be done twice, to the
/// same bits, and results are still written whole.
class Claims {
 public:
  /// Opens the file, which is made if it is not there. Throws RunError.
  explicit Claims(const std::filesystem::path& file);
  ~Claims();
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;

  /// False if another process holds it. A process does not see its own claims: keep them apart by other means.
  bool take(std::string_view key);
  void release(std::string_view key);
  /// Whether another process holds it.
  bool held_elsewhere(std::string_view key) const;

  /// The same without a claim of one's own, for those who only look; false if the file cannot be opened.
  static bool held(const std::filesystem::path& file, std::string_view key);

 private:
  int descriptor = -1;
};

}  // namespace study
