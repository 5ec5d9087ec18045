// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_LabelSubdivider_h
#define NonOscillatorySubdivision_LabelSubdivider_h

#include "NonOscillatorySubdivision/Subdivider.h"

#include <cstddef>
#include <memory>

namespace itk
{
namespace Subdivision
{

/** \brief A run from label map to label map (docs/scheme.md, section 6).
 *
 * Each label's indicator, 1 where a voxel has the label and 0 elsewhere, is subdivided by the scheme. That is the
 * label's vote; the largest vote wins a child, ties go to the label of the parent and then to the lowest. No label
 * appears that is not within the stencil. Where the 3^d voxels around a voxel have one label, so have its children.
 *
 * The label of an element depends on the input and the options alone: not on the box asked for, the tiles or the
 * threads.
 */
class NonOscillatorySubdivision_EXPORT LabelSubdivider : public TileRun
{
public:
  /** The restored scheme with tension 0: smooth surfaces, and small bodies keep their volume. No axis is chosen. */
  static Options
  GetDefaultOptions();

  /** \throw std::invalid_argument that names those that are, if a scheme is none for labels */
  static void
  CheckScheme(const Scheme & scheme);

  /** \param input labels, of any integer type: at least what Subdivider::GetInputRequest() names
   * \param whole the indices of the whole input, beyond which the boundary begins
   * \param output where the labels go, of any integer type: its box is what is computed
   * \param options the scheme is restored, bspline or linear; the latter two ignore the tension
   * \throw std::invalid_argument if options, types, sizes or boxes do not fit each other, before anything is computed
   */
  LabelSubdivider(const ConstArrayView & input, const Box & whole, const ArrayView & output, const Options & options);
  ~LabelSubdivider() override;
  LabelSubdivider(const LabelSubdivider &) = delete;
  LabelSubdivider &
  operator=(const LabelSubdivider &) = delete;

  std::size_t
  GetNumberOfTiles() const override;

  /** \throw std::range_error if a label does not fit the type of the output, or what a boundary's constant or elements
   * supply is no label, or one from 2^53 on, which doubles cannot tell apart; and whatever the boundary throws */
  void
  ComputeTile(std::size_t number, TileMonitor & monitor) override;

private:
  struct Implementation;
  std::unique_ptr<Implementation> m_Implementation;
};

} // namespace Subdivision
} // namespace itk

#endif
