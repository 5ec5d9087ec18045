// SPDX-License-Identifier: Apache-2.0
#ifndef itkNonOscillatorySubdivisionImageFilter_hxx
#define itkNonOscillatorySubdivisionImageFilter_hxx

#include "itkHugePages.h"
#include "itkSubdivisionMasks.h"

#include "itkContinuousIndex.h"
#include "itkMath.h"
#include "itkTotalProgressReporter.h"

#include <algorithm>
#include <exception>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::NonOscillatorySubdivisionImageFilter()
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
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Scheme: " << m_Scheme << std::endl;
  os << indent << "Tension: " << m_Tension << std::endl;
  os << indent << "SubdividedAxes: " << m_SubdividedAxes << std::endl;
  os << indent << "BoundaryCondition: ";
  if (m_BoundaryCondition)
  {
    m_BoundaryCondition->Print(os);
  }
  else
  {
    os << "(none)" << std::endl;
  }
}

template <typename TInputImage, typename TOutputImage>
void
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::VerifyPreconditions() const
{
  Superclass::VerifyPreconditions();
  if (!(Math::isfinite(m_Tension) && m_Tension > 1.0))
  {
    itkExceptionMacro("Tension is " << m_Tension << ", but must be finite and greater than 1");
  }
  const std::size_t axes = this->GetAxes().size();
  if (axes > MaximumNumberOfSubdividedAxes)
  {
    itkExceptionMacro("SubdividedAxes has " << axes << " axes, but at most " << MaximumNumberOfSubdividedAxes
                                            << " can be subdivided");
  }
  if (!m_BoundaryCondition)
  {
    itkExceptionMacro("BoundaryCondition is null, but must be an object");
  }
}

template <typename TInputImage, typename TOutputImage>
void
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::VerifyInputInformation() const
{
  Superclass::VerifyInputInformation();
  const InputRegionType & region = this->GetInput()->GetLargestPossibleRegion();
  if (region.GetNumberOfPixels() == 0)
  {
    itkExceptionMacro("The input has size " << region.GetSize() << ", but must have at least one pixel");
  }
}

template <typename TInputImage, typename TOutputImage>
auto
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::GetAxes() const -> AxisListType
{
  AxisListType axes;
  for (unsigned int axis = 0; axis < Dimension; ++axis)
  {
    if (m_SubdividedAxes[axis])
    {
      axes.push_back(axis);
    }
  }
  return axes;
}

template <typename TInputImage, typename TOutputImage>
void
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::GenerateOutputInformation()
{
  Superclass::GenerateOutputInformation();

  const InputImageType * const input = this->GetInput();
  OutputImageType * const      output = this->GetOutput();
  OutputRegionType             region = input->GetLargestPossibleRegion();
  auto                         spacing = input->GetSpacing();
  ContinuousIndex<double, Dimension> origin;
  origin.Fill(0.0);
  for (const unsigned int axis : this->GetAxes())
  {
    region.SetIndex(axis, SubdivisionMasks::Children * region.GetIndex(axis));
    region.SetSize(axis, SubdivisionMasks::Children * region.GetSize(axis));
    spacing[axis] /= SubdivisionMasks::Children;
    origin[axis] = SubdivisionMasks::FirstChildPosition;
  }
  typename OutputImageType::PointType point;
  input->TransformContinuousIndexToPhysicalPoint(origin, point);

  output->SetLargestPossibleRegion(region);
  output->SetSpacing(spacing);
  output->SetOrigin(point);

  if (output->GetNumberOfComponentsPerPixel() != input->GetNumberOfComponentsPerPixel())
  {
    itkExceptionMacro("Pixels of the output have " << output->GetNumberOfComponentsPerPixel()
                                                   << " components, but must have as many as those of the input, "
                                                   << input->GetNumberOfComponentsPerPixel());
  }
}

template <typename TInputImage, typename TOutputImage>
auto
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::ComputeParents(
  const OutputRegionType & outputRegion) const -> InputRegionType
{
  InputRegionType parents = outputRegion;
  for (const unsigned int axis : this->GetAxes())
  {
    const IndexValueType begin = outputRegion.GetIndex(axis);
    const IndexValueType end = begin + static_cast<IndexValueType>(outputRegion.GetSize(axis));
    const IndexValueType first = Math::Floor<IndexValueType>(begin / 2.0);
    const IndexValueType last = Math::Floor<IndexValueType>((end - 1) / 2.0);
    parents.SetIndex(axis, first);
    parents.SetSize(axis, static_cast<SizeValueType>(last - first + 1));
  }
  return parents;
}

