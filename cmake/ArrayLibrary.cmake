# The kernel and the array layer as a static library that needs no ITK: for the Python package, and for their tests on
# machines without ITK.

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

find_package(Threads REQUIRED)
include(GenerateExportHeader)
include("${CMAKE_CURRENT_LIST_DIR}/Highway.cmake")

get_filename_component(repository "${CMAKE_CURRENT_LIST_DIR}" DIRECTORY)

# The library by a name, with Highway's targets or without.
function(add_array_library name has_highway)
  file(GLOB sources CONFIGURE_DEPENDS
    "${repository}/src/kernel/*.cxx" "${repository}/src/array/*.cxx" "${repository}/src/memory/*.cxx"
  )
  if(NOT has_highway)
    list(FILTER sources EXCLUDE REGEX "/TargetsHighway\\.cxx$")
  endif()
  add_library(${name} STATIC ${sources})
  # As in src/CMakeLists.txt: results must not depend on where a compiler fuses a multiplication with an addition.
  set_source_files_properties("${repository}/src/kernel/TargetPortable.cxx" PROPERTIES
    COMPILE_OPTIONS "$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off;$<$<NOT:$<CONFIG:Debug>>:-O3>>"
  )
  target_compile_definitions(${name} PUBLIC NonOscillatorySubdivision_STATIC)
  target_include_directories(${name}
    PUBLIC "${repository}/include" "${PROJECT_BINARY_DIR}/include"
    PRIVATE "${repository}/src"
  )
  target_link_libraries(${name} PUBLIC Threads::Threads)
  if(has_highway)
    target_compile_definitions(${name} PRIVATE NonOscillatorySubdivision_HAS_HIGHWAY)
    target_link_libraries(${name} PRIVATE hwy::hwy)
  endif()
endfunction()

add_array_library(NonOscillatorySubdivision "${hwy_FOUND}")
generate_export_header(NonOscillatorySubdivision
  EXPORT_MACRO_NAME NonOscillatorySubdivision_EXPORT
  NO_EXPORT_MACRO_NAME NonOscillatorySubdivision_HIDDEN
  EXPORT_FILE_NAME "${PROJECT_BINARY_DIR}/include/NonOscillatorySubdivisionExport.h"
  STATIC_DEFINE NonOscillatorySubdivision_STATIC
)
