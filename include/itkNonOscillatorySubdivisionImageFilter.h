// SPDX-License-Identifier: Apache-2.0
#ifndef itkNonOscillatorySubdivisionImageFilter_h
#define itkNonOscillatorySubdivisionImageFilter_h

#include "itkNonOscillatorySubdivisionImageFilterEnums.h"
#include "itkSubdivisionKernel.h"
#include "itkSubdivisionPixelTraits.h"
#include "itkSubdivisionTileReader.h"
#include "itkSubdivisionTileWriter.h"

#include "itkFixedArray.h"
#include "itkImageToImageFilter.h"
#include "itkZeroFluxNeumannBoundaryCondition.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

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
 *
 * Averages are kept where the data is smooth, not exactly: the mean of the two children of a pixel along one axis is
 * f + 5/1024 times the sixth difference of f with the linear scheme, and moves at edges with the non-oscillatory one.
 *
 * Pixels are scalars or of several components, each of which is subdivided on its own. The computation is in
 * double if either pixel's components are double or 32- or 64-bit integers, otherwise in float. Integer output is
 * rounded to nearest, ties to even, and saturates; NaN becomes 0 there. Real output is neither rounded nor clamped.
 *
 * Where the input has a pixel that is not finite, exactly the children whose six-point stencil reads it are not finite;
 * those that only depend on it through a limit are finite.
 *
 * The result depends on the input and the options alone, never on the number of threads, the region asked for or how
 * the image was streamed. The filter streams: it requests the exact stencil of what it is asked for, as the boundary
 * condition needs it. Between updates it keeps what it computes in, some megabytes for each thread.
 *
 * \throw itk::ExceptionObject on update, when an option is out of its range (see its setter), the input is missing or
 * empty, or the pixels of input and output differ in their number of components.
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

  static constexpr unsigned int Dimension = TInputImage::ImageDimension;

  /** At most this many axes can be subdivided in one run. */
  static constexpr unsigned int MaximumNumberOfSubdividedAxes = 3;

  using InputImageType = TInputImage;
  using OutputImageType = TOutputImage;
  using InputRegionType = typename InputImageType::RegionType;
  using OutputRegionType = typename OutputImageType::RegionType;

  /** The type of the computation, float or double. */
  using RealType = SubdivisionRealType<InputImageType, OutputImageType>;

  using SchemeEnum = NonOscillatorySubdivisionImageFilterEnums::Scheme;
  using AxesType = FixedArray<bool, Dimension>;
  using BoundaryConditionType = ImageBoundaryCondition<InputImageType, InputImageType>;
  using BoundaryConditionPointerType = BoundaryConditionType *;
  using DefaultBoundaryConditionType = ZeroFluxNeumannBoundaryCondition<InputImageType, InputImageType>;

  /** The scheme. Default: NonOscillatory.
   * @{ */
  itkSetEnumMacro(Scheme, SchemeEnum);
  itkGetEnumMacro(Scheme, SchemeEnum);
  /** @} */

  /** The tension of the non-oscillatory scheme, without a unit: finite and greater than 1, which is checked when the
   * filter runs. The larger, the closer to the linear scheme. Default: 2.
   * @{ */
  itkSetMacro(Tension, double);
  itkGetConstMacro(Tension, double);
  /** @} */

  /** What supplies the pixels outside the image. The filter does not own it: it must live as long as the filter uses
   * it, and a change of it is seen only after Modified(). Default: zero flux, the nearest pixel.
   * @{ */
  itkSetMacro(BoundaryCondition, BoundaryConditionPointerType);
  itkGetConstMacro(BoundaryCondition, BoundaryConditionPointerType);
  /** @} */

  /** Which axes are subdivided, three at most, which is checked when the filter runs. An axis that is not keeps its
   * size, spacing and origin: each of its samples is an image of its own. Default: the first three.
   * @{ */
  itkSetMacro(SubdividedAxes, AxesType);
  itkGetConstReferenceMacro(SubdividedAxes, AxesType);
  /** @} */

