# Installs the package into a folder of the build tree, and there a separate project finds it, builds and runs.

if(built_as_itk_module)
  add_skipped_test(NonOscillatorySubdivisionPackage.FindPackage "ITK installs the module as one of its own")
  return()
endif()

set(installed_prefix "${CMAKE_CURRENT_BINARY_DIR}/installed")
add_test(
  NAME NonOscillatorySubdivisionPackage.Install
  COMMAND "${CMAKE_COMMAND}" --install "${PROJECT_BINARY_DIR}" --config "$<CONFIG>" --prefix "${installed_prefix}"
)
set_tests_properties(NonOscillatorySubdivisionPackage.Install PROPERTIES FIXTURES_SETUP installed_package)

add_test(
  NAME NonOscillatorySubdivisionPackage.FindPackage
  COMMAND "${CMAKE_CTEST_COMMAND}"
    --build-and-test "${PROJECT_SOURCE_DIR}/examples/find_package" "${CMAKE_CURRENT_BINARY_DIR}/find_package"
    --build-generator "${CMAKE_GENERATOR}"
    --build-options
      "-DCMAKE_PREFIX_PATH=${installed_prefix}"
      "-DITK_DIR=${ITK_DIR}"
      "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
      "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}"
      "-DCMAKE_BUILD_TYPE=$<CONFIG>"
    --test-command UseSubdivision
)
# The program prints a subdivided step; two of its children are 176 and 386 of 1024.
set_tests_properties(NonOscillatorySubdivisionPackage.FindPackage PROPERTIES
  FIXTURES_REQUIRED installed_package
  PASS_REGULAR_EXPRESSION "0\\.171875[\r\n]+0\\.376953"
)

# What was installed names no folder of this machine but those that the user chose, ITK's among them.
add_test(
  NAME NonOscillatorySubdivisionPackage.NamesNoFolderOfTheBuild
  COMMAND "${CMAKE_COMMAND}" "-DPREFIX=${installed_prefix}" "-DFORBIDDEN=${PROJECT_SOURCE_DIR};${hwy_DIR}"
    -P "${CMAKE_CURRENT_LIST_DIR}/FindForbiddenText.cmake"
)
set_tests_properties(NonOscillatorySubdivisionPackage.NamesNoFolderOfTheBuild PROPERTIES
  FIXTURES_REQUIRED installed_package
)

# The headers of the layers below ITK are found by the names that they include each other by.
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  add_test(
    NAME NonOscillatorySubdivisionPackage.HeadersWithoutITK
    COMMAND "${CMAKE_CXX_COMPILER}" -std=c++17 -fsyntax-only
      "-I${installed_prefix}/${CMAKE_INSTALL_INCLUDEDIR}/NonOscillatorySubdivision"
      -include NonOscillatorySubdivision/Kernel.h -include NonOscillatorySubdivision/Subdivider.h -x c++ /dev/null
  )
  set_tests_properties(NonOscillatorySubdivisionPackage.HeadersWithoutITK PROPERTIES FIXTURES_REQUIRED installed_package)
endif()
