#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "libtracker/core/random.h"

namespace depthmocap {

// What an expression is evaluated with: where draws come from, and the value of a name or nothing.
struct ExpressionScope {
  Random& random;
  std::function<std::optional<double>(std::string_view)> number;
};

struct ExpressionNode;

// A number of a motion file: a constant, or a formula with names, arithmetic and random draws such as
// "0.2 + uniform(0.1, 0.3) * depth"; docs/reference/motions.md has its operators and functions. Draws are made from
// left to right, and only in the branch of `?:` that is taken.
class Expression {
 public:
  Expression() : Expression(0.0) {}
  explicit Expression(double value);
  // Error naming `where` if the text is no formula or calls an unknown function.
  Expression(std::string_view text, const std::string& where);

  // Error naming the place given to the constructor if a name is not known or the value is not finite.
  [[nodiscard]] double evaluate(const ExpressionScope& scope) const;

 private:
  std::shared_ptr<const ExpressionNode> root_;
  std::string where_;
};

}  // namespace depthmocap
