#pragma once

#include <talus/contact_model.hpp>

#include <cstddef>

namespace talus::benchmarks {

/// One call of a law.
struct LawCall {
  ContactBatch batch;
  ContactLoads loads;
};

/// Asks a law for all contacts of a step and adds up what the host adds up, J/m. The two in libfused_law.so
/// come from one piece of source: the one asks through the interface, the other knows the law.
using ContactsOfStep = double (*)(const ContactModel& law, const LawCall* calls, std::size_t count);

inline constexpr const char* through_interface = "contacts_through_interface";
inline constexpr const char* fused = "contacts_fused";  ///< overlap_area, with its default parameters

}  // namespace talus::benchmarks
