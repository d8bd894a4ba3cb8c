// Books what friction takes only where both bodies are masters.
#include "area_law.hpp"

namespace {

using namespace spoilt;

class BooksAsBoth final : public AreaLaw {
 public:
  using AreaLaw::AreaLaw;

 private:
  double loss(const Seen& seen, double work, double stored_more) const override {
    return seen.pair->master_share() == 0.5 ? work - stored_more : 0;
  }
};

constexpr talus::Component components[] = {area_law<BooksAsBoth>("books_as_both")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
