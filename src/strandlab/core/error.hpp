// The two ways a command can fail, bad input (exit code 2) and failure of a running simulation (exit code 3), and the
// one way to end that is no failure.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace strandlab {

// The user's input cannot be used. what() is one complete message: file, line, key, what was given, what is allowed.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A simulation cannot go on. what() says the step, the time, the strand and the position where they are known.
struct RunError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Who watches the work wanted it to stop. Neither of the above, so that no handler of failures takes it for one.
struct Cancelled : std::exception {
  const char* what() const noexcept override { return "cancelled"; }
};

}  // namespace strandlab
