// SPDX-License-Identifier: Apache-2.0
#include "SubdivisionCommonFilters.h"

template class itk::NonOscillatorySubdivisionImageFilter<SubdivisionTest::Line>;
template class itk::NonOscillatorySubdivisionImageFilter<SubdivisionTest::DoubleImage>;
template class itk::NonOscillatorySubdivisionImageFilter<SubdivisionTest::FloatImage>;
template class itk::NonOscillatorySubdivisionImageFilter<SubdivisionTest::UShortImage>;
