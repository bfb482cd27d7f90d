# cmake --install build --prefix P  ->  P/bin/sinew, headers, libraries, find_package(sinew), pkg-config, scenes
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/sinew)
set(for_developers ARCHIVE COMPONENT dev FILE_SET HEADERS COMPONENT dev)

install(TARGETS sinew sinew_c EXPORT sinewTargets ${for_developers})
if(TARGET sinew_shared)
    install(TARGETS sinew_shared EXPORT sinewTargets LIBRARY COMPONENT lib NAMELINK_COMPONENT dev)
endif()
install(FILES bindings/c/sinew.h bindings/c/sinew_level.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
install(EXPORT sinewTargets NAMESPACE sinew:: DESTINATION ${package_dir} COMPONENT dev)
if(TARGET sinew_cli)
    install(TARGETS sinew_cli COMPONENT command)
    install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/sinew/scenes COMPONENT command)
endif()

configure_package_config_file(cmake/sinewConfig.cmake.in sinewConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(sinewConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sinewConfig.cmake ${PROJECT_BINARY_DIR}/sinewConfigVersion.cmake
    DESTINATION ${package_dir} COMPONENT dev)

file(RELATIVE_PATH pc_to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
# Without a shared library beside it the archive is what a program gets, with the libraries that it needs.
set(libraries_of_archive " -lstdc++ -lm -pthread")
if(TARGET sinew_shared)
    set(libraries_of_archive "")
endif()
# Options and definitions that the target hands on, for whoever compiles its headers: the same bits (CMakeLists.txt).
set(options "$<TARGET_PROPERTY:sinew,INTERFACE_COMPILE_OPTIONS>")
set(of_gcc "^-fno-ipa-")
set(flags_of_gcc "$<JOIN:$<FILTER:${options},INCLUDE,${of_gcc}>, >")
set(flags_of_users "$<JOIN:$<FILTER:${options},EXCLUDE,${of_gcc}>, > -D$<JOIN:$<TARGET_PROPERTY:sinew,INTERFACE_COMPILE_DEFINITIONS>, -D>")
foreach(name IN ITEMS sinew sinew-c)
    configure_file(cmake/${name}.pc.in ${name}.pc.in @ONLY)
    file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/${name}.pc INPUT ${PROJECT_BINARY_DIR}/${name}.pc.in TARGET sinew)
    install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endforeach()

include(cmake/package.cmake)
