#pragma once
#include <array>
#include <string_view>

namespace depthmocap {

// The commands of training and rendering. They live in a program of their own, which depthmocap starts in its own
// place: tracking starts without the libraries that only learning needs.
struct LearningCommand {
  const char* name;
  const char* help;
};
inline constexpr LearningCommand kForestCommand{"forest", "Trains, inspects and measures the classifier"};
inline constexpr LearningCommand kRoomsCommand{"rooms",
                                               "Renders furnished rooms, and measures how people are found in them"};
inline constexpr LearningCommand kSynthesizeCommand{"synthesize", "Renders a motion as a depth recording with truth."};
inline constexpr std::array kLearningCommands = {kForestCommand, kRoomsCommand, kSynthesizeCommand};
inline constexpr std::string_view kLearningProgram = "depthmocap-learn";

bool isLearningCommand(std::string_view name);
// Goes on as the other program, which lies beside this one, with the same arguments. Throws Error where it cannot be
// started.
[[noreturn]] void becomeLearningProgram(char** argv);

}  // namespace depthmocap
