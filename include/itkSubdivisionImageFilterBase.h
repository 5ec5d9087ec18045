// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionImageFilterBase_h
#define itkSubdivisionImageFilterBase_h

#include "NonOscillatorySubdivision/Subdivider.h"
#include "itkNonOscillatorySubdivisionImageFilterEnums.h"
#include "itkSubdivisionImageView.h"

#include "itkFixedArray.h"
#include "itkImageToImageFilter.h"

#include <memory>
#include <string>
#include <type_traits>

namespace itk
{

/** \class SubdivisionImageFilterBase
 *
 * \brief What NonOscillatorySubdivisionImageFilter and LabelSubdivisionImageFilter share: the options, the geometry of
 * the output, the part of the input that is asked for, threads and progress.
 *
 * With N pixels from index s along a subdivided axis, the output has 2 N pixels from index 2 s, half the spacing, the
 * same direction, and its index m lies at the continuous input index m / 2 - 1 / 4.
 *
 * \ingroup NonOscillatorySubdivision
 */
template <typename TInputImage, typename TOutputImage>
class ITK_TEMPLATE_EXPORT SubdivisionImageFilterBase : public ImageToImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SubdivisionImageFilterBase);

  using Self = SubdivisionImageFilterBase;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkTypeMacro(SubdivisionImageFilterBase, ImageToImageFilter);

  static_assert(Detail::IsBufferedGrid<TInputImage> && Detail::IsBufferedGrid<TOutputImage>,
                "Images to be subdivided are itk::Image or itk::VectorImage: no adaptors, label maps or special "
                "coordinates.");
  static_assert(Detail::HasElements<TInputImage> && Detail::HasElements<TOutputImage>,
                "Pixels to be subdivided are, or consist of, integers of 8 to 64 bits, float or double: no matrices, "
                "long double or pixels of variable length outside itk::VectorImage.");
  static_assert(static_cast<unsigned int>(TInputImage::ImageDimension) ==
                  static_cast<unsigned int>(TOutputImage::ImageDimension),
                "Images before and after subdivision have the same dimension.");

  static constexpr unsigned int Dimension = TInputImage::ImageDimension;

  /** At most this many axes can be subdivided in one run. */
  static constexpr unsigned int MaximumNumberOfSubdividedAxes = 3;

  using InputImageType = TInputImage;
  using OutputImageType = TOutputImage;
  using InputRegionType = typename InputImageType::RegionType;
  using OutputRegionType = typename OutputImageType::RegionType;

  using SchemeEnum = NonOscillatorySubdivisionImageFilterEnums::Scheme;
  using AxesType = FixedArray<bool, Dimension>;
  using BoundaryConditionType = ImageBoundaryCondition<InputImageType, InputImageType>;
  using BoundaryConditionPointerType = BoundaryConditionType *;
  using DefaultBoundaryConditionType = ZeroFluxNeumannBoundaryCondition<InputImageType, InputImageType>;

  /** The scheme. Each filter has a default of its own.
   * \throw ExceptionObject if there is no such scheme
   * @{ */
  virtual void
  SetScheme(SchemeEnum scheme);
  itkGetEnumMacro(Scheme, SchemeEnum);
  /** @} */

  /** The scheme by its name: nonoscillatory, linear, bounded, bspline or restored.
   * \throw ExceptionObject that lists the names, if it is none of them */
  virtual void
  SetSchemeByName(const std::string & name);

  /** The tension of the non-oscillatory and the restored scheme, without a unit: finite and greater than 1, or at
   * least 0 for the restored scheme, which is checked when the filter runs. The larger, the closer to the linear
   * scheme. Each filter has a default of its own.
   * @{ */
  itkSetMacro(Tension, double);
  itkGetConstMacro(Tension, double);
  /** @} */

  /** What supplies the pixels outside the image. The filter does not own it: it must live as long as the filter uses
   * it, and a change of it is seen only after Modified(). It is asked by several threads at once, unless it is one of
   * ITK's three or MirrorBoundaryCondition, but none derived from them. The constant of a ConstantBoundaryCondition
   * must have as many components as a pixel. Null stands for the default, which Get returns then: zero flux, the
   * nearest pixel.
   * @{ */
  virtual void
  SetBoundaryCondition(BoundaryConditionPointerType boundaryCondition);
  itkGetConstMacro(BoundaryCondition, BoundaryConditionPointerType);
  virtual void
  SetBoundaryConditionToDefault();
  /** @} */

  /** Which axes are subdivided, three at most, which is checked when the filter runs. An axis that is not keeps its
   * size, spacing and origin: each of its samples is an image of its own. Default: the first three.
   * @{ */
  itkSetMacro(SubdividedAxes, AxesType);
  itkGetConstReferenceMacro(SubdividedAxes, AxesType);
  /** @} */

  /** Whether one of the axes is subdivided.
   * \throw ExceptionObject if there is no such axis */
  virtual void
  SetSubdividedAxis(unsigned int axis, bool isSubdivided);

  /** The name of the instruction set to compute with, one of itk::Subdivision::Target::GetNames(). Results of two of
   * them may differ in the last place. Default: the empty name, which stands for the fastest.
   * \throw ExceptionObject that lists the names, if this processor has no such instruction set
   * @{ */
  virtual void
  SetTarget(const std::string & target);
  itkGetConstReferenceMacro(Target, std::string);
  /** @} */

protected:
  SubdivisionImageFilterBase();
  ~SubdivisionImageFilterBase() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() const override;

  void
  VerifyInputInformation() const override;

  void
  GenerateOutputInformation() override;

  void
  GenerateInputRequestedRegion() override;

  /** Hands the tiles of the requested region to the threads. */
  void
  GenerateData() override;

  /** A run from what there is of the input to a part of the output, as itk::Subdivision::Subdivider takes it. */
  virtual std::unique_ptr<Subdivision::TileRun>
  MakeRun(const Subdivision::ConstArrayView & input,
          const Subdivision::Box &            whole,
          const Subdivision::ArrayView &      output,
          const Subdivision::Options &        options,
          unsigned int                        threads) = 0;

  /** \throw std::invalid_argument if the scheme cannot have the tension */
  virtual void
  CheckTension() const
  {
    Subdivision::CheckTension(this->GetParts(), m_Tension);
  }

  const Subdivision::Scheme &
  GetParts() const
  {
    return Subdivision::Schemes[static_cast<std::size_t>(m_Scheme)];
  }

private:
  /** The axes as those of an array whose first axis is that of the components. */
  Subdivision::Flags
  GetFlags() const;

  /** What to compute, but for the boundary. */
  Subdivision::Options
  GetOptions() const;

  /** The input pixels, those outside the image among them, that a region of the output depends on. */
  InputRegionType
  ComputeStencil(const OutputRegionType & outputRegion) const;

  /** The part of the input that a region of the output, which is not empty, depends on. */
  InputRegionType
  ComputeRequest(const OutputRegionType & outputRegion) const;

  DefaultBoundaryConditionType m_DefaultBoundaryCondition;
  BoundaryConditionPointerType m_BoundaryCondition{ &m_DefaultBoundaryCondition };
  SchemeEnum                   m_Scheme{ SchemeEnum::NonOscillatory };
  double                       m_Tension{ 2.0 };
  AxesType                     m_SubdividedAxes;
  std::string                  m_Target;
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkSubdivisionImageFilterBase.hxx"
#endif

#endif
