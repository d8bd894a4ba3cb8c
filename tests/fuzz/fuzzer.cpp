// The door of libFuzzer: talus_fuzz --target=NAME [options of libFuzzer] [corpus ...]
#include "targets.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

constexpr std::string_view option = "--target=";
const talus::fuzz::Target* chosen = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(const int* count, char*** words) {
  for (int i = 1; i < *count; ++i) {
    const std::string_view word = (*words)[i];
    if (!word.starts_with(option)) continue;
    for (const talus::fuzz::Target& target : talus::fuzz::targets) {
      if (word.substr(option.size()) == target.name) chosen = &target;
    }
  }
  if (chosen != nullptr) return 0;
  std::fputs("expected --target=NAME, one of:", stderr);
  for (const talus::fuzz::Target& target : talus::fuzz::targets) std::fprintf(stderr, " %s", target.name);
  std::fputc('\n', stderr);
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  try {
    chosen->run({reinterpret_cast<const char*>(bytes), size});
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    std::abort();
  }
  return 0;
}
