#include "files/hash.hpp"

#include "files/whole_file.hpp"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace talus {
namespace {

std::string digits_of(XXH128_hash_t hash) {
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

std::string hash_of_bytes(std::string_view bytes) {
  return digits_of(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string hash_of_file(const std::filesystem::path& file) {
  return hash_of_bytes(read_whole_file(file));
}

struct RunningHash::State {
  XXH3_state_t sums;
};

RunningHash::RunningHash() : state_(std::make_unique<State>()) {
  XXH3_128bits_reset(&state_->sums);
}

RunningHash::~RunningHash() = default;

void RunningHash::add(std::string_view bytes) {
  XXH3_128bits_update(&state_->sums, bytes.data(), bytes.size());
}

std::string RunningHash::text() const {
  return digits_of(XXH3_128bits_digest(&state_->sums));
}

}  // namespace talus
