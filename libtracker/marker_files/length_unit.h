#pragma once
#include <string>
#include <string_view>

namespace depthmocap {

// Metres in a unit of length as files name it (mm, cm, m, in, ...; case does not matter). Error naming `where` for any
// other.
double metresPerUnit(std::string_view name, const std::string& where);

}  // namespace depthmocap
