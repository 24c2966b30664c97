# What `cmake --install` leaves: headers, one static library a room, the data, and a package so that
#   find_package(spall REQUIRED)
#   target_link_libraries(mine PRIVATE spall::specimens)
# works in another project. The spall command is installed by app/.
include(CMakePackageConfigHelpers)
get_property(spall_rooms GLOBAL PROPERTY SPALL_ROOMS)
set(spall_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/spall)

install(TARGETS ${spall_rooms} EXPORT spall ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT spall NAMESPACE spall:: FILE spall-targets.cmake DESTINATION ${spall_package_folder})
foreach(room libdem specimens exchange calibrate impact report study)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${room})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spall
            FILES_MATCHING PATTERN "*.h")
  endif()
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/ DESTINATION ${CMAKE_INSTALL_DATADIR}/spall)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/spall-config.cmake.in
                              ${PROJECT_BINARY_DIR}/spall-config.cmake INSTALL_DESTINATION ${spall_package_folder}
                              PATH_VARS CMAKE_INSTALL_DATADIR)
# Before 1.0 a new minor version may break whoever uses the libraries.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/spall-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/spall-config.cmake ${PROJECT_BINARY_DIR}/spall-config-version.cmake
        DESTINATION ${spall_package_folder})

# The promise above, kept: installs into a scratch folder, then builds and runs another project against it.
if(SPALL_TESTS AND NOT SPALL_SANITIZE)
  add_test(NAME cli.FindPackage.WorksAfterInstall
           COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DSOURCE=${PROJECT_SOURCE_DIR}/tests/install/consumer
                   -DSCRATCH=${PROJECT_BINARY_DIR}/tests/install -DCOMPILER=${CMAKE_CXX_COMPILER}
                   -DBUILD_TYPE=${CMAKE_BUILD_TYPE} -P ${PROJECT_SOURCE_DIR}/tests/install/check.cmake)
  set_tests_properties(cli.FindPackage.WorksAfterInstall PROPERTIES LABELS cli TIMEOUT 300)
endif()
