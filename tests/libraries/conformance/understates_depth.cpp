// Bodies are a hundred times as deep in each other as it says.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class UnderstatesDepth final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double depth(double measured) const override { return measured / 100; }
};

constexpr talus::Component components[] = {area_law<UnderstatesDepth>("understates_depth")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
