// SPDX-License-Identifier: Apache-2.0
// What the wrapping of ITK for Python parses: the public headers, and the types to be wrapped, named and completed in
// the namespace that it starts from.

#include "itkImage.h"
#include "itkImageFidelityCalculator.h"
#include "itkMirrorBoundaryCondition.h"
#include "itkNonOscillatorySubdivisionImageFilter.h"

namespace _wrapping_
{
namespace wrappers
{
using FilterOfFloats = itk::NonOscillatorySubdivisionImageFilter<itk::Image<float, 3>, itk::Image<float, 3>>;
using FilterOfBytes = itk::NonOscillatorySubdivisionImageFilter<itk::Image<unsigned char, 2>, itk::Image<double, 2>>;
using Mirror = itk::MirrorBoundaryCondition<itk::Image<float, 3>>;
} // namespace wrappers

inline void
CompleteTypes()
{
  static_cast<void>(sizeof(wrappers::FilterOfFloats));
  static_cast<void>(sizeof(wrappers::FilterOfBytes));
  static_cast<void>(sizeof(wrappers::Mirror));
}
} // namespace _wrapping_