template <typename TInputImage, typename TOutputImage>
auto
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::ComputeStencil(
  const OutputRegionType & outputRegion) const -> InputRegionType
{
  InputRegionType stencil = this->ComputeParents(outputRegion);
  const auto      radius = static_cast<IndexValueType>(KernelType::GetRadius(m_Scheme));
  for (const unsigned int axis : this->GetAxes())
  {
    // The radius is that of both children of a pixel; each of them reads one pixel less on the far side.
    const IndexValueType begin = outputRegion.GetIndex(axis);
    const IndexValueType end = begin + static_cast<IndexValueType>(outputRegion.GetSize(axis));
    const IndexValueType first = stencil.GetIndex(axis) - radius + (begin % 2 != 0 ? 1 : 0);
    const IndexValueType last =
      stencil.GetIndex(axis) + static_cast<IndexValueType>(stencil.GetSize(axis)) - 1 + radius - (end % 2 != 0 ? 1 : 0);
    stencil.SetIndex(axis, first);
    stencil.SetSize(axis, static_cast<SizeValueType>(last - first + 1));
  }
  return stencil;
}

template <typename TInputImage, typename TOutputImage>
auto
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::ComputeChildren(const InputRegionType & parents) const
  -> OutputRegionType
{
  OutputRegionType children = parents;
  for (const unsigned int axis : this->GetAxes())
  {
    children.SetIndex(axis, SubdivisionMasks::Children * parents.GetIndex(axis));
    children.SetSize(axis, SubdivisionMasks::Children * parents.GetSize(axis));
  }
  children.Crop(this->GetOutput()->GetRequestedRegion());
  return children;
}

template <typename TInputImage, typename TOutputImage>
void
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::GenerateInputRequestedRegion()
{
  Superclass::GenerateInputRequestedRegion();
  auto * const input = const_cast<InputImageType *>(this->GetInput());
  if (input)
  {
    // Asked as if the image began at 0: PeriodicBoundaryCondition forgets where it begins.
    InputRegionType largest = input->GetLargestPossibleRegion();
    InputRegionType stencil = this->ComputeStencil(this->GetOutput()->GetRequestedRegion());
    const auto      start = largest.GetIndex() - IndexType::Filled(0);
    largest.SetIndex(largest.GetIndex() - start);
    stencil.SetIndex(stencil.GetIndex() - start);
    InputRegionType request = m_BoundaryCondition->GetInputRequestedRegion(largest, stencil);
    request.SetIndex(request.GetIndex() + start);
    input->SetRequestedRegion(request);
  }
}

template <typename TInputImage, typename TOutputImage>
void
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::AllocateOutputs()
{
  Superclass::AllocateOutputs();
  auto * const pixels = this->GetOutput()->GetPixelContainer();
  AdviseHugePages(pixels->GetBufferPointer(), pixels->Size() * sizeof(*pixels->GetBufferPointer()));
}

template <typename TInputImage, typename TOutputImage>
auto
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::DivideUp(const SizeType & size, const SizeType & part)
  -> SizeType
{
  SizeType parts;
  for (unsigned int axis = 0; axis < Dimension; ++axis)
  {
    parts[axis] = DivideUp(size[axis], part[axis]);
  }
  return parts;
}

template <typename TInputImage, typename TOutputImage>
auto
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::Unravel(SizeValueType number, const SizeType & size)
  -> SizeType
{
  SizeType position;
  for (unsigned int axis = 0; axis < Dimension; ++axis)
  {
    position[axis] = number % size[axis];
    number /= size[axis];
  }
  return position;
}

template <typename TInputImage, typename TOutputImage>
auto
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::ComputeTileSize(const InputRegionType & parents) const
  -> SizeType
{
  const AxisListType axes = this->GetAxes();
  SizeType           tile = parents.GetSize();
  const auto         splitEvenly = [](SizeValueType & size, const SizeValueType most) {
    size = DivideUp(size, DivideUp(size, most));
  };

  // Along the lanes and the rows as suits the cache.
  std::size_t width = 0;
  std::size_t height = 0;
  KernelType::GetRecommendedTileSize(static_cast<unsigned int>(axes.size()), width, height);
  if (!axes.empty())
  {
    splitEvenly(tile[axes[0]], width);
  }
  if (axes.size() > 2)
  {
    splitEvenly(tile[axes[1]], height);
  }

  // Along axes that are not subdivided, where tiles need no halo, until a tile is a morsel.
  constexpr SizeValueType morsel = SizeValueType{ 1 } << 16;
  for (unsigned int axis = Dimension; axis-- > 0;)
  {
    if (!m_SubdividedAxes[axis])
    {
      const SizeValueType pixels = InputRegionType(tile).GetNumberOfPixels() / tile[axis];
      splitEvenly(tile[axis], std::max<SizeValueType>(morsel / pixels, 1));
    }
  }

  // Along the sweep, where each part costs its halo once more, only for threads that had nothing to do otherwise.
  if (axes.size() > 1)
  {
    constexpr SizeValueType shortest = 4 * SubdivisionMasks::ThresholdedRadius;
    const SizeValueType     threads = this->GetMultiThreader()->GetMaximumNumberOfThreads();
    const SizeValueType     tiles = InputRegionType(DivideUp(parents.GetSize(), tile)).GetNumberOfPixels();
    SizeValueType &         depth = tile[axes.back()];
    splitEvenly(depth, std::max(DivideUp(depth, DivideUp(threads, tiles)), shortest));
  }
  return tile;
}

