#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace depthmocap {

// Unpacks a depth picture of an .oni file to `pixels`, whose size says how many there are. False if the bytes do not
// give just so many, or the codec is unknown. Codecs: "NONE", "16zP" (differences), "16zT" (differences of indices into
// a table of the values that occur).
[[nodiscard]] bool unpackOniPicture(const std::array<char, 4>& codec, std::string_view bytes,
                                    std::vector<std::uint16_t>& pixels);

}  // namespace depthmocap
