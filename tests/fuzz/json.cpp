#include <nlohmann/json.hpp>

#include "libtracker/core/json_file.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

static void parse(std::string_view bytes) {
  each([&] { (void)parseJson(bytes, "fuzz").dump(2); }, [&] { (void)parseOrderedJson(bytes, "fuzz"); });
}
DEPTHMOCAP_FUZZ(parse)
