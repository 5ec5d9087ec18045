// SPDX-License-Identifier: Apache-2.0
#ifndef itkNonOscillatorySubdivisionImageFilter_h
#define itkNonOscillatorySubdivisionImageFilter_h

#include "itkSubdivisionImageFilterBase.h"

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
 *   p-4 ... p+5.
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
 * those that only depend on it through a limit are finite. The restored scheme's stencil is that of the sharpened
 * values: ten points along one axis.
 *
 * The result depends on the input and the options alone, never on the number of threads, the region asked for or how
 * the image was streamed. The filter streams: it requests the exact stencil of what it is asked for, as the boundary
 * condition needs it. Between updates it keeps what it computes in, some megabytes for each thread.
 *
 * Progress is reported by the thread that updates the filter; an abort, by an observer or another thread, keeps all
 * threads from going on. ITK itself forgets an abort that was asked for before the first progress, as in a StartEvent.
 *
 * \throw itk::ExceptionObject on update, when an option is out of its range (see its setter), the input is missing or
 * empty, the pixels of input and output differ in their number of components, or doubled indices do not fit 64 bits.
 *
 * \ingroup NonOscillatorySubdivision
 */
template <typename TInputImage, typename TOutputImage = TInputImage>
class ITK_TEMPLATE_EXPORT NonOscillatorySubdivisionImageFilter
  : public SubdivisionImageFilterBase<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(NonOscillatorySubdivisionImageFilter);

  using Self = NonOscillatorySubdivisionImageFilter;
  using Superclass = SubdivisionImageFilterBase<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(NonOscillatorySubdivisionImageFilter, SubdivisionImageFilterBase);

  /** The type of the computation, float or double. */
  using RealType = typename std::conditional<
    Subdivision::NeedsDouble(Subdivision::ElementTypeOf<Detail::SubdivisionComponentType<TInputImage>>()) ||
      Subdivision::NeedsDouble(Subdivision::ElementTypeOf<Detail::SubdivisionComponentType<TOutputImage>>()),
    double,
    float>::type;

protected:
  NonOscillatorySubdivisionImageFilter() = default;
  ~NonOscillatorySubdivisionImageFilter() override = default;

  std::unique_ptr<Subdivision::TileRun>
  MakeRun(const Subdivision::ConstArrayView & input,
          const Subdivision::Box &            whole,
          const Subdivision::ArrayView &      output,
          const Subdivision::Options &        options,
          const unsigned int                  threads) override
  {
    return std::make_unique<Subdivision::Subdivider>(input, whole, output, options, threads, m_Workspace);
  }

private:
  Subdivision::Workspace m_Workspace;
};

} // namespace itk

#endif
