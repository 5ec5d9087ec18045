// SPDX-License-Identifier: Apache-2.0
#ifndef SubdivisionCommonFilters_h
#define SubdivisionCommonFilters_h

#include "SubdivisionTestHelpers.h"

/** The filters that several test files use, compiled once in SubdivisionCommonFilters.cxx: it shortens the build. */
namespace SubdivisionTest
{
using Line = itk::Image<double, 1>;
using LineFilter = itk::NonOscillatorySubdivisionImageFilter<Line>;

using DoubleImage = itk::Image<double, 3>;
using DoubleFilter = itk::NonOscillatorySubdivisionImageFilter<DoubleImage>;

using FloatImage = itk::Image<float, 3>;
using FloatFilter = itk::NonOscillatorySubdivisionImageFilter<FloatImage>;

using UShortImage = itk::Image<unsigned short, 3>;
using UShortFilter = itk::NonOscillatorySubdivisionImageFilter<UShortImage>;
} // namespace SubdivisionTest

extern template class itk::NonOscillatorySubdivisionImageFilter<SubdivisionTest::Line>;
extern template class itk::NonOscillatorySubdivisionImageFilter<SubdivisionTest::DoubleImage>;
extern template class itk::NonOscillatorySubdivisionImageFilter<SubdivisionTest::FloatImage>;
extern template class itk::NonOscillatorySubdivisionImageFilter<SubdivisionTest::UShortImage>;

#endif
