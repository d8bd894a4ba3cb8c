# What `cmake --install` puts beside the program and its plugins, and the Debian package made of it (cpack).
# Everything is found from where the program is, so a prefix can be moved as a whole.
include(CMakePackageConfigHelpers)
set(talus_package lib/cmake/talus)
configure_package_config_file(cmake/talusConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/talusConfig.cmake
  INSTALL_DESTINATION ${talus_package} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/talusConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(EXPORT talusTargets NAMESPACE talus:: DESTINATION ${talus_package})
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/talusConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/talusConfigVersion.cmake
  cmake/TalusPlugin.cmake
  DESTINATION ${talus_package})
install(DIRECTORY scenes DESTINATION share/talus PATTERN __pycache__ EXCLUDE)
install(FILES LICENSE DESTINATION share/doc/talus RENAME copyright)

# Documents refer to each other, to scenes and to headers by where those stand in a checkout, so they stand alike here.
file(GLOB_RECURSE documents RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS docs/*.md docs/*.svg docs/*.png)
file(GLOB beside_what_they_describe RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
  contact_models/*/README.md plugins/*/README.md tests/benchmarks/README.md)
foreach(document README.md CHANGELOG.md LICENSE ${documents} ${beside_what_they_describe})
  cmake_path(GET document PARENT_PATH folder)
  install(FILES ${document} DESTINATION share/doc/talus/${folder})
endforeach()
file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/linked/kit)
file(CREATE_LINK ../../talus/scenes ${CMAKE_CURRENT_BINARY_DIR}/linked/scenes SYMBOLIC)
file(CREATE_LINK ../../../../../include/talus ${CMAKE_CURRENT_BINARY_DIR}/linked/kit/talus SYMBOLIC)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/linked/scenes DESTINATION share/doc/talus)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/linked/kit/talus DESTINATION share/doc/talus/core/kit)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "the talus authors")
set(CPACK_PACKAGE_CONTACT "the talus authors <talus@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Explicit numerical manifold method in 2D, contact laws as plugins")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What builds a plugin is no need of those who only run scenes.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, catch2")
include(CPack)
