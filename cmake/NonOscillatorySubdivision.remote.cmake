# The entry for Modules/Remote/ in ITK's source, which then fetches the module:
#   cmake -DModule_NonOscillatorySubdivision=ON -DNonOscillatorySubdivision_REPOSITORY=<address of a clone of this>
#
# ITK's criteria for remote modules. Levels 1 to 3:
#   [x] compiles, has tests that pass, its interface is stable and complete
#   [x] more than 10 % of the lines are covered by tests
# Level 4:
#   [x] ITK's style, by clang-format
#   [x] nothing is needed beyond ITK; Highway is optional
#   [x] more than 75 % of the lines are covered by tests (CONTRIBUTING.md has the figure and the command)
#   [x] continuous integration (.github/workflows)
#   [x] Linux, GCC: builds and passes its tests with ITK 5.2.1 and 6.0 beta 2, and those of the wrapping with 5.4.7
#   [ ] Windows, shared libraries, Visual Studio; macOS, Clang: the workflow builds both; not tried yet
# Of level 5: [x] what users call is wrapped for Python
# Contact: the maintainers named in CITATION.cff

if(Module_NonOscillatorySubdivision AND NOT NonOscillatorySubdivision_REPOSITORY)
  message(FATAL_ERROR "Set NonOscillatorySubdivision_REPOSITORY to the address that the module is cloned from.")
endif()

itk_fetch_module(
  NonOscillatorySubdivision
  "Doubles the resolution of images, CT volumes above all, with the non-oscillatory subdivision scheme of M. Stock and
S. Lopez-Urena, \"Towards smoother surfaces by applying subdivision to voxel data\": sixth-order accurate where the data
is smooth, free of overshoots at edges, local and deterministic. Label maps, too."
  MODULE_COMPLIANCE_LEVEL 3
  GIT_REPOSITORY "${NonOscillatorySubdivision_REPOSITORY}"
  GIT_TAG main
)
