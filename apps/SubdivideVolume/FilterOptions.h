// SPDX-License-Identifier: Apache-2.0
#ifndef FilterOptions_h
#define FilterOptions_h

#include "Options.h"
#include "Pieces.h"

#include "itkFixedArray.h"
#include "itkNonOscillatorySubdivisionImageFilterEnums.h"

/** The axes to subdivide in an image whose file has \c dimension of them.
 * \throw std::runtime_error if the options name one that it lacks */
itk::FixedArray<bool, Axes>
GetSubdividedAxes(const Options & options, unsigned int dimension);

itk::NonOscillatorySubdivisionImageFilterEnums::Scheme
GetScheme(const Options & options);

#endif
