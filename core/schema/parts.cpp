#include "schema/parts.hpp"

#include "scene/components.hpp"
#include "scene/quantity.hpp"
#include "scene/tables.hpp"
#include "schema/keys.hpp"
#include "schema/shapes.hpp"

#include <fmt/format.h>

#include <span>

namespace talus {
namespace {

using table::of;

Part world() {
  const OrderedJson materials{{"type", "object"},
                              {"propertyNames", shape::name()},
                              {"additionalProperties", shape::reference("material")}};
  Part part{"/", "scene", {}};
  part.keys = {
      {"talus", "", "required", "1", "Number of this format.", {{"const", 1}}},
      {"$schema", "", "not set", "path",
       "JSON Schema that editors check the scene with, as `talus schema` writes it; not read.",
       shape::text()},
      {"title", "", "\"\"", "text", "What the scene is called in reports.", shape::text()},
      {"plugins", "", "[]", "list of paths",
       "Libraries to load, relative to the scene; only with --allow-plugins, because they run code.",
       shape::list(shape::path())},
      pair_key(of(table::world, "origin")),
      pair_key(of(table::world, "gravity")),
      {"materials", "", "required", "object", "Materials by name.", materials},
      object_key("cover", R"({"model": "block"})", "Cover of the moving bodies that name none of their own.",
                 "cover"),
      object_key("contact", "required where bodies can meet", "Contact law.", "contact"),
      list_key("interfaces", "What the law needs to know of each pair of surfaces.", "interface"),
      {"bodies", "", "required without blocks", "list", "The bodies.", shape::list(shape::reference("body"))},
      list_key("blocks", "Generators: domains that are cut into bodies.", "generator"),
      list_key("loads", "Point loads.", "load"),
      list_key("surface_loads", "Tractions and pressures on surfaces.", "surface_load"),
      list_key("prescribed", "Surfaces with a prescribed motion.", "prescribed"),
      list_key("absorbing", "Surfaces that let waves out.", "absorbing"),
      functions_key(of(table::world, "base_acceleration"), Axes::both, false),
      worded_key(of(table::world, "damping"), {"adaptive", "kinetic"}),
      object_key("settle", "not set", "Brings the scene to rest before t = 0.", "settle"),
      list_key("stages", "What changes during the run.", "stage"),
      list_key("monitors", "What goes into history.csv.", "monitor"),
      object_key("time", "required", "End and time step.", "time"),
      object_key("sleep", "not set", "Lets what rests sleep: faster, with a deviation that is reported.",
                 "sleep"),
      object_key("output", "{}", "Intervals of what is written.", "output"),
      object_key("limits", "{}", "When a run is stopped.", "limits"),
      list_key("tolerances", "How far compared runs may part.", "tolerance"),
  };
  part.conditions = {{"anyOf", OrderedJson::array({shape::some_of("bodies"), shape::some_of("blocks")})}};
  return part;
}

Part material() {
  return {"/materials/*",
          "material",
          {number_key(of(table::material, "density")),
           {"model", "", "not set", "name of a material model",
            "Needed by bodies that deform, not by rigid and fixed ones.", shape::text()}}};
}

Part cover() {
  return {"/cover",
          "cover",
          {{"model", "", fmt::format("\"{}\"", default_cover), "name of a cover",
            "How the body is covered by patches and elements.", shape::text()}}};
}

Part contact() {
  return {"/contact",
          "contact",
          {{"model", "", "required", "name of a contact law", "The law by which bodies meet.", shape::text()},
           number_key(of(table::contact, "roles"))}};
}

Part interface() {
  Part part{"/interfaces/*",
            "interface",
            {{"between", "", "required", "two entries",
              "Each is a material, a surface, body/surface, or \"*\" for any.", shape::pair(shape::text())}}};
  const std::vector<Key> common = common_interface_keys();
  part.keys.insert(part.keys.end(), common.begin(), common.end());
  return part;
}

/// What bodies have in common with the blocks of a generator.
std::vector<Key> shared_keys() {
  return {
      {"material", "", "required", "name", "What it is made of.", shape::text()},
      object_key("cover", "that of the scene", "Cover of its own.", "cover"),
      number_key(of(table::body, "fixed")),
      pair_key(of(table::body, "velocity")),
      number_key(of(table::body, "angular_velocity")),
      {"fix",
       "",
       "[]",
       "list of \"x\", \"y\", \"rotation\"",
       "Motions of the body as a whole that are held; it may still strain.",
       {{"type", "array"}, {"items", shape::one_of({"x", "y", "rotation"})}, {"uniqueItems", true}}},
      object_key("drive", "{}", "Motions of the body as a whole that are prescribed, as velocities.",
                 "drive"),
      number_key(of(table::body, "self_contact")),
      number_key(of(table::body, "priority")),
  };
}

/// A body without unknowns is neither held nor cut.
OrderedJson nothing_held_where_fixed(const std::vector<std::string>& keys) {
  OrderedJson consequence = OrderedJson::object();
  for (const std::string& key : keys)
    consequence["properties"][key] = {{"maxItems", 0}, {"maxProperties", 0}};
  consequence["properties"]["self_contact"] = {{"const", false}};
  return shape::if_then({{"properties", {{"fixed", {{"const", true}}}}}, {"required", {"fixed"}}},
                        consequence);
}

Part body() {
  Part part{"/bodies/*", "body", {name_key("What others call the body by.")}};
  part.keys.insert(
      part.keys.end(),
      {{"polygon", "m", "required without mesh", "3 points or more",
        "Outer boundary, either way round, concave allowed.", shape::polygon(3)},
       {"holes", "m", "[]", "list of polygons", "Holes within the boundary, apart from each other.",
        shape::list(shape::polygon(3))},
       {"surfaces", "", "{}", R"({"name": [edges]})",
        "Names for edges of the polygon: edge i runs from point i to the next, as written, from 0; edges of "
        "holes are numbered on.",
        shape::edges()},
       {"mesh", "m", "not set", "path", "Shape from a mesh instead of the three above.", shape::path()},
       list_key("discontinuities", "Polylines along which the body is cut.", "polyline")});
  const std::vector<Key> shared = shared_keys();
  part.keys.insert(part.keys.end(), shared.begin(), shared.end());
  OrderedJson shaped =
      shape::if_then(shape::required({"mesh"}), shape::forbidden({"polygon", "holes", "surfaces"}));
  shaped["else"] = shape::required({"polygon"});
  part.conditions = {{"allOf", {shaped, nothing_held_where_fixed({"fix", "drive", "discontinuities"})}}};
  return part;
}

Part polyline() {
  return {"/bodies/*/discontinuities/*",
          "polyline",
          {{"points", "m", "required", "2 points or more",
            "May meet or cross others, leave the body, or end within it.", shape::polygon(2)},
           line_surface_key()}};
}

Part generator() {
  Part part{"/blocks/*", "generator", {name_key("What the names of the blocks begin with.")}};
  part.keys.insert(
      part.keys.end(),
      {{"domain", "m", "required", "3 points or more", "Outer boundary, either way round, concave allowed.",
        shape::polygon(3)},
       {"holes", "m", "[]", "list of polygons", "Openings in the domain.", shape::list(shape::polygon(3))},
       {"surfaces", "", "{}", R"({"name": [edges]})",
        "Names for edges of domain and holes, as for bodies; blocks along them have the surface.",
        shape::edges()},
       list_key("joint_sets", "Families of parallel joints.", "joint_set"),
       list_key("joints", "Single polylines, as discontinuities of bodies.", "polyline"),
       object_key("bricks", "not set", "Masonry.", "bricks"),
       object_key("voronoi", "not set", "Cells around points.", "voronoi"),
       {"dxf", "m", "not set", "path", "Joints from a drawing.", shape::path()},
       number_key(of(table::blocks, "smallest_area")),
       number_key(of(table::blocks, "smallest_share")),
       object_key("split", "not set", "Splits quadrilaterals into triangles.", "split")});
  const std::vector<Key> shared = shared_keys();
  part.keys.insert(part.keys.end(), shared.begin(), shared.end());
  part.conditions = nothing_held_where_fixed({"fix", "drive"});
  return part;
}

Part joint_set() {
  Part part{"/blocks/*/joint_sets/*", "joint_set", number_keys(table::joint_set)};
  for (Key& key : part.keys) {
    if (key.name == "seed") key = whole_key(of(table::joint_set, "seed"));
    if (key.name == "gap") key.default_text = "required with a persistence below 1";
  }
  part.keys.push_back(line_surface_key());
  const OrderedJson broken{{"properties", {{"persistence", {{"exclusiveMaximum", 1}}}}},
                           {"required", {"persistence"}}};
  part.conditions = shape::if_then(broken, shape::required({"gap"}));
  part.conditions["else"] = shape::forbidden({"gap"});
  return part;
}

Part voronoi() {
  Part part{"/blocks/*/voronoi",
            "voronoi",
            {whole_key(of(table::voronoi, "count")), number_key(of(table::voronoi, "spacing")),
             number_key(of(table::voronoi, "jitter")), whole_key(of(table::voronoi, "seed"))}};
  part.keys[0].default_text = "required without spacing";
  part.keys[1].default_text = "required without count";
  part.conditions = {{"oneOf", {shape::required({"count"}), shape::required({"spacing"})}},
                     {"dependentRequired", {{"jitter", {"spacing"}}}}};
  return part;
}

Part split() {
  return {"/blocks/*/split",
          "split",
          {number_key(of(table::split, "share")), whole_key(of(table::split, "seed"))}};
}

Part load() {
  return {"/loads/*",
          "load",
          {body_key("A body that moves."),
           {"point", "m", "required", "[x, y]", "Where it acts at the start; the load moves with the body.",
            shape::point()},
           functions_key(of(table::load, "force"), Axes::both)}};
}

Part surface_load() {
  return {"/surface_loads/*",
          "surface_load",
          {body_key("A body that moves."), surface_key(),
           functions_key(of(table::surface_load, "traction"), Axes::both),
           function_key(of(table::surface_load, "pressure"))},
          shape::any_of({"traction", "pressure"})};
}

Part prescribed() {
  return {"/prescribed/*",
          "prescribed",
          {body_key("A body that moves."), surface_key(), number_key(of(table::prescribed, "stiffness")),
           number_key(of(table::prescribed, "ramp")),
           functions_key(of(table::prescribed, "displacement"), Axes::may_be_free),
           functions_key(of(table::prescribed, "velocity"), Axes::may_be_free)},
          shape::any_of({"displacement", "velocity"})};
}

Part absorbing() {
  return {"/absorbing/*", "absorbing", {body_key("A body that moves."), surface_key()}};
}

Part settle() {
  return {"/settle",
          "settle",
          {number_key(of(table::settle, "duration")),
           worded_key(of(table::settle, "damping"), {"adaptive", "kinetic"}),
           number_key(of(table::settle, "until")), number_key(of(table::settle, "hold_stick"))}};
}

Part stage() {
  const OrderedJson set{
      {"type", "object"},
      {"propertyNames",
       {{"pattern",
         "^/(gravity|damping|base_acceleration|interfaces|loads|surface_loads|prescribed|absorbing|"
         "bodies/[0-9]+/(fix|drive))(/|$)"}}}};
  return {"/stages/*",
          "stage",
          {{"name", "", "required", "text", "What the stage is called.", shape::text()},
           number_key(of(table::stage, "from")),
           {"set", "", "required", R"({"/pointer": value})", "Values, each under its JSON pointer.", set}}};
}

Part monitor() {
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities()) names.emplace_back(quantity.name);
  OrderedJson recorded = shape::list(shape::one_of(names), 1);
  recorded["uniqueItems"] = true;
  return {"/monitors/*",
          "monitor",
          {name_key("Head of the columns, as in name.ux [m]."),
           body_key("Name of the body."),
           {"point", "m", "centre of mass", "[x, y]",
            "Point of the body at the start; where a discontinuity runs through it, of one of the two faces.",
            shape::point()},
           {"quantities", "", R"(["ux", "uy", "vx", "vy", "speed", "rotation"])", "list", "What is recorded.",
            recorded}}};
}

Part time() {
  Part part{"/time",
            "time",
            {number_key(of(table::time, "end")), worded_key(of(table::time, "dt"), {"auto"}),
             number_key(of(table::time, "safety"))}};
  return part;
}

Part output() {
  return {"/output",
          "output",
          {number_key_or(of(table::output, "history"), "a 500th of the run"),
           number_key(of(table::output, "frames"))}};
}

Part tolerance() {
  Part part{"/tolerances/*",
            "tolerance",
            {{"monitor", "", "required", "name", "A monitor of the scene.", shape::text()},
             {"quantity", "", "required", "name", "One of its quantities.", shape::text()}},
            shape::any_of({"largest", "rms", "final"})};
  for (Key& key : number_keys(table::tolerance)) {
    if (key.name != "against") key.unit = "that of the quantity";
    part.keys.push_back(std::move(key));
  }
  return part;
}

}  // namespace

std::vector<Part> parts_of_scene() {
  return {world(),
          material(),
          cover(),
          contact(),
          interface(),
          body(),
          polyline(),
          {"/bodies/*/drive", "drive", number_keys(table::drive)},
          generator(),
          joint_set(),
          {"/blocks/*/bricks", "bricks", number_keys(table::bricks)},
          voronoi(),
          split(),
          load(),
          surface_load(),
          prescribed(),
          absorbing(),
          settle(),
          stage(),
          monitor(),
          time(),
          {"/sleep", "sleep", number_keys(table::sleep)},
          output(),
          {"/limits", "limits", number_keys(table::limits)},
          tolerance()};
}

std::vector<Key> keys_of(const Component& component) {
  return number_keys({component.parameters, component.parameter_count});
}

std::vector<Key> interface_keys_of(const Component& law) {
  return number_keys({law.interface_parameters, law.interface_parameter_count});
}

std::vector<Key> common_interface_keys() {
  return number_keys(table::interface);
}

}  // namespace talus
