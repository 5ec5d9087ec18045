# Tests in Python: the rules that the sources keep, the programs as a user runs them, and the experiments. The system's
# Python comes first, as it is the one that Debian's numpy and other packages install for.

find_program(NonOscillatorySubdivision_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(NonOscillatorySubdivision_PYTHON python3)
mark_as_advanced(NonOscillatorySubdivision_PYTHON)

# Registers a test script that finds the given program targets by the environment; where a program, Python or a Python
# package is missing, the test is skipped and says so. THROUGH: a command that runs the script in Python's place; it ends
# with status 77 where it cannot.
function(add_python_test script)
  cmake_parse_arguments(PARSE_ARGV 1 argument "" "" "PROGRAMS;PACKAGES;THROUGH")
  get_filename_component(name "${script}" NAME_WE)
  set(missing "")
  set(environment "")
  foreach(program IN LISTS argument_PROGRAMS)
    if(TARGET ${program})
      string(REGEX REPLACE "([a-z])([A-Z])" "\\1_\\2" variable "${program}")
      string(TOUPPER "${variable}" variable)
      list(APPEND environment "${variable}=$<TARGET_FILE:${program}>")
    else()
      string(APPEND missing " ${program}")
    endif()
  endforeach()
  if(NOT NonOscillatorySubdivision_PYTHON)
    string(APPEND missing " python3")
  else()
    foreach(package IN LISTS argument_PACKAGES)
      execute_process(
        COMMAND "${NonOscillatorySubdivision_PYTHON}" -c "import ${package}"
        RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET
      )
      if(NOT result EQUAL 0)
        string(APPEND missing " ${package}")
      endif()
    endforeach()
  endif()

  if(missing)
    add_skipped_test(${name} "for want of${missing}")
  else()
    if(NOT argument_THROUGH)
      set(argument_THROUGH "${NonOscillatorySubdivision_PYTHON}")
    endif()
    add_test(NAME ${name} COMMAND ${argument_THROUGH} "${CMAKE_CURRENT_SOURCE_DIR}/${script}")
    set_tests_properties(${name} PROPERTIES ENVIRONMENT "${environment}" SKIP_RETURN_CODE 77)
  endif()
endfunction()

add_python_test(include_arrows_test.py)
# Planting all of the faults takes an hour; that their texts stand in the sources is seen at once.
add_python_test(faults/planted_faults_test.py)
add_python_test(programs/subdivide_volume_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_crashes_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_faults_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_headers_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_input_files_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_kills_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_labels_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_levels_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_longer_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_neighbours_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_nifti_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_piece_faults_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_pieces_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_processes_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_reports_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_streams_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_text_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/subdivide_volume_truncated_test.py PROGRAMS SubdivideVolume)
add_python_test(programs/compare_volumes_test.py PROGRAMS CompareVolumes)
foreach(script experiments_test.py experiments_surfaces_test.py)
  add_python_test(experiments/${script}
    PROGRAMS SubdivideVolume CompareVolumes
    PACKAGES numpy scipy pywt matplotlib skimage
    THROUGH bash "${PROJECT_SOURCE_DIR}/scripts/experiments_python.sh" "${PROJECT_BINARY_DIR}/experiments"
  )
endforeach()

# The wrapping for ITK's Python. Where ITK is wrapped, wrapping/test is run as well.
if(CASTXML_EXECUTABLE)
  add_python_test(headers/wrapping_test.py)
  if(NonOscillatorySubdivision_PYTHON)
    set_tests_properties(wrapping_test PROPERTIES ENVIRONMENT
      "CASTXML=${CASTXML_EXECUTABLE};CXX=${CMAKE_CXX_COMPILER};CXXFLAGS=${CMAKE_CXX_FLAGS};INCLUDE_DIRECTORIES=$<JOIN:${include_directories},:>"
    )
  endif()
else()
  add_skipped_test(wrapping_test "for want of castxml")
endif()
if(NOT ITK_WRAP_PYTHON)
  add_skipped_test(wrapping_in_itk_python_test
    "this ITK is not wrapped for Python, see wrapping/README.md; wrapping_test parses what would be wrapped"
  )
endif()

# The package for Python makes an environment of its own.
add_test(
  NAME python_package_test
  COMMAND bash "${PROJECT_SOURCE_DIR}/scripts/test_python_package.sh" "${PROJECT_BINARY_DIR}/python"
)
set_tests_properties(python_package_test PROPERTIES
  SKIP_RETURN_CODE 77
  PROCESSORS 2
  TIMEOUT 2400
)
