# talus_add_plugin: how a plugin is built, within the tree and outside of it (find_package(talus)).

option(TALUS_SIMD "Build the loops and the plugins for AVX2 and AVX-512, too, and pick when the program starts" ON)

# Instruction sets a plugin is compiled for beside the baseline of the machine's kind. The program loads the best
# that the machine has: <folder>/<level>/lib<name>.so in place of <folder>/lib<name>.so.
set(talus_simd_levels)
if(TALUS_SIMD AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  set(talus_simd_levels avx2 avx512)
  set(talus_flags_avx2 -march=x86-64-v3)
  set(talus_flags_avx512 -march=x86-64-v4 -mprefer-vector-width=512)
  # GCC copies packs by halves unless told, and what is stored so must be waited for when it is loaded whole.
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12)
    list(APPEND talus_flags_avx2 -mmove-max=256 -mstore-max=256)
    list(APPEND talus_flags_avx512 -mmove-max=512 -mstore-max=512)
  endif()
endif()

function(talus_add_plugin_library target name level)
  add_library(${target} MODULE ${ARGN})
  target_link_libraries(${target} PRIVATE talus::kit)
  set_target_properties(${target} PROPERTIES
    PREFIX lib
    SUFFIX .so
    OUTPUT_NAME ${name}
    CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  get_target_property(folder ${target} LIBRARY_OUTPUT_DIRECTORY)
  if(NOT folder)
    set(folder ${CMAKE_CURRENT_BINARY_DIR})
  endif()
  set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${folder}/${level})
  # Same bits everywhere: no contraction to fused multiply-add. Results stay those of IEEE 754; loops may be
  # vectorised that set errno or flags nobody reads.
  target_compile_options(${target} PRIVATE
    -ffp-contract=off -fno-math-errno -fno-trapping-math ${talus_flags_${level}})
  # Symbols unique to the process would make the levels share code.
  if(talus_simd_levels AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(${target} PRIVATE -fno-gnu-unique)
  endif()
  # The sanitizers' own functions are in the program, so their users are undefined until they are loaded.
  if(NOT TALUS_SANITIZE)
    target_link_options(${target} PRIVATE -Wl,--no-undefined)
  endif()
  install(TARGETS ${target} LIBRARY DESTINATION lib/talus/plugins/${level})
endfunction()

# talus_add_plugin(name [SIMD] sources...): a shared library that talus loads, in CMAKE_LIBRARY_OUTPUT_DIRECTORY or
# the folder of the build. Hidden visibility, nothing undefined; the one exported symbol is `talus_library`. SIMD
# builds it for each instruction set, too: worth it for what works in every step. `cmake --install` puts it where the
# program finds it, if the prefix is that of talus.
function(talus_add_plugin name)
  cmake_parse_arguments(PARSE_ARGV 1 plugin "SIMD" "" "")
  talus_add_plugin_library(${name} ${name} "" ${plugin_UNPARSED_ARGUMENTS})
  # What an earlier build left for a set that this one does not build would be taken in place of it.
  get_target_property(folder ${name} LIBRARY_OUTPUT_DIRECTORY)
  foreach(level IN ITEMS avx2 avx512)
    if(folder AND (NOT plugin_SIMD OR NOT level IN_LIST talus_simd_levels))
      file(REMOVE ${folder}/${level}/lib${name}.so)
    endif()
  endforeach()
  if(NOT plugin_SIMD)
    return()
  endif()
  foreach(level IN LISTS talus_simd_levels)
    talus_add_plugin_library(${name}.${level} ${name} ${level} ${plugin_UNPARSED_ARGUMENTS})
    add_dependencies(${name} ${name}.${level})
  endforeach()
endfunction()
