set(
  DOCUMENTATION
  "Doubles the resolution of images, CT volumes above all, with the
non-oscillatory subdivision scheme of M. Stock and S. Lopez-Urena, \"Towards
smoother surfaces by applying subdivision to voxel data\": sixth-order accurate
where the data is smooth, free of overshoots at edges, local and deterministic."
)

itk_module(
  NonOscillatorySubdivision
  ENABLE_SHARED
  DEPENDS
    ITKCommon
  TEST_DEPENDS
    ITKGoogleTest
    ITKImageGrid
    ITKIOMeta
    ITKIONRRD
    ITKTestKernel
  EXCLUDE_FROM_DEFAULT
  DESCRIPTION "${DOCUMENTATION}"
)
