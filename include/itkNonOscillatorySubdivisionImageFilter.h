// SPDX-License-Identifier: Apache-2.0
#ifndef itkNonOscillatorySubdivisionImageFilter_h
#define itkNonOscillatorySubdivisionImageFilter_h

#include "NonOscillatorySubdivision/Subdivider.h"
#include "itkNonOscillatorySubdivisionImageFilterEnums.h"
#include "itkSubdivisionImageView.h"

#include "itkFixedArray.h"
#include "itkImageToImageFilter.h"

#include <string>
#include <type_traits>

namespace itk
{

/** \class NonOscillatorySubdivisionImageFilter
 *
 * \brief Doubles the resolution of an image by subdivision: accurate where the data is smooth, free of overshoots at
 * edges, local and deterministic.
 *
 * A pixel is taken as the average of the image over its cell. Along every subdivided axis it gets two children, one for
 * each half of its cell, so that both images cover the same physical box. With N pixels from index s along an
 * axis, the output has 2 N pixels from index 2 s, half the spacing, the same direction, and its index m lies at the
 * continuous input index m / 2 - 1 / 4.
 *
 * The schemes (docs/scheme.md, after M. Stock and S. Lopez-Urena, "Towards smoother surfaces by applying subdivision to
 * voxel data"):
 * - NonOscillatory, the default: the B-spline of degree 10, plus second differences that are limited by Tension times
 *   the smallest variation nearby. Sixth-order accurate where the data is smooth. At an isolated edge only the B-spline
 *   remains, so the result stays within the range of the data there. Along one axis with pixels f, second differences d
 *   and h_j = |f_j - f_{j-1}| + |f_{j+1} - f_j|, both children are sum b f + sum c clamp(d, -K, K) with
 *   K_j = Tension min(h_{j-2} ... h_{j+2}); section 3 there has it for several axes. Reads p-4 ... p+5.
 * - Linear: the same without the limit, a linear six-point scheme. Sixth-order accurate, but rings at edges. Reads
 *   p-2 ... p+3.
 * - BoundedLinear: the linear result, clamped to the range of the pixels next to the child's own.
 * - BSpline: the B-spline alone, a convex combination of its stencil.
 * - Restored: the B-spline of sharpened values, clamped to the range of the pixels next to the child's own, plus what
 *   the linear scheme differs by, as far as Tension allows. With a tension of 0 it never leaves that range. Reads
 *   p-5 ... p+5.
 *
 * Averages are kept where the data is smooth, not exactly: the mean of the two children of a pixel along one axis is
 * f + 5/1024 times the sixth difference of f with the linear scheme, and moves at edges with the non-oscillatory one.
 *
 * Images are itk::Image or itk::VectorImage. Pixels are scalars or of several components, each of which is subdivided
 * on its own, the parts of a complex number among them; components are integers of 8 to 64 bits, float or double, as
 * their size says. The computation is in double if either pixel's components are double or 32- or 64-bit integers,
 * otherwise in float. Integer output is rounded to nearest, ties to even, and saturates; NaN becomes 0 there. Real
 * output is neither rounded nor clamped. Where no axis is subdivided and input and output have the same type of pixel,
 * pixels are copied exactly.
 *
 * Where the input has a pixel that is not finite, exactly the children whose six-point stencil reads it are not finite;
 * those that only depend on it through a limit are finite.
 *
 * The result depends on the input and the options alone, never on the number of threads, the region asked for or how
 * the image was streamed. The filter streams: it requests the exact stencil of what it is asked for, as the boundary
 * condition needs it. Between updates it keeps what it computes in, some megabytes for each thread.
 *
 * Progress is reported by the thread that updates the filter; an abort, by an observer or another thread, keeps all
 * threads from going on.
 *
 * \throw itk::ExceptionObject on update, when an option is out of its range (see its setter), the input is missing or
 * empty, the pixels of input and output differ in their number of components, or doubled indices do not fit 64 bits.
 *
 * \ingroup NonOscillatorySubdivision
 */
template <typename TInputImage, typename TOutputImage = TInputImage>
class ITK_TEMPLATE_EXPORT NonOscillatorySubdivisionImageFilter : public ImageToImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(NonOscillatorySubdivisionImageFilter);

  using Self = NonOscillatorySubdivisionImageFilter;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(NonOscillatorySubdivisionImageFilter, ImageToImageFilter);

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

  /** The type of the computation, float or double. */
  using RealType = typename std::conditional<
    Subdivision::NeedsDouble(Subdivision::ElementTypeOf<Detail::SubdivisionComponentType<InputImageType>>()) ||
      Subdivision::NeedsDouble(Subdivision::ElementTypeOf<Detail::SubdivisionComponentType<OutputImageType>>()),
    double,
    float>::type;

  using SchemeEnum = NonOscillatorySubdivisionImageFilterEnums::Scheme;
  using AxesType = FixedArray<bool, Dimension>;
  using BoundaryConditionType = ImageBoundaryCondition<InputImageType, InputImageType>;
  using BoundaryConditionPointerType = BoundaryConditionType *;
  using DefaultBoundaryConditionType = ZeroFluxNeumannBoundaryCondition<InputImageType, InputImageType>;

  /** The scheme. Default: NonOscillatory.
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
   * scheme. Default: 2.
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
  NonOscillatorySubdivisionImageFilter();
  ~NonOscillatorySubdivisionImageFilter() override = default;

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

private:
  /** The axes as those of an array whose first axis is that of the components. */
  Subdivision::Flags
  GetFlags() const;

  /** What to compute, but for the boundary. */
  Subdivision::Options
  GetOptions() const;

  const Subdivision::Scheme &
  GetParts() const
  {
    return Subdivision::Schemes[static_cast<std::size_t>(m_Scheme)];
  }

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
  Subdivision::Workspace       m_Workspace;
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkNonOscillatorySubdivisionImageFilter.hxx"
#endif

#endif