#ifdef ITK_USE_CONCEPT_CHECKING
  itkConceptMacro(SameDimensionCheck, (Concept::SameDimension<Dimension, OutputImageType::ImageDimension>));
  itkConceptMacro(InputComponentIsArithmeticCheck,
                  (Concept::HasNumericTraits<SubdivisionComponentType<InputImageType>>));
  itkConceptMacro(OutputComponentIsArithmeticCheck,
                  (Concept::HasNumericTraits<SubdivisionComponentType<OutputImageType>>));
#endif

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

  /** Allocates, on huge pages where the system has them. */
  void
  AllocateOutputs() override;

  /** Splits the requested region into tiles that keep the recomputed halo small and hands them to the threads. */
  void
  GenerateData() override;

  /** Computes one tile. */
  void
  DynamicThreadedGenerateData(const OutputRegionType & outputRegion) override;

private:
  using KernelType = SubdivisionKernel<RealType>;
  using KernelPointer = std::unique_ptr<KernelType>;
  using AxisListType = std::vector<unsigned int>;
  using IndexType = typename InputRegionType::IndexType;
  using SizeType = typename InputRegionType::SizeType;
  using ReaderType = SubdivisionTileReader<InputImageType, RealType>;
  using WriterType = SubdivisionTileWriter<OutputImageType, RealType>;

  /** The subdivided axes, in order. */
  AxisListType
  GetAxes() const;

  /** The input pixels that have children in an output region. */
  InputRegionType
  ComputeParents(const OutputRegionType & outputRegion) const;

  /** The input pixels that the children in an output region depend on, those outside the image among them. */
  InputRegionType
  ComputeStencil(const OutputRegionType & outputRegion) const;

  /** The output pixels, within the requested region, of the children of the given parents. */
  OutputRegionType
  ComputeChildren(const InputRegionType & parents) const;

  /** The size of the tiles that the parents in the requested region are split into. */
  SizeType
  ComputeTileSize(const InputRegionType & parents) const;

  /** Of tile sizes up to the largest one, parts of it along the rows and the sweep, the one with which the threads are
   * done first: with little halo, and none of them idle at the end. */
  SizeType
  BalanceTileSize(const SizeType & parents, const SizeType & largest) const;

  static SizeValueType
  DivideUp(const SizeValueType size, const SizeValueType part)
  {
    return (size + part - 1) / part;
  }

  /** How many parts there are along each axis. */
  static SizeType
  DivideUp(const SizeType & size, const SizeType & part);

  /** The position, along each axis, of an element of an array of the given size. */
  static SizeType
  Unravel(SizeValueType number, const SizeType & size);

  /** What a kernel is made for. */
  struct KernelSettings
  {
    std::string  Target;
    SchemeEnum   Scheme{};
    double       Tension{};
    unsigned int NumberOfAxes{};
    std::size_t  Width{};
    std::size_t  Height{};

    bool
    operator==(const KernelSettings & other) const
    {
      return Target == other.Target && Scheme == other.Scheme && Tension == other.Tension &&
             NumberOfAxes == other.NumberOfAxes && Width == other.Width && Height == other.Height;
    }
  };

  /** Forgets kernels that were made for something else than tiles of the given size. */
  void
  PrepareKernels(const SizeType & tileSize);

  KernelPointer
  BorrowKernel();

  void
  ReturnKernel(KernelPointer kernel);

  /** Subdivides what reader and writer are set to; reports the number of pixels that were written. */
  template <typename TReport>
  void
  SweepTile(KernelType &                kernel,
            const ReaderType &          reader,
            WriterType &                writer,
            const SubdivisionTileAxes & axes,
            const InputRegionType &     parents,
            const TReport &             report) const;

  DefaultBoundaryConditionType m_DefaultBoundaryCondition;
  BoundaryConditionPointerType m_BoundaryCondition{ &m_DefaultBoundaryCondition };
  SchemeEnum                   m_Scheme{ SchemeEnum::NonOscillatory };
  double                       m_Tension{ 2.0 };
  AxesType                     m_SubdividedAxes;

  /** Kernels that no thread uses at the moment: as many as threads once did, so that each allocates once, even if the
   * output is streamed. */
  std::vector<KernelPointer> m_IdleKernels;
  KernelSettings             m_KernelSettings;
  std::mutex                 m_IdleKernelsMutex;
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkNonOscillatorySubdivisionImageFilter.hxx"
#endif

#endif
