// Results: a value, or one message about what a user can cause.
//
// A user's mistake (file, parameter, command line) comes back as an Error whose message says what is wrong, where
// (file, line, key) and what is allowed. A programmer's mistake is an assertion instead. Only main() turns an Error
// into an exit status.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace bosquet {

enum class ErrorKind {
  input,          ///< the user's input is wrong: exit status 1
  cannot_finish,  ///< disk full, cancelled, no graphics: exit status 2
};

struct Error {
  std::string message;
  ErrorKind kind = ErrorKind::input;
};

/// An error of kind cannot_finish.
inline Error cannot_finish(std::string message) { return {std::move(message), ErrorKind::cannot_finish}; }

/// Either a T or an Error. Test it before asking for the value.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return state_.index() == 0; }
  T& operator*() & { return assert(*this), std::get<0>(state_); }
  const T& operator*() const& { return assert(*this), std::get<0>(state_); }
  T&& operator*() && { return assert(*this), std::get<0>(std::move(state_)); }
  T* operator->() { return assert(*this), &std::get<0>(state_); }
  const T* operator->() const { return assert(*this), &std::get<0>(state_); }
  const Error& error() const { return assert(!*this), std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}

  explicit operator bool() const { return !error_; }
  const Error& error() const { return assert(error_), *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace bosquet
