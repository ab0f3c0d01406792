// SPDX-License-Identifier: MIT
#include "host/toml/expression.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dmrp::host {

namespace {

constexpr int deepest = 50;  // parentheses in parentheses

// expression: term {(+ | -) term}; term: factor {(* | /) factor}; factor: [-] number | name | name(expression) |
// (expression).
class Parser {
 public:
  Parser(std::string_view text, double level) : rest_(text), level_(level) {}

  double whole() {
    const double value = expression();
    if (!rest_.empty()) fail("an operator");
    return value;
  }

 private:
  [[noreturn]] void fail(const char* expected) const {
    throw std::invalid_argument(
        fmt::format("expected {} {}", expected, rest_.empty() ? "at its end" : fmt::format("before '{}'", rest_)));
  }

  bool take(char sign) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != sign) return false;
    rest_.remove_prefix(1);
    skip_blanks();
    return true;
  }

  void skip_blanks() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }

  double expression() {
    double value = term();
    for (;;) {
      if (take('+'))
        value += term();
      else if (take('-'))
        value -= term();
      else
        return value;
    }
  }

  double term() {
    double value = factor();
    for (;;) {
      if (take('*'))
        value *= factor();
      else if (take('/'))
        value /= factor();
      else
        return value;
    }
  }

  double factor() {
    if (++depth_ > deepest) fail("fewer parentheses");
    const double value = take('-') ? -factor() : take('(') ? closed() : number_or_name();
    --depth_;
    return value;
  }

  double closed() {
    const double value = expression();
    if (!take(')')) fail("')'");
    return value;
  }

  double number_or_name() {
    skip_blanks();
    double value = 0.0;
    if (const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        error == std::errc()) {
      rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
      return value;
    }
    std::size_t length = 0;
    while (length < rest_.size() && rest_[length] >= 'a' && rest_[length] <= 'z') ++length;
    const std::string_view name = rest_.substr(0, length);
    if (name == "level" || name == "pi") {
      rest_.remove_prefix(length);
      return name == "pi" ? std::numbers::pi : level_;
    }
    double (*function)(double) = name == "sin"     ? +[](double x) { return std::sin(x); }
                                 : name == "cos"   ? +[](double x) { return std::cos(x); }
                                 : name == "sqrt"  ? +[](double x) { return std::sqrt(x); }
                                 : name == "floor" ? +[](double x) { return std::floor(x); }
                                 : name == "round" ? +[](double x) { return std::round(x); }
                                                   : nullptr;
    if (!function) fail("a number, 'level', 'pi', sin, cos, sqrt, floor or round");
    rest_.remove_prefix(length);
    if (!take('(')) fail("'('");
    return function(closed());
  }

  std::string_view rest_;
  double level_;
  int depth_ = 0;
};

}  // namespace

double evaluate_expression(std::string_view text, double level) {
  const double value = Parser(text, level).whole();
  if (!std::isfinite(value)) throw std::invalid_argument("it has no finite value");
  return value;
}

}  // namespace dmrp::host
