# Builds the module as a plain library with its own CMake package, for ITKs that
# were installed without ITKModuleMacros.cmake (Debian, conda, vcpkg).

include(CTest)
include(GNUInstallDirs)
include(GenerateExportHeader)
include(CMakePackageConfigHelpers)

option(BUILD_SHARED_LIBS "Build shared libraries." ON)
option(NonOscillatorySubdivision_BUILD_APPS "Build the command line programs." ON)
option(NonOscillatorySubdivision_BUILD_EXAMPLES "Build the examples." ON)
option(NonOscillatorySubdivision_BUILD_BENCHMARK "Build the speed comparison (needs Google Benchmark)." OFF)
option(NonOscillatorySubdivision_WARNINGS_AS_ERRORS "Treat compiler warnings as errors." OFF)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")

add_compile_options(-Wall -Wextra)
if(NonOscillatorySubdivision_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()

add_subdirectory(src)

generate_export_header(NonOscillatorySubdivision
  EXPORT_FILE_NAME "${PROJECT_BINARY_DIR}/include/NonOscillatorySubdivisionExport.h"
  EXPORT_MACRO_NAME NonOscillatorySubdivision_EXPORT
  NO_EXPORT_MACRO_NAME NonOscillatorySubdivision_HIDDEN
  STATIC_DEFINE NonOscillatorySubdivision_STATIC
)
set_target_properties(NonOscillatorySubdivision PROPERTIES
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}"
)
target_include_directories(NonOscillatorySubdivision
  PUBLIC
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
    "$<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/NonOscillatorySubdivision>"
)
target_include_directories(NonOscillatorySubdivision SYSTEM PUBLIC ${ITK_INCLUDE_DIRS})
target_link_libraries(NonOscillatorySubdivision PUBLIC ${ITK_LIBRARIES})
if(NOT BUILD_SHARED_LIBS)
  target_compile_definitions(NonOscillatorySubdivision PUBLIC NonOscillatorySubdivision_STATIC)
endif()

# The target that users link has the name that ITK 6 would give it.
add_library(NonOscillatorySubdivisionModule INTERFACE)
target_link_libraries(NonOscillatorySubdivisionModule INTERFACE NonOscillatorySubdivision)
add_library(ITK::NonOscillatorySubdivisionModule ALIAS NonOscillatorySubdivisionModule)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/NonOscillatorySubdivision")
install(TARGETS NonOscillatorySubdivision NonOscillatorySubdivisionModule
  EXPORT NonOscillatorySubdivisionTargets
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}"
)
install(DIRECTORY include/ "${PROJECT_BINARY_DIR}/include/"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/NonOscillatorySubdivision"
)
install(EXPORT NonOscillatorySubdivisionTargets NAMESPACE ITK:: DESTINATION "${package_dir}")
configure_package_config_file(cmake/NonOscillatorySubdivisionConfig.cmake.in
  "${PROJECT_BINARY_DIR}/NonOscillatorySubdivisionConfig.cmake"
  INSTALL_DESTINATION "${package_dir}"
)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/NonOscillatorySubdivisionConfigVersion.cmake"
  COMPATIBILITY SameMajorVersion
)
install(FILES
  "${PROJECT_BINARY_DIR}/NonOscillatorySubdivisionConfig.cmake"
  "${PROJECT_BINARY_DIR}/NonOscillatorySubdivisionConfigVersion.cmake"
  DESTINATION "${package_dir}"
)

if(NonOscillatorySubdivision_BUILD_APPS)
  add_subdirectory(apps)
endif()
if(NonOscillatorySubdivision_BUILD_EXAMPLES)
  add_subdirectory(examples)
endif()
if(NonOscillatorySubdivision_BUILD_BENCHMARK)
  add_subdirectory(benchmark)
endif()
if(BUILD_TESTING)
  add_subdirectory(test)
endif()
