# talus_embed(output header namespace name=file...): a source that defines a std::string_view with the text of each
# file, declared in the header. Written anew when a file changes.
function(talus_embed output header namespace)
  set(text "#include \"${header}\"\n\nnamespace ${namespace} {\n\n")
  foreach(entry IN LISTS ARGN)
    string(REGEX MATCH "^([^=]+)=(.*)$" matched "${entry}")
    set(name ${CMAKE_MATCH_1})
    set(file ${CMAKE_MATCH_2})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} content)
    # A page that needs nothing else names no map of its sources.
    string(REGEX REPLACE "\n?/[/*]# sourceMappingURL=[^\n]*" "" content "${content}")
    string(APPEND text "const std::string_view ${name} = R\"talus(${content})talus\";\n\n")
  endforeach()
  string(APPEND text "}  // namespace ${namespace}\n")
  file(WRITE ${output}.new "${text}")
  file(COPY_FILE ${output}.new ${output} ONLY_IF_DIFFERENT)
endfunction()
