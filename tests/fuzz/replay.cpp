// Gives a fuzz target the files named, or all files of the folders named, once each: the corpus as an ordinary test.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  int count = 0;
  const auto give = [&count](const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::printf("%s\n", path.c_str());  // the last one is the one that failed
    std::fflush(stdout);
    // Shorter ones are what a cut file is.
    for (std::size_t size = bytes.size() + 1; size-- > 0; size -= size / 16) {
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), size);
    }
    ++count;
  };
  for (int i = 1; i < argc; ++i) {
    if (fs::is_regular_file(argv[i])) give(argv[i]);
    if (!fs::is_directory(argv[i])) continue;
    for (const auto& entry : fs::recursive_directory_iterator(argv[i])) {
      if (entry.is_regular_file()) give(entry.path());
    }
  }
  return count > 0 ? 0 : 1;
}
