// SPDX-License-Identifier: Apache-2.0
// What the wrapping of ITK for Python parses: the public headers, and the filter instantiated on an image.

#include "itkImage.h"
#include "itkImageFidelityCalculator.h"
#include "itkMirrorBoundaryCondition.h"
#include "itkNonOscillatorySubdivisionImageFilter.h"

template class itk::NonOscillatorySubdivisionImageFilter<itk::Image<float, 3>>;
template class itk::NonOscillatorySubdivisionImageFilter<itk::Image<unsigned char, 2>, itk::Image<double, 2>>;
template class itk::MirrorBoundaryCondition<itk::Image<float, 3>>;
