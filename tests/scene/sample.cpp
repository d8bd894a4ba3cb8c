#include "scene/sample.hpp"

#include <cstdio>
#include <stdexcept>

namespace talus::sample {
namespace {

int anything;

void* make_anything(const double*, char*, std::size_t) noexcept {
  return &anything;
}
void* make_shear(const double* values, char* error, std::size_t error_size) noexcept {
  if (values[0] == 0 || values[1] == 0) return &anything;
  std::snprintf(error, error_size, "strict needs return_mapping");
  return nullptr;
}
void* make_elastic(const double* values, char* error, std::size_t error_size) noexcept {
  if (values[1] <= 0.45) return &anything;
  std::snprintf(error, error_size, "poisson_ratio locks the block");
  return nullptr;
}
void* make_block(const double* values, char* error, std::size_t error_size) noexcept {
  if (values[0] < 3) return &anything;
  std::snprintf(error, error_size, "tilt turns the triangle upside down");
  return nullptr;
}
void destroy_nothing(void*) noexcept {}

constexpr Parameter shear_parameters[] = {
    choice("friction_rule", "return_mapping|paper", 0, "How slip is told."),
    flag("strict", false, "Whether to be strict."),
};
constexpr Parameter shear_interface[] = {
    number("normal_damping", "-", required, 0, 10, "Normal damping."),
    number("friction_angle", "deg", required, 0, 89, "Friction."),
    number("normal_stiffness", "Pa/m", required, 1e-9, unbounded, "Stiffness."),
    number("cohesion", "Pa", 0, 0, unbounded, "Cohesion."),
    number("dilation", "deg", 5, 0, 45, "A key of this law alone."),
};
constexpr Parameter smooth_interface[] = {
    number("normal_stiffness", "Pa/m", required, 1, 1e15, "Stiffness."),
    number("normal_damping", "-", 0.1, 0, 10, "Normal damping."),
};
constexpr Parameter elastic_parameters[] = {
    number("young_modulus", "Pa", required, 1, unbounded, "Stiffness of the material."),
    number("poisson_ratio", "-", 0.25, 0, 0.49, "Lateral contraction."),
};
constexpr Parameter block_parameters[] = {number("tilt", "deg", 0, -180, 180, "Angle of the triangle.")};

constexpr Component components[] = {
    {ComponentKind::contact_model, "shear", "A law with friction.", shear_parameters, 2, shear_interface, 5,
     make_shear, destroy_nothing},
    {ComponentKind::contact_model, "smooth", "A law without.", nullptr, 0, smooth_interface, 2, make_anything,
     destroy_nothing},
    {ComponentKind::material, "linear_elastic", "Hooke.", elastic_parameters, 2, nullptr, 0, make_elastic,
     destroy_nothing},
    {ComponentKind::cover_builder, "block", "One triangle.", block_parameters, 1, nullptr, 0, make_block,
     destroy_nothing},
    {ComponentKind::cover_builder, "rigid", "No strain.", nullptr, 0, nullptr, 0, make_anything,
     destroy_nothing},
};

Library library() {
  Library all;
  all.name = "sample";
  all.version = "1";
  all.author = "nobody";
  all.components = components;
  all.component_count = 5;
  return all;
}

}  // namespace

const char* const good = R"({
  "talus": 1,
  "gravity": [0, -10],
  "materials": {
    "rock": {"density": 2300, "model": "linear_elastic", "young_modulus": 1e10},
    "steel": {"density": 7800}
  },
  "contact": {"model": "shear", "shear": {"friction_rule": "paper"}},
  "interfaces": [
    {"between": ["*", "*"], "normal_stiffness": 1e10, "friction_angle": 20, "normal_damping": 0.3}
  ],
  "bodies": [
    {"name": "ramp", "polygon": [[0, 0], [4, 0], [4, 1], [0, 1]], "material": "steel", "fixed": true, "surfaces": {"top": [2]}},
    {"name": "block", "polygon": [[1, 1], [2, 1], [2, 2], [1, 2]], "material": "rock"}
  ],
  "loads": [{"body": "block", "point": [2, 2], "force": [1, 0]}],
  "monitors": [{"name": "block", "body": "block"}],
  "time": {"end": 5}
})";

Registry registry() {
  static const Library sample = library();
  Registry all;
  all.add(sample, "/nowhere/libsample.so");
  return all;
}

std::string good_but(const std::string& old_text, const std::string& new_text) {
  std::string text = good;
  const std::size_t at = text.find(old_text);
  if (at == std::string::npos || text.find(old_text, at + 1) != std::string::npos) {
    throw std::logic_error("not there exactly once: " + old_text);
  }
  return text.replace(at, old_text.size(), new_text);
}

std::string good_with(const std::string& part) {
  std::string text = good_but("\"material\": \"rock\"",
                              "\"material\": \"rock\", \"surfaces\": {\"base\": [0], \"side\": [1, 3]}");
  const std::string time = "\"time\":";
  return text.replace(text.find(time), time.size(), part + ",\n  " + time);
}

Scene read(const std::string& text, const ReadOptions& options) {
  static Registry all = registry();  // scenes point into it
  return read_scene_text(text, "scene.json", all, options);
}

std::vector<Mistake> mistakes(const std::string& text, const ReadOptions& options) {
  try {
    read(text, options);
  } catch (const SceneError& error) {
    return error.mistakes;
  }
  return {};
}

std::string interface_row(const std::string& first, const std::string& second, int friction_angle) {
  return "{\"between\": [\"" + first + "\", \"" + second +
         "\"], \"normal_stiffness\": 1, \"normal_damping\": 0, \"friction_angle\": " +
         std::to_string(friction_angle) + "}";
}

}  // namespace talus::sample
