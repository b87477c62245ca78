# cmake --install: the program, the libraries, their headers, the shipped scenes, and a package for
# find_package(interflect).

include(CMakePackageConfigHelpers)

get_property(rooms_built GLOBAL PROPERTY INTERFLECT_ROOMS)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/interflect)

foreach(room IN LISTS rooms_built)
  install(TARGETS interflect_${room} EXPORT interflect ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/interflect/${room}
          FILES_MATCHING PATTERN "*.h")
endforeach()
if(TARGET interflect_program)
  install(TARGETS interflect_program DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/data DESTINATION ${CMAKE_INSTALL_DATADIR}/interflect)

install(EXPORT interflect NAMESPACE interflect:: DESTINATION ${package_dir} FILE interflect-targets.cmake)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/interflect-config.cmake.in
  ${PROJECT_BINARY_DIR}/interflect-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/interflect-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/interflect-config.cmake ${PROJECT_BINARY_DIR}/interflect-config-version.cmake
        DESTINATION ${package_dir})
