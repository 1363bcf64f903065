# libifov, the library that other programs link: the facade of src/session/facade with all rooms below it, in one shared
# library that shows the names of include/ifov and no others; and what `cmake --install` puts where.
include(CMakePackageConfigHelpers)
include(CheckLinkerFlag)
include(GNUInstallDirs)

add_library(libifov SHARED $<TARGET_OBJECTS:ifov_session_facade>)
add_library(ifov::ifov ALIAS libifov)
set(IFOV_SYMBOLS ${CMAKE_CURRENT_LIST_DIR}/libifov.map)
# The names of include/ifov may change with every 0.x; from 1.0 on they will not within one number.
set_target_properties(libifov PROPERTIES OUTPUT_NAME ifov EXPORT_NAME ifov LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
  LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR} LINK_DEPENDS ${IFOV_SYMBOLS})
target_compile_features(libifov PUBLIC cxx_std_20)
target_include_directories(libifov PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/include>
                                          $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_link_libraries(libifov PRIVATE ifov_session)
target_link_options(libifov PRIVATE -Wl,--version-script=${IFOV_SYMBOLS})
ifov_harden(libifov)

# On a processor without the instructions it was compiled for, the library's own initialization would end the program. A mark makes
# the loader (of glibc 2.33 and later) say so before that, to a program as it starts and to one that calls dlopen.
ifov_processor_needs(needs IFOV_ISA_LEVEL)
if(IFOV_ISA_LEVEL GREATER 1)
  check_linker_flag(CXX -Wl,-z,x86-64-v${IFOV_ISA_LEVEL} IFOV_LINKER_MARKS_ISA_V${IFOV_ISA_LEVEL})
  if(IFOV_LINKER_MARKS_ISA_V${IFOV_ISA_LEVEL})
    target_link_options(libifov PRIVATE -Wl,-z,x86-64-v${IFOV_ISA_LEVEL})
  endif()
endif()

install(TARGETS ifov RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS libifov EXPORT ifovTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/ifov DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(FILES LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# For find_package(ifov) of CMake. A program needs none of the libraries that libifov itself is linked with.
set(IFOV_PACKAGE ${CMAKE_INSTALL_LIBDIR}/cmake/ifov)
install(EXPORT ifovTargets NAMESPACE ifov:: DESTINATION ${IFOV_PACKAGE})
file(WRITE ${CMAKE_BINARY_DIR}/package/ifovConfig.cmake
     "include(\"\${CMAKE_CURRENT_LIST_DIR}/ifovTargets.cmake\")\n")
write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/ifovConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/package/ifovConfig.cmake ${CMAKE_BINARY_DIR}/package/ifovConfigVersion.cmake
        DESTINATION ${IFOV_PACKAGE})

# For pkg-config. Paths are told from where the file lies, since `cmake --install --prefix` comes after all this.
file(RELATIVE_PATH IFOV_PREFIX_FROM_PC /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(${CMAKE_CURRENT_LIST_DIR}/ifov.pc.in ${CMAKE_BINARY_DIR}/package/ifov.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/package/ifov.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
