# `cmake --install`: the library with its headers and kernels, and the config package that find_package(ptbench) reads.
# Programs, configs/ and results/ install themselves. The tree may be moved afterwards.
include(CMakePackageConfigHelpers)

set_target_properties(ptbench_core PROPERTIES EXPORT_NAME core)
install(TARGETS ptbench_core EXPORT ptbench ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ptbench COMPONENT development
        FILES_MATCHING PATTERN "*.h" PATTERN "*.inl")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/kernels/shared DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ptbench/kernels
        COMPONENT development FILES_MATCHING PATTERN "*.h")
# The kernels' text, to read, and to edit a copy of for --kernel-dir; the binary has its own inside.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/kernels DESTINATION ${CMAKE_INSTALL_DATADIR}/ptbench
        FILES_MATCHING PATTERN "*.cl" PATTERN "*.h" PATTERN "*.md")

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ptbench)
install(EXPORT ptbench NAMESPACE ptbench:: DESTINATION ${package_dir} FILE ptbenchTargets.cmake
        COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/ptbenchConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/package/ptbenchConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/ptbenchConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/ptbenchConfig.cmake ${PROJECT_BINARY_DIR}/package/ptbenchConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT development)
