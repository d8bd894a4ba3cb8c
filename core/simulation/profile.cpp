#include "simulation/profile.hpp"

namespace talus {

std::string_view name_of(Phase phase) {
  constexpr std::array<std::string_view, phase_count> names{
      "move", "boundary", "neighbours", "contacts", "loads", "materials", "velocities", "books", "checks"};
  return names[static_cast<std::size_t>(phase)];
}

}  // namespace talus
