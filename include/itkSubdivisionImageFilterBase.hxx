// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionImageFilterBase_hxx
#define itkSubdivisionImageFilterBase_hxx

#include "NonOscillatorySubdivision/DefaultFloatingPoint.h"
#include "NonOscillatorySubdivision/Geometry.h"
#include "NonOscillatorySubdivision/Scheme.h"
#include "NonOscillatorySubdivision/Target.h"
#include "itkSubdivisionProgress.h"

#include "itkContinuousIndex.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <stdexcept>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
SubdivisionImageFilterBase<TInputImage, TOutputImage>::SubdivisionImageFilterBase()
{
  for (unsigned int axis = 0; axis < Dimension; ++axis)
  {
    m_SubdividedAxes[axis] = axis < MaximumNumberOfSubdividedAxes;
  }
  this->DynamicMultiThreadingOn();
  this->ThreaderUpdateProgressOff();
}

template <typename TInputImage, typename TOutputImage>
void
SubdivisionImageFilterBase<TInputImage, TOutputImage>::SetScheme(const SchemeEnum scheme)
{
  constexpr std::size_t schemes = std::size(Subdivision::Schemes);
  static_assert(static_cast<std::size_t>(SchemeEnum::Restored) + 1 == schemes, "ITK's enumeration has all schemes");
  if (static_cast<std::size_t>(scheme) >= schemes)
  {
    itkExceptionMacro("Scheme is number " << static_cast<unsigned int>(scheme) << ", but must be less than "
                                          << schemes);
  }
  if (m_Scheme != scheme)
  {
    m_Scheme = scheme;
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
void
SubdivisionImageFilterBase<TInputImage, TOutputImage>::SetSchemeByName(const std::string & name)
{
  const auto scheme = std::find_if(std::begin(Subdivision::Schemes),
                                   std::end(Subdivision::Schemes),
                                   [&name](const Subdivision::Scheme & candidate) { return candidate.Name == name; });
  if (scheme == std::end(Subdivision::Schemes))
  {
    std::string names;
    for (const Subdivision::Scheme & candidate : Subdivision::Schemes)
    {
      names += (names.empty() ? "" : ", ") + std::string(candidate.Name);
    }
    itkExceptionMacro("Scheme is '" << name << "', but must be one of: " << names);
  }
  this->SetScheme(static_cast<SchemeEnum>(scheme - std::begin(Subdivision::Schemes)));
}

template <typename TInputImage, typename TOutputImage>
void
SubdivisionImageFilterBase<TInputImage, TOutputImage>::SetBoundaryCondition(
  const BoundaryConditionPointerType boundaryCondition)
{
  const BoundaryConditionPointerType chosen = boundaryCondition ? boundaryCondition : &m_DefaultBoundaryCondition;
  if (m_BoundaryCondition != chosen)
  {
    m_BoundaryCondition = chosen;
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
void
SubdivisionImageFilterBase<TInputImage, TOutputImage>::SetBoundaryConditionToDefault()
{
  this->SetBoundaryCondition(nullptr);
}

template <typename TInputImage, typename TOutputImage>
void
SubdivisionImageFilterBase<TInputImage, TOutputImage>::SetSubdividedAxis(const unsigned int axis,
                                                                         const bool         isSubdivided)
{
  if (axis >= Dimension)
  {
    itkExceptionMacro("SubdividedAxis is " << axis << ", but must be less than " << Dimension);
  }
  AxesType axes = m_SubdividedAxes;
  axes[axis] = isSubdivided;
  this->SetSubdividedAxes(axes);
}

template <typename TInputImage, typename TOutputImage>
void
SubdivisionImageFilterBase<TInputImage, TOutputImage>::SetTarget(const std::string & target)
{
  try
  {
    Subdivision::Target::Named(target);
  }
  catch (const std::invalid_argument & error)
  {
    itkExceptionMacro("Target: " << error.what());
  }
  if (m_Target != target)
  {
    m_Target = target;
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
void
SubdivisionImageFilterBase<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Scheme: " << m_Scheme << std::endl;
  os << indent << "Tension: " << m_Tension << std::endl;
  os << indent << "SubdividedAxes: " << m_SubdividedAxes << std::endl;
  os << indent << "Target: " << (m_Target.empty() ? "(the fastest)" : m_Target) << std::endl;
  os << indent << "BoundaryCondition: ";
  m_BoundaryCondition->Print(os);
}

template <typename TInputImage, typename TOutputImage>
void
SubdivisionImageFilterBase<TInputImage, TOutputImage>::VerifyPreconditions() const
{
  Superclass::VerifyPreconditions();
  try
  {
    this->CheckTension();
  }
  catch (const std::invalid_argument & error)
  {
    itkExceptionMacro("Tension is " << m_Tension << ", but " << error.what());
  }
  const auto axes = std::count(m_SubdividedAxes.Begin(), m_SubdividedAxes.End(), true);
  if (axes > static_cast<std::ptrdiff_t>(MaximumNumberOfSubdividedAxes))
  {
    itkExceptionMacro("SubdividedAxes has " << axes << " axes, but at most " << MaximumNumberOfSubdividedAxes
                                            << " can be subdivided");
  }
}

template <typename TInputImage, typename TOutputImage>
void
SubdivisionImageFilterBase<TInputImage, TOutputImage>::VerifyInputInformation() const
{
  Superclass::VerifyInputInformation();
  const InputRegionType & region = this->GetInput()->GetLargestPossibleRegion();
  for (unsigned int axis = 0; axis < Dimension; ++axis)
  {
    if (region.GetSize(axis) == 0)
    {
      itkExceptionMacro("The input has size " << region.GetSize() << ", but must have at least one pixel");
    }
  }
  // Throws if the boundary condition does not fit the pixels.
  Detail::ToBoundary<InputImageType>(*m_BoundaryCondition, this->GetInput());
}

template <typename TInputImage, typename TOutputImage>
Subdivision::Flags
SubdivisionImageFilterBase<TInputImage, TOutputImage>::GetFlags() const
{
  Subdivision::Flags flags{ false };
  flags.insert(flags.end(), m_SubdividedAxes.Begin(), m_SubdividedAxes.End());
  return flags;
}

template <typename TInputImage, typename TOutputImage>
Subdivision::Options
SubdivisionImageFilterBase<TInputImage, TOutputImage>::GetOptions() const
{
  Subdivision::Options options;
  options.Scheme = &this->GetParts();
  options.Tension = m_Tension;
  options.SubdividedAxes = this->GetFlags();
  options.Target = &Subdivision::Target::Named(m_Target);
  return options;
}

template <typename TInputImage, typename TOutputImage>
void
SubdivisionImageFilterBase<TInputImage, TOutputImage>::GenerateOutputInformation()
{
  const Subdivision::DefaultFloatingPoint environment;
  Superclass::GenerateOutputInformation();

  const InputImageType * const       input = this->GetInput();
  OutputImageType * const            output = this->GetOutput();
  auto                               spacing = input->GetSpacing();
  ContinuousIndex<double, Dimension> origin;
  origin.Fill(0.0);
  for (unsigned int axis = 0; axis < Dimension; ++axis)
  {
    if (m_SubdividedAxes[axis])
    {
      spacing[axis] /= Subdivision::Children;
      origin[axis] = Subdivision::FirstChildPosition;
    }
  }
  typename OutputImageType::PointType point;
  input->TransformContinuousIndexToPhysicalPoint(origin, point);

  try
  {
    const Subdivision::Box whole = Detail::ToBox(input, input->GetLargestPossibleRegion());
    output->SetLargestPossibleRegion(
      Detail::ToRegion<Dimension>(Subdivision::Subdivider::GetWholeOutput(whole, this->GetFlags())));
  }
  catch (const std::overflow_error & error)
  {
    itkExceptionMacro("The input has region " << input->GetLargestPossibleRegion()
                                              << " too large to be subdivided: " << error.what());
  }
  output->SetSpacing(spacing);
  output->SetOrigin(point);

  if (Detail::CountComponents(output) != Detail::CountComponents(input))
  {
    itkExceptionMacro("Pixels of the output have " << Detail::CountComponents(output)
                                                   << " components, but must have as many as those of the input, "
                                                   << Detail::CountComponents(input));
  }
}

template <typename TInputImage, typename TOutputImage>
auto
SubdivisionImageFilterBase<TInputImage, TOutputImage>::ComputeStencil(const OutputRegionType & outputRegion) const
  -> InputRegionType
{
  InputRegionType stencil = outputRegion;
  for (unsigned int axis = 0; axis < Dimension; ++axis)
  {
    if (m_SubdividedAxes[axis])
    {
      const Subdivision::Interval interval =
        Subdivision::GetStencil({ outputRegion.GetIndex(axis), outputRegion.GetSize(axis) }, this->GetParts().Radius());
      stencil.SetIndex(axis, static_cast<IndexValueType>(interval.First));
      stencil.SetSize(axis, static_cast<SizeValueType>(interval.Size));
    }
  }
  return stencil;
}

template <typename TInputImage, typename TOutputImage>
auto
SubdivisionImageFilterBase<TInputImage, TOutputImage>::ComputeRequest(const OutputRegionType & outputRegion) const
  -> InputRegionType
{
  const InputImageType * const input = this->GetInput();
  const InputRegionType &      largest = input->GetLargestPossibleRegion();
  if (!Detail::IsKnown<InputImageType>(*m_BoundaryCondition))
  {
    const InputRegionType stencil = this->ComputeStencil(outputRegion);
    return largest.IsInside(stencil) ? stencil
                                     : Detail::AskForRequest<InputImageType>(*m_BoundaryCondition, largest, stencil);
  }
  Subdivision::Options options = this->GetOptions();
  options.Boundary = Detail::ToBoundary<InputImageType>(*m_BoundaryCondition, input);
  return Detail::ToRegion<Dimension>(Subdivision::Subdivider::GetInputRequest(
    Detail::ToBox(this->GetOutput(), outputRegion), Detail::ToBox(input, largest), options));
}

template <typename TInputImage, typename TOutputImage>
void
SubdivisionImageFilterBase<TInputImage, TOutputImage>::GenerateInputRequestedRegion()
{
  auto * const input = const_cast<InputImageType *>(this->GetInput());
  if (input)
  {
    const OutputRegionType & requested = this->GetOutput()->GetRequestedRegion();
    // Nothing is computed of an empty region, and the pipeline refuses one outside the output as soon as this returns.
    const bool isComputed = requested.GetNumberOfPixels() != 0 && this->GetOutput()->VerifyRequestedRegion();
    input->SetRequestedRegion(isComputed ? this->ComputeRequest(requested) : input->GetLargestPossibleRegion());
  }
}

template <typename TInputImage, typename TOutputImage>
void
SubdivisionImageFilterBase<TInputImage, TOutputImage>::GenerateData()
{
  this->AllocateOutputs();
  const InputImageType * const input = this->GetInput();
  OutputImageType * const      output = this->GetOutput();
  const OutputRegionType &     requested = output->GetRequestedRegion();
  MultiThreaderBase * const    threader = this->GetMultiThreader();
  const SizeValueType          workUnits = this->GetNumberOfWorkUnits();
  const SizeValueType          threads = std::min<SizeValueType>(threader->GetMaximumNumberOfThreads(), workUnits);
  threader->SetNumberOfWorkUnits(static_cast<ThreadIdType>(workUnits));
  threader->SetUpdateProgress(false);

  Subdivision::Options options = this->GetOptions();
  options.Boundary = Detail::ToBoundary<InputImageType>(*m_BoundaryCondition, input);
  std::unique_ptr<Subdivision::TileRun> run;
  try
  {
    run = this->MakeRun(Detail::ViewRegion<const void>(input, input->GetBufferedRegion()),
                        Detail::ToBox(input, input->GetLargestPossibleRegion()),
                        Detail::ViewRegion<void>(output, requested),
                        options,
                        static_cast<unsigned int>(threads));
  }
  catch (const std::invalid_argument & error)
  {
    itkExceptionMacro("The images do not fit what was requested of them: " << error.what());
  }
  Detail::SubdivisionProgress progress(this, requested.GetNumberOfPixels() * Detail::CountComponents(output));
  progress.RunTiles(*run, threader, workUnits);

  if constexpr (std::is_same<Detail::SubdivisionComponentType<OutputImageType>, bool>::value)
  {
    // Computed as bytes, of which a linear scheme may make more than 1.
    auto * const bytes = reinterpret_cast<std::uint8_t *>(output->GetBufferPointer());
    std::transform(bytes, bytes + output->GetPixelContainer()->Size(), bytes, [](const std::uint8_t value) {
      return static_cast<std::uint8_t>(value != 0);
    });
  }
}

} // namespace itk

#endif
