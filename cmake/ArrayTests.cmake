# The tests of the kernel and of the array layer, which need no ITK: files in test/.
set(array_tests
  BoundaryGTest.cxx
  GeometryGTest.cxx
  LabelSubdividerGTest.cxx
  LabelSubdividerPropertiesGTest.cxx
  LabelSubdividerTiesGTest.cxx
  SubdividerExtremesGTest.cxx
  SubdividerGTest.cxx
  SubdividerPropertiesGTest.cxx
  SubdividerRandomGTest.cxx
  SubdivisionKernelConversionGTest.cxx
  SubdivisionKernelGTest.cxx
  SubdivisionKernelPromisesGTest.cxx
  TilingGTest.cxx
)
