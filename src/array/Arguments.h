// SPDX-License-Identifier: Apache-2.0
#ifndef Arguments_h
#define Arguments_h

#include "NonOscillatorySubdivision/Subdivider.h"

namespace itk
{
namespace Subdivision
{

/** The scheme that options stand for, out of the library's own table.
 * \throw std::invalid_argument if there is none of that name */
const Scheme &
GetScheme(const Options & options);

/** What a Subdivider is made of fits together.
 * \throw std::invalid_argument that names the value which does not
 * \throw std::overflow_error if indices, sizes or distances in memory do not fit 64 bits */
void
CheckArguments(const ConstArrayView & input, const Box & whole, const ArrayView & output, const Options & options);

/** \throw std::invalid_argument unless options and boxes have as many axes, the output box lies within the whole output
 * and nothing is empty */
void
CheckBoxes(const Box & output, const Box & whole, const Options & options);

} // namespace Subdivision
} // namespace itk

#endif
