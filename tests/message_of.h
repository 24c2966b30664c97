// What a refusal says, for tests of messages.
#pragma once
#include <functional>
#include <string>

#include "libdem/core/error.h"

namespace test {

/// The message of the `Error` that `action` throws; "no error" if it throws none.
template <class Error = dem::InputError>
std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace test
