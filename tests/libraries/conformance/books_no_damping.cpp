// Damps, and says nothing of it.
#include "damped_law.hpp"

namespace {

using namespace spoilt;

class BooksNoDamping final : public DampedLaw {
 public:
  using DampedLaw::DampedLaw;

 private:
  double told_power(double /*power*/) const override { return 0; }
  double told_force(double /*force*/) const override { return 0; }
};

constexpr talus::Component components[] = {damped_law<BooksNoDamping>("books_no_damping")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = spoilt::library(components);
