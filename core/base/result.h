#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace sward::base {

/// What an error means to the caller; the command line maps it to its exit code.
enum class ErrorKind {
  Failed,    ///< the machine, a device or the disk failed: exit code 1
  BadInput,  ///< the command, the project or an asset is wrong: exit code 2
  Cancelled  ///< the user stopped it: exit code 130
};

/// An expected failure. Says what is wrong, where, and how to mend it; `where` and `remedy` may be empty.
struct Error {
  ErrorKind kind = ErrorKind::BadInput;
  std::string what;
  std::string where;
  std::string remedy;

  /// One line for people: "WHERE: WHAT. REMEDY".
  std::string text() const;

  static Error failed(std::string what, std::string where = {}, std::string remedy = {});
  static Error badInput(std::string what, std::string where = {}, std::string remedy = {});
  static Error cancelled();
};

/// A value or the Error that stands in its place.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : m_state(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : m_state(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return m_state.index() == 0; }
  explicit operator bool() const { return ok(); }

  /// The value. Calling it on an error throws std::bad_variant_access: check ok() first.
  T& value() & { return std::get<0>(m_state); }
  const T& value() const& { return std::get<0>(m_state); }
  T&& value() && { return std::get<0>(std::move(m_state)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const& { return std::get<1>(m_state); }
  Error&& error() && { return std::get<1>(std::move(m_state)); }

 private:
  std::variant<T, Error> m_state;
};

/// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : m_error(std::move(error)) {}

  bool ok() const { return !m_error.has_value(); }
  explicit operator bool() const { return ok(); }
  const Error& error() const& { return *m_error; }
  Error&& error() && { return *std::move(m_error); }

 private:
  std::optional<Error> m_error;
};

}  // namespace sward::base

namespace sward {
using base::Error;
using base::ErrorKind;
using base::Result;
}  // namespace sward

/// Returns the error of EXPRESSION, a Result, from the enclosing function; goes on when it is a success.
#define SWARD_TRY(expression)                                     \
  do {                                                            \
    if (auto sward_result_ = (expression); !sward_result_.ok()) { \
      return std::move(sward_result_).error();                    \
    }                                                             \
  } while (false)

#define SWARD_CONCAT_INNER(a, b) a##b
#define SWARD_CONCAT(a, b) SWARD_CONCAT_INNER(a, b)
/// Declares DECLARATION with the value of EXPRESSION, or returns its error from the enclosing function.
#define SWARD_ASSIGN(declaration, expression)                        \
  auto SWARD_CONCAT(sward_result_, __LINE__) = (expression);         \
  if (!SWARD_CONCAT(sward_result_, __LINE__).ok()) {                 \
    return std::move(SWARD_CONCAT(sward_result_, __LINE__)).error(); \
  }                                                                  \
  declaration = std::move(SWARD_CONCAT(sward_result_, __LINE__)).value()
