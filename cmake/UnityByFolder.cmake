# talus_unite_by_folder(target sources...): in a unity build (CMAKE_UNITY_BUILD), the sources of a folder, given
# relative to it or absolute, are compiled as one.
function(talus_unite_by_folder target)
  foreach(source IN LISTS ARGN)
    cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE path)
    cmake_path(GET path PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(MAKE_C_IDENTIFIER ${folder} group)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# talus_compile_folders(target option folder...): in a unity build, one more option for the compiler in these folders of
# the current directory. It may be one that precompiled headers must agree on, so these go without.
function(talus_compile_folders target option)
  foreach(folder IN LISTS ARGN)
    cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE here)
    string(MAKE_C_IDENTIFIER ${here}/${folder} group)
    set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir/Unity/unity_${group}_cxx.cxx
      PROPERTIES COMPILE_OPTIONS ${option} SKIP_PRECOMPILE_HEADERS ON)
  endforeach()
endfunction()