template <typename TInputImage, typename TOutputImage>
void
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::GenerateData()
{
  this->AllocateOutputs();
  this->BeforeThreadedGenerateData();

  const InputRegionType parents = this->ComputeParents(this->GetOutput()->GetRequestedRegion());
  const SizeType        tileSize = this->ComputeTileSize(parents);
  const SizeType        tiles = DivideUp(parents.GetSize(), tileSize);
  const auto            computeTile = [&](const SizeValueType number) {
    const SizeType  position = Unravel(number, tiles);
    InputRegionType tile = parents;
    for (unsigned int axis = 0; axis < Dimension; ++axis)
    {
      const SizeValueType offset = position[axis] * tileSize[axis];
      tile.SetIndex(axis, parents.GetIndex(axis) + static_cast<IndexValueType>(offset));
      tile.SetSize(axis, std::min(tileSize[axis], parents.GetSize(axis) - offset));
    }
    this->DynamicThreadedGenerateData(this->ComputeChildren(tile));
  };

  // Not every version of every threader passes on what a thread throws.
  std::exception_ptr        firstException;
  std::mutex                exceptionMutex;
  MultiThreaderBase * const threader = this->GetMultiThreader();
  threader->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
  threader->SetUpdateProgress(false);
  threader->ParallelizeArray(
    0,
    InputRegionType(tiles).GetNumberOfPixels(),
    [&](const SizeValueType number) {
      try
      {
        computeTile(number);
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(exceptionMutex);
        firstException = firstException ? firstException : std::current_exception();
      }
    },
    nullptr);
  m_IdleKernels.clear();
  if (firstException)
  {
    std::rethrow_exception(firstException);
  }

  this->AfterThreadedGenerateData();
}

template <typename TInputImage, typename TOutputImage>
auto
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::BorrowKernel() -> KernelPointer
{
  {
    const std::lock_guard<std::mutex> lock(m_IdleKernelsMutex);
    if (!m_IdleKernels.empty())
    {
      KernelPointer kernel = std::move(m_IdleKernels.back());
      m_IdleKernels.pop_back();
      return kernel;
    }
  }
  const auto  numberOfAxes = static_cast<unsigned int>(this->GetAxes().size());
  std::size_t width = 0;
  std::size_t height = 0;
  KernelType::GetRecommendedTileSize(numberOfAxes, width, height);
  return KernelPointer(new KernelType(m_Scheme, m_Tension, numberOfAxes, width, height));
}

template <typename TInputImage, typename TOutputImage>
void
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::ReturnKernel(KernelPointer kernel)
{
  const std::lock_guard<std::mutex> lock(m_IdleKernelsMutex);
  m_IdleKernels.push_back(std::move(kernel));
}

