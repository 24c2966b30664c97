// The errors that Spall throws. Each one is a sentence for its reader: where it went wrong, what is wrong
// there, and what is allowed or would help. The command line maps them to exit codes.
#pragma once
#include <stdexcept>
#include <string>

namespace dem {

/// The input is wrong (exit code 2). `where` names the file and the key, column or row; `what_is_wrong` says
/// what was found; `remedy` says what is allowed. The message is one line: "where: what_is_wrong; remedy".
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& where, const std::string& what_is_wrong, const std::string& remedy)
      : std::runtime_error(where + ": " + what_is_wrong + (remedy.empty() ? "" : "; " + remedy)),
        place(where),
        wrong(what_is_wrong),
        allowed(remedy) {}

  /// The three parts, as they were given.
  const std::string& where() const { return place; }
  const std::string& what_is_wrong() const { return wrong; }
  const std::string& remedy() const { return allowed; }

 private:
  std::string place, wrong, allowed;
};

/// The run failed although its input was acceptable: it diverged, or a file could not be written (exit code 1).
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The run was stopped by a signal and left a checkpoint (exit code 3). The message says how to go on.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dem
