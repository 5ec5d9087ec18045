// SPDX-License-Identifier: Apache-2.0
// Does not compile, but says why: REFUSED_IMAGE chooses a kind of image that the filters do not take.

#include "itkAddPixelAccessor.h"
#include "itkImageAdaptor.h"
#include "itkLabelMap.h"
#include "itkLabelObject.h"
#include "itkLabelSubdivisionImageFilter.h"
#include "itkMatrix.h"
#include "itkNonOscillatorySubdivisionImageFilter.h"
#include "itkPhasedArray3DSpecialCoordinatesImage.h"
#include "itkVariableLengthVector.h"

using Adaptor = itk::ImageAdaptor<itk::Image<float, 3>, itk::Accessor::AddPixelAccessor<float>>;
using LabelMap = itk::LabelMap<itk::LabelObject<unsigned long, 3>>;
using SpecialCoordinates = itk::PhasedArray3DSpecialCoordinatesImage<float>;
using Matrices = itk::Image<itk::Matrix<float, 3, 3>, 3>;
using VariableLength = itk::Image<itk::VariableLengthVector<float>, 3>;
using LongDoubles = itk::Image<long double, 3>;

/** \brief What refuses an image; for BoolOfLabels, labels that are to become pixels of bool. */
template <typename TImage>
struct Refusing
{
  using Filter = itk::NonOscillatorySubdivisionImageFilter<TImage>;
};
struct BoolOfLabels;
template <>
struct Refusing<BoolOfLabels>
{
  using Filter = itk::LabelSubdivisionImageFilter<itk::Image<unsigned char, 3>, itk::Image<bool, 3>>;
};

int
main()
{
  Refusing<REFUSED_IMAGE>::Filter::New()->Update();
}
