# talus_add_plugin(name sources...): a shared library that talus loads. Hidden visibility, nothing undefined,
# the one exported symbol is `talus_library`.
function(talus_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE talus_kit)
  # Square roots without errno, loops without regard to the flags of floating point: the same results, as
  # vectors.
  target_compile_options(${name} PRIVATE -fno-math-errno -fno-trapping-math)
  set_target_properties(${name} PROPERTIES
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/talus/plugins)
  # The sanitizers' own functions are in the program, so their users are undefined until they are loaded.
  if(NOT TALUS_SANITIZE)
    target_link_options(${name} PRIVATE -Wl,--no-undefined)
  endif()
  install(TARGETS ${name} LIBRARY DESTINATION lib/talus/plugins)
endfunction()
