#include "conformance/check.hpp"
#include "conformance/guarded.hpp"
#include "conformance/sample_values.hpp"
#include "plugin/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus::conformance {
namespace {

struct MadeFrom {
  bool made;
  std::string words;  ///< of the refusal
};

/// Calls `create` and `destroy` with a small buffer for the error between guard zones.
MadeFrom make_from(const Component& component, const std::vector<double>& values, std::size_t room,
                   Trial& trial) {
  constexpr unsigned char mark = 0x7E;
  const Guarded<double> guarded{std::span<const double>(values)};
  Guarded<char> error(room, mark);
  error.surround(mark);
  void* object = component.create(guarded.data(), error.data(), room);
  trial.due(error.surrounded_by(mark), "error text past its end", "at most error_size bytes of it");
  if (object != nullptr) {
    component.destroy(object);
    return {true, ""};
  }
  const char* end = std::find(error.begin(), error.end(), '\0');
  trial.due(end != error.end(), "a refusal that is not zero-terminated", "words, zero-terminated");
  std::string words(error.data(), static_cast<std::size_t>(end - error.begin()));
  trial.due(!words.empty(), "nullptr without a reason", "an object, or nullptr and the reason in words");
  return {false, words_of_plugin(words)};
}

void expect_state_that_fits(const Subject& subject, const std::vector<double>& values, Trial& trial) {
  std::uint32_t kept = 0;
  switch (subject.component->component->kind) {
    case ComponentKind::contact_model:
      kept = make<ContactModel>(*subject.component, values)->doubles_per_contact();
      break;
    case ComponentKind::material:
      kept = make<Material>(*subject.component, values)->doubles_per_element();
      break;
    default:
      return;
  }
  trial.due(kept <= most_state_doubles, fmt::format("{} doubles kept per contact or element", kept),
            fmt::format("{} at most", most_state_doubles));
}

}  // namespace

void check_parameters(const Subject& subject, Trial& trial) {
  const Component& component = *subject.component->component;
  const std::span<const Parameter> table(component.parameters, component.parameter_count);
  const std::vector<double> samples = in_order(table, {});
  trial.feed(in_words(table, samples));
  const MadeFrom usual = make_from(component, samples, room_for_words, trial);
  trial.due(usual.made, "refused: " + usual.words,
            "an object: these are defaults, and values within the ranges");
  if (usual.made) expect_state_that_fits(subject, samples, trial);

  for (std::size_t i = 0; i < table.size(); ++i) {
    const double huge = std::numeric_limits<double>::max();
    for (const double value :
         {table[i].minimum, table[i].maximum, std::nextafter(table[i].minimum, -huge),
          std::nextafter(table[i].maximum, huge), -1.0, 0.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
      std::vector<double> values = samples;
      values[i] = value;
      for (const std::size_t room : {room_for_words, std::size_t{8}}) {
        trial.feed(fmt::format("{} (in SI), with {} bytes for the reason of a refusal",
                               in_words({&table[i], 1}, {&value, 1}), room));
        make_from(component, values, room, trial);
      }
    }
  }
}

}  // namespace talus::conformance
