// Friction takes energy and says nothing of it.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class BooksNoLoss final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double loss(const Seen&, double /*work*/, double /*stored_more*/) const override { return 0; }
};

constexpr talus::Component components[] = {area_law<BooksNoLoss>("books_no_loss")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
