#pragma once

#include <cstdint>
#include <string>

namespace talus {

/// Which of these sets (bits of `Library::instructions`) this machine lacks, "avx512f, avx512vl"; "" if none.
std::string instructions_lacking(std::uint64_t needed);

}  // namespace talus
