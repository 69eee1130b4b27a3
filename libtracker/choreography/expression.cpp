#include "libtracker/choreography/expression.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "depthmocap/error.h"
#include "libtracker/choreography/easing.h"
#include "libtracker/choreography/flight.h"
#include "libtracker/core/nearest_name.h"

namespace depthmocap {
namespace {

constexpr int kMaxDepth = 40;  // of nested parentheses; by hand, far above what anybody writes and below any stack

using Arguments = std::span<const double>;

struct Function {
  std::string_view name;
  std::size_t min_arguments, max_arguments;
  double (*call)(Random&, Arguments);
};

// A value within +-share of the given one.
double drawNear(Random& random, Arguments a) {
  constexpr double kUsualShare = 0.15;  // by hand
  const double share = a.size() == 2 ? a[1] : kUsualShare;
  return a[0] * random.uniform(1.0 - share, 1.0 + share);
}
// A whole number in [0, n); not a number if there is none.
double drawBelow(Random& random, Arguments a) {
  constexpr double kMost = 1e6;  // keeps n within 32 bits
  if (!(a[0] >= 1.0 && a[0] <= kMost)) return std::numeric_limits<double>::quiet_NaN();
  return random.below(static_cast<std::uint32_t>(a[0]));
}

constexpr std::array kFunctions = {
    Function{"uniform", 2, 2, [](Random& random, Arguments a) { return random.uniform(a[0], a[1]); }},
    Function{"near", 1, 2, &drawNear},
    Function{"chance", 1, 1, [](Random& random, Arguments a) { return random.uniform() < a[0] ? 1.0 : 0.0; }},
    Function{"below", 1, 1, &drawBelow},
    Function{"min", 2, 2, [](Random&, Arguments a) { return std::min(a[0], a[1]); }},
    Function{"max", 2, 2, [](Random&, Arguments a) { return std::max(a[0], a[1]); }},
    Function{"sin", 1, 1, [](Random&, Arguments a) { return std::sin(a[0]); }},
    Function{"cos", 1, 1, [](Random&, Arguments a) { return std::cos(a[0]); }},
    Function{"asin", 1, 1, [](Random&, Arguments a) { return std::asin(a[0]); }},
    Function{"degrees", 1, 1, [](Random&, Arguments a) { return degrees(a[0]); }},
    Function{"air_time", 1, 1, [](Random&, Arguments a) { return airTime(a[0]); }},
};

// Of two operands; a higher level binds tighter.
struct Operator {
  std::string_view sign;
  int level;
  double (*call)(Random&, Arguments);
};
constexpr int kLevels = 3;
constexpr std::array kOperators = {
    Operator{"==", 0, [](Random&, Arguments a) { return a[0] == a[1] ? 1.0 : 0.0; }},
    Operator{"!=", 0, [](Random&, Arguments a) { return a[0] != a[1] ? 1.0 : 0.0; }},
    Operator{"<", 0, [](Random&, Arguments a) { return a[0] < a[1] ? 1.0 : 0.0; }},
    Operator{">", 0, [](Random&, Arguments a) { return a[0] > a[1] ? 1.0 : 0.0; }},
    Operator{"+", 1, [](Random&, Arguments a) { return a[0] + a[1]; }},
    Operator{"-", 1, [](Random&, Arguments a) { return a[0] - a[1]; }},
    Operator{"*", 2, [](Random&, Arguments a) { return a[0] * a[1]; }},
    Operator{"/", 2, [](Random&, Arguments a) { return a[0] / a[1]; }},
    Operator{"%", 2, [](Random&, Arguments a) { return std::fmod(a[0], a[1]); }},
};

std::vector<std::string> functionNames() {
  std::vector<std::string> names;
  names.reserve(kFunctions.size());
  for (const Function& function : kFunctions) names.emplace_back(function.name);
  return names;
}

bool startsName(char c) {
  return (c >= 'a' && c <= 'z') || c == '_';
}
bool continuesName(char c) {
  return startsName(c) || (c >= '0' && c <= '9') || c == '.';
}

}  // namespace

// A constant (value), a name, a call of arguments, or, with neither, a choice: condition, then, else.
struct ExpressionNode {
  double value = 0.0;
  std::string name{};
  double (*call)(Random&, Arguments) = nullptr;
  std::vector<ExpressionNode> arguments{};
};

namespace {

// Recursive descent: choice, comparison, sum, product, sign, atom.
class Parser {
 public:
  Parser(std::string_view text, const std::string& where) : rest_(text), where_(where) {}

