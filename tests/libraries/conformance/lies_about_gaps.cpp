// Says of bodies without contact that they are a metre apart.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class LiesAboutGaps final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  bool apart(const ContactBatch&, const ContactLoads&, const Seen&,
             talus::PairReport& report) const override {
    report.gap = 1;
    return false;
  }
};

constexpr talus::Component components[] = {area_law<LiesAboutGaps>("lies_about_gaps")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
