#include "tally.hpp"

#include <array>

namespace talus::tally {

std::uint32_t contacts = 1;

namespace {

constexpr Parameter interface_parameters[] = {
    number("normal_stiffness", "Pa/m", required, 0, unbounded, "Read by nobody."),
};

class Tally final : public ContactModel {
 public:
  explicit Tally(const double* /*values*/) {}

  std::uint32_t doubles_per_contact() const noexcept override { return 1; }

  void evaluate(const ContactBatch& batch, const ContactLoads& loads) const noexcept override {
    for (std::uint32_t k = 0; k < batch.active_count; ++k) {
      const std::uint32_t i = batch.active[k];
      const BodyPair& pair = batch.pairs[i];
      loads.pairs[i] = {};
      loads.pairs[i].contact_count = contacts;
      for (const PiecePair pieces : batch.piece_pairs.of(pair)) {
        const std::uint32_t* start = batch.boundaries.piece_start;
        const std::uint32_t corners =
            start[pieces.a + 1] - start[pieces.a] + start[pieces.b + 1] - start[pieces.b];
        for (std::uint32_t c = 0; c < corners; ++c) loads.corner[pieces.load_start + c] = {0, 0};
      }
      for (std::uint32_t c = 0; c < contacts && c < pair.slot_capacity; ++c) {
        const double age = c < pair.contact_count ? batch.history[pair.slot_start + c] : 0;
        loads.history[pair.slot_start + c] = age + 1;
      }
    }
  }

  ContactStiffness stiffness(const double* /*values*/, double /*length*/) const noexcept override {
    return {};
  }
};

constexpr Component components[] = {{
    ComponentKind::contact_model,
    "tally",
    "Counts the steps of each contact.",
    nullptr,
    0,
    interface_parameters,
    std::size(interface_parameters),
    create_component<ContactModel, Tally>,
    destroy_component<ContactModel>,
}};

const Library library = {.name = "tally",
                         .version = "1",
                         .author = "a test",
                         .components = components,
                         .component_count = std::size(components)};

}  // namespace

Registry& registry() {
  static Registry all = [] {
    Registry made;
    load_folders(made, std::array{std::filesystem::path(TALUS_PLUGINS)});
    made.add(library, "/nowhere/libtally.so");
    return made;
  }();
  return all;
}

}  // namespace talus::tally
