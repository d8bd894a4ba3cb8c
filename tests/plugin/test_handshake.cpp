#include "plugin/descriptors.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;
using Catch::Contains;

namespace {

/// Words for a library that fits but for what `spoil` does to it.
template <class Spoil>
std::string reason_when(Spoil spoil) {
  const Component component = fitting_component();
  Library library = fitting_library(&component, 1);
  spoil(library);
  return reason_to_refuse(library).value_or("");
}

}  // namespace

TEST_CASE("A library that fits is not refused", "[plugin]") {
  REQUIRE(reason_when([](Library&) {}) == "");
}

TEST_CASE("The size of every structure of the door is checked", "[plugin]") {
  const auto spoilt = [](std::uint32_t Library::*size) {
    return reason_when([size](Library& library) { library.*size -= 4; });
  };
  CHECK_THAT(spoilt(&Library::library_size), Contains("found Library of") && Contains("rebuild it against"));
  CHECK_THAT(spoilt(&Library::component_size), Contains("found Component of"));
  CHECK_THAT(spoilt(&Library::parameter_size), Contains("found Parameter of"));
  CHECK_THAT(spoilt(&Library::contact_batch_size), Contains("found ContactBatch of"));
  CHECK_THAT(spoilt(&Library::contact_loads_size), Contains("found ContactLoads of"));
  CHECK_THAT(spoilt(&Library::body_pair_size), Contains("found BodyPair of"));
  CHECK_THAT(spoilt(&Library::material_batch_size), Contains("found MaterialBatch of"));
  CHECK_THAT(spoilt(&Library::body_shape_size), Contains("found BodyShape of"));
  CHECK_THAT(spoilt(&Library::boundaries_size), Contains("found Boundaries of"));
  CHECK_THAT(spoilt(&Library::boundary_corner_size), Contains("found BoundaryCorner of"));
}

TEST_CASE("Name, version, author and units of a library must stand", "[plugin]") {
  CHECK_THAT(reason_when([](Library& library) { library.name = ""; }), Contains("no name"));
  CHECK_THAT(reason_when([](Library& library) { library.version = nullptr; }), Contains("no version"));
  CHECK_THAT(reason_when([](Library& library) { library.author = nullptr; }), Contains("no author"));
  CHECK_THAT(reason_when([](Library& library) { library.name = "two\nlines"; }),
             Contains("the name to hold control"));
  CHECK_THAT(reason_when([](Library& library) { library.author = "\xe9mile"; }), Contains("no UTF-8"));
  CHECK_THAT(reason_when([](Library& library) { library.units = nullptr; }), Contains("unit system ''"));
  CHECK_THAT(reason_when([](Library& library) { library.component_count = 0; }), Contains("no components"));
  CHECK_THAT(reason_when([](Library& library) { library.components = nullptr; }), Contains("no components"));
}

TEST_CASE("Two components of a kind in one library have two names", "[plugin]") {
  Component components[] = {fitting_component("twin"), fitting_component("twin")};
  CHECK_THAT(reason_to_refuse(fitting_library(components, 2)).value_or(""),
             Contains("two contact laws called 'twin'"));
  components[1].kind = ComponentKind::material;
  CHECK(!reason_to_refuse(fitting_library(components, 2)));
}

TEST_CASE("A component that lacks a name, sentence, constructor or table is refused, and the lack is named",
          "[plugin]") {
  const auto spoilt = [](auto spoil) {
    Component component = fitting_component();
    spoil(component);
    return reason_for(component);
  };
  CHECK_THAT(spoilt([](Component& c) { c.name = nullptr; }), Contains("component 0: found no name"));
  CHECK_THAT(spoilt([](Component& c) { c.name = "a,b"; }), Contains("'a,b'") && Contains("other characters"));
  CHECK_THAT(spoilt([](Component& c) { c.name = "roles"; }),
             Contains("'roles'") && Contains("wanted another"));
  CHECK_THAT(spoilt([](Component& c) { c.sentence = nullptr; }), Contains("no sentence"));
  CHECK_THAT(spoilt([](Component& c) { c.sentence = ""; }), Contains("no sentence"));
  CHECK_THAT(spoilt([](Component& c) { c.sentence = "caf\xe9"; }), Contains("no UTF-8"));
  CHECK_THAT(spoilt([](Component& c) { c.create = nullptr; }), Contains("no `create`"));
  CHECK_THAT(spoilt([](Component& c) { c.destroy = nullptr; }), Contains("no `destroy`"));
  CHECK_THAT(spoilt([](Component& c) { c.kind = static_cast<ComponentKind>(9); }), Contains("the kind 9"));
  CHECK_THAT(spoilt([](Component& c) { c.parameter_count = 2; }), Contains("2 parameters at a null pointer"));
  CHECK_THAT(spoilt([](Component& c) {
               c.kind = ComponentKind::material;
               c.interface_parameter_count = 1;
             }),
             Contains("interface parameters in a material"));
}

