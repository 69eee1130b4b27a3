#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include <gtest/gtest.h>

#include "apps/ik/bones.h"
#include "apps/ik/routes.h"
#include "apps/track/page_tracking.h"
#include "apps/track/start_page.h"
#include "libtracker/core/json_file.h"
#include "tests/support/page_files.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Names = std::set<std::string>;

const json& document() {
  static const json parsed = parseJson(embeddedOpenApi(), "openapi.json");
  return parsed;
}

const json& schema(const char* name) {
  return document()["components"]["schemas"][name];
}

Names keysOf(const json& object) {
  Names keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

template <typename List>
Names namesOf(const List& list) {
  return Names(list.begin(), list.end());
}

const IkRequests& requests() {
  static const IkRequests all(
      {.actor = {}, .priors = std::filesystem::path(DEPTHMOCAP_SOURCE_DIR) / "forest/models/pose_priors.bin"});
  return all;
}

json answerTo(const char* more) {
  return json::parse(requests().answer(std::string(R"({"targets": {"head": [0, 1.6, 0]})") + more + "}"));
}

TEST(OpenApi, HasEveryFieldOfARequest) {
  EXPECT_EQ(keysOf(schema("IkRequest")["properties"]), namesOf(IkRequests::kKeys));
  const json& request = schema("IkRequest")["properties"];
  EXPECT_EQ(namesOf(request["prior"]["enum"].get<std::vector<std::string>>()), namesOf(kIkPriorNames));
  EXPECT_EQ(namesOf(request["solver"]["enum"].get<std::vector<std::string>>()), namesOf(kIkMethodNames));
  EXPECT_EQ(namesOf(request["bones"]["enum"].get<std::vector<std::string>>()), namesOf(kBoneConventionNames));
  EXPECT_EQ(keysOf(request["targets"]["properties"]), namesOf(kJointNames));
  EXPECT_EQ(keysOf(request["weights"]["properties"]), namesOf(kJointNames));
  EXPECT_EQ(namesOf(schema("Joint")["enum"].get<std::vector<std::string>>()), namesOf(kJointNames));
}

TEST(OpenApi, HasEveryFieldOfAnAnswer) {
  const json answer = answerTo(R"(, "bones": "gltf")");
  const json& properties = schema("IkAnswer")["properties"];
  EXPECT_EQ(keysOf(properties), keysOf(answer));
  for (const char* table : {"joints", "rotations"}) {
    EXPECT_EQ(keysOf(properties[table]["properties"]), keysOf(answer[table])) << table;
  }
  EXPECT_EQ(properties["pose"]["minItems"], answer["pose"].size());
  EXPECT_EQ(keysOf(schema("GltfBone")["properties"]), keysOf(answer["bones"]["Spine"]));
  EXPECT_EQ(keysOf(schema("BlenderBone")["properties"]), keysOf(answerTo(R"(, "bones": "blender")")["bones"]["Spine"]));
  Names required = keysOf(answer);
  required.erase("bones");
  EXPECT_EQ(namesOf(schema("IkAnswer")["required"].get<std::vector<std::string>>()), required);
}

TEST(OpenApi, HasEveryEndpoint) {
  const TemporaryFolder share;
  makePageFiles(share / "view");
  setenv("DEPTHMOCAP_SHARE", share.path().c_str(), 1);
  PageTracking tracking{ReplayOptions{}};
  StartPage start({.port = 0}, {}, StartPage::Cameras::Listed, tracking);
  unsetenv("DEPTHMOCAP_SHARE");
  LivePage& page = start.page();
  addIkRoutes(page.server(), requests());
  std::set<std::pair<std::string, std::string>> served;
  for (auto [path, method] : page.server().routes()) {
    std::ranges::transform(method, method.begin(), [](char c) { return static_cast<char>(c | 0x20); });
    served.insert({path, method});
  }
  std::set<std::pair<std::string, std::string>> described;
  for (const auto& [path, methods] : document()["paths"].items()) {
    for (const auto& [method, operation] : methods.items()) described.insert({path, method});
  }
  EXPECT_EQ(described, served);
}

}  // namespace
}  // namespace depthmocap