template <typename TInputImage, typename TOutputImage>
void
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::DynamicThreadedGenerateData(
  const OutputRegionType & outputRegion)
{
  OutputImageType * const output = this->GetOutput();
  TotalProgressReporter   progress(this, output->GetRequestedRegion().GetNumberOfPixels());
  progress.CheckAbortGenerateData();

  const AxisListType axes = this->GetAxes();
  const unsigned int lanes = axes.empty() ? 0 : axes[0];
  ReaderType         reader(this->GetInput(), m_BoundaryCondition, lanes, this->ComputeStencil(outputRegion));
  WriterType         writer(output, lanes, outputRegion);
  KernelPointer      kernel = axes.empty() ? nullptr : this->BorrowKernel();

  // Every position along the axes that are not subdivided, and every component, is an image of its own.
  const InputRegionType parents = this->ComputeParents(outputRegion);
  SizeType              images = parents.GetSize();
  images[lanes] = 1;
  for (const unsigned int axis : axes)
  {
    images[axis] = 1;
  }
  const SizeValueType numberOfImages = InputRegionType(images).GetNumberOfPixels();
  const unsigned int  components = output->GetNumberOfComponentsPerPixel();
  for (SizeValueType number = 0; number < numberOfImages; ++number)
  {
    const SizeType position = Unravel(number, images);
    IndexType      start = parents.GetIndex();
    for (unsigned int axis = 0; axis < Dimension; ++axis)
    {
      start[axis] += static_cast<IndexValueType>(position[axis]);
    }
    for (unsigned int component = 0; component < components; ++component)
    {
      // Progress counts pixels, not components.
      const auto report = [&](const SizeValueType pixels) {
        if (component + 1 == components)
        {
          progress.Completed(pixels);
        }
      };
      if (kernel)
      {
        SweepTile(*kernel, reader, writer, axes, InputRegionType(start, parents.GetSize()), component, report);
      }
      else
      {
        report(CopyRow(reader, writer, start, parents.GetSize(lanes), component));
      }
    }
  }
  if (kernel)
  {
    this->ReturnKernel(std::move(kernel));
  }
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::CopyRow(const ReaderType &  reader,
                                                                         const WriterType &  writer,
                                                                         const IndexType &   start,
                                                                         const SizeValueType count,
                                                                         const unsigned int  component)
{
  std::vector<RealType> row(count);
  reader.ReadRow(start, count, component, row.data());
  writer.WriteRow(start, row.data(), count, component);
  return count;
}

template <typename TInputImage, typename TOutputImage>
template <typename TReport>
void
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::SweepTile(KernelType &            kernel,
                                                                           const ReaderType &      reader,
                                                                           WriterType &            writer,
                                                                           const AxisListType &    axes,
                                                                           const InputRegionType & parents,
                                                                           const unsigned int      component,
                                                                           const TReport &         report)
{
  const unsigned int lanes = axes[0];
  // Without such an axis there is a single row or plane, at the start of the tile.
  const bool           hasRows = axes.size() > 2;
  const bool           hasSweep = axes.size() > 1;
  const auto           radius = static_cast<IndexValueType>(KernelType::GetRadius(m_Scheme));
  const auto           width = static_cast<IndexValueType>(parents.GetSize(lanes));
  const IndexValueType height = hasRows ? static_cast<IndexValueType>(parents.GetSize(axes[1])) : 1;
  const IndexValueType depth = hasSweep ? static_cast<IndexValueType>(parents.GetSize(axes.back())) : 1;
  const IndexValueType rowHalo = hasRows ? radius : 0;
  const IndexValueType sweepHalo = hasSweep ? radius : 0;

  const auto indexOf = [&](const IndexValueType lane, const IndexValueType row, const IndexValueType plane) {
    IndexType index = parents.GetIndex();
    index[lanes] += lane;
    index[hasRows ? axes[1] : lanes] += row;
    index[axes.back()] += plane;
    return index;
  };
  const auto readWidth = static_cast<SizeValueType>(width + 2 * radius);
  // Calls a function with the index and the rows of the children of each row of a plane of parents.
  const auto forEachRowOfChildren = [&](const IndexValueType plane, const IndexValueType row, const auto & function) {
    IndexType index = indexOf(0, row, plane);
    for (const unsigned int axis : axes)
    {
      index[axis] *= SubdivisionMasks::Children;
    }
    for (int sweepChild = 0; sweepChild < (hasSweep ? SubdivisionMasks::Children : 1); ++sweepChild)
    {
      for (int rowChild = 0; rowChild < (hasRows ? SubdivisionMasks::Children : 1); ++rowChild)
      {
        function(index, sweepChild, rowChild);
        index[hasRows ? axes[1] : lanes] += 1;
      }
      index[hasRows ? axes[1] : lanes] -= hasRows ? SubdivisionMasks::Children : 1;
      index[axes.back()] += 1;
    }
  };

  kernel.StartTile(static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  for (IndexValueType plane = -sweepHalo; plane < depth + sweepHalo; ++plane)
  {
    const IndexValueType complete = plane - sweepHalo;
    for (IndexValueType row = -rowHalo; row < height + rowHalo; ++row)
    {
      reader.ReadRow(indexOf(-radius, row, plane), readWidth, component, kernel.GetInputRow(row) - radius);
    }
    for (IndexValueType row = -rowHalo; row < height + rowHalo; ++row)
    {
      reader.PrefetchRow(indexOf(-radius, row, plane + 1), readWidth);
    }
    for (IndexValueType row = 0; row < height && complete >= 0; ++row)
    {
      forEachRowOfChildren(complete, row, [&](const IndexType & index, int, int) { writer.PrefetchRow(index); });
    }
    if (!kernel.AdvancePlane())
    {
      continue;
    }
    for (IndexValueType row = 0; row < height; ++row)
    {
      const auto    children = kernel.ComputeChildren(static_cast<std::size_t>(row));
      SizeValueType written = 0;
      forEachRowOfChildren(complete, row, [&](const IndexType & index, const int sweepChild, const int rowChild) {
        written += writer.WriteChildren(
          index, children.Rows[sweepChild][rowChild], parents.GetSize(lanes), component);
      });
      report(written);
    }
  }
}

} // namespace itk

#endif
