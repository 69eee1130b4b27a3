#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libtracker/choreography/gait.h"

namespace depthmocap {

// The numbers that a step of a motion file takes by name.
struct NumberNames {
  std::vector<std::string> required, optional;
};

// The same with their values.
class Numbers {
 public:
  void set(const std::string& name, double value) { values_[name] = value; }
  [[nodiscard]] bool has(const std::string& name) const { return values_.contains(name); }
  [[nodiscard]] double get(const std::string& name, double otherwise = 0.0) const;

 private:
  std::map<std::string, double, std::less<>> values_;
};

const NumberNames& playNumbers();
const NumberNames& flightNumbers();
const NumberNames& orbitNumbers();
const NumberNames& strokesNumbers();

// The fields of GaitStyle; `running` is 0 or 1.
const NumberNames& styleNumbers();
// Nothing if there is no such field.
std::optional<double> findStyleNumber(const GaitStyle& style, std::string_view name);
void changeStyle(const Numbers& numbers, GaitStyle& style);

}  // namespace depthmocap
