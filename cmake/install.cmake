# `cmake --install build` puts the program, its manual page, the library and what find_package(inkgrid) needs into place.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/inkgrid)

add_library(inkgrid::inkgrid ALIAS inkgrid)

install(TARGETS inkgrid_cli)
install(TARGETS inkgrid EXPORT inkgridTargets)
install(DIRECTORY include/inkgrid DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_BINARY_DIR}/inkgrid.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT inkgridTargets NAMESPACE inkgrid:: DESTINATION ${package_dir})
configure_package_config_file(cmake/inkgridConfig.cmake.in ${PROJECT_BINARY_DIR}/inkgridConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/inkgridConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/inkgridConfig.cmake ${PROJECT_BINARY_DIR}/inkgridConfigVersion.cmake
        DESTINATION ${package_dir})
