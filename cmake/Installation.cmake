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
install(FILES README.md CHANGELOG.md DESTINATION share/doc/talus)
install(FILES LICENSE DESTINATION share/doc/talus RENAME copyright)
install(DIRECTORY docs DESTINATION share/doc/talus FILES_MATCHING PATTERN *.md PATTERN *.svg)

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
