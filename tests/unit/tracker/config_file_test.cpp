#include "libtracker/tracker/config_file.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

class ConfigFile : public testing::Test {
 protected:
  // What is said of a file with this text.
  std::string read(const std::string& text) {
    writeBytes(folder_ / "c.json", text);
    return errorOf([&] { readConfigFile(folder_ / "c.json", config_); });
  }
  static std::string with(const std::string& sections) {
    return R"({"format": "depthmocap-config", "version": 1, )" + sections + "}";
  }
  TemporaryFolder folder_;
  TrackerConfig config_;
};

TEST_F(ConfigFile, ReadsBackWhatWasWritten) {
  TrackerConfig written = paperConfig();
  written.solve.lambda_prior = 0.125;
  written.markers.bandwidth_scale[14] = 7;
  written.prior.neighbours = {10, 20};
  written.policy.expect_sides = true;
  writeConfigFile(folder_ / "a.json", written);
  readConfigFile(folder_ / "a.json", config_);
  writeConfigFile(folder_ / "b.json", config_);
  EXPECT_EQ(readBytes(folder_ / "a.json"), readBytes(folder_ / "b.json"));
  EXPECT_EQ(config_.solve.lambda_prior, 0.125);
  EXPECT_EQ(config_.prior.neighbours, (std::vector<int>{10, 20}));
}

TEST_F(ConfigFile, LeavesOutWhatStays) {
  const double before = config_.solve.lambda_smooth;
  EXPECT_EQ(read(with(R"("solve": {"lambda_prior": 3})")), "");
  EXPECT_EQ(config_.solve.lambda_prior, 3);
  EXPECT_EQ(config_.solve.lambda_smooth, before);
}

TEST_F(ConfigFile, RefusesWhatItDoesNotKnowAndNamesTheNearest) {
  EXPECT_NE(read(with(R"("solv": {})")).find("c.json: there is no \"solv\"; did you mean \"solve\"?"),
            std::string::npos);
  EXPECT_NE(read(with(R"("solve": {"lamda_prior": 1})"))
                .find("c.json: solve: there is no \"lamda_prior\"; did you mean "
                      "\"lambda_prior\"?"),
            std::string::npos);
}

TEST_F(ConfigFile, RefusesWrongTypesAndValues) {
  EXPECT_NE(read(with(R"("solve": {"lambda_prior": "much"})")).find("solve.lambda_prior: must be a number"),
            std::string::npos);
  EXPECT_NE(read(with(R"("solve": {"max_iterations": 1.5})")).find("must be a whole number"), std::string::npos);
  EXPECT_NE(read(with(R"("policy": {"hold_feet": 1})")).find("must be true or false"), std::string::npos);
  EXPECT_NE(read(with(R"("markers": {"bandwidth_scale": [1, 2]})")).find("must be a list of 15 numbers"),
            std::string::npos);
  EXPECT_NE(read(with(R"("solve": {"sigma_m": 0})")).find("sigma_m must be above 0, not 0"), std::string::npos);
  EXPECT_NE(read(with(R"("solve": 3)")).find("must be an object"), std::string::npos);
  EXPECT_NE(read(R"({"format": "other", "version": 1})"), "");
  EXPECT_NE(read("[]"), "");
}

TEST_F(ConfigFile, EveryDefaultIsValid) {
  EXPECT_NO_THROW(TrackerConfig{}.validate());
  EXPECT_NO_THROW(paperConfig().validate());
}

// After a change of a field: replace the page's sections by what `build/depthmocap config-table` prints.
TEST_F(ConfigFile, TheReferencePageListsEveryField) {
  const std::string page = readBytes(std::string(DEPTHMOCAP_SOURCE_DIR) + "/docs/reference/config.md");
  const std::size_t first = page.find("\n## ");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(page.substr(first), configTable()) << "replace the page's sections by this table";
}

}  // namespace
}  // namespace depthmocap
