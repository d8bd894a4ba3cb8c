// A constructor that throws, and does not say why.
#include "area_law.hpp"

#include <stdexcept>

namespace {

using namespace spoilt;

class RefusesWithoutWords final : public AreaLaw {
 public:
  explicit RefusesWithoutWords(const double* values) : AreaLaw(values) { throw std::invalid_argument(""); }
};

constexpr talus::Component components[] = {area_law<RefusesWithoutWords>("refuses_without_words")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
