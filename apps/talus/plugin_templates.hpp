#pragma once

#include <string_view>

/// What `talus new-plugin` writes: the files in apps/talus/templates, embedded by CMake.
namespace talus::templates {

extern const std::string_view cmake_lists, ci;
extern const std::string_view contact_source, contact_test, contact_readme, contact_scene;
extern const std::string_view material_source, material_test, material_readme, material_scene;
extern const std::string_view cover_source, cover_test, cover_readme, cover_scene;

}  // namespace talus::templates
