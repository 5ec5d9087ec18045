// SPDX-License-Identifier: Apache-2.0
#ifndef itkImageFidelityCalculator_hxx
#define itkImageFidelityCalculator_hxx

#include "itkImageFidelityCalculator.h"

#include "itkImageRegionConstIteratorWithIndex.h"
#include "itkImageRegionSplitterDirection.h"
#include "itkImageScanlineConstIterator.h"
#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <cmath>

namespace itk
{
template <typename TReferenceImage, typename TTestImage>
ImageFidelityCalculator<TReferenceImage, TTestImage>::ImageFidelityCalculator()
{
  this->SetPrimaryInputName("ReferenceImage");
  this->AddRequiredInputName("TestImage", 1);

  const auto wholeRows = ImageRegionSplitterDirection::New();
  wholeRows->SetDirection(0);
  this->SetRegionSplitter(wholeRows);
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::SetQuantileLevels(const std::vector<double> & levels)
{
  if (levels != m_QuantileLevels)
  {
    m_QuantileLevels = levels;
    this->Modified();
  }
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::Update()
{
  m_Figures = Figures{};
  try
  {
    Superclass::Update();
  }
  catch (...)
  {
    // Where an input fails, the superclass leaves the pipeline marked as being updated.
    this->ResetPipeline();
    throw;
  }
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::VerifyPreconditions() const
{
  Superclass::VerifyPreconditions();
  if (!std::isfinite(m_Peak) || m_Peak < 0.0)
  {
    itkExceptionMacro("The peak must be finite and positive, or 0 for the range of the reference; it is " << m_Peak
                                                                                                          << '.');
  }
  for (const double level : m_QuantileLevels)
  {
    if (!(level >= 0.0 && level <= 1.0))
    {
      itkExceptionMacro("The level of a quantile must lie in [0, 1]; it is " << level << '.');
    }
  }
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::VerifyInputInformation() const
{
  const RegionType & referenceRegion = this->GetReferenceImage()->GetLargestPossibleRegion();
  const RegionType & testRegion = this->GetTestImage()->GetLargestPossibleRegion();
  if (testRegion != referenceRegion)
  {
    itkExceptionMacro("The images differ in region: the reference has size "
                      << referenceRegion.GetSize() << " from index " << referenceRegion.GetIndex()
                      << ", the test image size " << testRegion.GetSize() << " from index " << testRegion.GetIndex()
                      << '.');
  }
  if (referenceRegion.GetNumberOfPixels() == 0)
  {
    itkExceptionMacro("The images have no voxels.");
  }
  Superclass::VerifyInputInformation();
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::BeforeStreamedGenerateData()
{
  Superclass::BeforeStreamedGenerateData();
  m_Sums = RowSummary{};
  m_ErrorQuantiles = RadixQuantiles(m_QuantileLevels);
  m_NumberOfVisitedVoxels = 0;
  for (unsigned int axis = 0; axis < ImageDimension; ++axis)
  {
    m_DifferenceWeights[axis] = m_UseImageSpacing ? 1.0 / this->GetReferenceImage()->GetSpacing()[axis] : 1.0;
  }
}

template <typename TReferenceImage, typename TTestImage>
unsigned int
ImageFidelityCalculator<TReferenceImage, TTestImage>::GetNumberOfPieces()
{
  return this->GetRegionSplitter()->GetNumberOfSplits(this->GetReferenceImage()->GetLargestPossibleRegion(),
                                                      this->GetNumberOfStreamDivisions());
}

template <typename TReferenceImage, typename TTestImage>
unsigned int
ImageFidelityCalculator<TReferenceImage, TTestImage>::GetNumberOfInputRequestedRegions()
{
  return RadixQuantiles::NumberOfPasses * this->GetNumberOfPieces();
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::GenerateNthInputRequestedRegion(unsigned int number)
{
  const RegionType   image = this->GetReferenceImage()->GetLargestPossibleRegion();
  const unsigned int numberOfPieces = this->GetNumberOfPieces();
  m_Pass = number / numberOfPieces;
  m_Piece = image;
  this->GetRegionSplitter()->GetSplit(number % numberOfPieces, numberOfPieces, m_Piece);

  RegionType request = m_Piece;
  for (unsigned int axis = 1; axis < ImageDimension; ++axis)
  {
    request.SetSize(axis, m_Piece.GetSize(axis) + 1); // for the forward differences
  }
  request.Crop(image);
  const_cast<ReferenceImageType *>(this->GetReferenceImage())->SetRequestedRegion(request);
  const_cast<TestImageType *>(this->GetTestImage())->SetRequestedRegion(request);
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::StreamedGenerateData(unsigned int number)
{
  const SizeValueType numberOfRows = m_Piece.GetNumberOfPixels() / m_Piece.GetSize(0);
  m_RowSummaries.assign(m_Pass == 0 ? numberOfRows : 0, RowSummary{});
  this->GetMultiThreader()->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
  this->GetMultiThreader()->template ParallelizeImageRegionRestrictDirection<ImageDimension>(
    0, m_Piece, [this](const RegionType & region) { this->ThreadedStreamedGenerateData(region); }, nullptr);
  for (const RowSummary & row : m_RowSummaries)
  {
    m_Sums.Append(row);
  }
  if ((number + 1) % this->GetNumberOfPieces() == 0)
  {
    this->FinishPass();
  }
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::ThreadedStreamedGenerateData(const RegionType & region)
{
  Workspace  workspace(region.GetSize(0), m_ErrorQuantiles.MakeCounts());
  RegionType firstVoxels = region;
  firstVoxels.SetSize(0, 1);
  ImageRegionConstIteratorWithIndex<ReferenceImageType> row(this->GetReferenceImage(), firstVoxels);
  for (; !row.IsAtEnd(); ++row)
  {
    const IndexType start = row.GetIndex();
    this->LoadRowPair(start, workspace.row);
    if (m_Pass == 0)
    {
      m_RowSummaries[this->GetRowNumber(start)] = this->SummarizeRow(start, workspace);
    }
    this->CountErrors(workspace);
  }

  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_ErrorQuantiles.Merge(workspace.counts);
  m_NumberOfVisitedVoxels += region.GetNumberOfPixels();
}

template <typename TReferenceImage, typename TTestImage>
SizeValueType
ImageFidelityCalculator<TReferenceImage, TTestImage>::GetRowNumber(const IndexType & start) const
{
  SizeValueType number = 0;
  for (unsigned int axis = ImageDimension - 1; axis > 0; --axis)
  {
    number = number * m_Piece.GetSize(axis) + static_cast<SizeValueType>(start[axis] - m_Piece.GetIndex(axis));
  }
  return number;
}

template <typename TReferenceImage, typename TTestImage>
template <typename TImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::LoadRow(const TImage *        image,
                                                              const IndexType &     start,
                                                              std::vector<double> & row)
{
  RegionType region;
  for (unsigned int axis = 0; axis < ImageDimension; ++axis)
  {
    region.SetIndex(axis, start[axis]);
    region.SetSize(axis, axis == 0 ? row.size() : 1);
  }
  ImageScanlineConstIterator<TImage> voxel(image, region);
  for (double & value : row)
  {
    value = static_cast<double>(voxel.Get());
    ++voxel;
  }
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::LoadRowPair(const IndexType & start, RowPair & row) const
{
  LoadRow(this->GetReferenceImage(), start, row.reference);
  LoadRow(this->GetTestImage(), start, row.test);
  for (SizeValueType i = 0; i < row.test.size(); ++i)
  {
    const bool isCompared = std::isfinite(row.reference[i]) && std::isfinite(row.test[i]);
    row.reference[i] = isCompared ? row.reference[i] : NaN;
    row.test[i] = isCompared ? row.test[i] : NaN;
  }
}

template <typename TReferenceImage, typename TTestImage>
auto
ImageFidelityCalculator<TReferenceImage, TTestImage>::SummarizeRow(const IndexType & start, Workspace & workspace) const
  -> RowSummary
{
  RowSummary summary;
  for (SizeValueType i = 0; i < workspace.row.test.size(); ++i)
  {
    if (!std::isnan(workspace.row.reference[i]))
    {
      summary.AddVoxel(workspace.row.reference[i], workspace.row.test[i]);
    }
  }
  this->ComputeSquaredGradients(start, workspace);
  summary.reference.totalVariation = Detail::SumOfRoots(workspace.squaredGradient.reference);
  summary.test.totalVariation = Detail::SumOfRoots(workspace.squaredGradient.test);
  return summary;
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::ComputeSquaredGradients(const IndexType & start,
                                                                              Workspace &       workspace) const
{
  RowPair &           gradient = workspace.squaredGradient;
  const RowPair &     row = workspace.row;
  const SizeValueType length = row.test.size();
  std::fill(gradient.reference.begin(), gradient.reference.end(), 0.0);
  std::fill(gradient.test.begin(), gradient.test.end(), 0.0);
  Detail::AddSquaredDifferences(
    row.reference, row.reference.data() + 1, length - 1, m_DifferenceWeights[0], gradient.reference);
  Detail::AddSquaredDifferences(row.test, row.test.data() + 1, length - 1, m_DifferenceWeights[0], gradient.test);

  const RegionType & image = this->GetReferenceImage()->GetLargestPossibleRegion();
  for (unsigned int axis = 1; axis < ImageDimension; ++axis)
  {
    IndexType next = start;
    ++next[axis];
    if (image.IsInside(next))
    {
      const RowPair & nextRow = workspace.nextRow;
      this->LoadRowPair(next, workspace.nextRow);
      Detail::AddSquaredDifferences(
        row.reference, nextRow.reference.data(), length, m_DifferenceWeights[axis], gradient.reference);
      Detail::AddSquaredDifferences(row.test, nextRow.test.data(), length, m_DifferenceWeights[axis], gradient.test);
    }
  }
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::CountErrors(Workspace & workspace) const
{
  for (SizeValueType i = 0; i < workspace.row.test.size(); ++i)
  {
    const double error = std::abs(workspace.row.test[i] - workspace.row.reference[i]);
    if (!std::isnan(error))
    {
      m_ErrorQuantiles.Count(error, workspace.counts);
    }
  }
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::FinishPass()
{
  // An exception in a thread, lack of memory for instance, is lost in some versions of ITK.
  const SizeValueType numberOfVoxels = this->GetReferenceImage()->GetLargestPossibleRegion().GetNumberOfPixels();
  if (m_NumberOfVisitedVoxels != numberOfVoxels)
  {
    itkExceptionMacro("Only " << m_NumberOfVisitedVoxels << " of " << numberOfVoxels << " voxels could be compared.");
  }
  m_NumberOfVisitedVoxels = 0;
  if (m_Pass == 0)
  {
    this->VerifySums();
  }
  m_ErrorQuantiles.FinishPass();
  if (m_Pass + 1 == RadixQuantiles::NumberOfPasses)
  {
    this->MakeFigures();
  }
}

template <typename TReferenceImage, typename TTestImage>
double
ImageFidelityCalculator<TReferenceImage, TTestImage>::ComputePeak() const
{
  return m_Peak > 0.0 ? m_Peak : m_Sums.reference.maximum - m_Sums.reference.minimum;
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::VerifySums() const
{
  if (m_Sums.numberOfComparedVoxels == 0)
  {
    itkExceptionMacro("There is no voxel at which both images are finite.");
  }
  if (this->ComputePeak() == 0.0)
  {
    itkExceptionMacro("The reference is constant, so its range cannot serve as the peak: set the peak.");
  }
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::MakeFigures()
{
  Figures figures;
  figures.numberOfComparedVoxels = m_Sums.numberOfComparedVoxels;
  figures.numberOfExcludedVoxels =
    this->GetReferenceImage()->GetLargestPossibleRegion().GetNumberOfPixels() - m_Sums.numberOfComparedVoxels;
  figures.peak = this->ComputePeak();
  const double meanSquaredError = m_Sums.squaredError / static_cast<double>(m_Sums.numberOfComparedVoxels);
  figures.peakSignalToNoiseRatio = 20.0 * std::log10(figures.peak / std::sqrt(meanSquaredError));
  figures.relativeL2Error = std::sqrt(m_Sums.squaredError) / std::sqrt(m_Sums.squaredReference);
  figures.relativeErrorQuantiles = m_ErrorQuantiles.GetQuantiles();
  for (double & quantile : figures.relativeErrorQuantiles)
  {
    quantile /= figures.peak;
  }
  figures.reference = m_Sums.reference;
  figures.test = m_Sums.test;
  const double voxelVolume = m_UseImageSpacing ? this->ComputeVoxelVolume() : 1.0;
  figures.reference.totalVariation *= voxelVolume;
  figures.test.totalVariation *= voxelVolume;
  m_Figures = figures;
}

template <typename TReferenceImage, typename TTestImage>
double
ImageFidelityCalculator<TReferenceImage, TTestImage>::ComputeVoxelVolume() const
{
  double volume = 1.0;
  for (unsigned int axis = 0; axis < ImageDimension; ++axis)
  {
    volume *= this->GetReferenceImage()->GetSpacing()[axis];
  }
  return volume;
}

template <typename TReferenceImage, typename TTestImage>
void
ImageFidelityCalculator<TReferenceImage, TTestImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Peak: " << m_Peak << std::endl;
  os << indent << "QuantileLevels:";
  for (const double level : m_QuantileLevels)
  {
    os << ' ' << level;
  }
  os << std::endl;
  os << indent << "UseImageSpacing: " << (m_UseImageSpacing ? "On" : "Off") << std::endl;
  os << indent << "EffectivePeak: " << m_Figures.peak << std::endl;
  os << indent << "PeakSignalToNoiseRatio: " << m_Figures.peakSignalToNoiseRatio << std::endl;
  os << indent << "RelativeL2Error: " << m_Figures.relativeL2Error << std::endl;
  os << indent << "RelativeTotalVariation: " << this->GetRelativeTotalVariation() << std::endl;
  os << indent << "NumberOfComparedVoxels: " << m_Figures.numberOfComparedVoxels << std::endl;
  os << indent << "NumberOfExcludedVoxels: " << m_Figures.numberOfExcludedVoxels << std::endl;
}
} // end namespace itk

#endif
