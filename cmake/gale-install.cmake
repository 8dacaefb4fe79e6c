include(CMakePackageConfigHelpers)

# A package for each library, so that who links gale::gale alone is asked for what that needs.
set(gale_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gale)
install(TARGETS gale EXPORT gale-targets)
install(TARGETS gale_io EXPORT gale-io-targets)
install(TARGETS gale_outputs EXPORT gale-outputs-targets)
set(gale_exports gale-targets gale-io-targets gale-outputs-targets)
if(GALE_ENABLE_MPI)
  install(TARGETS gale_distributed EXPORT gale-distributed-targets)
  list(APPEND gale_exports gale-distributed-targets)
endif()
foreach(name IN LISTS gale_exports)
  install(EXPORT ${name} NAMESPACE gale:: DESTINATION ${gale_package_dir})
endforeach()
if(GALE_ENABLE_APP)
  install(TARGETS gale_app)
endif()

# Headers in their folders.
function(gale_install_headers root)
  foreach(header IN LISTS ARGN)
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${root}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gale/${folder})
  endforeach()
endfunction()
gale_install_headers(${PROJECT_SOURCE_DIR}/src ${gale_public_headers} ${gale_included_headers})
gale_install_headers(${gale_generated_root}/gale ${gale_generated_headers})

# Static libraries leave it to the program to link what they use; shared ones have done that.
set(gale_wants_kokkos_kernels FALSE)
set(gale_io_wants_vtk FALSE)
if(NOT BUILD_SHARED_LIBS)
  set(gale_io_wants_vtk ${GALE_ENABLE_VTK})
  if(GALE_ENABLE_KOKKOS_KERNELS AND NOT gale_kokkos_kernels_files_known)
    set(gale_wants_kokkos_kernels TRUE)
  endif()
endif()
set(gale_without_kokkos_kernels ON) # who uses the package can do without
if(gale_wants_kokkos_kernels)
  set(gale_without_kokkos_kernels OFF)
endif()
set(gale_has_distributed FALSE)
if(GALE_ENABLE_MPI)
  set(gale_has_distributed TRUE)
endif()
configure_package_config_file(cmake/gale-config.cmake.in ${PROJECT_BINARY_DIR}/gale-config.cmake
  INSTALL_DESTINATION ${gale_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gale-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gale-config.cmake ${PROJECT_BINARY_DIR}/gale-config-version.cmake
  cmake/gale-dependencies.cmake DESTINATION ${gale_package_dir})

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The manual page is what the command says about itself, where help2man is there to ask it.
if(GALE_ENABLE_APP)
  find_program(GALE_HELP2MAN help2man DOC "Makes the manual page; without it there is none")
  mark_as_advanced(GALE_HELP2MAN)
  if(GALE_HELP2MAN)
    set(gale_man_page ${PROJECT_BINARY_DIR}/gale.1)
    add_custom_command(OUTPUT ${gale_man_page} DEPENDS gale_app VERBATIM
      COMMAND ${GALE_HELP2MAN} --no-info --name=${PROJECT_DESCRIPTION} --output=${gale_man_page} $<TARGET_FILE:gale_app>)
    add_custom_target(gale_man ALL DEPENDS ${gale_man_page})
    install(FILES ${gale_man_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  endif()
endif()
