// SPDX-License-Identifier: Apache-2.0
#ifndef Subdivide_hxx
#define Subdivide_hxx

#include "BoundaryCondition.h"
#include "FilterOptions.h"
#include "MemoryPlan.h"
#include "Subdivide.h"

#include "itkCommand.h"
#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkImageSeriesReader.h"
#include "itkNonOscillatorySubdivisionImageFilter.h"
#include "itkVectorImage.h"

#include <type_traits>

/** Whether the filter computes with double where a pixel has components of this type. */
template <typename TComponent>
inline constexpr bool NeedsDouble = sizeof(TComponent) > 2 && !std::is_same_v<TComponent, float>;

template <typename TImage>
typename itk::ImageSource<TImage>::Pointer
MakeReader(const InputImage & input)
{
  if (input.FileNames.size() > 1)
  {
    const auto reader = itk::ImageSeriesReader<TImage>::New();
    reader->SetImageIO(input.ImageIO);
    reader->SetFileNames(input.FileNames);
    return reader.GetPointer();
  }
  const auto reader = itk::ImageFileReader<TImage>::New();
  reader->SetImageIO(input.ImageIO);
  reader->SetFileName(input.FileNames.front());
  reader->SetUseStreaming(input.CanStream);
  return reader.GetPointer();
}

/** The grid of an image as its file has it, with as many axes as the input has. */
template <typename TImage>
ImageGrid
GetGrid(const TImage & image, unsigned int dimension)
{
  const auto &               region = image.GetLargestPossibleRegion();
  typename TImage::PointType origin;
  image.TransformIndexToPhysicalPoint(region.GetIndex(), origin);
  ImageGrid grid;
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    grid.Size.push_back(region.GetSize(axis));
    grid.Spacing.push_back(image.GetSpacing()[axis]);
    grid.Origin.push_back(origin[axis]);
    grid.Directions.emplace_back();
    for (unsigned int row = 0; row < dimension; ++row)
    {
      grid.Directions.back().push_back(image.GetDirection()[row][axis]);
    }
  }
  return grid;
}

/** A reader and the filter, run for one piece of the output after the other.
 * \tparam TInputImage, TOutputImage images or vector images with four axes */
template <typename TInputImage, typename TOutputImage>
class SubdivisionPipeline
{
public:
  explicit SubdivisionPipeline(const SubdivisionJob & job)
    : m_Job(job)
    , m_Reader(MakeReader<TInputImage>(job.Input))
    , m_Boundary(MakeBoundaryCondition<TInputImage>(job.Options.Boundary, job.Input.NumberOfComponents))
  {
    m_Filter->SetInput(m_Reader->GetOutput());
    m_Filter->SetScheme(GetScheme(job.Options));
    m_Filter->SetTension(job.Options.Tension);
    m_Filter->SetBoundaryCondition(m_Boundary.get());
    m_Filter->SetSubdividedAxes(GetSubdividedAxes(job.Options, job.Input.Dimension));
  }

  SubdivisionReport
  Run()
  {
    m_Filter->UpdateOutputInformation();
    SubdivisionReport report;
    report.InputGrid = GetGrid(*m_Reader->GetOutput(), m_Job.Input.Dimension);
    report.OutputGrid = GetGrid(*m_Filter->GetOutput(), m_Job.Input.Dimension);
    m_Job.Output.Begin(report.OutputGrid, m_Job.OutputComponent, m_Job.Input);

    const std::vector<ImageRegion> pieces = this->PlanPieces();
    report.NumberOfPieces = pieces.size();
    this->ObserveProgress(pieces.size());
    for (; m_Piece < pieces.size(); ++m_Piece)
    {
      this->Compute(pieces[m_Piece]);
      this->IncludeInput(report.InputRange);
      const void * const values = this->GetOutputValues(report.OutputRange);
      m_Reader->GetOutput()->SetReleaseDataFlag(pieces.size() == 1);
      this->Write(pieces[m_Piece], values);
    }
    return report;
  }

private:
  using FilterType = itk::NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>;
  using InputComponentType = typename TInputImage::InternalPixelType;
  using OutputComponentType = typename TOutputImage::InternalPixelType;

  bool
  IsConverted() const
  {
    return m_Job.OutputComponent != PixelComponentOf<OutputComponentType>;
  }

  std::vector<ImageRegion>
  PlanPieces()
  {
    MemoryPlan plan;
    plan.Whole = m_Filter->GetOutput()->GetLargestPossibleRegion();
    plan.OutputStreams = m_Job.Output.CanStream();
    plan.NumberOfThreads = m_Filter->GetMultiThreader()->GetMaximumNumberOfThreads();
    plan.GetPieceBytes = [this](const ImageRegion & piece) { return this->GetPieceBytes(piece); };
    return plan.Split(m_Job.Options);
  }

  /** Bytes that a piece needs, the scratch memory of the filter left out. */
  PieceBytes
  GetPieceBytes(const ImageRegion & piece)
  {
    auto * const output = m_Filter->GetOutput();
    output->SetRequestedRegion(piece);
    output->PropagateRequestedRegion();
    const std::uint64_t components = m_Job.Input.NumberOfComponents;
    const std::uint64_t inputValues = components * m_Reader->GetOutput()->GetRequestedRegion().GetNumberOfPixels();
    const std::uint64_t outputValues = components * piece.GetNumberOfPixels();
    const std::uint64_t fileBytes = outputValues * GetPixelComponentSize(m_Job.OutputComponent);

    PieceBytes bytes;
    bytes.Kept = inputValues * sizeof(InputComponentType) + outputValues * sizeof(OutputComponentType) +
                 (this->IsConverted() ? fileBytes : 0);
    // Readers of formats that do not stream may hold a copy, and ITK's reader does for multi-component pixels.
    const bool isCopied = !m_Job.Input.CanStream || components > 1;
    bytes.Reader = isCopied ? inputValues * sizeof(InputComponentType) : 0;
    bytes.Writer = m_Job.Output.GetWriterBytes(fileBytes);
    return bytes;
  }

