#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace sward::base {

/// Thrown by SWARD_CHECK: a contract was broken by the calling code (a bug), not by the user's input.
class ContractError : public std::logic_error {
  using std::logic_error::logic_error;
};

template <typename A, typename B>
[[noreturn]] void failCheck(const char* expression, const A& a, const B& b, const char* file, int line) {
  std::ostringstream text;
  text << file << ':' << line << ": check failed: " << expression << " (" << a << " vs " << b << ')';
  throw ContractError(text.str());
}

}  // namespace sward::base

/// Contract checks, on in release: SWARD_CHECK_EQ(a, b) and so on throw ContractError with both values.
#define SWARD_CHECK_OP(a, op, b)                                                           \
  do {                                                                                     \
    const auto& sward_a_ = (a);                                                            \
    const auto& sward_b_ = (b);                                                            \
    if (!(sward_a_ op sward_b_)) {                                                         \
      ::sward::base::failCheck(#a " " #op " " #b, sward_a_, sward_b_, __FILE__, __LINE__); \
    }                                                                                      \
  } while (false)
#define SWARD_CHECK_EQ(a, b) SWARD_CHECK_OP(a, ==, b)
#define SWARD_CHECK_LT(a, b) SWARD_CHECK_OP(a, <, b)
#define SWARD_CHECK_LE(a, b) SWARD_CHECK_OP(a, <=, b)
#define SWARD_CHECK_GT(a, b) SWARD_CHECK_OP(a, >, b)
#define SWARD_CHECK_GE(a, b) SWARD_CHECK_OP(a, >=, b)
#define SWARD_CHECK(condition) SWARD_CHECK_OP(static_cast<bool>(condition), ==, true)