TEST_CASE("Parameter tables are checked row by row", "[plugin]") {
  const auto with = [](std::initializer_list<Parameter> parameters) {
    Component component = fitting_component();
    component.parameters = parameters.begin();
    component.parameter_count = static_cast<std::uint32_t>(parameters.size());
    return reason_for(component);
  };
  CHECK(with({number("a", "m", required, 0, 1, "."), number("b", "m", 1, 0, 1, "."),
              choice("c", "one|two", 1, "."), flag("d", true, ".")}) == "");
  CHECK_THAT(with({number("a", "m", 0, 0, 1, "."), flag("a", true, ".")}),
             Contains("two parameters called 'a'"));
  CHECK_THAT(with({number(nullptr, "m", 0, 0, 1, ".")}), Contains("parameter without a key"));
  CHECK_THAT(with({number("a/b", "m", 0, 0, 1, ".")}), Contains("other characters"));
  CHECK_THAT(with({number("a", nullptr, 0, 0, 1, ".")}), Contains("no unit"));
  CHECK_THAT(with({number("a", "", 0, 0, 1, ".")}), Contains("no unit"));
  CHECK_THAT(with({number("a", "m", 0, 0, 1, "")}), Contains("no sentence"));
  CHECK_THAT(with({number("a", "m", 0, 0, 1, "\x1b[2J")}), Contains("control characters"));
  CHECK_THAT(with({number("a", "\xb0", 0, 0, 1, ".")}), Contains("no UTF-8"));
  CHECK_THAT(with({number("a", "m", 2, 0, 1, ".")}), Contains("default 2 outside its range [0, 1]"));
  CHECK_THAT(with({number("a", "m", -unbounded, -unbounded, 0, ".")}), Contains("found the default -inf"));
  CHECK(with({number("a", "m", unbounded, 0, unbounded, ".")}) == "");
  CHECK_THAT(with({number("a", "m", 0, 1, 0, ".")}), Contains("range [1, 0]"));
  CHECK_THAT(with({number("a", "m", 0, required, 0, ".")}), Contains("the range [nan, 0]"));
  CHECK_THAT(with({choice("a", nullptr, 0, ".")}), Contains("choice without choices"));
  CHECK_THAT(with({choice("a", "\xff|b", 0, ".")}), Contains("no UTF-8"));
  CHECK_THAT(with({choice("a", "one||two", 0, ".")}), Contains("'one||two'"));
  CHECK_THAT(with({choice("a", "one|one", 0, ".")}), Contains("'one|one'"));
  CHECK_THAT(with({choice("a", "one|two", 2, ".")}), Contains("default position 2, wanted 0 to 1"));
  CHECK_THAT(with({choice("a", "one|two", 0.5, ".")}), Contains("default position 0.5"));
  Parameter half = flag("a", true, ".");
  half.default_value = 0.5;
  CHECK_THAT(with({half}), Contains("default 0.5"));
  half.kind = static_cast<ParameterKind>(7);
  CHECK_THAT(with({half}), Contains("the kind 7"));
}

TEST_CASE("Keys that scenes use themselves are not for parameters", "[plugin]") {
  const Parameter model = number("model", "-", 0, 0, 1, ".");
  const Parameter between = number("between", "-", 0, 0, 1, ".");
  Component component = fitting_component();
  component.parameters = &model;
  component.parameter_count = 1;
  CHECK(reason_for(component) == "");  // parameters of a law stand in a section of their own
  component.kind = ComponentKind::material;
  CHECK_THAT(reason_for(component), Contains("the name 'model'"));
  component.kind = ComponentKind::cover_builder;
  CHECK_THAT(reason_for(component), Contains("the name 'model'"));
  component = fitting_component();
  component.interface_parameters = &between;
  component.interface_parameter_count = 1;
  CHECK_THAT(reason_for(component), Contains("interface parameter 'between'"));
}
