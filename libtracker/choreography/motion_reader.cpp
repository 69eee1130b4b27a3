#include "libtracker/choreography/motion_reader.h"

#include <array>

#include "libtracker/choreography/motion_json.h"
#include "libtracker/choreography/step_reader.h"

namespace depthmocap {
namespace {

constexpr int kMaxVariants = 100;  // of one motion; by hand, far above what is of use

HandTarget readPlace(const MotionJson& value) {
  HandTarget place;
  const std::array<double*, 4> numbers = {&place.out, &place.up, &place.forward, &place.elbow};
  const auto elements = value.elements();
  if (elements.size() != numbers.size()) value.fail("must have 4 numbers");
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!elements[i].json().is_number()) elements[i].fail("must be a number");
    *numbers[i] = elements[i].json().get<double>();
  }
  return place;
}

void readPlaces(const MotionJson& object, MotionFile& file) {
  for (const auto& [name, value] : object.members()) {
    value.checkNewName(name);
    if (!file.places.emplace(name, readPlace(value)).second) value.fail("is a place of the shared file already");
  }
}

void readParts(const MotionJson& object, const std::string& file_name, MotionFile& file) {
  const std::string owner = file_name + ": part ";
  for (const auto& [name, value] : object.members()) {
    const MotionJson part(value.json(), owner + name);
    part.checkKeys({"steps"});
    auto steps = std::make_shared<const Steps>(readSteps(part.at("steps"), file.parts));
    if (!file.parts.emplace(name, std::move(steps)).second) part.fail("is a part of the shared file already");
  }
}

MotionScript readMotion(const MotionJson& listed, const std::string& file_name, const MotionFile& file) {
  MotionScript script;
  script.name = listed.at("name").newName();
  script.where = file_name + ": motion " + script.name;
  for (const MotionScript& other : file.motions) {
    if (other.name == script.name) listed.fail("there is another motion \"" + script.name + "\"");
  }
  const MotionJson motion(listed.json(), script.where);
  motion.checkKeys({"name", "variants", "steps"});
  script.variants = motion.at("variants").integer(1, kMaxVariants);
  script.steps = readSteps(motion.at("steps"), file.parts);
  return script;
}

}  // namespace

MotionFile readMotionFile(std::string_view text, const std::string& name, const MotionFile& shared) {
  const nlohmann::ordered_json json = MotionJson::parse(text, name);
  const MotionJson root(json, name);
  root.checkKeys({"places", "parts", "motions"});
  MotionFile file{shared.places, shared.parts, {}};
  if (root.has("places")) readPlaces(root.at("places"), file);
  if (root.has("parts")) readParts(root.at("parts"), name, file);
  if (!root.has("motions")) return file;
  for (const MotionJson& motion : root.at("motions").elements()) {
    file.motions.push_back(readMotion(motion, name, file));
  }
  return file;
}

}  // namespace depthmocap
