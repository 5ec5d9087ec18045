// SPDX-License-Identifier: Apache-2.0
#ifndef itkNonOscillatorySubdivisionImageFilter_hxx
#define itkNonOscillatorySubdivisionImageFilter_hxx

#include "itkHugePages.h"
#include "itkSubdivisionMasks.h"

#include "itkContinuousIndex.h"
#include "itkMath.h"
#include "itkTotalProgressReporter.h"

#include <algorithm>
#include <atomic>
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

  const InputImageType * const       input = this->GetInput();
  OutputImageType * const            output = this->GetOutput();
  OutputRegionType                   region = input->GetLargestPossibleRegion();
  auto                               spacing = input->GetSpacing();
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
  return axes.size() > 1 ? this->BalanceTileSize(parents.GetSize(), tile) : tile;
}

template <typename TInputImage, typename TOutputImage>
auto
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::BalanceTileSize(const SizeType & parents,
                                                                                 const SizeType & largest) const
  -> SizeType
{
  const SubdivisionTileAxes axes(this->GetAxes());
  constexpr SizeValueType   halo = SubdivisionMasks::ThresholdedRadius;
  constexpr SizeValueType   shortest = 4 * halo;
  const SizeValueType       threads =
    std::min<SizeValueType>(this->GetMultiThreader()->GetMaximumNumberOfThreads(), this->GetNumberOfWorkUnits());
  const SizeValueType fewestRowParts = axes.HasRows() ? DivideUp(parents[axes.GetRows()], largest[axes.GetRows()]) : 1;
  const SizeValueType mostRowParts = axes.HasRows() ? 2 * fewestRowParts : 1;
  const SizeValueType mostSweepParts =
    std::max<SizeValueType>(std::min(parents[axes.GetSweep()] / shortest, threads), 1);

  SizeType      best = largest;
  SizeValueType leastTime = NumericTraits<SizeValueType>::max();
  for (SizeValueType rowParts = fewestRowParts; rowParts <= mostRowParts; ++rowParts)
  {
    for (SizeValueType sweepParts = 1; sweepParts <= mostSweepParts; ++sweepParts)
    {
      SizeType tile = largest;
      if (axes.HasRows())
      {
        tile[axes.GetRows()] = DivideUp(parents[axes.GetRows()], rowParts);
      }
      tile[axes.GetSweep()] = DivideUp(parents[axes.GetSweep()], sweepParts);
      const SizeValueType tiles = InputRegionType(DivideUp(parents, tile)).GetNumberOfPixels();
      // About half of the work extends over the halo on both sides.
      const SizeValueType rows = axes.HasRows() ? tile[axes.GetRows()] + halo : 1;
      const SizeValueType time = DivideUp(tiles, threads) * rows * (tile[axes.GetSweep()] + halo);
      if (time < leastTime)
      {
        leastTime = time;
        best = tile;
      }
    }
  }
  return best;
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
  this->PrepareKernels(tileSize);
  const auto computeTile = [&](const SizeValueType number) {
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

  // Work units take tiles as they get done with others: all threads stay busy, and the calling one, the only one that
  // may tell observers, reports progress to the end. Not every version of every threader passes on what a thread
  // throws.
  const SizeValueType        numberOfTiles = InputRegionType(tiles).GetNumberOfPixels();
  std::atomic<SizeValueType> nextTile{ 0 };
  std::exception_ptr         firstException;
  std::mutex                 exceptionMutex;
  const auto                 computeTiles = [&](SizeValueType) {
    try
    {
      for (SizeValueType number = nextTile++; number < numberOfTiles; number = nextTile++)
      {
        computeTile(number);
      }
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(exceptionMutex);
      firstException = firstException ? firstException : std::current_exception();
    }
  };
  MultiThreaderBase * const threader = this->GetMultiThreader();
  threader->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
  threader->SetUpdateProgress(false);
  threader->ParallelizeArray(
    0, std::min<SizeValueType>(this->GetNumberOfWorkUnits(), numberOfTiles), computeTiles, nullptr);
  if (firstException)
  {
    std::rethrow_exception(firstException);
  }
  this->UpdateProgress(1.0f);

  this->AfterThreadedGenerateData();
}

template <typename TInputImage, typename TOutputImage>
void
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::PrepareKernels(const SizeType & tileSize)
{
  const SubdivisionTileAxes axes(this->GetAxes());
  KernelSettings            settings;
  settings.Target = GetSubdivisionTarget();
  settings.Scheme = m_Scheme;
  settings.Tension = m_Tension;
  settings.NumberOfAxes = axes.GetNumber();
  settings.Width = tileSize[axes.GetLanes()];
  settings.Height = tileSize[axes.GetRows()];
  if (!(settings == m_KernelSettings))
  {
    m_IdleKernels.clear();
    m_KernelSettings = settings;
  }
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
  const KernelSettings & settings = m_KernelSettings;
  return KernelPointer(
    new KernelType(settings.Scheme, settings.Tension, settings.NumberOfAxes, settings.Width, settings.Height));
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
  // The rest is for the end: the sum of all parts may exceed 1 by a rounding error, and progress would begin anew.
  constexpr float       progressWeight = 0.99f;
  TotalProgressReporter progress(this, output->GetRequestedRegion().GetNumberOfPixels(), 100, progressWeight);
  progress.CheckAbortGenerateData();

  const SubdivisionTileAxes axes(this->GetAxes());
  const bool                isSubdivided = axes.GetNumber() > 0;
  const InputRegionType     parents = this->ComputeParents(outputRegion);
  const IndexValueType      halo = isSubdivided ? KernelType::GetRadius(m_Scheme) : 0;
  ReaderType    reader(this->GetInput(), m_BoundaryCondition, axes, parents, halo, this->ComputeStencil(outputRegion));
  WriterType    writer(output, axes, outputRegion);
  KernelPointer kernel = isSubdivided ? this->BorrowKernel() : nullptr;

  // Every position along the axes that are not the tile's, and every component, is an image of its own.
  SizeType images = parents.GetSize();
  for (unsigned int axis = 0; axis < Dimension; ++axis)
  {
    images[axis] = axes.Has(axis) ? 1 : images[axis];
  }
  const SizeValueType numberOfImages = InputRegionType(images).GetNumberOfPixels();
  const unsigned int  components = output->GetNumberOfComponentsPerPixel();
  for (SizeValueType number = 0; number < numberOfImages; ++number)
  {
    IndexType      position = parents.GetIndex();
    const SizeType offset = Unravel(number, images);
    for (unsigned int axis = 0; axis < Dimension; ++axis)
    {
      position[axis] += static_cast<IndexValueType>(offset[axis]);
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
      reader.SetImage(position, component);
      writer.SetImage(position, component);
      if (kernel)
      {
        SweepTile(*kernel, reader, writer, axes, parents, report);
      }
      else
      {
        std::vector<RealType> row(parents.GetSize(axes.GetLanes()));
        reader.ReadRow(0, 0, row.data());
        report(writer.WriteRow(row.data()));
      }
    }
  }
  if (kernel)
  {
    this->ReturnKernel(std::move(kernel));
  }
}

template <typename TInputImage, typename TOutputImage>
template <typename TReport>
void
NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::SweepTile(KernelType &                kernel,
                                                                           const ReaderType &          reader,
                                                                           WriterType &                writer,
                                                                           const SubdivisionTileAxes & axes,
                                                                           const InputRegionType &     parents,
                                                                           const TReport &             report) const
{
  // Without rows or a sweep there is a single one.
  const auto           halo = static_cast<IndexValueType>(KernelType::GetRadius(m_Scheme));
  const IndexValueType rowHalo = axes.HasRows() ? halo : 0;
  const IndexValueType planeHalo = axes.HasSweep() ? halo : 0;
  const auto           width = parents.GetSize(axes.GetLanes());
  const auto           height = static_cast<IndexValueType>(axes.HasRows() ? parents.GetSize(axes.GetRows()) : 1);
  const auto           depth = static_cast<IndexValueType>(axes.HasSweep() ? parents.GetSize(axes.GetSweep()) : 1);
  const IndexValueType firstRow = parents.GetIndex(axes.GetRows());
  const IndexValueType firstPlane = parents.GetIndex(axes.GetSweep());
  const IndexValueType firstLane = SubdivisionMasks::Children * parents.GetIndex(axes.GetLanes());

  kernel.StartTile(width, static_cast<std::size_t>(height), static_cast<std::size_t>(depth));
  const auto advance = [&](const IndexValueType plane) {
    for (IndexValueType row = -rowHalo; row < height + rowHalo; ++row)
    {
      reader.ReadRow(firstRow + row, firstPlane + plane, kernel.GetInputRow(row) - halo);
    }
    return kernel.AdvancePlane();
  };
  const int  rowChildren = axes.HasRows() ? SubdivisionMasks::Children : 1;
  const int  sweepChildren = axes.HasSweep() ? SubdivisionMasks::Children : 1;
  const auto writeChildren = [&](const IndexValueType row, const IndexValueType endPlane, const unsigned int planes) {
    for (int rowChild = 0; rowChild < rowChildren; ++rowChild)
    {
      kernel.ComputeRow(static_cast<std::size_t>(row), rowChild, planes);
      const IndexValueType childRow = SubdivisionMasks::Children * (firstRow + row) + rowChild;
      for (unsigned int age = 0; age < planes; ++age)
      {
        const IndexValueType plane = firstPlane + endPlane - 1 - static_cast<IndexValueType>(age);
        for (int sweepChild = 0; sweepChild < sweepChildren; ++sweepChild)
        {
          const IndexValueType childPlane = SubdivisionMasks::Children * plane + sweepChild;
          const auto * const   children = kernel.ComputeChildren(age, sweepChild);
          report(writer.WriteChildren(children, width, firstLane, childRow, childPlane));
        }
      }
    }
  };

  unsigned int   complete = 0;
  IndexValueType endPlane = 0;
  for (IndexValueType plane = -planeHalo; plane < depth + planeHalo; ++plane)
  {
    complete += advance(plane);
    // The next plane may complete two.
    if (complete + 1 >= KernelType::PlanesPerStep || plane + 1 == depth + planeHalo)
    {
      endPlane += complete;
      for (IndexValueType row = 0; row < height; ++row)
      {
        writeChildren(row, endPlane, complete);
      }
      complete = 0;
    }
  }
}

} // namespace itk

#endif
