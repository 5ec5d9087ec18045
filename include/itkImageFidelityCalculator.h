// SPDX-License-Identifier: Apache-2.0
#ifndef itkImageFidelityCalculator_h
#define itkImageFidelityCalculator_h

#include "itkImageFidelitySums.h"
#include "itkImageSink.h"
#include "itkRadixQuantiles.h"

#include <limits>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

namespace itk
{
/** \class ImageFidelityCalculator
 * \brief Compares a test image with a reference: PSNR, relative L2 error, quantiles of the error, total variation.
 *
 * With \f$r\f$ the reference, \f$t\f$ the test image, \f$n\f$ the number of voxels and \f$P\f$ the peak (the range of
 * the reference, \f$\max r - \min r\f$, unless SetPeak() gives another one):
 * - peak signal-to-noise ratio, in dB: \f$10 \log_{10} \left(P^2 / \frac1n \sum (t - r)^2\right)\f$,
 *   infinite where the images are equal;
 * - relative L2 error, a fraction: \f$\sqrt{\sum (t - r)^2} / \sqrt{\sum r^2}\f$;
 * - quantiles of the relative error, fractions: of \f$|t - r| / P\f$ over all voxels. They are exact, and interpolated
 *   linearly between neighbours in sorted order (see RadixQuantiles);
 * - total variation of each image: \f$\sum_x \sqrt{\sum_w (f(x + e_w) - f(x))^2}\f$ over all axes \f$w\f$, a difference
 *   that leads out of the image being zero. With UseImageSpacingOn() every difference is divided by the spacing along
 *   its axis and the sum multiplied by the volume of a voxel: the integral of the gradient's magnitude;
 * - relative total variation, a fraction: that of the test image divided by that of the reference;
 * - minimum and maximum of each image.
 *
 * All is computed in double; 64-bit integers beyond 2^53 are rounded to it first. Divisions by zero and overflow
 * follow IEEE 754: the relative L2 error of a reference of zeros and the relative total variation of a constant one are
 * infinite or NaN.
 *
 * A voxel is excluded where either image is not finite. It takes no part in any of the figures above, and a difference
 * from or to it counts as zero in both images. GetNumberOfExcludedVoxels() says how many there are.
 *
 * The images may have different scalar pixel types. They must have the same largest possible region and occupy the same
 * space within the coordinate and direction tolerances of ImageSink. Update() throws an itk::ExceptionObject where they
 * do not, where no voxel is left to compare, and where the reference is constant and no peak is set.
 * Before the first successful Update() every figure is NaN.
 *
 * The inputs are read in RadixQuantiles::NumberOfPasses passes, each of NumberOfStreamDivisions pieces of whole rows
 * (a 1-D image is one row, and one piece), with one voxel more on the high sides of each piece: a pipeline upstream
 * that has to stream is executed as often. Sums are taken along each row and then from row to row, so the result
 * depends neither on the number of threads nor on the number of pieces.
 *
 * \ingroup NonOscillatorySubdivision
 */
template <typename TReferenceImage, typename TTestImage = TReferenceImage>
class ITK_TEMPLATE_EXPORT ImageFidelityCalculator : public ImageSink<TReferenceImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(ImageFidelityCalculator);

  using Self = ImageFidelityCalculator;
  using Superclass = ImageSink<TReferenceImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using ReferenceImageType = TReferenceImage;
  using TestImageType = TTestImage;
  using RegionType = typename TReferenceImage::RegionType;
  using IndexType = typename TReferenceImage::IndexType;

  static constexpr unsigned int ImageDimension = TReferenceImage::ImageDimension;

  static_assert(TTestImage::ImageDimension == ImageDimension, "Both images must have the same dimension.");
  static_assert(std::is_arithmetic<typename TReferenceImage::PixelType>::value &&
                  std::is_arithmetic<typename TTestImage::PixelType>::value,
                "Both images must have scalar pixels.");

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "ImageFidelityCalculator";
  }

  /** The image that is compared with, the primary input. */
  itkSetInputMacro(ReferenceImage, ReferenceImageType);
  itkGetInputMacro(ReferenceImage, ReferenceImageType);

  /** The image that is judged. */
  itkSetInputMacro(TestImage, TestImageType);
  itkGetInputMacro(TestImage, TestImageType);

  /** The peak \f$P\f$, finite and positive; 0, the default, stands for the range of the reference. */
  itkSetMacro(Peak, double);
  itkGetConstMacro(Peak, double);

  /** The levels, each in [0, 1], of the quantiles to compute. Default: 0.5 and 0.99. */
  void
  SetQuantileLevels(const std::vector<double> & levels);
  itkGetConstReferenceMacro(QuantileLevels, std::vector<double>);

  /** Whether the total variation is an integral in physical space. Default: false. */
  itkSetMacro(UseImageSpacing, bool);
  itkGetConstMacro(UseImageSpacing, bool);
  itkBooleanMacro(UseImageSpacing);

  // Public here; a using declaration would not be seen by the wrapping.
  void
  SetNumberOfStreamDivisions(const unsigned int n) override
  {
    Superclass::SetNumberOfStreamDivisions(n);
  }
  unsigned int
  GetNumberOfStreamDivisions() const override
  {
    return Superclass::GetNumberOfStreamDivisions();
  }

  /** Compares the images. After an exception the calculator can be used again. */
  void
  Update() override;

  /** The peak that the last Update() used. */
  double
  GetEffectivePeak() const
  {
    return m_Figures.peak;
  }

  /** In dB; infinite where the images are equal. */
  double
  GetPeakSignalToNoiseRatio() const
  {
    return m_Figures.peakSignalToNoiseRatio;
  }

  double
  GetRelativeL2Error() const
  {
    return m_Figures.relativeL2Error;
  }

  /** One quantile for each of the levels that the last Update() found set, in their order. */
  const std::vector<double> &
  GetRelativeErrorQuantiles() const
  {
    return m_Figures.relativeErrorQuantiles;
  }

  double
  GetReferenceTotalVariation() const
  {
    return m_Figures.reference.totalVariation;
  }
  double
  GetTestTotalVariation() const
  {
    return m_Figures.test.totalVariation;
  }
  /** That of the test image by that of the reference; 1 where neither varies. */
  double
  GetRelativeTotalVariation() const
  {
    return GetRelativeTotalVariation(this->GetReferenceTotalVariation(), this->GetTestTotalVariation());
  }
  static double
  GetRelativeTotalVariation(const double reference, const double test)
  {
    return reference == 0.0 && test == 0.0 ? 1.0 : test / reference;
  }

  double
  GetReferenceMinimum() const
  {
    return m_Figures.reference.minimum;
  }
  double
  GetReferenceMaximum() const
  {
    return m_Figures.reference.maximum;
  }
  double
  GetTestMinimum() const
  {
    return m_Figures.test.minimum;
  }
  double
  GetTestMaximum() const
  {
    return m_Figures.test.maximum;
  }

  SizeValueType
  GetNumberOfComparedVoxels() const
  {
    return m_Figures.numberOfComparedVoxels;
  }
  SizeValueType
  GetNumberOfExcludedVoxels() const
  {
    return m_Figures.numberOfExcludedVoxels;
  }

