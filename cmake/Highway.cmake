# Finds Highway, where it is wanted; hwy_FOUND says whether there is one.
option(
  NonOscillatorySubdivision_USE_HIGHWAY
  "Vectorise the kernel with Highway where it is installed; the portable kernel is built always."
  ON
)
if(NonOscillatorySubdivision_USE_HIGHWAY)
  find_package(hwy QUIET CONFIG)
endif()
