include(CMakePackageConfigHelpers)

install(TARGETS gale gale_io gale_outputs EXPORT gale-targets)
if(GALE_ENABLE_APP)
  install(TARGETS gale_app)
endif()
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gale FILES_MATCHING PATTERN "*.hpp" PATTERN "app" EXCLUDE)
install(EXPORT gale-targets NAMESPACE gale:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/gale)
configure_package_config_file(cmake/gale-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/gale-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/gale)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/gale-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/gale-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/gale-config-version.cmake
  cmake/gale-dependencies.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/gale)
