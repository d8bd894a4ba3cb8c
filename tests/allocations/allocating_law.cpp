// A law without contacts that asks for memory in three ways whenever it is called: what the counting must
// see.
#include "libraries/descriptor.hpp"

#include <cstdlib>
#include <new>

namespace {

/// Kept out of the compiler's sight, or it would see that the memory is not used and not ask for it.
void* volatile last;

class AllocatingLaw : public SilentLaw {
 public:
  using SilentLaw::SilentLaw;

  void evaluate(const talus::ContactBatch& batch, const talus::ContactLoads& loads) const noexcept override {
    for (std::uint32_t i = 0; i < batch.active_count; ++i) loads.pairs[batch.active[i]] = {};
    last = std::malloc(1);
    std::free(last);
    last = ::operator new(1);
    ::operator delete(last);
    last = ::operator new (64, std::align_val_t{64});
    ::operator delete (last, std::align_val_t{64});
  }
};

constexpr talus::Component components[] = {law<AllocatingLaw>("allocating")};

}  // namespace

TALUS_EXPORT const talus::Library talus_library = descriptor(components, 1);
