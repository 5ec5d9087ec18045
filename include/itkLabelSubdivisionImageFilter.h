// SPDX-License-Identifier: Apache-2.0
#ifndef itkLabelSubdivisionImageFilter_h
#define itkLabelSubdivisionImageFilter_h

#include "NonOscillatorySubdivision/LabelSubdivider.h"
#include "itkSubdivisionImageFilterBase.h"

#include <stdexcept>

namespace itk
{

/** \class LabelSubdivisionImageFilter
 *
 * \brief Doubles the resolution of a label map: no label that was not there, smooth borders, and small bodies keep
 * their volume.
 *
 * Each label's indicator, 1 where a pixel has the label and 0 elsewhere, is subdivided by Scheme: that is the label's
 * vote on a child. The largest vote wins; ties go to the label of the parent, then to the lowest (docs/scheme.md,
 * section 6). The scheme is Restored, the default with a Tension of 0, or BSpline or Linear, which ignore the Tension;
 * others are refused on update.
 *
 * Pixels are integers of 8 to 64 bits; if those of the output have another type, every label must fit it. Labels that a
 * ConstantBoundaryCondition, or one that is asked, supplies must be below 2^53 in magnitude. Geometry, axes, boundary
 * conditions, streaming, threads and progress are those of NonOscillatorySubdivisionImageFilter. The result depends on
 * the input and the options alone, not even on the instruction set where the tension is 0.
 *
 * \throw itk::ExceptionObject on update, as NonOscillatorySubdivisionImageFilter does, and if a label does not fit.
 *
 * \ingroup NonOscillatorySubdivision
 */
template <typename TInputImage, typename TOutputImage = TInputImage>
class ITK_TEMPLATE_EXPORT LabelSubdivisionImageFilter : public SubdivisionImageFilterBase<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(LabelSubdivisionImageFilter);

  using Self = LabelSubdivisionImageFilter;
  using Superclass = SubdivisionImageFilterBase<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(LabelSubdivisionImageFilter, SubdivisionImageFilterBase);

  static_assert(std::is_integral<typename TInputImage::PixelType>::value &&
                  std::is_integral<typename TOutputImage::PixelType>::value,
                "Labels are integers.");
  static_assert(!std::is_same<typename TOutputImage::PixelType, bool>::value ||
                  std::is_same<typename TInputImage::PixelType, bool>::value,
                "Labels other than those of bool do not fit pixels of bool.");

protected:
  LabelSubdivisionImageFilter()
  {
    this->SetScheme(Superclass::SchemeEnum::Restored);
    this->SetTension(0.0);
  }
  ~LabelSubdivisionImageFilter() override = default;

  void
  VerifyPreconditions() const override
  {
    try
    {
      Subdivision::LabelSubdivider::CheckScheme(this->GetParts());
    }
    catch (const std::invalid_argument & error)
    {
      itkExceptionMacro(<< error.what());
    }
    Superclass::VerifyPreconditions();
  }

  void
  CheckTension() const override
  {
    if (this->GetParts().HasTension())
    {
      Superclass::CheckTension();
    }
  }

  void
  GenerateData() override
  {
    try
    {
      Superclass::GenerateData();
    }
    catch (const std::range_error & error)
    {
      itkExceptionMacro(<< error.what());
    }
  }

  std::unique_ptr<Subdivision::TileRun>
  MakeRun(const Subdivision::ConstArrayView & input,
          const Subdivision::Box &            whole,
          const Subdivision::ArrayView &      output,
          const Subdivision::Options &        options,
          unsigned int) override
  {
    return std::make_unique<Subdivision::LabelSubdivider>(input, whole, output, options);
  }
};

} // namespace itk

#endif
