#include "study/folder.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/core/scratch_files.h"

namespace study {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t key_length = 64;
constexpr const char* parts[] = {"tasks", "times", "specimens", "checkpoints"};

std::string content_of(const fs::path& file) {
  // Reading one would end in an error of the library that names no file.
  std::error_code ignored;
  if (fs::is_directory(file, ignored))
    throw dem::InputError(file.string(), "is a folder, and should be a file that a task has written",
                          "remove it and run again");
  std::ifstream in(file, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in && !in.eof()) throw dem::RunError(fmt::format("{}: cannot be read", file.string()));
  return content;
}

nlohmann::ordered_json json_of(const fs::path& file) {
  try {
    return nlohmann::ordered_json::parse(content_of(file));
  } catch (const nlohmann::json::exception& error) {
    throw dem::InputError(file.string(), fmt::format("is damaged ({})", error.what()),
                          "delete it and run again");
  }
}

}  // namespace

void StudyFolder::make() const {
  dem::require_writable_folder(root);
  for (const char* part : parts) dem::require_writable_folder(root / part);
}

void StudyFolder::require_space() const {
  // As much as a result may be: a nearly full disk still takes a few bytes.
  const fs::path probe = dem::scratch_path(root / "tasks" / "space");
  dem::write_file_atomically(probe, std::string(1 << 18, ' '));
  std::error_code ignored;
  fs::remove(probe, ignored);
}

bool StudyFolder::concerns(const std::string& message) const {
  return std::any_of(std::begin(parts), std::end(parts), [&](const char* part) {
    return message.find((root / part / "").string()) != std::string::npos;
  });
}

void StudyFolder::sweep(Claims& claims) const {
  dem::sweep_scratch(root);
  std::error_code error;
  for (const char* part : parts) {
    dem::sweep_scratch(root / part);
    for (fs::directory_iterator entry(root / part, error), end; !error && entry != end;
         entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (name.size() <= key_length || name.front() != '.' || !name.ends_with(".part")) continue;
      const std::string key = name.substr(1, key_length);
      if (!claims.take(key)) continue;  // somebody is writing it now
      std::error_code ignored;
      fs::remove(entry->path(), ignored);
      claims.release(key);
    }
  }
}

bool StudyFolder::has_result(const std::string& key) const {
  std::error_code ignored;
  return fs::exists(result_file(key), ignored);
}

bool StudyFolder::has_failure(const std::string& key) const {
  std::error_code ignored;
  return fs::exists(failure_file(key), ignored);
}

TaskResult StudyFolder::read_result(const std::string& key) const {
  const std::string file = result_file(key).string();
  try {
    TaskResult result = result_from(json_of(file), file);
    if (result.key != key)
      throw dem::InputError(file, "holds the result of another task", "delete it and run again");
    return result;
  } catch (const nlohmann::json::exception& error) {
    throw dem::InputError(file, fmt::format("is no result of a task ({})", error.what()),
                          "delete it and run again");
  }
}

void StudyFolder::write_result(const std::string& key, const TaskResult& result) const {
  dem::write_file_atomically(result_file(key), to_json(result).dump() + "\n");
}

std::string StudyFolder::read_failure(const std::string& key) const {
  const nlohmann::ordered_json json = json_of(failure_file(key));
  return json.value("message", "no message");
}

void StudyFolder::write_failure(const std::string& key, const std::string& message) const {
  const nlohmann::ordered_json json{{"key", key}, {"message", message}};
  dem::write_file_atomically(failure_file(key),
                             json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void StudyFolder::forget_failure(const std::string& key) const {
  std::error_code error;
  if (!fs::remove(failure_file(key), error) && error)
    throw dem::RunError(fmt::format("{}: cannot be removed ({})", failure_file(key).string(), error.message()));
}

std::optional<TaskTime> StudyFolder::read_time(const std::string& key) const {
  try {
    return time_from(nlohmann::ordered_json::parse(content_of(time_file(key))));
  } catch (const std::exception&) {
    return std::nullopt;  // a remark, not a result: nothing hangs on it
  }
}

void StudyFolder::write_time(const std::string& key, const TaskTime& time) const {
  dem::write_file_atomically(time_file(key), to_json(time).dump() + "\n");
}

}  // namespace study
