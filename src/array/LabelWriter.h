// SPDX-License-Identifier: Apache-2.0
#ifndef array_LabelWriter_h
#define array_LabelWriter_h

#include "array/LabelBlock.h"

#include <cstddef>
#include <vector>

namespace itk
{
namespace Subdivision
{

/** \brief Writes the labels of the children of blocks, as far as they are asked for, in the type of the output. */
class LabelWriter
{
public:
  LabelWriter(const ArrayView & output, const LabelBlockAxes & axes)
    : m_Output(output)
    , m_Axes(axes)
  {}

  /** One label for all children of a block. Returns the number of those that are asked for.
   * \throw std::range_error if the label does not fit the output */
  template <typename T>
  std::size_t
  Fill(const LabelBlockPlace & place, T label) const;

  /** The labels of all children of a block, x fastest.
   * \throw std::range_error if a label does not fit the output */
  template <typename T>
  std::size_t
  Copy(const LabelBlockPlace & place, const std::vector<T> & labels) const;

private:
  /** Calls \c function with a row of the output's elements, their number and stride, and the number of the row's first
   * child in the block, for all rows of a block's children that are asked for. Returns the number of children. */
  template <typename TOut, typename TFunction>
  std::size_t
  ForEachRow(const LabelBlockPlace & place, const TFunction & function) const;

  const ArrayView      m_Output;
  const LabelBlockAxes m_Axes;
};

} // namespace Subdivision
} // namespace itk

#endif