  ExpressionNode parse() {
    ExpressionNode node = choice();
    skipSpace();
    if (!rest_.empty()) fail("unexpected \"" + std::string(rest_) + "\"");
    return node;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& advice = {}) const {
    throw Error(what, where_, advice);
  }
  void skipSpace() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }
  bool take(std::string_view sign) {
    skipSpace();
    if (!rest_.starts_with(sign)) return false;
    rest_.remove_prefix(sign.size());
    return true;
  }
  void expect(std::string_view sign) {
    if (!take(sign)) fail("\"" + std::string(sign) + "\" is missing before \"" + std::string(rest_) + "\"");
  }

  ExpressionNode choice() {
    if (++depth_ > kMaxDepth) fail("is nested too deeply");
    ExpressionNode node = operation(0);
    if (take("?")) {
      ExpressionNode then = choice();
      expect(":");
      ExpressionNode otherwise = choice();
      node = {.arguments = {std::move(node), std::move(then), std::move(otherwise)}};
    }
    --depth_;
    return node;
  }

  ExpressionNode operation(int level) {
    if (level == kLevels) return signedAtom();
    ExpressionNode node = operation(level + 1);
    for (const Operator* found = takeOperator(level); found != nullptr; found = takeOperator(level)) {
      ExpressionNode right = operation(level + 1);
      node = {.call = found->call, .arguments = {std::move(node), std::move(right)}};
    }
    return node;
  }

  const Operator* takeOperator(int level) {
    for (const Operator& candidate : kOperators) {
      if (candidate.level == level && take(candidate.sign)) return &candidate;
    }
    return nullptr;
  }

  ExpressionNode signedAtom() {
    if (!take("-")) return atom();
    return {.call = [](Random&, Arguments a) { return -a[0]; }, .arguments = {atom()}};
  }

  ExpressionNode atom() {
    if (take("(")) {
      ExpressionNode node = choice();
      expect(")");
      return node;
    }
    skipSpace();
    if (!rest_.empty() && startsName(rest_.front())) return nameOrCall();
    double value = 0.0;
    const auto [end, failure] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (failure != std::errc{}) fail("a number or a name is missing before \"" + std::string(rest_) + "\"");
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return {.value = value};
  }

  ExpressionNode nameOrCall() {
    const auto* const end = std::find_if_not(rest_.begin(), rest_.end(), continuesName);
    const std::string name(rest_.begin(), end);
    rest_.remove_prefix(name.size());
    if (name == "pi") return {.value = std::numbers::pi};
    return take("(") ? call(name) : ExpressionNode{.name = name};
  }

  ExpressionNode call(const std::string& name) {
    const auto* const function = std::find_if(kFunctions.begin(), kFunctions.end(),
                                              [&](const Function& candidate) { return candidate.name == name; });
    if (function == kFunctions.end()) {
      fail("there is no function \"" + name + "\"", "did you mean \"" + nearestName(name, functionNames()) + "\"?");
    }
    ExpressionNode node{.call = function->call};
    do node.arguments.push_back(choice());
    while (take(","));
    expect(")");
    if (node.arguments.size() < function->min_arguments || node.arguments.size() > function->max_arguments) {
      fail("\"" + name + "\" does not take " + std::to_string(node.arguments.size()) + " numbers");
    }
    return node;
  }

  std::string_view rest_;
  const std::string& where_;
  int depth_ = 0;
};

double evaluateNode(const ExpressionNode& node, const ExpressionScope& scope, const std::string& where) {
  if (!node.name.empty()) {
    const std::optional<double> value = scope.number(node.name);
    if (!value) throw Error("\"" + node.name + "\" is not known here", where, "name it by a \"let\" before");
    return *value;
  }
  if (node.arguments.empty()) return node.value;
  if (node.call == nullptr) {
    const bool holds = evaluateNode(node.arguments[0], scope, where) != 0.0;
    return evaluateNode(node.arguments[holds ? 1 : 2], scope, where);
  }
  std::array<double, 2> values{};
  for (std::size_t i = 0; i < node.arguments.size(); ++i) values[i] = evaluateNode(node.arguments[i], scope, where);
  return node.call(scope.random, Arguments(values).first(node.arguments.size()));
}

}  // namespace

Expression::Expression(double value) : root_(std::make_shared<ExpressionNode>(ExpressionNode{.value = value})) {}

Expression::Expression(std::string_view text, const std::string& where)
    : where_(where + " \"" + std::string(text) + "\"") {
  root_ = std::make_shared<ExpressionNode>(Parser(text, where_).parse());
}

double Expression::evaluate(const ExpressionScope& scope) const {
  const double value = evaluateNode(*root_, scope, where_);
  if (!std::isfinite(value)) throw Error("is not finite", where_);
  return value;
}

}  // namespace depthmocap