protected:
  ImageFidelityCalculator();
  ~ImageFidelityCalculator() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() const override;

  /** Besides the geometry, which the superclass verifies, the regions must agree. */
  void
  VerifyInputInformation() const override;

  void
  BeforeStreamedGenerateData() override;

  /** The pieces of all passes: each pass asks for the whole images once more. */
  unsigned int
  GetNumberOfInputRequestedRegions() override;

  void
  GenerateNthInputRequestedRegion(unsigned int number) override;

  void
  StreamedGenerateData(unsigned int number) override;

  /** Counts and sums one part of the piece, all rows of which are whole. Called by several threads. */
  void
  ThreadedStreamedGenerateData(const RegionType & region) override;

private:
  static constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

  using ImageSummary = Detail::ImageFidelityImageSummary;
  using RowSummary = Detail::ImageFidelityRowSummary;

  /** The result. */
  struct Figures
  {
    ImageSummary        reference{ NaN, NaN, NaN };
    ImageSummary        test{ NaN, NaN, NaN };
    double              peak{ NaN };
    double              peakSignalToNoiseRatio{ NaN };
    double              relativeL2Error{ NaN };
    std::vector<double> relativeErrorQuantiles{};
    SizeValueType       numberOfComparedVoxels{ 0 };
    SizeValueType       numberOfExcludedVoxels{ 0 };
  };

  /** A number for each voxel of a row of either image. */
  struct RowPair
  {
    explicit RowPair(SizeValueType length)
      : reference(length)
      , test(length)
    {}

    std::vector<double> reference;
    std::vector<double> test;
  };

  /** Memory that a thread uses for row after row. */
  struct Workspace
  {
    Workspace(SizeValueType length, RadixQuantiles::Counts zeros)
      : row(length)
      , nextRow(length)
      , squaredGradient(length)
      , counts(std::move(zeros))
    {}

    RowPair                row;
    RowPair                nextRow;
    RowPair                squaredGradient;
    RadixQuantiles::Counts counts;
  };

  unsigned int
  GetNumberOfPieces();

  /** The number of a row within the current piece. */
  SizeValueType
  GetRowNumber(const IndexType & start) const;

  template <typename TImage>
  static void
  LoadRow(const TImage * image, const IndexType & start, std::vector<double> & row);

  /** Loads the row from both images, with NaN in both where a voxel is excluded. */
  void
  LoadRowPair(const IndexType & start, RowPair & row) const;

  /** Summarizes the row that is loaded. */
  RowSummary
  SummarizeRow(const IndexType & start, Workspace & workspace) const;

  /** Fills workspace.squaredGradient for the row that is loaded. */
  void
  ComputeSquaredGradients(const IndexType & start, Workspace & workspace) const;

  /** Shows the errors of the row that is loaded to the quantiles. */
  void
  CountErrors(Workspace & workspace) const;

  void
  FinishPass();

  double
  ComputePeak() const;

  double
  ComputeVoxelVolume() const;

  /** Throws where the sums of the first pass do not allow a comparison. */
  void
  VerifySums() const;

  void
  MakeFigures();

  double                  m_Peak{ 0.0 };
  std::vector<double>     m_QuantileLevels{ 0.5, 0.99 };
  bool                    m_UseImageSpacing{ false };
  Figures                 m_Figures{};
  RowSummary              m_Sums{};
  RadixQuantiles          m_ErrorQuantiles{};
  unsigned int            m_Pass{ 0 };
  RegionType              m_Piece{};
  std::vector<RowSummary> m_RowSummaries{};
  SizeValueType           m_NumberOfVisitedVoxels{ 0 };
  double                  m_DifferenceWeights[ImageDimension]{};
  std::mutex              m_Mutex{};
};
} // end namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkImageFidelityCalculator.hxx"
#endif

#endif