  void
  ObserveProgress(std::size_t numberOfPieces)
  {
    const auto command = itk::SimpleMemberCommand<SubdivisionPipeline>::New();
    command->SetCallbackFunction(this, &SubdivisionPipeline::ShowProgress);
    m_Filter->AddObserver(itk::ProgressEvent(), command);
    m_NumberOfPieces = numberOfPieces;
  }

  void
  ShowProgress()
  {
    // The last percents are for the writer, which does not tell.
    const double inPiece = 0.98 * static_cast<double>(m_Filter->GetProgress());
    m_Job.Progress.Update((static_cast<double>(m_Piece) + inPiece) / static_cast<double>(m_NumberOfPieces));
  }

  void
  Compute(const ImageRegion & piece)
  {
    auto * const output = m_Filter->GetOutput();
    output->SetRequestedRegion(piece);
    output->PropagateRequestedRegion();
    ReleaseIfTooSmall(*m_Reader->GetOutput(), m_Job.Input.NumberOfComponents);
    ReleaseIfTooSmall(*output, m_Job.Input.NumberOfComponents);
    output->UpdateOutputData();
  }

  /** Memory is used again for the next piece, but a container that must grow would first hold the old and the new. */
  template <typename TImage>
  static void
  ReleaseIfTooSmall(TImage & image, std::size_t components)
  {
    if (image.GetPixelContainer()->Capacity() < image.GetRequestedRegion().GetNumberOfPixels() * components)
    {
      image.ReleaseData();
    }
  }

  void
  IncludeInput(PixelRange & range)
  {
    const auto & input = *m_Reader->GetOutput();
    if (input.GetBufferedRegion() != m_InputRegion)
    {
      m_InputRegion = input.GetBufferedRegion();
      range.Include(PixelComponentOf<InputComponentType>,
                    input.GetBufferPointer(),
                    m_InputRegion.GetNumberOfPixels() * m_Job.Input.NumberOfComponents);
    }
  }

  /** The computed piece in the type of the output file. */
  const void *
  GetOutputValues(PixelRange & range)
  {
    const auto &      output = *m_Filter->GetOutput();
    const std::size_t count = output.GetBufferedRegion().GetNumberOfPixels() * m_Job.Input.NumberOfComponents;
    const void *      values = output.GetBufferPointer();
    if constexpr (std::is_floating_point_v<OutputComponentType>)
    {
      if (this->IsConverted())
      {
        m_Converted.resize(count * GetPixelComponentSize(m_Job.OutputComponent));
        ConvertReals(output.GetBufferPointer(), count, m_Job.OutputComponent, m_Converted.data());
        values = m_Converted.data();
      }
    }
    range.Include(m_Job.OutputComponent, values, count);
    return values;
  }

  void
  Write(const ImageRegion & piece, const void * values)
  {
    const ImageRegion & whole = m_Filter->GetOutput()->GetLargestPossibleRegion();
    itk::ImageIORegion  region(m_Job.Input.Dimension);
    for (unsigned int axis = 0; axis < m_Job.Input.Dimension; ++axis)
    {
      region.SetIndex(axis, piece.GetIndex(axis) - whole.GetIndex(axis));
      region.SetSize(axis, piece.GetSize(axis));
    }
    m_Job.Output.Write(region, values);
  }

  const SubdivisionJob &                                    m_Job;
  typename itk::ImageSource<TInputImage>::Pointer           m_Reader;
  std::unique_ptr<itk::ImageBoundaryCondition<TInputImage>> m_Boundary;
  typename FilterType::Pointer                              m_Filter = FilterType::New();
  std::size_t                                               m_Piece = 0;
  std::size_t                                               m_NumberOfPieces = 1;
  ImageRegion                                               m_InputRegion;
  std::vector<char>                                         m_Converted;
};

/** The filter writes the input's type or the real type that it computes with, and from there other types are converted
 * to: the number of filters to compile grows with the number of types, not with its square. */
template <typename TComponent>
SubdivisionReport
Subdivide(const SubdivisionJob & job)
{
  const auto run = [&job](auto outType) {
    using OutType = decltype(outType);
    using itk::Image;
    using itk::VectorImage;
    return job.Input.NumberOfComponents == 1
             ? SubdivisionPipeline<Image<TComponent, Axes>, Image<OutType, Axes>>(job).Run()
             : SubdivisionPipeline<VectorImage<TComponent, Axes>, VectorImage<OutType, Axes>>(job).Run();
  };
  if (job.OutputComponent == PixelComponentOf<TComponent>)
  {
    return run(TComponent{});
  }
  if constexpr (!NeedsDouble<TComponent>)
  {
    if (!WithComponentType(job.OutputComponent, [](auto type) { return NeedsDouble<decltype(type)>; }))
    {
      return run(float{});
    }
  }
  return run(double{});
}

#endif
