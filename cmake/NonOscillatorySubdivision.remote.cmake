# The entry for Modules/Remote/ in ITK's source, which then fetches the module:
#   cmake -DModule_NonOscillatorySubdivision=ON -DNonOscillatorySubdivision_REPOSITORY=<address of a clone of this>
#
# Of ITK's compliance levels for remote modules it aims at 4: ITK's style (clang-format), nothing needed beyond ITK
# (Highway is optional), wrapping with tests, tests of everything public.
# Contact: the maintainers named in CITATION.cff
itk_fetch_module(
  NonOscillatorySubdivision
  "Doubles the resolution of images, CT volumes above all, with the non-oscillatory subdivision scheme of M. Stock and
S. Lopez-Urena, \"Towards smoother surfaces by applying subdivision to voxel data\": sixth-order accurate where the data
is smooth, free of overshoots at edges, local and deterministic. Label maps, too."
  MODULE_COMPLIANCE_LEVEL 4
  GIT_REPOSITORY ${NonOscillatorySubdivision_REPOSITORY}
  GIT_TAG main
)
