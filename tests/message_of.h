// What a refusal says, for tests of messages.
#pragma once
#include <functional>
#include <string>

#include "libdem/core/error.h"

namespace test {

/// The message of the InputError that `action` throws; "no error" if it throws none.
inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const dem::InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace test
